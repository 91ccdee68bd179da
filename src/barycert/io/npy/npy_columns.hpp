/// The columns of an NPY file: those of an array of rows, or the fields of a structured one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io/npy/npy_header.hpp"
#include "barycert/io/npy/npy_types.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Value i of a column stands at first + i * step, in bytes from the end of the header.
struct NpyColumn {
    std::string name;
    NpyType type;
    std::uint64_t first = 0, step = 0;
};

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
