/// The inverse of interpolation: from a value to the point that has it, and from weights to the point.
///
/// A field that is linear between a, where it is value_a, and b, where it is value_b, has the value V at
/// t = (V - value_a) / (value_b - value_a), the weight of b, and at the point a + t (b - a). Both are exact and rounded
/// once, to nearest, ties to even; an exact zero is +0, and what underflows to zero keeps its sign. Integers compute
/// them, whatever the floating-point environment.
#pragma once

#include <span>

#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

struct Parameter {
    double t = 0;               ///< the weight of b; below 0 or above 1 beyond the ends; NaN if undetermined
    bool undetermined = false;  ///< both ends have the same value: every t has it, or none
};

/// Returns t of `value` on a segment with the given values at its ends, or an Error if an argument is not finite.
Result<Parameter> parameter_of_value(double value_a, double value_b, double value);

/// The same, and sets `point` to the point, each coordinate correctly rounded from the exact t (not from the rounded
/// one); to NaN if undetermined. Requires a, b and point of the same size. Returns an Error if a number is not finite.
Result<Parameter> point_of_value(std::span<const double> a, std::span<const double> b, double value_a, double value_b,
                                 double value, std::span<double> point);

/// Sets `point`, of space_dimension(simplex) numbers, to the sum of weights[i] * vertex i, each coordinate rounded
/// once. The weights are taken as they are: they are not scaled to sum to 1. Returns an Error if a number is not
/// finite.
Status point_from_weights(Simplex simplex, const double* vertices, const double* weights, double* point);

}  // namespace barycert
