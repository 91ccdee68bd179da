/// Points that are in memory, with what their file says of each.
#pragma once

#include <memory>
#include <string>

#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "io/tetgen/node_table.hpp"

namespace barycert::io {

/// As open_points of a .node file. Error, thrown as an Exception: it cannot be read.
std::unique_ptr<PointSource> open_node_source(const std::string& path, int dimension, const PointOptions& options);

/// As open_points chooses among columns: the coordinates x, y[, z]; NAME, or NAME.0, NAME.1, ... of each field; labels.
std::unique_ptr<PointSource> points_of_table(PointTable table, const std::string& file, int dimension,
                                             const PointOptions& options);

/// Points and point arrays: integers of one component and texts as labels. Without `arrays` those of XML are unread.
Result<PointTable> read_vtk_table(const std::string& path, bool arrays,
                                  NonfinitePoints nonfinite = NonfinitePoints::error);

}  // namespace barycert::io
