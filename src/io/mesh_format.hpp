/// The formats of meshes.
#pragma once

#include <cstdint>
#include <string>

#include "barycert/result.hpp"

namespace barycert::io {

enum class MeshFormat : std::uint8_t {
    tetgen,  ///< and Triangle: several files of one stem
    vtk,
    gmsh,
    medit,
    by_meshio,  ///< converted: io/converted
};

/// Returns the format of a mesh to read: by its first bytes, else the end of its name. Error: none is recognised, or
/// one that is not read.
Result<MeshFormat> mesh_format(const std::string& path);

/// The name that meshio has for the format; empty if it is not read by way of it.
std::string meshio_format(const std::string& path);

/// Returns the format of a mesh to write: by the end of its name. Error: no such format.
Result<MeshFormat> mesh_output_format(const std::string& path);

}  // namespace barycert::io
