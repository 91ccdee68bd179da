/// The other way round: from an attribute's value to the place that has it, and from weights to the point.
///
/// Any attribute can stand for the coordinate: between a, where it is value_a, and b, where it is value_b, the value
/// V is met at t = (V - value_a) / (value_b - value_a), the weight of b, and at the point a + t (b - a). Everything is
/// exact and rounded once, to nearest, ties to even; an exact zero is +0, and what underflows to zero keeps its sign.
/// All of it is done in integers, whatever the floating-point environment. Error: an argument is not finite.
#pragma once

#include <span>

#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

struct Parameter {
    double t = 0;               ///< the weight of b; below 0 or above 1 beyond the ends; NaN if undetermined
    bool undetermined = false;  ///< both ends have the same value: every t has it, or none
};

/// t of `value` on a segment with the given values at its ends.
Result<Parameter> parameter_of_value(double value_a, double value_b, double value);

/// The same, and the point with `a.size()` coordinates into `point`, each correctly rounded from the exact t (not from
/// the rounded one); NaN if undetermined. Precondition: a, b and point have the same size.
Result<Parameter> point_of_value(std::span<const double> a, std::span<const double> b, double value_a, double value_b,
                                 double value, std::span<double> point);

/// sum of weights[i] * vertex i, exactly as the weights are (they are not scaled to sum 1), each coordinate rounded
/// once. `point` gets space_dimension(simplex) numbers.
Status point_from_weights(Simplex simplex, const double* vertices, const double* weights, double* point);

}  // namespace barycert
