/// Meshes read by way of meshio.
#pragma once

#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "io/in_space.hpp"

namespace barycert::io {

/// Reads a mesh by way of meshio, whose name of the format is `format`: nodes and cells in its order, which is told
/// with its version and what it printed. Error: run_meshio(); meshio cannot read the file; read_vtk(); what comes back
/// differs from what meshio counted.
Result<Mesh> read_converted(const std::string& path, const std::string& format, InSpace* space);

/// The path and, of XDMF, the file of numbers that lies beside it.
std::vector<std::string> converted_files(const std::string& path);

}  // namespace barycert::io
