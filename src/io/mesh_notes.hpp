/// What meshes are converted to when they are read, and what they lose when they are written; told in notes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Tells that so many cells of the mesh are taken by their corners, if there are such.
void note_by_corners(std::size_t cells, const std::string& path, Mesh& mesh);

/// As mesh::cut_into_simplices(), and notes it; nothing without shapes. Throws: a polyhedron that is not closed.
void cut_into_simplices(Mesh& mesh, const std::string& path);

/// Adds to `notes`, once, which of these names are lost in a .node or .ele file: it has attribute0, attribute1, ...
void note_lost_names(const std::vector<std::string>& columns, const char* file, Notes& notes);

}  // namespace barycert::io
