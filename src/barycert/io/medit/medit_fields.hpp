/// Fields in Medit's files.
#pragma once

#include "barycert/io/medit/medit_file.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Appends those of nodes and of cells of the mesh's dimension to its fields; others are noted.
Status add_medit_fields(const MeditFile& file, Mesh& mesh);

/// Notes the sections that nobody reads, under the name of all they are: "sections".
void note_medit_sections(const MeditFile& file, Notes& notes);

}  // namespace barycert::io
