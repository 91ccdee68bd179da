/// Quadratic interpolation on a straight-sided cell with nodes amid its edges, by the oracle: exact integers, rounded
/// once, nothing shared with core.
#pragma once

#include <span>

#include "barycert/core/simplex.hpp"

namespace barycert::exact {

/// sum l_i (2 l_i - 1) f_i + sum 4 l_i l_j f_ij with the exact weights l of the point, f = c.values at the corners and
/// `mids` on the edges 01 12 02 (triangle) or 01 12 02 03 13 23 (tetrahedron), correctly rounded; NaN if degenerate.
/// Preconditions: triangle or tetrahedron, everything finite, a value for each edge.
double quadratic_value(const Case& c, std::span<const double> mids);

}  // namespace barycert::exact
