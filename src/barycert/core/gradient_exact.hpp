/// Internal: the last tier of gradients, in integers.
#pragma once

#include "barycert/simplex.hpp"

namespace barycert {

/// The gradient of the field with `values` (one a vertex) in the cell at `vertices`, each component correctly rounded,
/// to out[0 ... d - 1]. False, and NaN, if the cell is degenerate. Preconditions: triangle or tetrahedron, everything
/// finite.
bool exact_gradient(Simplex simplex, const double* vertices, const double* values, double* out);

}  // namespace barycert
