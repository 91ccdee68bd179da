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

#include "barycert/core/integer.hpp"
#include "barycert/core/scaled_double.hpp"

namespace barycert::raster {

using Form = std::array<core::Integer, 3>;  ///< of a segment, the first two

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
        unit.add(core::scaled(x(i)));
        unit.add(core::scaled(y(i)));
    }
    Form form;
    for (int i = 0; i < count; ++i) {
        form[static_cast<std::size_t>(i)] =
            unit.multiple<core::Integer>(core::scaled(x(i))) - unit.multiple<core::Integer>(core::scaled(y(i)));
    }
    return form;
}

/// The point where h is zero on the segment. Precondition: h differs at its ends.
ExactPoint zero_on_segment(const Form& h);

/// The point where g and h are zero in the triangle. Precondition: there is exactly one.
ExactPoint zero_in_triangle(const Form& g, const Form& h);

/// The sign of h at the point: -1, 0 or 1.
int sign_at(const Form& h, const ExactPoint& p, int count);

/// The number at the point, correctly rounded, of which each vertex has one.
double value_at(const ExactPoint& p, const double* values, std::size_t stride, int count);

}  // namespace barycert::raster
