/// A mesh whose fields of nodes are rows that were sampled.
#pragma once

#include <string>

#include "app/jobs/stream.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/table_files.hpp"

namespace barycert::jobs {

/// Takes one row a node, and writes the mesh when all is there. Refused: carried columns.
Sink mesh_sink(Mesh mesh, const std::string& path, const TableFormat& format, Notes& notes);

}  // namespace barycert::jobs
