/// Does a mesh conform to the facets of the PLC that it was made from?
///
/// A PLC facet is respected if it is a union of faces of cells. That is decided by area: faces whose three nodes lie in
/// the facet's plane, and whose centroid lies in its polygons, must add up to the facet's own area, both projected
/// along an axis and summed exactly. A mesher that puts new nodes on slanted facets has to round them, so a facet may
/// be respected
///   exactly        all these nodes lie in the plane of the facet, and the areas are the same, or
///   by rounding    the nodes lie within 2^-40 of the PLC's extent from it, and the areas agree to 2^-30; how far the
///                  farthest node is off is measured;
/// else it is violated, and the share of it that is covered is told. Facets without area (single segments) are left
/// out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "barycert/mesh/mesh.hpp"
#include "barycert/plc/plc.hpp"

namespace barycert::check {

struct ViolatedFacet {
    std::int64_t facet = -1;  ///< position in the PLC
    double covered = 0;       ///< share of its area
};

struct Conformity {
    std::uint64_t facets = 0;  ///< of the PLC, with an area
    std::uint64_t exact = 0, rounded = 0, violated = 0;
    std::uint64_t missing_vertices = 0;   ///< of PLC facets, where the mesh has no node
    double largest_distance = 0;          ///< of a node on a respected facet from its plane
    double relative_distance = 0;         ///< the same over the PLC's extent
    std::vector<ViolatedFacet> examples;  ///< the first ones violated
};

/// Of the cells for which use[cell] is not 0: their corners are nodes with finite coordinates. Areas mean little where
/// the mesh is not certified. Precondition: tetrahedra. On all threads of the calling arena.
Conformity check_conformity(const Mesh& mesh, std::span<const std::uint8_t> use, const Plc& plc, std::size_t examples);

}  // namespace barycert::check
