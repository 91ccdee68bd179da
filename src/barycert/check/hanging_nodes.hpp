/// Nodes of the boundary that nearly lie within an edge or a facet of another cell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/check/exact_volumes.hpp"
#include "barycert/check/pairs.hpp"

namespace barycert::check {

/// Those no farther from the edge or facet than the radius of the node and of each node of the facet, and farther from
/// these nodes; of no cell that has the node, too. `radius`: of each node, 0 of those that are not of the boundary.
/// Ascending; `complete` is false if there are more than `limit`.
std::vector<HangingNode> nearly_hanging(const Mesh& mesh, const std::vector<std::uint8_t>& usable,
                                        const std::vector<BoundaryFacet>& facets, const ExactVolumes& volumes,
                                        const std::vector<double>& radius, std::size_t limit, bool& complete);

}  // namespace barycert::check
