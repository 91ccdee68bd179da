/// Perspective-correct interpolation on a triangle in window coordinates, correctly rounded.
///
/// Input: three vertices x, y, w, one after the other (nine doubles): the place in the window, and the depth w that the
/// projection divided by (the w of clip space, not the projected z); a point x, y of the window; attributes at the
/// vertices. Coordinates in any unit, w > 0 in another.
///
/// With alpha_i the barycentric weights of the point in the window,
///     1/Z = sum alpha_i / w_i,    beta_i = Z alpha_i / w_i,    I = sum beta_i I_i
/// are its depth Z, its perspective-correct weights beta_i, and the value there of an attribute that is linear on the
/// triangle before the projection. Geometry: the ray from the eye (0, 0, 0) through (x, y, 1) meets the plane of the
/// points (x_i w_i, y_i w_i, w_i) in the point with weights beta_i and third coordinate Z.
///
/// Laws (those of weights.hpp, D1 and D2 as there; tests in tests/core/perspective_test.cpp):
///   W1, W2  A weight is the exact one rounded to nearest, ties to even; an exact zero is +0.
///   V1      A depth and a value are the exact ones, rounded once in the same way.
///   V2      On an edge the values have the same bits from both of its triangles, if its vertices have the same.
///
/// There are no weights, and they, depth and values are NaN and `degenerate`, if the triangle's area in the window is
/// exactly zero, or if 1/Z is: then the ray is parallel to the plane, which happens outside the triangle only. Where
/// 1/Z < 0, likewise outside only, the plane is met behind the eye: the answers are those of that point. An attribute
/// that is NaN or infinite makes its value NaN, unless its weight is exactly zero. A coordinate that is not finite, or
/// a w that is not a finite number above zero, is an Error: clip before the division.
///
/// Example:
///
///     const double window[] = {0, 0, 1, 8, 0, 2, 0, 8, 4};  // x, y, w of each vertex
///     const double pixel[] = {2, 2}, red[] = {0, 1, 1};
///     const double depth = perspective_depth(window, pixel).value().value;
///     const double shade = perspective_value(window, pixel, red).value().value;
#pragma once

#include <array>
#include <span>

#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"

namespace barycert {

struct PerspectiveWeights {
    std::array<double, 3> weights{};  ///< NaN if degenerate
    bool degenerate = false;
    Tier tier = Tier::double_double;
};

/// Returns beta_0, beta_1, beta_2.
Result<PerspectiveWeights> perspective_weights(const double* vertices, const double* point);

/// Returns Z.
Result<Value> perspective_depth(const double* vertices, const double* point);

/// Returns I for the attribute with `values[i]` at vertex i.
Result<Value> perspective_value(const double* vertices, const double* point, const double* values);

/// Values at many points of one triangle: points are x, y, x, y, ...; values[components * i + c] is component c at
/// vertex i; out[components * j + c] is set to component c at point j. Returns an Error also if `values` is not three
/// times, or `out` not points.size() / 2 times, as long as `components`; `out` is then not to be used. Requires `out`
/// not to overlap any input.
Status perspective_values(const double* vertices, std::span<const double> points, std::span<const double> values,
                          int components, std::span<double> out, TierCounts* tiers = nullptr);

}  // namespace barycert
