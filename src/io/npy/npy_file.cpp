// The rows of an NPY file.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/npy/npy.hpp"
#include "io/streams.hpp"
#include "io/vtk/numbers.hpp"

namespace barycert::io {
namespace {

/// Sign, 5 bits of exponent, 10 of fraction.
double half(std::uint16_t bits) {
    const auto fraction = static_cast<double>(bits & 0x3FFU);
    const int exponent = static_cast<int>(bits >> 10 & 0x1FU);
    double x = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(fraction + 1024, exponent - 25);
    if (exponent == 31)
        x = fraction == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    return (bits & 0x8000U) != 0 ? -x : x;
}

/// Requires: a type whose kind and size are known; neither halves nor booleans.
NumberType number_type(const NpyType& type) {
    if (type.kind == 'f') return type.is_double() ? NumberType::float64 : NumberType::float32;
    const int first = static_cast<int>(type.kind == 'i' ? NumberType::int8 : NumberType::uint8);
    return static_cast<NumberType>(first + 2 * (static_cast<int>(std::bit_width(type.size)) - 1));
}

/// The numbers of `count` items, each `step` bytes behind the one before, to out[0], out[stride], ..., up to the first
/// that is none of that type (an integer that is no double, or beyond int64); how many there were.
template <class To>  // double, std::int64_t
std::size_t npy_numbers(const char* at, std::size_t step, std::size_t count, const NpyType& type, To* out,
                        std::size_t stride) {
    const auto all = [&]<class From>(const auto& change) {
        std::size_t i = 0;
        while (i < count && convert_number(change(number_at<From>(at + i * step, type.swapped)), out[i * stride])) ++i;
        return i;
    };
    if (type.kind == 'f' && type.size == 2) return all.template operator()<std::uint16_t>(half);
    if (type.kind == 'b')
        return all.template operator()<std::uint8_t>([](std::uint8_t x) { return static_cast<int>(x != 0); });
    return with_number_type(number_type(type),
                            [&]<class From>() { return all.template operator()<From>([](From x) { return x; }); });
}

/// The text at `at` without zeros at its end, characters in UTF-8; nothing if one is none. Requires: is_text().
std::optional<std::string> npy_text(const char* at, const NpyType& type) {
    if (type.kind == 'S') {
        std::size_t size = type.size;
        while (size != 0 && at[size - 1] == '\0') --size;
        return std::string(at, size);
    }
    std::string text;
    std::size_t count = type.size / 4;
    const auto code_at = [&](std::size_t i) { return number_at<std::uint32_t>(at + 4 * i, type.swapped); };
    while (count != 0 && code_at(count - 1) == 0) --count;
    for (std::size_t i = 0; i < count; ++i) {
        if (!append_utf8(text, code_at(i))) return std::nullopt;
    }
    return text;
}

void make_simple(const NpyHeader& header, const std::string& file, NpyTable& table) {
    const auto type = npy_type(header.descr);
    if (!type || type->size == 0)
        refuse_file("column.type", file, "cannot read an array of that type",
                    "integers, floating-point numbers or texts", base::quoted(header.descr), "save a.astype('f8')");
    const std::uint64_t columns = header.shape.size() == 2 ? header.shape[1] : 1;
    if (columns > most_npy_columns)
        refuse_file("point.dimension", file, "an array of another shape",
                    "at most " + std::to_string(most_npy_columns) + " columns", as_tuple(header.shape),
                    "save an array with a row for each point");
    table.row_size = columns * type->size;
    table.by_columns = header.fortran_order && columns > 1;
    for (std::uint64_t c = 0; c < columns; ++c) {
        const std::uint64_t first = (table.by_columns ? table.rows : 1) * c * type->size;
        table.columns.push_back({column_number(c), *type, first, table.by_columns ? type->size : table.row_size});
    }
}

/// `room`: the bytes after the header.
void check_room(const NpyTable& table, std::uint64_t room, const std::string& file) {
    const std::uint64_t row = table.row_size;
    if (row != 0 && table.rows > room / row)
        refuse_file("file.truncated", file, "the file ends too early",
                    std::to_string(table.rows) + " rows of " + std::to_string(row) + " bytes, as its header tells",
                    std::to_string(room) + " bytes", "the file may be cut short: write it again");
    if (table.rows * row != room)
        refuse_file("file.count", file, "bytes after the array",
                    std::to_string(table.rows * row) + ", as the header tells", std::to_string(room),
                    "save one array a file");
}

}  // namespace

NpyFile::NpyFile(const std::string& path)
    : path_(path),
      file_(base::InputFile::open(path, "save the array to a regular file first; CSV can be read from a pipe").value()),
      header_(read_npy_header(file_, path)) {}

void NpyFile::read(std::uint64_t offset, std::span<char> bytes) const {
    const std::uint64_t end = header_.size + offset + bytes.size();
    if (file_.read_at(header_.size + offset, bytes, path_).value() != bytes.size())
        refuse_file("file.truncated", path_, "the file ends too early", "byte " + std::to_string(end - 1),
                    "the end of the file", "do not change the file while it is read");
}

const NpyTable& NpyFile::make_table() {
    const std::vector<std::uint64_t>& shape = header_.shape;
    if (shape.empty() || shape.size() > (header_.structured ? 1U : 2U))
        refuse_file("point.dimension", path_, "an array of another shape", header_.structured ? "(n,)" : "(n, columns)",
                    as_tuple(shape), "save an array with a row for each point");
    table_.rows = shape[0];
    if (header_.structured) {
        table_.columns = header_.fields;
        table_.row_size = header_.item_size;
        for (NpyColumn& column : table_.columns) column.step = table_.row_size;
    } else {
        make_simple(header_, path_, table_);
    }
    check_room(table_, file_.size() - header_.size, path_);
    return table_;
}

void NpyFile::go_to(std::uint64_t first, std::size_t count) {
    first_ = first;
    count_ = count;
    if (table_.by_columns) return;
    bytes_.resize(count * table_.row_size);
    read(first * table_.row_size, bytes_);
}

/// Where the first value of the column in the rows stands.
const char* NpyFile::items(const NpyColumn& column) {
    if (!table_.by_columns) return bytes_.data() + column.first;
    bytes_.resize(count_ * column.step);
    read(column.first + first_ * column.step, bytes_);
    return bytes_.data();
}

void NpyFile::refuse(const std::string& what, std::size_t row, const char* expected, const char* remedy) const {
    throw Exception(
        about("options.keep", file_error("column.type", path_, "row " + std::to_string(first_ + row) + " of " + what,
                                         expected, "another value", remedy)));
}

void NpyFile::numbers(const NpyColumn& column, const std::string& what, double* out, std::size_t stride) {
    const std::size_t good = npy_numbers(items(column), column.step, count_, column.type, out, stride);
    if (good != count_) refuse(what, good, "an integer that a double holds exactly", "save a.astype('f8') to round it");
}

void NpyFile::values(const NpyColumn& column, const std::string& what, Column& out) {
    const char* const first = items(column);
    const auto append = [&]<class T>(std::vector<T>& values) {
        const char* const remedy = "leave the column out of options.keep";
        const std::size_t before = values.size();
        if constexpr (std::is_same_v<T, std::string>) {
            for (std::size_t i = 0; i < count_; ++i) {
                auto text = npy_text(first + i * column.step, column.type);
                if (!text) refuse(what, i, "characters of Unicode", remedy);
                values.push_back(std::move(*text));
            }
        } else {
            values.resize(before + count_);
            const std::size_t good = npy_numbers(first, column.step, count_, column.type, values.data() + before, 1);
            if (good != count_) refuse(what, good, "an integer below 2^63", remedy);
        }
    };
    std::visit(append, out.values);
}

}  // namespace barycert::io
