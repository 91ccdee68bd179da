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

#include "barycert/check.hpp"
#include "barycert/io.hpp"
#include "barycert/mesh.hpp"

namespace barycert::check {

/// Of the cells for which use[cell] is not 0: their corners are nodes with finite coordinates. Areas mean little where
/// the mesh is not certified. Precondition: tetrahedra. On all threads of the calling arena.
ConformityReport check_conformity(const Mesh& mesh, std::span<const std::uint8_t> use, const Plc& plc,
                                  std::size_t examples);

}  // namespace barycert::check
