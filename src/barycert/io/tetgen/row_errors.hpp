/// Why a line of a TetGen file is refused, in words. Slow: called once, for the one line that is told.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io/tetgen/text_table.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// The fields of the line that holds `at`, without its comment; an empty field where a comma has no neighbour.
std::vector<std::string_view> fields_of_line(const TextTable& table, const char* at);

/// The error of a header field or of the whole header.
Error header_error(const TextTable& table, std::string what, std::string expected, std::string found,
                   std::string remedy);

/// The error of header field `field` that is no count; `name` is what it counts.
Error count_error(const TextTable& table, std::string_view field, const char* name);

/// The error of row number `row` (from 0), which holds `at` and which the row parser refused.
Error row_error(const TextTable& table, const char* at, std::size_t row);

/// The file ended after `found` rows.
Error too_few_rows(const TextTable& table, std::size_t found);

/// At `at` there is text after the last row.
Error surplus_text(const TextTable& table, const char* at);

}  // namespace barycert::io
