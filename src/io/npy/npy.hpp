/// NPY files: the types of their items, the columns that the header makes of them, their rows. The format:
/// numpy.org/doc/stable/reference/generated/numpy.lib.format.html. Errors are thrown as Exceptions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/mesh.hpp"
#include "files/input_file.hpp"

namespace barycert::io {

/// A type by the letter of its kind and its bytes: 'f' 2, 4, 8; 'i', 'u' 1, 2, 4, 8; 'b' 1 (booleans); 'S' bytes, 'U'
/// characters of 4 bytes; 'V' others, that are passed over.
struct NpyType {
    char kind = 'V';
    std::size_t size = 0;
    bool swapped = false;  ///< in the byte order that is not this machine's
    std::string text{};    ///< as it stands in the file

    bool is_double() const { return kind == 'f' && size == 8; }
    bool is_integer() const { return kind == 'i' || kind == 'u' || kind == 'b'; }
    bool is_number() const { return kind == 'f' || is_integer(); }
    bool is_text() const { return kind == 'S' || kind == 'U'; }
};

/// Returns the type that a simple code such as <f8 means. Nothing where the size of an item is not known, or an item is
/// a Python object.
std::optional<NpyType> npy_type(std::string_view descr);

/// False if it is no code of Unicode, or a surrogate.
bool append_utf8(std::string& text, std::uint32_t code);

/// The text of a header is at most this long: more has no meaning for an array of numbers.
inline constexpr std::size_t longest_npy_text = std::size_t{1} << 20;

/// As Python writes it: (5, 3), (5,), ().
std::string as_tuple(const std::vector<std::uint64_t>& shape);

/// The header of an array, padded to `size` bytes; 0: to the next multiple of 64.
std::string npy_header_of(const std::string& descr, const std::vector<std::uint64_t>& shape, std::size_t size = 0);

/// Value i of a column stands at first + i * step, in bytes from the end of the header.
struct NpyColumn {
    std::string name;
    NpyType type;
    std::uint64_t first = 0, step = 0;
};

struct NpyHeader {
    std::string descr;  ///< the type as it stands there: <f8
    bool structured = false;
    std::vector<NpyColumn> fields;  ///< of a structured type, without steps
    std::uint64_t item_size = 0;    ///< likewise, in bytes
    bool fortran_order = false;
    std::vector<std::uint64_t> shape;
    std::size_t size = 0;  ///< of the header, in bytes
};

NpyHeader read_npy_header(const base::InputFile& file, const std::string& path);

/// At most so many columns: more have no meaning for points.
inline constexpr std::uint64_t most_npy_columns = std::uint64_t{1} << 16;

/// A field NAME of several values is NAME.0, ...; structures and unnamed ones are passed over. Or column1, ...
struct NpyTable {
    std::uint64_t rows = 0;
    std::vector<NpyColumn> columns;
    std::size_t row_size = 0;  ///< bytes
    bool by_columns = false;   ///< one column after the other, not row after row
};

/// The rows are read by blocks and not mapped: memory is bounded, and a file that shrinks meanwhile is told.
class NpyFile {
public:
    explicit NpyFile(const std::string& path);

    const NpyHeader& header() const { return header_; }

    /// Columns can be read afterwards. Error: a type of unknown size, Python objects, a shape or size of no table.
    const NpyTable& make_table();

    /// How many rows of the table are read at once: some hundred kilobytes, or one.
    std::size_t rows_at_once() const {
        return std::max<std::size_t>(1, (std::size_t{1} << 18) / std::max<std::size_t>(1, table_.row_size));
    }

    /// Reads `count` rows from row `first` on; of a table by columns nothing, yet.
    void go_to(std::uint64_t first, std::size_t count);

    /// The numbers of a column in these rows, to out[0], out[stride], ... Error, of `what`: an integer is no double.
    void numbers(const NpyColumn& column, const std::string& what, double* out, std::size_t stride);

    /// Appends the values to `out`, a column of their type. Error: an integer beyond int64; a text not of characters.
    void values(const NpyColumn& column, const std::string& what, Column& out);

    void read(std::uint64_t offset, std::span<char> bytes) const;

private:
    const char* items(const NpyColumn& column);
    [[noreturn]] void refuse(const std::string& what, std::size_t row, const char* expected, const char* remedy) const;

    std::string path_;
    base::InputFile file_;
    NpyHeader header_;
    NpyTable table_;
    std::uint64_t first_ = 0;  // of the rows gone to
    std::size_t count_ = 0;
    std::vector<char> bytes_;  // of these rows, or of one column
};

}  // namespace barycert::io
