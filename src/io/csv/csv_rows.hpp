/// Points and rows in CSV.
#pragma once

#include <memory>
#include <string>

#include "barycert/point_files.hpp"
#include "barycert/table_files.hpp"

namespace barycert::io {

// As open_points and open_table. Errors are thrown as Exceptions.
std::unique_ptr<PointSource> open_csv_source(const std::string& path, int dimension, const PointOptions& options);
std::unique_ptr<TableSink> open_csv_sink(const std::string& path, const TableFormat& format);

}  // namespace barycert::io
