/// What the first line of a CSV file tells about the others, and why a line is refused.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/result.hpp"

namespace barycert::io {

struct CsvLayout {
    char separator = ',';        ///< ',' ';' '\t', or ' ' for blanks
    std::vector<int> axis_of{};  ///< one a field: the coordinate it holds, or -1
    bool header = false;         ///< the first line is a header
};

/// Where a line stands.
struct LinePlace {
    std::string file;
    std::size_t line = 0;
};

/// Not blank and no comment. With tabs as separator a line of tabs is a row without values, and so not blank.
bool holds_fields(std::string_view line, char separator);

/// From the first line that holds fields.
Result<CsvLayout> settle_csv_layout(std::string_view line, int dimension, const LinePlace& place);

/// Why the row was refused. Slow: called once.
Error csv_row_error(std::string_view line, const CsvLayout& layout, const LinePlace& place);

}  // namespace barycert::io
