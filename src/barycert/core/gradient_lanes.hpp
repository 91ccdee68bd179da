/// Internal: gradients on SIMD lanes, dispatched at run time as lanes.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "barycert/simplex.hpp"

namespace barycert::lanes {

/// Cells in structure of arrays: vertices[d * i + k][j] is coordinate k of vertex i of cell j, values[n * c + i][j]
/// component c at vertex i; component k of the gradient of c goes to out[d * c + k][j]. Returns how many cells are left
/// undecided, their numbers, ascending, in undecided[0 ...], which has room for `count`. Preconditions: triangle or
/// tetrahedron; every array has room for a multiple of 8 cells, or count is 1.
std::size_t gradients(Simplex s, const double* const* vertices, const double* const* values, int components,
                      std::size_t count, double* const* out, std::uint32_t* undecided);

}  // namespace barycert::lanes
