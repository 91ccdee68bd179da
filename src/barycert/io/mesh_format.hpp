/// Which reader and which writer a mesh goes to: the one place that knows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
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

/// What of the mesh a file of that format has no place for: names of fields, labels of cells, faces. What follows from
/// the cells, as neighbours do, is not among it.
Notes left_out_by(MeshFormat format, const Mesh& mesh);

/// Adds to `notes`, once, which of these names a .node or .ele file does not have: its columns have no names, and are
/// read as attribute0, attribute1, ...
void note_lost_names(const std::vector<std::string>& columns, const char* file, Notes& notes);

}  // namespace barycert::io
