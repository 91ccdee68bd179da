/// The gradient of a linear field in a cell, correctly rounded.
///
/// Input: coordinates and nodal values f_i as doubles. Output: g_k = sum f_i d(lambda_i)/dx_k, in units of the values
/// over units of the coordinates: the one vector with g . (v_i - v_j) = f_i - f_j for any two vertices of the cell.
///
/// Laws, for triangles in the plane and tetrahedra:
///   G1  Each component is the exact one rounded to nearest, ties to even, subnormal results and infinity included. An
///       exact zero is +0; what underflows to zero keeps its sign.
///   D1  Results depend on the input bits alone, not on threads, SIMD target, compiler or optimisation, nor on the
///       order of a cell's vertices.
///
/// The gradient in a degenerate cell is NaN, and TierCounts::degenerate counts the cell. A nodal value that is NaN or
/// infinite makes g_k of its component NaN, unless d(lambda_i)/dx_k is exactly zero; TierCounts::not_finite counts the
/// cell.
#pragma once

#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

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

}  // namespace barycert
