/// Internal: quadratic interpolation on SIMD lanes, dispatched at run time as lanes.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "barycert/core/lanes.hpp"
#include "barycert/simplex.hpp"

namespace barycert::lanes {

/// values[m * c + i][j] is component c at node i of case j, m the nodes of a cell, mid-edge nodes behind corners; the
/// value of component c of case j goes to out[c][j]. Returns how many cases are left undecided, their numbers,
/// ascending, in undecided[0 ...], which has room for `cases.count`. Preconditions: triangle or tetrahedron; every
/// array has room for a multiple of 8 cases, or the count is 1.
std::size_t quadratic_values(Simplex s, const Cases& cases, const double* const* values, int components,
                             double* const* out, std::uint32_t* undecided);

/// The same by the plain formula in double: nothing is proved, everything decided.
void plain_quadratic_values(Simplex s, const Cases& cases, const double* const* values, int components,
                            double* const* out);

}  // namespace barycert::lanes
