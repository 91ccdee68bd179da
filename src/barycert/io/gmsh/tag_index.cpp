#include "barycert/io/gmsh/tag_index.hpp"

#include <algorithm>

namespace barycert::io {
namespace {

bool in_sequence(std::span<const std::int64_t> tags) {
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (static_cast<std::uint64_t>(tags[i]) - static_cast<std::uint64_t>(tags[0]) != i) return false;
    }
    return true;
}

}  // namespace

TagIndex::TagIndex(std::span<const std::int64_t> tags, std::optional<std::size_t>& first_twice) {
    first_twice.reset();
    if (tags.empty()) return;
    const auto [low, high] = std::minmax_element(tags.begin(), tags.end());
    low_ = *low;
    const std::uint64_t range = static_cast<std::uint64_t>(*high) - static_cast<std::uint64_t>(*low);
    span_ = range + 1;
    in_sequence_ = in_sequence(tags);
    if (in_sequence_) return;
    if (span_ <= 8 * tags.size() + 1024) {
        table_.assign(span_, -1);
        for (std::size_t i = 0; i < tags.size(); ++i) {
            Mesh::Index& entry = table_[static_cast<std::uint64_t>(tags[i]) - static_cast<std::uint64_t>(low_)];
            if (entry != -1) {
                first_twice = i;
                return;
            }
            entry = static_cast<Mesh::Index>(i);
        }
        return;
    }
    in_order_.reserve(tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i) in_order_.emplace_back(tags[i], static_cast<Mesh::Index>(i));
    std::sort(in_order_.begin(), in_order_.end());
    for (std::size_t i = 1; i < in_order_.size(); ++i) {
        if (in_order_[i].first != in_order_[i - 1].first) continue;
        const auto position = static_cast<std::size_t>(in_order_[i].second);
        if (!first_twice || position < *first_twice) first_twice = position;
    }
}

Mesh::Index TagIndex::search(std::int64_t tag) const {
    const auto found = std::lower_bound(in_order_.begin(), in_order_.end(), tag,
                                        [](const auto& entry, std::int64_t t) { return entry.first < t; });
    return found != in_order_.end() && found->first == tag ? found->second : -1;
}

}  // namespace barycert::io
