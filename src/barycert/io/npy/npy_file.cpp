#include "barycert/io/npy/npy_file.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "barycert/io.hpp"
#include "barycert/io/npy/npy_header.hpp"

namespace barycert::io {
namespace {

/// Bytes read at a time, or a row.
constexpr std::size_t bytes_at_once = std::size_t{1} << 18;

Error too_short(const std::string& path, std::string expected, std::string found, const char* remedy) {
    return file_error(path, "the file ends too early", std::move(expected), std::move(found), remedy);
}

}  // namespace

Status NpyFile::read(std::uint64_t offset, std::span<char> bytes) const {
    const Result<std::size_t> got = file_.read_at(data_ + offset, bytes, path_);
    if (!got) return got.error();
    if (*got == bytes.size()) return Done{};
    return too_short(path_, "byte " + std::to_string(data_ + offset + bytes.size() - 1), "the end of the file",
                     "do not change the file while it is read");
}

Result<NpyFile> NpyFile::open(const std::string& path) {
    Result<base::InputFile> opened =
        base::InputFile::open(path, "save the array to a regular file first; CSV can be read from a pipe");
    if (!opened) return opened.error();
    NpyFile out;
    out.path_ = path;
    out.file_ = std::move(*opened);
    const std::uint64_t size = out.file_.size();
    std::vector<char> bytes(std::min<std::uint64_t>(npy_head, size));
    if (Status head = out.read(0, bytes); !head) return head.error();
    const Result<NpyText> text = find_npy_text({bytes.data(), bytes.size()}, path);
    if (!text) return text.error();
    if (text->offset + text->size > size)
        return too_short(path, "a header of " + std::to_string(text->offset + text->size) + " bytes",
                         std::to_string(size), "the file may be cut short: write it again");
    bytes.resize(text->size);
    if (Status read = out.read(text->offset, bytes); !read) return read.error();
    auto header = parse_npy_text({bytes.data(), bytes.size()}, text->latin1, path);
    if (!header) return header.error();
    out.header_ = std::move(*header);
    out.data_ = text->offset + text->size;
    return out;
}

Result<NpyTable> NpyFile::table() const {
    Result<NpyTable> table = npy_table(header_, path_);
    if (!table) return table;
    if (Status fits = check_npy_room(*table, file_.size() - data_, path_); !fits) return fits.error();
    return table;
}

std::size_t NpyFile::rows_at_once(const NpyTable& table) {
    return std::max<std::size_t>(1, bytes_at_once / std::max<std::size_t>(1, table.row_size));
}

Status NpyFile::go_to(const NpyTable& table, std::uint64_t first, std::size_t count) {
    by_columns_ = table.by_columns;
    first_ = first;
    count_ = count;
    if (by_columns_) return Done{};
    bytes_.resize(count * table.row_size);
    return read(first * table.row_size, bytes_);
}

/// Where the first value of the column in the rows stands.
Result<const char*> NpyFile::items(const NpyColumn& column) {
    if (by_columns_) {
        bytes_.resize(count_ * column.step);
        if (Status done = read(column.first + first_ * column.step, bytes_); !done) return done.error();
    }
    return static_cast<const char*>(bytes_.data() + (by_columns_ ? 0 : column.first));
}

/// Calls take(i, place) for the value i of the rows; the first Error ends that.
template <class Take>
Status NpyFile::for_items(const NpyColumn& column, Take take) {
    const Result<const char*> first = items(column);
    if (!first) return first.error();
    const char* at = *first;
    for (std::size_t i = 0; i < count_; ++i, at += column.step) {
        if (Status taken = take(i, at); !taken) return taken;
    }
    return Done{};
}

Error NpyFile::value_error(const std::string& what, std::size_t row, const char* expected, const char* remedy) const {
    return file_error(path_, "row " + std::to_string(first_ + row) + " of " + what, expected, "another value", remedy);
}

Status NpyFile::numbers(const NpyColumn& column, const std::string& what, double* out, std::size_t stride) {
    if (column.type.kind == 'f') {  // there is nothing to refuse
        const Result<const char*> first = items(column);
        if (!first) return first.error();
        const char* at = *first;
        const bool as_in_memory = column.type.size == sizeof(double) && !column.type.swapped;
        for (std::size_t i = 0; i < count_; ++i, at += column.step) {
            if (as_in_memory) {
                std::memcpy(out + i * stride, at, sizeof(double));
            } else {
                out[i * stride] = *npy_double(at, column.type);
            }
        }
        return Done{};
    }
    return for_items(column, [&](std::size_t i, const char* at) -> Status {
        const auto x = npy_double(at, column.type);
        if (!x)
            return value_error(what, i, "an integer that a double holds exactly", "save a.astype('f8') to round it");
        out[i * stride] = *x;
        return Done{};
    });
}

Status NpyFile::values(const NpyColumn& column, const std::string& what, Column& out) {
    return for_items(column, [&](std::size_t i, const char* at) -> Status {
        if (column.type.kind == 'f') {
            std::get<std::vector<double>>(out.values).push_back(*npy_double(at, column.type));
        } else if (column.type.is_integer()) {
            const auto x = npy_integer(at, column.type);
            if (!x) return value_error(what, i, "an integer below 2^63", "leave the column out of options.keep");
            std::get<std::vector<std::int64_t>>(out.values).push_back(*x);
        } else {
            auto text = npy_text(at, column.type);
            if (!text) return value_error(what, i, "characters of Unicode", "leave the column out of options.keep");
            std::get<std::vector<std::string>>(out.values).push_back(std::move(*text));
        }
        return Done{};
    });
}

}  // namespace barycert::io
