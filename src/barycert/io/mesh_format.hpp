/// Which reader and which writer a mesh goes to: the one place that knows.
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

/// Of a mesh that is to be read: by its first bytes if they tell, else by the end of its name; stems of TetGen's files
/// have none. Error: it is not there; it is a file of another format, which is named.
Result<MeshFormat> mesh_format(const std::string& path);

/// What meshio calls the format of a file that is MeshFormat::by_meshio.
std::string meshio_format(const std::string& path);

/// Of a mesh that is to be written: by the end of its name. Error: it is another one.
Result<MeshFormat> mesh_output_format(const std::string& path);

}  // namespace barycert::io
