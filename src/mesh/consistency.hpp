/// Whether a mesh in memory is whole.
#pragma once

#include <cstddef>
#include <span>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::mesh {

/// Values that fields may have. Coordinates are always finite.
enum class FieldValues : bool { finite, any };

inline constexpr const char* not_listed = "the nodes and cells of a grid are not listed (ReadOptions::list_grids)";

/// Returns, in one clause, what is wrong with sizes, indices or numbers. Returns nullptr if nothing is: the mesh can be
/// written, and read again.
const char* inconsistency(const Mesh& mesh, FieldValues values = FieldValues::finite);

/// The same without what belongs to faces: their markers and nodes at mid-edges. A mesh that check_mesh certifies
/// passes.
const char* inconsistency_of_cells(const Mesh& mesh, FieldValues values);

/// The same for a grid whose cells are not listed.
const char* inconsistency_of_axes(const Mesh& mesh);

/// Finite coordinates of planes, at least two.
bool is_increasing(std::span<const double> coordinates);

/// The part of that which check_mesh does not find otherwise: about what belongs to nodes and cells (markers, fields,
/// nodes at mid-edges), and the index base. Requires: whole nodes and cells of dimension 2 or 3.
const char* inconsistency_of_extras(const Mesh& mesh, FieldValues values);

/// The field is there and has `rows` rows; `of` as in "node".
Status check_field(const Field* field, std::size_t rows, const char* of);

inline constexpr const char* faces_of_triangles = "a mesh of triangles has no faces";

}  // namespace barycert::mesh
