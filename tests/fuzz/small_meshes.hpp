/// Two small meshes with fields, for targets that need any mesh.
#pragma once

#include "barycert/mesh.hpp"

namespace barycert::fuzz {

/// A mesh of `dimension` 2 or 3: two cells that share a facet; fields T (of nodes), v (of nodes, a vector) and q (of
/// cells).
const Mesh& small_mesh(int dimension);

}  // namespace barycert::fuzz
