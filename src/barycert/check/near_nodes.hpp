/// Nodes at one place, or nearly, and the cracks of the boundary that they leave.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/check/defect_list.hpp"
#include "barycert/check/facets.hpp"
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

/// The pairs of `nodes` that lie no farther apart than `radius` of both, an entry a node; ascending. The search ends
/// beyond `limit` pairs, or somewhat later.
std::vector<NearPair> near_pairs(const Mesh& mesh, const std::vector<Mesh::Index>& nodes,
                                 const std::vector<double>& radius, std::size_t limit);

/// Finds near_nodes, as CheckOptions::near has them, and crack. `in_contact`: 1 for each node of a facet at a
/// boundary_contact: near nodes and cracks there are its cause.
void find_cracks(const Mesh& mesh, const std::vector<std::uint8_t>& usable, const std::vector<BoundaryFacet>& facets,
                 double near, const std::vector<std::uint8_t>& in_contact, CellMeasures& measures, DefectList& defects);

}  // namespace barycert::check
