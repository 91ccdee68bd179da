/// The points of VTK's files with what stands at them.
#pragma once

#include <memory>
#include <string>

#include "barycert/io.hpp"
#include "barycert/io/point_table.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Points and point arrays: integers of one component and texts as labels, all others as fields. Without `arrays` those
/// of XML files are not read, and their names are in PointTable::unread.
Result<PointTable> read_vtk_table(const std::string& path, bool arrays,
                                  NonfinitePoints nonfinite = NonfinitePoints::error);

/// As open_points, of a file with or without cells.
Result<std::unique_ptr<PointSource>> open_vtk_points(const std::string& path, int dimension,
                                                     const PointOptions& options);

}  // namespace barycert::io
