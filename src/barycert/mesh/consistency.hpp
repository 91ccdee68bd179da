/// Whether a mesh in memory is whole.
#pragma once

#include "barycert/mesh/mesh.hpp"

namespace barycert::detail {

/// What the values of fields may be. Coordinates are always finite.
enum class FieldValues : bool { finite, any };

/// What is wrong with the sizes, indices or numbers of the mesh, in one clause; nullptr if nothing is. A mesh that
/// passes can be written, and what is written can be read.
const char* inconsistency(const Mesh& mesh, FieldValues values = FieldValues::finite);

}  // namespace barycert::detail
