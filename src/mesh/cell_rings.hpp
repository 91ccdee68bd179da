/// The faces of a cell as rings of nodes: turned alike, and without what has no area.
#pragma once

#include <vector>

#include "barycert/mesh.hpp"
#include "mesh/face_cut.hpp"

namespace barycert::mesh {

using Rings = std::vector<std::vector<Mesh::Index>>;

/// Takes out nodes that a ring passes twice in a row, and rings of less than three nodes.
void drop_repeated(Rings& rings);

/// Turns rings so that each edge is passed both ways. False if an edge is not one of two faces.
bool turn_alike(Rings& rings);

/// Makes nodes at one place one, that of lowest number, and rings that pass a node more than once several; what has no
/// area then goes. Requires: finite coordinates.
void collapse(const NumberedNodes& nodes, Rings& rings);

}  // namespace barycert::mesh
