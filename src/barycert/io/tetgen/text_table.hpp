/// A header line, then rows numbered from 0 or 1: the form of every TetGen file.
///
/// Rows are parsed on several threads. Their ids tell where they belong, so each block of lines can write straight to
/// its place: the first id of each block is looked at before any work starts, and every block verifies that its rows
/// lead from its own first id to that of the next block. Whatever fails is parsed again from the beginning, on one
/// thread, which finds the first error; results and errors therefore do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/base/mapped_file.hpp"
#include "barycert/io/tetgen/scanner.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// The largest count or index.
inline constexpr std::int64_t max_count = INT32_MAX;

enum class ColumnKind : std::uint8_t {
    id,         ///< base + row
    index,      ///< base <= value < base + limit
    neighbour,  ///< an index, or -1 for none
    integer,
    real,
};

/// Some columns alike.
struct Columns {
    ColumnKind kind = ColumnKind::id;
    std::size_t count = 0;
    std::string name;         ///< of one of them, in messages
    std::int64_t limit = 0;   ///< of an index
    std::string refers_to{};  ///< of an index: what it counts
};

/// Parses the rows [row, last) that stand before `stop`. On failure `row` and the scanner tell where.
using ParseBlock = std::function<bool(Scanner& scanner, const char* stop, std::size_t& row, std::size_t last)>;

struct TextTable {
    std::string file;
    base::MappedFile data;
    std::string_view bytes;            ///< of data
    const char* header_at = nullptr;   ///< the first field of the header
    const char* body = nullptr;        ///< the line after the header
    std::vector<std::int64_t> header;  ///< the numbers of the header, at least the count of rows

    std::size_t rows = 0;
    int base = 0;
    bool base_is_given = false;  ///< by another file of the mesh
    std::vector<Columns> columns;
    std::string surplus_remedy;  ///< what to mend if rows have more columns than the header tells
    std::string finite_remedy = "give every node and cell finite numbers";
    ParseBlock parse;

    const char* begin() const { return bytes.data(); }
    const char* end() const { return begin() + bytes.size(); }
    std::size_t column_count() const;

    /// The first row's fields; empty if there is no row.
    std::vector<std::string_view> first_row() const;
};

/// Reads the file and its header: non-negative integers up to 2^31 - 1, one for each of `header_names` or fewer.
Result<TextTable> open_table(const std::string& path, std::span<const char* const> header_names, int threads);

/// Refuses a count of rows that cannot stand in the file. Call before memory is taken for them.
/// Needs the columns and the base.
Status check_room(const TextTable& table);

/// Parses the rows of all tables; the error of the first table that has one.
Status parse_tables(std::span<TextTable* const> tables, int threads);

/// The ParseBlock of a row parser: bool(Scanner&, std::size_t row), which moves from the first field over the row end.
template <class ParseRow>
ParseBlock parse_block_by(ParseRow parse_row) {
    return [parse_row](Scanner& scanner, const char* stop, std::size_t& row, std::size_t last) {
        Scanner local = scanner;  // its address is not known elsewhere, so it may stay in registers
        std::size_t r = row;
        bool good = true;
        while (good && local.next_row(stop)) {
            good = r != last && parse_row(local, r);
            if (good) ++r;
        }
        scanner = local;
        row = r;
        return good && r == last;
    };
}

}  // namespace barycert::io
