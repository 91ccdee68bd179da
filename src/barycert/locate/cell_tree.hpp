/// Boxes of cells in a tree, to find every cell that may hold a point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/locate/buffer.hpp"
#include "barycert/locate/cell_index.hpp"

namespace barycert::locate {

/// Eight boxes in the whole numbers of the quantizer; in 2D the third axis is zero. A box that is none has low > high.
struct alignas(64) BoxGroup {
    std::array<std::array<std::int32_t, 8>, 3> low, high;
};

/// Cells in the order of space, eight to a group; groups eight to a group above, up to one.
class CellTree {
public:
    explicit CellTree(const CellIndex& index);

    std::size_t levels() const { return level_.size(); }
    /// By level from the cells up; box i of a level stands in group i / 8 at i % 8.
    const BoxGroup* level(std::size_t l) const { return groups_.data() + level_[l]; }
    std::size_t bytes() const { return groups_.bytes(); }

private:
    std::vector<std::size_t> level_;  ///< where each begins
    Buffer<BoxGroup> groups_;
};

struct PointRecord;

struct Candidate {
    std::uint32_t point;
    Place cell;
};

/// Appends each cell whose box holds points[i], for i = which[0 .. count), to `out`, point by point. Cells that are not
/// named do not hold the point. Points must lie in the box of the mesh.
void find_candidates(const CellIndex& index, const CellTree& tree, const PointRecord* points,
                     const std::uint32_t* which, std::size_t count, std::vector<Candidate>& out);

}  // namespace barycert::locate
