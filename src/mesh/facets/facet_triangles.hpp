/// A flat facet cut into triangles of its own nodes: polygons with holes, segments and points in it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/mesh.hpp"
#include "mesh/cell_types.hpp"

namespace barycert::surface {

/// Why a facet cannot be cut, or is not as its polygons say.
struct FacetFault {
    enum class Kind : std::uint8_t {
        flat,        ///< all of its nodes lie on one line
        folded,      ///< two of its nodes have one place in the facet's plane
        crossing,    ///< two of its segments cross
        on_segment,  ///< a node lies on a segment that does not have it
    };
    Kind kind{};
    std::array<Mesh::Index, 4> nodes{-1, -1, -1, -1};  ///< the node and the segment, or both segments
};

struct FacetTriangles {
    std::vector<std::array<Mesh::Index, 3>> triangles;  ///< turned as the first polygon is
    std::vector<FacetFault> faults;                     ///< with any but on_segment there are no triangles
};

/// The region that the segments of the polygons enclose, but for what a hole's point lies in: as TetGen has it, what is
/// reached from without, or from a hole, over no segment is not part of it. `polygons`: rings of nodes; two are a
/// segment, one is a point. `holes`: three coordinates a point. Signs are exact, in the projection along the axis on
/// which the normal of the widest triangle at a node is longest; there are no new points. Four nodes are cut at the
/// lower of those where both triangles turn one way.
FacetTriangles triangles_of_facet(std::span<const double> points, std::span<const std::vector<Mesh::Index>> polygons,
                                  std::span<const double> holes);

/// Appends the corners of the triangles of a polygon or strip, by its corners. Returns how many of its rings cannot be
/// cut.
std::size_t add_triangles(std::span<const double> points, const mesh::CellType& type,
                          std::span<const Mesh::Index> nodes, std::vector<Mesh::Index>& corners);

}  // namespace barycert::surface
