/// Does a mesh conform to the facets of the PLC that it was made from?
///
/// A PLC facet is respected if it is a union of faces of cells. Faces that may be part of it have their three nodes
/// close to its plane and their centroid in its region. It is respected
///   exactly        if all these nodes lie in its plane, no side of these faces crosses a side of its polygons, the
///                  polygons' vertices are nodes, and the faces add up to its area, all exactly. In a certified mesh
///                  then each of the faces lies in the region, for a side of a polygon that entered it would have to
///                  end in a node inside it or cross one of its sides; faces do not overlap; so equal areas mean equal
///                  sets;
///   by rounding    if that fails by little: a mesher that puts new nodes on slanted facets has to round them. Nodes
///                  within 2^-40 of the PLC's extent from the plane, crossings within that of an end, areas that agree
///                  to 2^-30. How far the farthest node is off the plane is measured;
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
    double largest_distance = 0;          ///< of a node from the plane of a facet respected by rounding
    double relative_distance = 0;         ///< the same over the PLC's extent
    std::vector<ViolatedFacet> examples;  ///< the first ones violated
};

/// Of the cells for which use[cell] is not 0: their corners are nodes with finite coordinates. Areas mean little where
/// the mesh is not certified. Precondition: tetrahedra. On all threads of the calling arena.
Conformity check_conformity(const Mesh& mesh, std::span<const std::uint8_t> use, const Plc& plc, std::size_t examples);

}  // namespace barycert::check
