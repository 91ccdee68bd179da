/// Internal: the sources and sinks by format. `path` and `format` are as for open_source and open_sink.
#pragma once

#include <memory>
#include <string>

#include "barycert/io.hpp"

namespace barycert::points {

Result<std::unique_ptr<Source>> open_csv_source(const std::string& path, int dimension);
Result<std::unique_ptr<Source>> open_npy_source(const std::string& path, int dimension);
Result<std::unique_ptr<Source>> open_node_source(const std::string& path, int dimension);

Result<std::unique_ptr<Sink>> open_csv_sink(const std::string& path, const RowFormat& format);
Result<std::unique_ptr<Sink>> open_npy_sink(const std::string& path, const RowFormat& format);

/// Refuses rows whose spans do not fit together and the format, and the feature degenerate.
Status check_rows(const Rows& rows, const RowFormat& format, const std::string& path);

}  // namespace barycert::points
