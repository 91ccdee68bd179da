/// What cuts require of their input, as Errors.
#pragma once

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"

namespace barycert::surface {

/// The mesh has whole nodes and cells, indices in range, finite coordinates and the dimension; 0: any. On all threads
/// of the calling arena.
Status check_mesh(const Mesh& mesh, int dimension);

/// The field has `rows` rows; `of` as in "node".
Status check_field(const Field* field, std::size_t rows, const char* of);

/// Those to be carried along.
Status check_options(const Mesh& mesh, const CutOptions& options);

}  // namespace barycert::surface
