/// The weights that points have on the nodes of a mesh: a sparse matrix that gives values from any field, anywhere.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"

namespace barycert {

/// Entry k of row i, begin[i] <= k < begin[i + 1], is weights[k] on node nodes[k], nodes ascending.
struct NodeWeights {
    std::vector<std::size_t> begin;  ///< one more than there are rows
    std::vector<Mesh::Index> nodes;
    std::vector<double> weights;

    std::size_t row_count() const { return begin.empty() ? 0 : begin.size() - 1; }
};

/// The weights of located points: of rows.points[i] in cell rows.cells[i] of the locator's mesh, or outside if that is
/// -1, as locate() and locate_all() find them. On cells of second order they are the quadratic's at corners and
/// mid-edge nodes. Each is the exact one rounded once, to nearest, ties to even; what rounds to zero is left out. So
/// they need not sum to 1, and their sum with nodal values, rounded in each step, is not the correctly rounded value.
///
/// Points outside have no weights, unless the policy is `nearest` (within its limit: those of the nearest point of the
/// mesh, which on cells of second order has its barycentric weights rounded first) or `extrapolate` (those of the
/// function of the nearest cell) and the point is finite. Works on the calling thread. Returns an Error if sizes do not
/// fit, a cell is out of range or degenerate, or a coordinate of a point in a cell is not finite.
Result<NodeWeights> node_weights(const Locator& locator, const TableView& rows, const OutsidePolicy& outside = {});

}  // namespace barycert
