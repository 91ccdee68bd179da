/// Points that are in memory with what their file says of each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

struct PointTable {
    int dimension = 3;           ///< of the file
    std::vector<double> points;  ///< `dimension` coordinates a point
    std::vector<Field> fields{};
    std::vector<Column> labels{};
    std::vector<std::string> unread{};  ///< columns that nobody asked for, by name
    Notes notes{};
};

/// As open_points chooses among columns: the coordinates x, y[, z]; NAME, or NAME.0, NAME.1, ... of each field; labels.
Result<std::unique_ptr<PointSource>> points_of_table(PointTable table, const std::string& file, int dimension,
                                                     const PointOptions& options);

}  // namespace barycert::io
