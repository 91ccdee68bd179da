/// From the tags of nodes or elements to their positions.
#pragma once

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
    /// there is one; then the index is of no use. Precondition: fewer than 2^31, none
    /// negative.
    explicit TagIndex(std::span<const std::int64_t> tags, std::optional<std::size_t>& first_twice);
    TagIndex() = default;

    /// The position of a tag, or -1.
    Mesh::Index find(std::int64_t tag) const {
        const std::uint64_t offset = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(low_);
        if (offset >= span_) return -1;
        if (in_sequence_) return static_cast<Mesh::Index>(offset);
        if (!table_.empty()) return table_[offset];
        return search(tag);
    }

    /// The tags are 1, 2, 3, ...
    bool from_one() const { return in_sequence_ && low_ == 1; }

private:
    Mesh::Index search(std::int64_t tag) const;

    std::int64_t low_ = 0;
    std::uint64_t span_ = 0;  ///< highest - lowest + 1
    bool in_sequence_ = false;
    std::vector<Mesh::Index> table_;                              ///< where it is not much larger than the tags
    std::vector<std::pair<std::int64_t, Mesh::Index>> in_order_;  ///< by tag, where it would be
};

}  // namespace barycert::io
