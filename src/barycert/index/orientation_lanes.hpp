/// Exact orientations of many cells, on SIMD lanes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "barycert/index/cell_index.hpp"

namespace barycert::index {

/// out[i] = the sign of the volume of the cell at place first + i, for i < count: -1, 0 or 1. One determinant in double
/// with its bound; integers where that leaves it open.
void find_orientations(const CellIndex& index, std::size_t first, std::size_t count, std::int8_t* out);

}  // namespace barycert::index
