/// A header line, then rows numbered from 0 or 1: the form of every TetGen file.
///
/// Rows are parsed on several threads. Their ids tell where they belong, so each block of lines can write straight to
/// its place: the first id of each block is looked at before any work starts, and every block verifies that its rows
/// lead from its own first id to that of the next block. Each thread reads its blocks into memory that it uses again.
/// Whatever fails is read whole and parsed again from the beginning, on one thread, which finds the first error;
/// results and errors therefore do not depend on the number of threads. Errors are thrown as Exceptions, which
/// read_guarded() makes a Result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/mesh.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"

namespace barycert::io {

inline constexpr std::int64_t max_count = INT32_MAX;

enum class ColumnKind : std::uint8_t {
    id,         ///< base + row
    index,      ///< base <= value < base + limit
    neighbour,  ///< an index, or -1 for none
    integer,
    real,
};

/// Columns alike. Values go to one of these vectors, k of row r to r * step + k, or a field each, or are checked alone.
struct Columns {
    ColumnKind kind = ColumnKind::id;
    std::size_t count = 1;
    std::string name{};       ///< of one of them, in messages
    std::int64_t limit = 0;   ///< of an index
    std::string refers_to{};  ///< of an index: what it counts

    std::vector<Mesh::Index>* indices = nullptr;
    std::vector<Mesh::Index>* more_indices = nullptr;  ///< of the columns from number `step` on
    std::size_t step = 0;                              ///< columns whose values go to `indices`; 0: all
    std::vector<std::int64_t>* integers = nullptr;
    std::vector<double>* reals = nullptr;
    std::vector<Field>* fields = nullptr;
};

struct TextTable {
    std::string file;
    base::InputFile input;
    int threads = 1;                  ///< that read it
    base::MappedFile data;            ///< all of it, or its first block
    bool is_whole = false;            ///< all of it
    std::string_view bytes;           ///< of data: whole lines, the first row among them
    std::size_t header_at = 0;        ///< the byte at which the first field of the header begins
    std::size_t body = 0;             ///< the byte at which the line after the header begins; 0: no header is read yet
    std::vector<std::size_t> header;  ///< the numbers of the header, at least the count of rows

    std::size_t rows = 0;
    int base = 0;
    bool base_is_given = false;  ///< by another file of the mesh
    std::vector<Columns> columns;
    std::string surplus_remedy;  ///< what to mend if rows have more columns than the header tells
    std::string finite_remedy = "give every node and cell finite numbers";
    std::string finite_subject = {};  ///< the member of options that the remedy names
    bool any_real = false;            ///< numbers may be nan and inf

    const char* begin() const { return bytes.data(); }
    const char* end() const { return begin() + bytes.size(); }
    void read_whole();
    std::size_t column_count() const;

    /// The header's number i, or what stands for it if the header is shorter.
    std::size_t header_field(std::size_t i, std::size_t otherwise) const {
        return i < header.size() ? header[i] : otherwise;
    }
    std::int64_t limit() const { return static_cast<std::int64_t>(rows); }

    std::vector<std::string_view> first_row() const;
};

/// Reads the file and its header: non-negative integers up to 2^31 - 1, one for each of `header_names` or fewer.
TextTable open_table(const std::string& path, std::span<const char* const> header_names, int threads);

/// Makes room for the values of all columns. Needs these and the base. Error: so many rows cannot stand in the file.
void make_room(TextTable& table);

/// Parses the rows of all tables; the error of the first table that has one.
void parse_tables(std::span<TextTable* const> tables, int threads);

/// The fields of the line that holds `at`, without its comment; an empty field where a comma has no neighbour.
std::vector<std::string_view> fields_of_line(const TextTable& table, const char* at);

/// As refuse_line(), of the header.
template <class... Parts>
[[noreturn]] void refuse_header(ErrorCode code, const TextTable& table, Parts&&... parts) {
    refuse_line(code, table.file, line_of(table.bytes, table.begin() + table.header_at), std::forward<Parts>(parts)...);
}

/// Header field `field` is no count; `name` is what it counts.
[[noreturn]] void refuse_count(const TextTable& table, std::string_view field, const char* name);

/// Row number `row` (from 0), which holds `at` and which the row parser refused.
[[noreturn]] void refuse_row(const TextTable& table, const char* at, std::size_t row);

[[noreturn]] void refuse_end(const TextTable& table, std::size_t found);
[[noreturn]] void refuse_surplus(const TextTable& table, const char* at);

}  // namespace barycert::io
