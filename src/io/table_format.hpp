/// The formats of rows and points, and what rows must hold.
#pragma once

#include <string>

#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "io/paths.hpp"

namespace barycert::io {

/// The format of rows or points by the suffix: csv, npy, node or vtu; "-" is CSV. Error: another suffix.
Result<FormatKind> format_of_table(const std::string& path);

/// The same for points: .txt .dat .xyz .tsv are CSV, as pipes and devices; first bytes tell a file without a suffix.
Result<FormatKind> format_of_points(const std::string& path);

/// Refuses rows whose spans and columns do not fit together and the format, and the feature degenerate.
Status check_rows(const TableView& rows, const TableFormat& format, const std::string& path);

}  // namespace barycert::io
