/// Unstructured grids to VTU files through VTK's writer. Includes VTK.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <cstddef>
#include <string>

#include "barycert/result.hpp"

namespace barycert::io {

/// Writes the grid, raw appended and uncompressed, in memory first: `size` is about that of the file, so that the
/// stream takes no more than it does. Error: VTK's words; the file cannot be written.
Status write_vtu_grid(vtkUnstructuredGrid* grid, const std::string& path, std::size_t size);

/// VTK could not do it, for that reason.
Error vtk_failure(const std::string& path, std::string found);

}  // namespace barycert::io
