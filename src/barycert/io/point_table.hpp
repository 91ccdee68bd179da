/// Points that are in memory with what their file says of each, those of VTK's files among them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

struct PointTable : PointData {
    std::vector<std::string> unread;  ///< columns that nobody asked for, by name
};

/// As open_points chooses among columns: the coordinates x, y[, z]; NAME, or NAME.0, NAME.1, ... of each field; labels.
Result<std::unique_ptr<PointSource>> points_of_table(PointTable table, const std::string& file, int dimension,
                                                     const PointOptions& options);

/// Points and point arrays: integers of one component and texts as labels, all others as fields. Without `arrays` those
/// of XML files are not read, and their names are in PointTable::unread.
Result<PointTable> read_vtk_table(const std::string& path, bool arrays,
                                  NonfinitePoints nonfinite = NonfinitePoints::error);

/// As open_points, of a file with or without cells.
Result<std::unique_ptr<PointSource>> open_vtk_points(const std::string& path, int dimension,
                                                     const PointOptions& options);

}  // namespace barycert::io
