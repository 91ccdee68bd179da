/// From a mesh to VTK's cells.
#pragma once

#include "barycert/mesh.hpp"

class vtkUnstructuredGrid;

namespace barycert::in_vtk {

/// Makes `grid` the mesh: as write_vtu writes it, so ParaView shows the same either way. Triangles get z = 0; cells are
/// quadratic where there are nodes at mid-edges; fields are arrays of doubles; point_markers an array "marker" of
/// 64-bit integers.
void fill_grid(const Mesh& mesh, vtkUnstructuredGrid& grid);

}  // namespace barycert::in_vtk
