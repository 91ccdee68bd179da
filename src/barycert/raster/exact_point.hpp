/// Points of a segment or triangle by their exact weights, for clipping.
///
/// Notation. A form h is a number at each vertex, h_i, and so one at each point of the simplex: sum of weight i times
/// h_i; the distance to a bound, up to a factor. A form is known up to a positive factor, as integers in a unit of its
/// own. Widths: a distance to a plane x = w or x = min is a difference of doubles, 2099 bits (integer.hpp); that to a
/// half-space is a sum of four products of two doubles, 4198 bits. Numerators are such a distance, or in a triangle a
/// difference of two products of differences, 4199 bits; times a double or a difference, and summed over three
/// vertices, that is less than 6302 bits, of 14704 that there are.
#pragma once

#include <array>
#include <cstddef>

#include "barycert/core/scaled_double.hpp"

namespace barycert::raster {

using Form = std::array<core::Integer, 3>;  ///< of a segment, the first two; the third is zero

/// Weight i is numerator[i] / denominator.
struct ExactPoint {
    Form numerator;
    core::Integer denominator;  ///< the sum of the numerators; positive
};

/// x(i) - y(i) at each of `count` vertices.
template <class X, class Y>
Form difference_form(int count, X x, Y y) {
    core::Unit unit;
    for (int i = 0; i < count; ++i) {
        unit.add(x(i));
        unit.add(y(i));
    }
    Form form;
    for (int i = 0; i < count; ++i) form[static_cast<std::size_t>(i)] = unit.integer(x(i)) - unit.integer(y(i));
    return form;
}

/// Weights in the ratio of these numbers.
inline ExactPoint exact_point(const Form& n) {
    ExactPoint p{n, n[0] + n[1] + n[2]};
    if (p.denominator.sign() >= 0) return p;
    for (core::Integer& x : p.numerator) x = core::Integer() - x;
    p.denominator = core::Integer() - p.denominator;
    return p;
}

/// The point where g and h are zero in the triangle. Precondition: there is exactly one.
inline ExactPoint zero_in_triangle(const Form& g, const Form& h) {
    return exact_point({g[1] * h[2] - g[2] * h[1], g[2] * h[0] - g[0] * h[2], g[0] * h[1] - g[1] * h[0]});
}

/// The sign of h at the point: -1, 0 or 1.
inline int sign_at(const Form& h, const ExactPoint& p) {
    return (h[0] * p.numerator[0] + h[1] * p.numerator[1] + h[2] * p.numerator[2]).sign();
}

/// The number at the point, correctly rounded, of which each vertex has one.
inline double value_at(const ExactPoint& p, const double* values, std::size_t stride, std::size_t count) {
    core::Unit unit;
    for (std::size_t i = 0; i < count; ++i) unit.add(values[stride * i]);
    core::Integer sum;
    for (std::size_t i = 0; i < count; ++i) sum = sum + p.numerator[i] * unit.integer(values[stride * i]);
    return core::round_quotient(sum, p.denominator, unit.exponent - 1074);
}

}  // namespace barycert::raster
