/// Some lines of a CSV file as points.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "barycert/io/csv/csv_layout.hpp"

namespace barycert::io {

/// What became of whole lines; the last of the file may lack its end.
struct CsvPiece {
    std::vector<double> points;   ///< of the lines before the bad one
    std::vector<Column> carried;  ///< likewise
    std::size_t lines = 0;        ///< parsed, the bad one included
    bool failed = false;
    std::string_view bad;  ///< the line that is no point, without its end
    bool cut = false;      ///< it ends with the file, and within a value: 0.2 may be the beginning of 0.25
};

/// Parses `text` up to its end or the first bad line. The byte after the text must be readable. Keeps the memory of
/// `piece`.
void parse_csv(std::string_view text, const CsvLayout& layout, int dimension, CsvPiece& piece);

}  // namespace barycert::io
