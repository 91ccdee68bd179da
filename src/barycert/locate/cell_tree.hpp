/// Boxes of cells in a tree, to find every cell that may hold a point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/locate/box_groups.hpp"
#include "barycert/locate/cell_index.hpp"

namespace barycert::locate {

/// In the order of their places.
using CellTree = BoxGroups;

/// On the threads of the calling arena.
CellTree make_cell_tree(const CellIndex& index);

/// The box of `count` points with as many coordinates as the index has dimensions.
CellBox box_of(const CellIndex& index, const double* const* points, std::size_t count);

/// The box of a cell.
CellBox box_of(const CellIndex& index, Place cell);

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
