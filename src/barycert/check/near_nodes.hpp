/// Nodes at one place, or nearly, and the cracks of the boundary that they leave.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "barycert/check/defect_list.hpp"
#include "barycert/check/exact_volumes.hpp"
#include "barycert/check/facets.hpp"
#include "barycert/check/pairs.hpp"
#include "barycert/mesh.hpp"

namespace barycert::check {

/// Those of `nodes` at the place of another one, second, each with the lowest that is there, first; by the second. 0
/// and -0 are one place. Precondition: their coordinates are finite.
std::vector<std::array<Mesh::Index, 2>> coincident_nodes(const Mesh& mesh, const std::vector<Mesh::Index>& nodes);

/// Of two nodes, rounded.
double node_distance(const Mesh& mesh, Mesh::Index a, Mesh::Index b);

struct NearPair {
    Mesh::Index first = -1, second = -1;
    double distance = 0;
};

/// found(pair) for the pairs of `nodes` that lie no farther apart than `radius` of both, an entry a node; in an order
/// that does not depend on threads. False if there are more than `limit` of them, or on average more than 64 a node
/// over many nodes: those beyond are not found. Memory is bounded by that.
bool for_each_near(const Mesh& mesh, const std::vector<Mesh::Index>& nodes, const std::vector<double>& radius,
                   std::size_t limit, const std::function<void(const NearPair&)>& found);

/// Finds near_nodes and near_hanging, as CheckOptions::near has them, crack, and of touching.hanging those that are no
/// near nodes. `meeting`: cells that meet where they must not; what two of them have of these is the cause.
void find_cracks(const Mesh& mesh, const std::vector<std::uint8_t>& usable, const std::vector<BoundaryFacet>& facets,
                 const ExactVolumes& volumes, double near, const BoundaryContacts& touching,
                 const std::vector<CellPair>& meeting, CellMeasures& measures, DefectList& defects);

}  // namespace barycert::check
