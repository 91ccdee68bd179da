/// The boundary as a complex: ridges, pieces, cavities, tunnels.
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/check/defect_list.hpp"
#include "barycert/check/exact_volumes.hpp"
#include "barycert/check/facets.hpp"

namespace barycert::check {

struct BoundaryPieces {
    BoundaryReport summary;
    std::vector<std::uint32_t> facets;  ///< for each piece one of its facets: an index into Facets::boundary
    Integer enclosed;                   ///< d! times the volume that the boundary encloses, in the unit of ExactVolumes
};

/// Finds open_boundary, pinched_ridge, pinched_node, missing_cell.
BoundaryPieces check_boundary(const Mesh& mesh, const std::vector<BoundaryFacet>& facets, const ExactVolumes& volumes,
                              DefectList& defects);

}  // namespace barycert::check
