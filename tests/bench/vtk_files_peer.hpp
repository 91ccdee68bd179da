/// VTK's own readers and writers of unstructured grids. Only where VTK is there (BARYCERT_WITH_VTK).
#pragma once

#include <memory>
#include <string>

#include "barycert/mesh.hpp"
#include "barycert/table.hpp"

namespace barycert::bench {

/// A vtkUnstructuredGrid.
using VtkGrid = std::shared_ptr<void>;

/// The grid of a .vtu or .vtk file; nullptr if VTK tells of an error.
VtkGrid vtk_read(const std::string& path);

/// By the suffix: .vtu with appended data (or ascii), .vtk binary or ascii.
bool vtk_write(const VtkGrid& grid, const std::string& path, VtkData data);

/// Whether all points, nodes of cells and point fields are those of the mesh, doubles by their bits.
bool vtk_is(const VtkGrid& grid, const Mesh& mesh);

}  // namespace barycert::bench
