/// Boxes of cells in a tree, to find every cell that may hold a point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/index/box_groups.hpp"
#include "barycert/index/cell_index.hpp"

namespace barycert::index {

/// In the order of their places.
using CellTree = BoxGroups;

/// On the threads of the calling arena.
CellTree make_cell_tree(const CellIndex& index);

/// The box of `count` points with as many coordinates as the index has dimensions.
CellBox box_of(const CellIndex& index, const double* const* points, std::size_t count);

/// The box of a cell.
CellBox box_of(const CellIndex& index, Place cell);

}  // namespace barycert::index
