/// The rows of an NPY file, read by blocks and not mapped: memory is bounded, and a file that shrinks meanwhile is
/// told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "barycert/base/input_file.hpp"
#include "barycert/io/npy/npy_header.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

class NpyFile {
public:
    /// Reads the header.
    static Result<NpyFile> open(const std::string& path);

    const NpyHeader& header() const { return header_; }

    /// See npy_table; and checks the size of the file. Columns can be read afterwards.
    Result<NpyTable> table() const;

    /// How many rows of the table are read at once: some hundred kilobytes, or one.
    static std::size_t rows_at_once(const NpyTable& table);

    /// Reads `count` rows from row `first` on; of a table by columns nothing, yet.
    Status go_to(const NpyTable& table, std::uint64_t first, std::size_t count);

    /// The numbers of a column in these rows, to out[0], out[stride], ...; `what` is the column in messages. Error: an
    /// integer that is no double. Precondition: a column of numbers.
    Status numbers(const NpyColumn& column, const std::string& what, double* out, std::size_t stride);

    /// Appends them to `out`, a column of integers, numbers or texts, as the type is. Error: an integer beyond int64; a
    /// text that is not of characters.
    Status values(const NpyColumn& column, const std::string& what, Column& out);

    /// The bytes of the array from `offset` on.
    Status read(std::uint64_t offset, std::span<char> bytes) const;

private:
    Result<const char*> items(const NpyColumn& column);
    template <class Take>
    Status for_items(const NpyColumn& column, Take take);
    Error value_error(const std::string& what, std::size_t row, const char* expected, const char* remedy) const;

    std::string path_;
    base::InputFile file_;
    std::uint64_t data_ = 0;  // where the array begins
    NpyHeader header_;
    bool by_columns_ = false;
    std::uint64_t first_ = 0;  // of the rows gone to
    std::size_t count_ = 0;
    std::vector<char> bytes_;  // of these rows, or of one column
};

}  // namespace barycert::io
