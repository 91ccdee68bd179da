/// The fields of the structured array that an NPY file of rows holds.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// The longest feature of a row: interior.
inline constexpr std::size_t npy_feature_size = 8;

struct NpyFields {
    std::string descr;                   ///< the list of names and types, as Python writes it
    std::size_t row_size = 0;            ///< bytes
    std::vector<std::size_t> carried{};  ///< the bytes of each carried column
};

/// How many bytes a carried column takes in a row.
std::size_t npy_size(const ColumnFormat& column);

/// Error: an empty name, one that is not UTF-8, two that are alike.
Result<NpyFields> npy_fields(const TableFormat& format, const std::string& path);

}  // namespace barycert::io
