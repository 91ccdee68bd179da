/// Barycentric weights, interpolated values and gradients of linear and quadratic fields, correctly rounded.
///
/// Input: coordinates and nodal values as doubles (of linear fields also as floats). Output: doubles.
///
/// Laws (each is a test of that name in tests/core):
///   W1  A weight has the sign of the exact weight. It is +0 if the exact weight is zero. If the exact weight is not
///       zero but rounds to zero (at most half of the min subnormal), it is a zero with the exact weight's sign.
///       weight_signs tells these two cases apart.
///   W2  Each weight is the exact one rounded to nearest, ties to even, subnormal results and infinity included.
///   V1  Each value is the exact sum of weight (quadratic field: of shape function) times nodal value, rounded once in
///       the same way, for every component. An exact zero is +0, even if all nodal values are -0; what underflows to
///       zero keeps its sign.
///   V2  At a point on a shared face, edge or vertex the value has the same bits from every cell that holds it, if the
///       cells are not degenerate, whatever values the nodes beside it have.
///   G1  Each component of a gradient is the exact one, rounded once in the same way. An exact zero is +0,
///       what underflows to zero keeps its sign.
///   D1  Results depend on the input bits alone, not on threads, SIMD target, compiler or optimisation, nor (D2) on the
///       caller's floating-point environment.
///
/// A degenerate simplex has no weights: they, its values and gradients are NaN, and TierCounts::degenerate counts the
/// case. A nodal value that is NaN or infinite makes its component NaN, and TierCounts::not_finite counts the case,
/// unless its exact weight is zero: then it takes no part. NaN or infinity among the coordinates is an Error.
///
/// Rounded weights need not sum to 1, nor give back the point they came from; their rounded combination with nodal
/// values is not the value. On segment and triangle3d V2 holds for points on the shared edge or vertex itself, not for
/// those projected to it.
///
/// Example:
///
///     const double triangle[] = {0, 0, 3, 0, 0, 3}, point[] = {1, 1}, values[] = {1, 2, 4};
///     const std::array<double, 4> w = barycentric_weights(Simplex::triangle, triangle, point).value().weights;
///     const double value = interpolate(Simplex::triangle, triangle, point, values).value().value;
///     const Gradient slope = gradient(Simplex::triangle, triangle, values).value();
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

enum class Rounding : std::uint8_t {
    correct,  ///< as above
    plain,    ///< evaluated in double: only D2, the checks of sizes and what is said of NaN hold; no counts
};

struct Weights {
    std::array<double, 4> weights{};  ///< vertex_count(simplex) of them; NaN if degenerate
    bool degenerate = false;
    Tier tier = Tier::double_double;
};

/// Returns the weights of `point` in the simplex at `vertices` (vertex after vertex, see Case), or an Error if a
/// coordinate is not finite.
Result<Weights> barycentric_weights(Simplex simplex, const double* vertices, const double* point);

struct Value {
    double value = 0;  ///< NaN if degenerate or a nodal value that takes part is not finite
    bool degenerate = false;
    Tier tier = Tier::double_double;
};

/// Returns the value at `point` of the linear field with `values[i]` at vertex i, or an Error if a coordinate is not
/// finite.
Result<Value> interpolate(Simplex simplex, const double* vertices, const double* point, const double* values);

/// Returns the sign of the exact, not rounded, value less `threshold`: whether the field is above, at or below it. So a
/// value can be rounded once to any other type. Returns an Error if a number that takes part is not finite or the
/// simplex is degenerate.
Result<Sign> compare_value(Simplex simplex, const double* vertices, const double* point, const double* values,
                           double threshold);

/// Weights of many cases: out[n * j + i] is weight i of case j, n = vertex_count(simplex). Returns an Error if a
/// coordinate is not finite, if out.size() is not n times the number of cases, or if the sizes of the queries do not
/// fit each other; `out` is then not to be used. Requires indices in range, and `out` not to overlap any input.
Status barycentric_weights(const CaseArrays& cases, std::span<double> out, TierCounts* tiers = nullptr);
Status barycentric_weights(const MeshQueries& queries, std::span<double> out, TierCounts* tiers = nullptr);

/// Values of many cases: out[components * j + c] is component c of case j. `tiers` counts a case for the highest tier
/// that one of its components needed. Returns an Error if a coordinate is not finite (not with Rounding::plain), if
/// out.size() is not `components` times the number of cases, if the sizes of the queries do not fit each other, or if
/// components < 1; `out` is then not to be used. Requires indices in range, a value for each component of each node,
/// and `out` not to overlap any input.
Status interpolate(const CaseArrays& cases, const ValueArrays<double>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);
Status interpolate(const CaseArrays& cases, const ValueArrays<float>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);
Status interpolate(const MeshQueries& queries, const NodalValues<double>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);
Status interpolate(const MeshQueries& queries, const NodalValues<float>& values, std::span<double> out,
                   TierCounts* tiers = nullptr, Rounding rounding = Rounding::correct);

// The gradient of a linear field f in a cell, a triangle in the plane or a tetrahedron: g_k = sum f_i d(lambda_i)/dx_k,
// in units of the values over units of the coordinates. It is the one vector with g . (v_i - v_j) = f_i - f_j for any
// two vertices of the cell, whatever their order. A nodal value that is NaN or infinite makes g_k of its component NaN,
// unless d(lambda_i)/dx_k is exactly zero.

struct Gradient {
    std::array<double, 3> gradient{};  ///< space_dimension(simplex) of them
    bool degenerate = false;
    Tier tier = Tier::double_double;
};

/// Returns the gradient in the cell at `vertices` (vertex after vertex, see Case) with `values[i]` at vertex i. Returns
/// an Error if a coordinate is not finite, or for other simplices than triangle and tetrahedron.
Result<Gradient> gradient(Simplex simplex, const double* vertices, const double* values);

/// Gradients in all cells of a mesh: vertex i of cell j is node corners[n * j + i] with coordinates nodes[d * node
/// ...], n = vertex_count(simplex), d = space_dimension(simplex). Component k of the gradient of field component c is
/// out[(components * j + c) * d + k]. `tiers` counts a cell for the highest tier that one of its numbers needed.
///
/// Returns an Error if a coordinate of a cell is not finite, for other simplices, if corners.size() is not a multiple
/// of n, if out.size() is not d * components times the number of cells, or if components < 1; `out` is then not to be
/// used. Requires corners in range, a value for each component of each node, and `out` not to overlap any input.
Status gradients(Simplex simplex, std::span<const double> nodes, std::span<const std::int32_t> corners,
                 const NodalValues<double>& values, std::span<double> out, TierCounts* tiers = nullptr);

// Quadratic fields on tetrahedra of ten nodes and triangles, in the plane, of six. With l the exact barycentric weights
// of the point in the straight-sided cell of the corners (wherever the mid-edge nodes lie), the value is
//     sum_i l_i (2 l_i - 1) f_i + sum_ij 4 l_i l_j f_ij        over the corners i and the edges ij
// with the edges in the order 01 12 02 (triangle) or 01 12 02 03 13 23 (tetrahedron), the order in which meshes hold
// their mid-edge nodes.
//
// V1 holds with these factors for the weights. So does V2, if the cells have the same nodes on what they share: at a
// corner the value is that of its node, in the middle of an edge that of the mid-edge node; NaN if that is not finite.
// A nodal value that is NaN or infinite makes its component NaN, unless its factor is exactly zero.

/// Number of mid-edge nodes: 3 for a triangle, 6 for a tetrahedron.
constexpr int mid_node_count(Simplex s) {
    return s == Simplex::tetrahedron ? 6 : 3;
}

/// Returns the value at `point` of the quadratic field with values[i] at corner i and, behind these, those of the
/// mid-edge nodes. Returns an Error if a coordinate is not finite, or for other simplices than triangle and
/// tetrahedron.
Result<Value> interpolate_quadratic(Simplex simplex, const double* vertices, const double* point, const double* values);

/// Values of many cases: out[components * j + c] is component c of case j. Mid-edge node e of cell k is
/// mid_nodes[m * k + e], m = mid_node_count(simplex); values are indexed by corners and mid-edge nodes alike. `tiers`
/// counts a case for the highest tier that one of its components needed. Rounding::plain evaluates the formula in
/// double: nothing is counted, and nothing promised but what is said of NaN.
///
/// Returns an Error if a coordinate is not finite (not with Rounding::plain), for other simplices, if out.size() is not
/// `components` times the number of cases, if components < 1, or if corners and mid-edge nodes are not of the same
/// number of cells; `out` is then not to be used. Requires indices in range, a value for each component of each node,
/// and `out` not to overlap any input.
Status interpolate_quadratic(const MeshQueries& queries, std::span<const std::int32_t> mid_nodes,
                             const NodalValues<double>& values, std::span<double> out, TierCounts* tiers = nullptr,
                             Rounding rounding = Rounding::correct);

/// Returns the gradient at `point` of the quadratic field with these values (as for interpolate_quadratic). Each
/// component is the exact one rounded once, to nearest, ties to even, subnormal results and infinity included; an exact
/// zero is +0. NaN in a degenerate cell, and in a component where a nodal value is not finite, unless the derivative of
/// its factor is exactly zero there. Always in integers, a microsecond or more; Rounding::plain evaluates the formula
/// in double, and promises nothing else. Returns an Error if a coordinate is not finite, or for other simplices.
Result<Gradient> quadratic_gradient(Simplex simplex, const double* vertices, const double* point, const double* values,
                                    Rounding rounding = Rounding::correct);

// The condition number of a cell: how many bits a kernel that works with differences of coordinates may lose in the
// weights of points of the cell.
//
//     kappa = (volume of the cell's box along the axes) / (volume of the cell)        (areas in 2D)
//           = d! X Y Z / |det E|,    X, Y, Z the extents of the cell, E the matrix of its edges from a corner
//
// It is 6 for a right-angled tetrahedron along the axes, however long its sides, and never below 3 for a tetrahedron
// or 2 for a triangle. Multiplying an axis by a power of two changes neither kappa nor what such a kernel loses. It is
// large where a cell is thin in a direction oblique to the axes: there the products of a determinant are as large as
// the box and cancel to the cell.
//
// Derivation. Let u = 2^-53 and p a point of the cell. Every difference of coordinates that a kernel forms, of two
// vertices or of a vertex and p, is at most the extent X, Y or Z; so every product in a determinant is at most X Y Z.
// To first order a sum of n such products, each of which meets k roundings on its way, is off by at most k n u X Y Z.
// Counted as in filter-inl.hpp:
//   2D  a numerator has 2 products of 4 roundings: 4 u kappa |det E|. So has the denominator if it comes from the
//       edges; as the sum of three numerators it has 6 of 6: 18 u kappa |det E|.
//   3D  a numerator has 6 products of 8 roundings: 8 u kappa |det E|. So has the denominator if it comes from the
//       edges; as the sum of four numerators it has 24 of 10: 40 u kappa |det E|.
// A weight w = numerator / denominator, 0 <= w <= 1, is off by the first, by w times the second, and by u w: at most
// 8 u kappa + u or 22 u kappa + u in 2D, and 16 u kappa + u or 48 u kappa + u in 3D. A weight that is computed as 1
// less the others is off by the sum of their errors. Kernels that multiply by a rounded inverse of E meet the same
// products with a few more roundings. Measured, the constant is about 1 in 3D and 2 in 2D
// (tests/audit/prediction_test.cpp).
//
// Why not perm |E| / |det E|, the usual quotient: at no corner need the permanent be as large as in the middle. Where
// two opposite edges of length h are a distance 1 apart along (1, 1, 1), |det E| is about h^2, every corner's
// permanent about h, and the kernel loses 1 / h^2 in between.

/// Returns kappa of the triangle or tetrahedron at `vertices` (layout of Case), with a relative error below 2^-10:
/// infinity if and only if the cell is exactly degenerate; the max double if the quotient is beyond it; NaN if a
/// coordinate is not finite, and for segment and triangle3d (points are projected on them by dot products, which lose
/// accuracy in another way).
double condition_number(Simplex simplex, const double* vertices);

// The inverse of interpolation: from a value to the point that has it, and from weights to the point.
//
// A field that is linear between a, where it is value_a, and b, where it is value_b, has the value V at
// t = (V - value_a) / (value_b - value_a), the weight of b, and at the point a + t (b - a). Both are exact and rounded
// once, to nearest, ties to even; an exact zero is +0, and what underflows to zero keeps its sign. Integers compute
// them, whatever the floating-point environment.

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
