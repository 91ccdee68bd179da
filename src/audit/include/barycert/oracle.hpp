/// The oracle: exact answers to a case, each rounded correctly to double once, at the very end.
///
/// Input: a Case with finite coordinates and values. Output: exact signs, region and feature; exact weights and value
/// rounded to nearest, ties to even; exact residuals of somebody else's weights. The oracle shares nothing with the
/// kernels or with core's predicates, so that it can judge them.
///
/// The mathematics. With v_i the vertices, p the point, all relative to p: the weight of vertex i is n_i / d where
///   tetrahedron: n_i = the 3x3 determinant of the other three with alternating sign,   d = sum n_i
///   triangle:    n_i = the cross product of the next two,                              d = sum n_i
///   triangle3d:  n_i = N . (cross product of the next two), N = (v1 - v0) x (v2 - v0), d = N . N
///   segment:     n_0 = v_1 . e, n_1 = -v_0 . e, e = v_1 - v_0,                         d = e . e
/// The last two are the weights of the orthogonal projection of p: dotting with N or e removes what is normal to
/// the simplex. In each case sum n_i = d, so that d = 0 exactly when the simplex is degenerate.
///
/// Perspective (Case::perspective, a triangle with depths w_i in a window): the ray from the eye through the point
/// meets the triangle with the vertices (x_i w_i, y_i w_i, w_i) at the weights m_i / m, m_i = n_i w_j w_k, m = sum m_i.
/// Where d or m is zero (then the ray is parallel to the triangle's plane) there are none: the case counts as
/// degenerate.
///
/// Example:
///
///     const Case c{.simplex = Simplex::triangle, .vertices = {0, 0, 1, 0, 0, 1}, .point = {0.5, 0.5}};
///     const OracleAnswer exact = ask_oracle(c);
///     const bool on_edge = exact.region == Region::boundary;
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "barycert/simplex.hpp"

namespace barycert {

struct OracleAnswer {
    Region region = Region::outside;
    Feature feature = Feature::outside;
    std::uint8_t support = 0;            ///< bit i is set if the exact weight i is not zero
    std::array<std::int8_t, 4> signs{};  ///< signs of the exact weights; zero if degenerate
    std::array<double, 4> weights{};     ///< correctly rounded; NaN if degenerate
    double value = 0;                    ///< sum of weight times nodal value, correctly rounded; NaN if degenerate
    bool narrow = false;                 ///< machine words were wide enough (for counting; never changes an answer)
};

/// The answer to every degenerate case.
inline OracleAnswer degenerate_answer() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {
        .region = Region::degenerate, .feature = Feature::degenerate, .weights = {nan, nan, nan, nan}, .value = nan};
}

/// Requires: all numbers of the case are finite, and its depths are above zero.
OracleAnswer ask_oracle(const Case& c);

/// The same by CGAL's kernel of exact predicates and exact constructions (Epeck): orientations for the signs,
/// constructions for weights, values, projections and rays, rounded by MPFR. It shares nothing with ask_oracle(), and
/// is slower by an order of magnitude. `narrow` is false.
OracleAnswer ask_cgal(const Case& c);

/// Equal bit by bit, `narrow` aside; NaN equals NaN.
bool same_answer(const OracleAnswer& a, const OracleAnswer& b);

namespace exact {
/// The same by wide integers alone. For tests: both must always agree.
OracleAnswer ask_wide(const Case& c);
}  // namespace exact

/// Exact (sum of weights) - 1, rounded once. Requires: weights finite.
double partition_residual(std::span<const double> weights);

/// Exact Euclidean length of (sum of weight times vertex) - p, rounded once, where p is the case's point, or its
/// projection for a triangle3d or segment. For perspective, the distance in the window from p to the projection of the
/// point that the weights give before the projection; infinite if that has depth zero. Requires: weights finite,
/// simplex not degenerate.
double reproduction_residual(const Case& c, std::span<const double> weights);

/// Kind of a simplex by the dimension of its affine hull: 3 for a proper tetrahedron, ... 0 if all vertices coincide.
int affine_dimension(const Case& c);

// Exact proofs, case by case, that interpolation along auxiliary lines is barycentric interpolation.
//
// Bilinear: the horizontal line through the point meets two sides of the triangle; interpolate along the sides, then
// along the line. Trilinear: a plane through the point meets three edges of the tetrahedron, a line in it the segments
// in two faces; interpolate along the edges, the segments, the line. Both are carried out in CGAL's rationals and
// compared with ratios of signed areas or volumes. In floating point the three differ; the audit shows how.

enum class IdentityVerdict : std::uint8_t {
    holds,      ///< equal as rational numbers, every weight
    fails,      ///< unequal: would refute the theorem
    undefined,  ///< degenerate, or every choice of auxiliary lines meets a vertex or runs along a side
};

/// Requires: c.simplex == Simplex::triangle, finite coordinates.
IdentityVerdict bilinear_is_barycentric(const Case& c);

/// Requires: c.simplex == Simplex::tetrahedron, finite coordinates.
IdentityVerdict trilinear_is_barycentric(const Case& c);

/// Perspective-correct interpolation is ray casting: the ray from the eye through (x, y, 1) is met with the plane of
/// the triangle before the projection, (x_i w_i, y_i w_i, w_i), and the weights of the common point are read off ratios
/// of areas in that plane; they are compared with the weights of 1/Z = sum alpha_i / w_i. `undefined` where there are
/// no weights. Requires: c.perspective, finite coordinates, depths above zero.
IdentityVerdict perspective_is_ray_casting(const Case& c);

// The gradient of a linear field, by the oracle: exact integers, rounded once, nothing shared with core.
//
// The mathematics. The gradient of weight i is the normal of the opposite face over the signed volume: with (i, a, b,
// c) an even permutation of the vertices, grad lambda_i = -((b - a) x (c - a)) / det(v1 - v0, v2 - v0, v3 - v0); in
// the plane, with (i, a, b) one, grad lambda_i = (a - b) turned by a right angle over the signed area. The gradient is
// the sum of values times these.

struct GradientAnswer {
    bool degenerate = false;
    std::array<double, 3> gradient{};  ///< correctly rounded; NaN if degenerate
};

/// Returns the gradient of the field with c.values at the vertices; ignores the point. Requires: triangle or
/// tetrahedron, everything finite.
GradientAnswer oracle_gradient(const Case& c);

/// Quadratic interpolation on a straight-sided cell with nodes amid its edges, likewise: sum l_i (2 l_i - 1) f_i + sum
/// 4 l_i l_j f_ij with the exact weights l of the point, f = c.values at the corners and `mids` on the edges 01 12 02
/// (triangle) or 01 12 02 03 13 23 (tetrahedron), correctly rounded; NaN if degenerate.
/// Requires: triangle or tetrahedron, everything finite, a value for each edge.
double oracle_quadratic_value(const Case& c, std::span<const double> mids);

/// The texel of a finite coordinate u in a row of `size` >= 1 texels that covers 0 to 1: floor(u size), brought into
/// [0, size) by clamping or, with `repeat`, modulo size. In exact integers.
std::int64_t oracle_texel(double u, std::int64_t size, bool repeat);

// Triangles in space, of non-zero area, by CGAL's exact kernel. All numbers are finite; a triangle is nine.

/// The distance of the point from the triangle, correctly rounded.
double oracle_distance(std::span<const double> triangle, const double* point);

/// Whether they have a point in common.
bool oracle_meet(std::span<const double> a, std::span<const double> b);

/// 1 inside, 0 on, -1 outside the closed surface that the triangles are; coordinates are below 2^1022. By the parity of
/// a segment to a point outside that meets no edge.
int oracle_side(std::span<const std::array<double, 9>> triangles, const double* point);

}  // namespace barycert
