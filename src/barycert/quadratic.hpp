/// Quadratic interpolation, correctly rounded: tetrahedra of ten nodes and triangles of six.
///
/// Input: coordinates of the corners, points, and values at corners and mid-edge nodes, as doubles. Output: doubles.
/// With l the exact barycentric weights of the point in the straight-sided cell of the corners (wherever the mid-edge
/// nodes lie), the value is
///   sum_i l_i (2 l_i - 1) f_i + sum_ij 4 l_i l_j f_ij        over the corners i and the edges ij
/// with the edges in the order 01 12 02 (triangle) or 01 12 02 03 13 23 (tetrahedron), the order in which meshes hold
/// their mid-edge nodes.
///
/// Laws, for triangles in the plane and tetrahedra:
///   V1  Each value is the exact one rounded once, to nearest, ties to even, subnormal results and infinity included,
///       for every component. An exact zero is +0; what underflows to zero keeps its sign.
///   V2  At a point on a shared face, edge or vertex the value has the same bits from every cell that holds it, if the
///       cells are not degenerate and have the same nodes there, whatever values the others have. At a corner it is the
///       value of that node, in the middle of an edge that of the mid-edge node; NaN if that is not finite.
///   D1  Results depend on the input bits alone, not on threads, SIMD target, compiler or optimisation.
///
/// In a degenerate cell values are NaN, and TierCounts::degenerate counts the case. A nodal value that is NaN or
/// infinite makes its component NaN, and TierCounts::not_finite counts the case, unless its factor is exactly zero.
#pragma once

#include "barycert/gradient.hpp"
#include "barycert/weights.hpp"

namespace barycert {

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

}  // namespace barycert
