/// TetGen behind one call. Only mesher.cpp sees TetGen's header.
///
/// TetGen prints, throws integers, calls exit(), may crash or never end: call make_mesh() in a child (child.hpp).
#pragma once

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

namespace barycert {

/// The cells of the region that the facets enclose. `switches` are TetGen's, without a dash. The mesh has no cells if
/// TetGen carved everything away. Throws TetGen's error codes, which are integers, and std::bad_alloc.
Mesh make_mesh(const Plc& plc, std::string switches);

std::pair<std::string_view, std::string_view> meaning_of(int code);

}  // namespace barycert
