/// The gradient of a linear field in a cell, correctly rounded.
///
/// Enters: coordinates and nodal values f_i as doubles. Leaves: g_k = sum f_i d(lambda_i)/dx_k, in units of the values
/// over units of the coordinates: the one vector with g . (v_i - v_j) = f_i - f_j for any two vertices of the cell.
///
/// What holds, for triangles in the plane and tetrahedra:
///   G1  Each component is the exact one rounded to nearest, ties to even, subnormal results and infinity included. An
///       exact zero is +0; what underflows to zero keeps its sign.
///   D1  Results depend on the input bits alone, not on threads, SIMD target, compiler or optimisation, nor on the
///       order of a cell's vertices.
///   A degenerate cell is told: its gradient is NaN, and the cell is counted. A nodal value that is NaN or infinite
///   makes the gradient of its component NaN, and the cell is counted. NaN or infinity among the coordinates of a cell
///   is an Error, and so are the other simplices.
///
/// How: plain double and one step of refinement with a proven bound, accepted where both ends of the bound round alike
/// (gradient-inl.hpp); integers elsewhere.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "barycert/batch.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/tiers.hpp"

namespace barycert {

struct Gradient {
    std::array<double, 3> gradient{};  ///< space_dimension(simplex) of them; NaN if degenerate or a value is not finite
    bool degenerate = false;
    Tier tier = Tier::double_double;
};

/// The gradient in the cell at `vertices` (vertex after vertex, see Case) with `values[i]` at vertex i.
Result<Gradient> gradient(Simplex simplex, const double* vertices, const double* values);

/// Gradients in all cells of a mesh: vertex i of cell j is node corners[n * j + i] with coordinates nodes[d * node
/// ...], n = vertex_count, d = space_dimension. Component k of the gradient of field component c is out[(components * j
/// + c) * d + k]. A cell counts for the highest tier that one of its numbers needed.
///
/// Errors besides: corners.size() is not a multiple of n, out.size() not d * components times the number of cells,
/// components < 1. On error `out` is not to be used. `out` must not overlap any input. Preconditions: corners in range,
/// a value for each component of each node.
Status gradients(Simplex simplex, std::span<const double> nodes, std::span<const std::int32_t> corners,
                 const NodalValues<double>& values, std::span<double> out, TierCounts* tiers = nullptr);

}  // namespace barycert
