/// From the tags of nodes or elements to their positions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::io {

class TagIndex {
public:
    /// Tags in any order, with gaps of any size. `first_twice` gets the position of the first one that stood before, if
    /// there is one; then the index is of no use. Precondition: fewer than 2^31.
    TagIndex(std::span<const std::int64_t> tags, std::optional<std::size_t>& first_twice) {
        first_twice.reset();
        if (tags.empty()) return;
        const auto [low, high] = std::minmax_element(tags.begin(), tags.end());
        low_ = *low;
        span_ = offset_of(*high) + 1;
        std::size_t same = 0;
        while (same != tags.size() && offset_of(tags[same]) == same) ++same;
        if (same == tags.size()) return;
        if (span_ <= 8 * tags.size() + 1024) {
            table_.assign(span_, -1);
            for (std::size_t i = 0; i < tags.size() && !first_twice; ++i) {
                Mesh::Index& entry = table_[offset_of(tags[i])];
                if (entry != -1) first_twice = i;
                entry = static_cast<Mesh::Index>(i);
            }
            return;
        }
        in_order_.reserve(tags.size());
        for (std::size_t i = 0; i < tags.size(); ++i) in_order_.emplace_back(tags[i], static_cast<Mesh::Index>(i));
        std::sort(in_order_.begin(), in_order_.end());
        for (std::size_t i = 1; i < in_order_.size(); ++i) {
            const auto position = static_cast<std::size_t>(in_order_[i].second);
            if (in_order_[i].first == in_order_[i - 1].first)
                first_twice = std::min(first_twice.value_or(position), position);
        }
    }
    TagIndex() = default;

    /// The position of a tag, or -1.
    Mesh::Index find(std::int64_t tag) const {
        const std::uint64_t offset = offset_of(tag);
        if (offset >= span_) return -1;
        if (!table_.empty()) return table_[offset];
        return in_order_.empty() ? static_cast<Mesh::Index>(offset) : search(tag);
    }

private:
    std::uint64_t offset_of(std::int64_t tag) const {
        return static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(low_);
    }
    Mesh::Index search(std::int64_t tag) const {
        const auto found = std::lower_bound(in_order_.begin(), in_order_.end(), std::pair(tag, Mesh::Index{0}));
        return found != in_order_.end() && found->first == tag ? found->second : -1;
    }

    std::int64_t low_ = 0;
    std::uint64_t span_ = 0;                                      ///< highest - lowest + 1
    std::vector<Mesh::Index> table_;                              ///< where it is not much larger than the tags
    std::vector<std::pair<std::int64_t, Mesh::Index>> in_order_;  ///< by tag, where it would be; neither: in sequence
};

}  // namespace barycert::io
