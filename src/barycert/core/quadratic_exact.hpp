/// Internal: the last tier of quadratic interpolation, in integers.
#pragma once

#include "barycert/simplex.hpp"

namespace barycert {

/// Values of the fields whose component c at node i (mid-edge nodes behind corners) is values[nodes * c + i], correctly
/// rounded, to out[0 ... components - 1]. False, and `out` untouched, if the cell is degenerate. Preconditions:
/// triangle or tetrahedron, everything finite.
bool exact_quadratic(Simplex simplex, const double* vertices, const double* point, const double* values, int components,
                     double* out);

}  // namespace barycert
