/// The header of an NPY file: the type and the shape of its array, and the columns that these make. Its format:
/// numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/result.hpp"

namespace barycert::io {

/// A type by the letter of its kind and its bytes: 'f' 2, 4, 8; 'i', 'u' 1, 2, 4, 8; 'b' 1 (booleans); 'S' bytes, 'U'
/// characters of 4 bytes; 'V' others, that are passed over.
struct NpyType {
    char kind = 'V';
    std::size_t size = 0;
    bool swapped = false;  ///< in the byte order that is not this machine's
    std::string text{};    ///< as it stands in the file

    bool is_integer() const { return kind == 'i' || kind == 'u' || kind == 'b'; }
    bool is_number() const { return kind == 'f' || is_integer(); }
    bool is_text() const { return kind == 'S' || kind == 'U'; }
};

/// Of a simple type such as <f8. Nothing where the size of an item is not known, or an item is a Python object.
std::optional<NpyType> npy_type(std::string_view descr);

/// The number at `at`; nothing if it is an integer that is no double. Precondition: is_number().
std::optional<double> npy_double(const char* at, const NpyType& type);

/// The integer at `at`; nothing if it is beyond int64. Precondition: is_integer().
std::optional<std::int64_t> npy_integer(const char* at, const NpyType& type);

/// The text at `at`, in UTF-8 if it is of characters, without the zeros at its end; nothing if one is no character.
/// Precondition: is_text().
std::optional<std::string> npy_text(const char* at, const NpyType& type);

/// Precondition: a code of Unicode, and no surrogate.
void append_utf8(std::string& text, std::uint32_t code);

/// Whether that many bytes hold the text, as characters or as bytes.
bool fits_npy_text(std::string_view text, std::size_t size, bool characters);

/// Writes the text into `size` bytes, with zeros behind it. Precondition: it fits.
void put_npy_text(char* at, std::size_t size, std::string_view text, bool characters);

/// Where an NPY file keeps the sizes: 6 bytes of magic, 2 of version, then the length of the text in 2 or 4 bytes.
inline constexpr std::string_view npy_magic = "\x93NUMPY";
inline constexpr std::size_t npy_head = 12;

/// The text of a header is at most this long: more has no meaning for an array of numbers.
inline constexpr std::size_t longest_npy_text = std::size_t{1} << 20;

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
};

/// The place and length of the text of the header: where it begins, and how many bytes it has.
struct NpyText {
    std::size_t offset = 0;
    std::size_t size = 0;
    bool latin1 = false;  ///< else in UTF-8
};

/// From the first npy_head bytes of the file, or all of them. Errors: not an NPY file, another version.
Result<NpyText> find_npy_text(std::string_view head, const std::string& file);

/// From the text of the header, a Python dictionary of descr, fortran_order and shape; `latin1`: else it is UTF-8.
Result<NpyHeader> parse_npy_text(std::string_view text, bool latin1, const std::string& file);

struct NpyTable {
    std::uint64_t rows = 0;
    std::vector<NpyColumn> columns;
    std::size_t row_size = 0;  ///< bytes
    bool structured = false;
    bool by_columns = false;  ///< one column after the other, not row after row
};

/// At most so many columns: more have no meaning for points.
inline constexpr std::uint64_t most_npy_columns = std::uint64_t{1} << 16;

/// From the header. A field NAME of several values is NAME.0, NAME.1, ...; fields that are structures, and unnamed
/// ones, are passed over. An array without names has column1, column2, ...; one of shape (rows,) is one column. Errors:
/// a type of unknown size, or Python objects; a shape that is no table.
Result<NpyTable> npy_table(const NpyHeader& header, const std::string& file);

/// `room`: the bytes after the header. Error: there are more or fewer than the table has.
Status check_npy_room(const NpyTable& table, std::uint64_t room, const std::string& file);

/// As Python writes it: (5, 3), (5,), ().
std::string as_tuple(const std::vector<std::uint64_t>& shape);

}  // namespace barycert::io
