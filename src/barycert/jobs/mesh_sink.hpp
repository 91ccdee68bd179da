/// Values at the nodes of a mesh, into a file of that mesh.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/jobs.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// The files that such an output has; what is wrong with it, as far as its name tells.
std::vector<std::string> files_of_mesh_output(const ResampleJob& job);
Status check_mesh_output(const ResampleJob& job);

/// True if the output is rows: CSV or NPY.
bool is_rows_output(const std::string& path);

/// Takes one row a node, and writes the mesh when all is there: VTK's files, or TetGen's by their stem. Error: columns
/// that are carried through, for which meshes have no place. `notes` gets the names that a .node file cannot hold,
/// once.
Result<std::unique_ptr<TableSink>> mesh_sink(Mesh mesh, const std::string& path, const TableFormat& format,
                                             Notes& notes);

}  // namespace barycert::jobs
