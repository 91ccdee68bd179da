/// Gathering defects from several threads, in an order that does not depend on them.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "barycert/check.hpp"

namespace barycert::check {

/// DefectList of all problems, each with its count and its first places.
class DefectList {
public:
    explicit DefectList(std::size_t examples = 0) : examples_(examples), all_(defect_kind_count) {
        for (std::size_t i = 0; i < defect_kind_count; ++i) all_[i].kind = defect_texts[i].kind;
    }

    void add(DefectKind p, const DefectPlace& place, std::uint64_t count = 1) {
        Defect& f = of(p);
        f.count += count;
        if (f.places.size() < examples_) f.places.push_back(place);
    }
    void add_at_least(DefectKind p) { of(p).at_least = true; }
    void cause(DefectKind p) { of(p).cause = true; }
    void remedy(DefectKind p, std::string_view text) { of(p).better_remedy = text; }
    bool is_cause(DefectKind p) const { return all_[static_cast<std::size_t>(p)].cause; }

    /// Appends what another block of the same work found.
    void append(const DefectList& other) {
        for (std::size_t i = 0; i < defect_kind_count; ++i) {
            Defect& f = all_[i];
            const Defect& g = other.all_[i];
            f.count += g.count;
            f.at_least |= g.at_least;
            f.cause |= g.cause;
            const std::size_t room = std::min(examples_ - std::min(examples_, f.places.size()), g.places.size());
            f.places.insert(f.places.end(), g.places.begin(), g.places.begin() + static_cast<std::ptrdiff_t>(room));
        }
    }

    std::uint64_t count(DefectKind p) const { return all_[static_cast<std::size_t>(p)].count; }
    std::size_t examples() const { return examples_; }

    /// Those that occur; first those that break the certificate.
    std::vector<Defect> list() && {
        std::erase_if(all_, [](const Defect& f) { return f.count == 0; });
        std::stable_partition(all_.begin(), all_.end(), [](const Defect& f) { return f.breaks(); });
        return std::move(all_);
    }

private:
    Defect& of(DefectKind p) { return all_[static_cast<std::size_t>(p)]; }

    std::size_t examples_;
    std::vector<Defect> all_;
};

/// work(first, last, part) for blocks of [0, count), on all threads of the calling arena; then join(part) for each
/// block in order. `make` makes an empty part.
template <class Make, class Work, class Join>
void in_blocks(std::size_t count, std::size_t block, Make make, Work work, Join join) {
    const std::size_t blocks = (count + block - 1) / block;
    std::vector<decltype(make())> parts;
    parts.reserve(blocks);
    for (std::size_t i = 0; i < blocks; ++i) parts.push_back(make());
    tbb::parallel_for(std::size_t{0}, blocks,
                      [&](std::size_t i) { work(i * block, std::min(count, (i + 1) * block), parts[i]); });
    for (auto& part : parts) join(part);
}

/// The same in waves of a fixed number of blocks, for searches that may find more than anybody wants: when more()
/// returns false after a wave, nothing else is done. So the outcome does not depend on threads.
template <class Make, class Work, class Join, class More>
void in_waves(std::size_t count, std::size_t block, Make make, Work work, Join join, More more) {
    constexpr std::size_t blocks = 64;
    for (std::size_t from = 0; from < count; from += block * blocks) {
        in_blocks(
            std::min(count - from, block * blocks), block, make,
            [&](std::size_t first, std::size_t last, auto& part) { work(from + first, from + last, part); }, join);
        if (!more()) return;
    }
}

}  // namespace barycert::check
