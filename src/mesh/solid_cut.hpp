/// A cell in space cut into tetrahedra between its own nodes, none of them flat, its faces as face_cut.hpp has it.
///
/// The triangles of the faces are the boundary. From the node of lowest number for which all triangles that do not have
/// it lie strictly on one side, the cell is the tetrahedra on these triangles: exactly one of them is at each point
/// inside, as the boundary winds once around that. Where there is no such node, other tetrahedra are searched
/// (tetrahedra_search.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "barycert/mesh.hpp"
#include "mesh/face_cut.hpp"

namespace barycert::mesh {

/// The parts of a cell.
struct Parts {
    std::vector<std::array<Mesh::Index, 4>> corners;
    std::vector<std::uint16_t> inside;  ///< of each, as Shapes::inside
    bool at_lowest = true;              ///< the cell and all of its faces at their nodes of lowest number
};

/// Parts by nodes; none if the cell cannot be cut. `rings`: its faces, turned alike, so that each edge is passed as
/// often one way as the other. Requires: of each ring three nodes or more, all different; finite coordinates.
Parts cut_solid(const NumberedNodes& nodes, const std::vector<std::vector<Mesh::Index>>& rings);

}  // namespace barycert::mesh
