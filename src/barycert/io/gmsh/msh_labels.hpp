/// What cells of a .msh file belong to, and what was left out beside them.
#pragma once

#include <string>

#include "barycert/io/gmsh/msh_cells.hpp"
#include "barycert/io/gmsh/msh_elements.hpp"
#include "barycert/io/gmsh/msh_file.hpp"
#include "barycert/io/gmsh/msh_groups.hpp"
#include "barycert/mesh.hpp"

namespace barycert::io {

/// Tells which elements are not among the cells, and which nodes are of no cell.
void note_cells(const MshCells& cells, const MshGroups& groups, const std::string& path, Notes& notes);

/// Appends the fields "gmsh:physical" and "gmsh:geometrical", and the labels "gmsh:tag" and "gmsh:physical_name". A
/// cell field of one of these names that is there already stays: the writer makes such where groups cannot say the
/// same.
void label_cells(const MshFile& file, const MshElements& elements, MshCells cells, const MshGroups& groups, Mesh& mesh);

}  // namespace barycert::io
