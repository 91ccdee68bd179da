/// A field from columns of a CSV file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Adds the data of the column of that name or number (from 1), or of the columns NAME.0, NAME.1, ... The first line
/// settles the separator as in files of points. Errors: no such column; a value that is no number, an integer that no
/// double represents, a line with more or fewer fields than the first.
Result<Field> read_csv_column(Field field, const std::string& path, const std::string& column);

/// The places of `name` among the names, or of NAME.0, NAME.1, ...; empty if there are none.
std::vector<std::size_t> columns_of_field(const std::vector<std::string>& names, const std::string& name);

}  // namespace barycert::io
