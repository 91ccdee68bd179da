/// Whether a mesh in memory is whole.
#pragma once

#include "barycert/mesh/mesh.hpp"

namespace barycert::detail {

/// What is wrong with the sizes, indices or numbers of the mesh, in one clause; nullptr if nothing is. A mesh that
/// passes can be written, and what is written can be read.
const char* inconsistency(const Mesh& mesh);

}  // namespace barycert::detail
