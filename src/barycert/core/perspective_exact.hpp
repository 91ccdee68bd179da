/// Perspective-correct weights, depth and values in exact integers. All functions require what perspective.hpp requires
/// of coordinates and depths; they return false, and leave `out` as it was, if there are no weights. Layouts as there.
#pragma once

namespace barycert::core {

/// The three weights, correctly rounded.
bool exact_perspective_weights(const double* vertices, const double* point, double* out);

/// Z, correctly rounded.
bool exact_perspective_depth(const double* vertices, const double* point, double* out);

/// `components` values, each correctly rounded; NaN where a value is not finite at a vertex whose weight is not exactly
/// zero.
bool exact_perspective_values(const double* vertices, const double* point, const double* values, int components,
                              double* out);

}  // namespace barycert::core
