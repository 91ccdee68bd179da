/// Which points and triangles a cut has, from the states of nodes alone.
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"

namespace barycert::surface {

/// Sets cells, mesh_cells and mesh_edges of the surface, and the counts of cells and points, from the State of each
/// node. On all threads of the calling arena. Error: a corner of a cell that is no node; more points or triangles than
/// indices can number.
Status cut_cells(const Mesh& mesh, const std::vector<std::uint8_t>& states, Surface& surface, CutCounts& counts);

}  // namespace barycert::surface
