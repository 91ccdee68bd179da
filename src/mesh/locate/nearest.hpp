/// The nearest point of a mesh: boxes of cells to find it from anywhere, and the search, with its work counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/locator.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/names.hpp"
#include "mesh/locate/near_feature.hpp"

namespace barycert::locate {

class MappedCells;

/// Boxes whose numbers are coordinates of nodes, unrounded: those of eight neighbouring cells, in the order of the
/// index, then of eight such boxes, up to one. Boxes of the cells themselves are made when they are asked for: 7 bytes
/// a cell in all. The whole numbers of CellTree would not do: from far away, a difference of 2^-31 of the mesh in depth
/// outweighs all that distinguishes cells sideways.
class NearestTree {
public:
    static constexpr std::size_t fan = 8;

    /// Without cells that have maps. Requires: there is a cell. Time O(cells).
    explicit NearestTree(const CellIndex& index, const MappedCells* mapped = nullptr);

    std::size_t levels() const { return begin_.size() - 1; }
    /// The number of boxes on a level; the lowest level is 0.
    std::size_t count(std::size_t level) const { return begin_[level + 1] - begin_[level]; }
    const Box& box(std::size_t level, std::size_t i) const { return boxes_[begin_[level] + i]; }
    std::size_t bytes() const { return boxes_.size() * sizeof(Box); }

private:
    std::vector<std::size_t> begin_;
    std::vector<Box> boxes_;
};

/// The cell at a place of the index.
NearCell near_cell(const CellIndex& index, std::size_t place);

/// How much a search looked at, for tests of its cost.
struct NearestWork {
    std::uint64_t boxes = 0;        ///< of groups of cells
    std::uint64_t cells = 0;        ///< of which corners were read
    std::uint64_t exact = 0;        ///< cells whose feature was found exactly
    std::uint64_t comparisons = 0;  ///< in integers
};

/// As Locator::nearest, of cells or triangles in space, without those that have maps. Requires: coordinates are
/// finite; there is a cell.
Nearest find_nearest(const CellIndex& index, const NearestTree& tree, const double* point, double limit,
                     NearestWork* work = nullptr, const MappedCells* mapped = nullptr);
/// The same of the cells at these places alone.
Nearest find_nearest_of(const CellIndex& index, std::span<const std::uint32_t> places, const double* point,
                        double limit);
Nearest find_nearest(const LocatorData& data, const double* point, double limit, NearestWork* work = nullptr);

}  // namespace barycert::locate
