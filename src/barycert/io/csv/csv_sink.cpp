#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "barycert/base/output_file.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"

namespace barycert::io {
namespace {

// The longest text of a double is -2.2250738585072014e-308, that of an int32 -2147483648, of an int64
// -9223372036854775808, that of a feature
// degenerate; and a comma or line end.
constexpr std::size_t longest_double = 24 + 1;
constexpr std::size_t longest_cell = 11 + 1;
constexpr std::size_t longest_integer = 20 + 1;
constexpr std::size_t longest_feature = 10 + 1;

// What one thread formats at a time: large enough that handing it over costs nothing.
constexpr std::size_t piece_size = std::size_t{1} << 18;
constexpr std::size_t pieces_at_once = 16;

char* put(char* at, double x) {
    if (std::isnan(x)) [[unlikely]] {  // its sign bit says nothing
        for (const char c : {'n', 'a', 'n'}) *at++ = c;
        return at;
    }
    return std::to_chars(at, at + longest_double, x).ptr;
}

/// Whether a name or text would not be read as it is: readers settle the separator by the header, and pass over blanks
/// around fields.
bool needs_quotes(std::string_view text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
    return text.find_first_of(",;\"\r\n\t") != std::string_view::npos ||
           (!text.empty() && (is_blank(text.front()) || is_blank(text.back())));
}

/// A name or text as a field of CSV takes this much at most.
std::size_t longest_field(std::string_view text) {
    return 2 * text.size() + 2 + 1;
}

char* put(char* at, std::string_view text) {
    if (!needs_quotes(text)) return std::copy(text.begin(), text.end(), at);
    *at++ = '"';
    for (const char c : text) {
        if (c == '"') *at++ = c;
        *at++ = c;
    }
    *at++ = '"';
    return at;
}

std::string as_field(const std::string& name) {
    std::string text(longest_field(name), '\0');
    text.resize(static_cast<std::size_t>(put(text.data(), name) - text.data()));
    return text;
}

char* put(char* at, const Column& column, std::size_t row) {
    if (const auto* const integers = std::get_if<std::vector<std::int64_t>>(&column.values))
        return std::to_chars(at, at + longest_integer, (*integers)[row]).ptr;
    if (const auto* const numbers = std::get_if<std::vector<double>>(&column.values)) return put(at, (*numbers)[row]);
    return put(at, std::string_view(std::get<std::vector<std::string>>(column.values)[row]));
}

/// What the carried columns of any of these rows take at most.
std::size_t longest_carried(const TableView& rows) {
    std::size_t size = 0;
    for (const Column& column : rows.carried) {
        std::size_t longest = std::max(longest_integer, longest_double);
        if (const auto* const texts = std::get_if<std::vector<std::string>>(&column.values)) {
            longest = 0;
            for (const std::string& text : *texts) longest = std::max(longest, longest_field(text));
        }
        size += longest;
    }
    return size;
}

class CsvSink final : public TableSink {
public:
    CsvSink(const std::string& path, TableFormat format)
        : path_(path == "-" ? "standard output" : path),
          format_(std::move(format)),
          columns_(format_.columns().size()),
          file_(path == "-" ? base::OutputFile::standard_output() : base::OutputFile(path)) {
        const std::size_t numbers =
            static_cast<std::size_t>(format_.dimension) + columns_ + (format_.distances ? 1 : 0);
        longest_row_ = numbers * longest_double + longest_cell + longest_feature + 1;
    }

    Status begin();
    Status write(const TableView& rows) override;
    Status commit() override { return error_.what.empty() ? file_.commit() : Status(error_); }

private:
    /// The rows [first, last) as text; the place after it.
    char* format(const TableView& rows, std::size_t first, std::size_t last, char* at) const;

    std::string path_;
    TableFormat format_;
    std::size_t columns_;
    base::OutputFile file_;
    std::size_t longest_row_ = 0;  // without carried columns
    std::vector<std::vector<char>> pieces_;
    Error error_;  // rows that do not fit
};

Status CsvSink::begin() {
    std::string header = format_.dimension == 2 ? "x,y,cell,feature" : "x,y,z,cell,feature";
    for (const std::string& column : format_.columns()) header += ',' + as_field(column);
    if (format_.distances) header += ",distance";
    for (const ColumnFormat& column : format_.carried) header += ',' + as_field(column.name);
    file_.write(header + '\n');
    return file_.status();
}

char* CsvSink::format(const TableView& rows, std::size_t first, std::size_t last, char* at) const {
    const auto dimension = static_cast<std::size_t>(format_.dimension);
    for (std::size_t row = first; row < last; ++row) {
        for (const double x : rows.points.subspan(row * dimension, dimension)) {
            at = put(at, x);
            *at++ = ',';
        }
        at = std::to_chars(at, at + longest_cell, rows.cells[row]).ptr;
        *at++ = ',';
        for (const char c : name(rows.features[row])) *at++ = c;
        for (const double value : rows.values.subspan(row * columns_, columns_)) {
            *at++ = ',';
            at = put(at, value);
        }
        if (format_.distances) {
            *at++ = ',';
            at = put(at, rows.distances[row]);
        }
        for (const Column& column : rows.carried) {
            *at++ = ',';
            at = put(at, column, row);
        }
        *at++ = '\n';
    }
    return at;
}

Status CsvSink::write(const TableView& rows) {
    const ExactEnvironment environment;
    if (!error_.what.empty()) return error_;
    if (Status fits = check_rows(rows, format_, path_); !fits) return error_ = fits.error();
    const std::size_t count = rows.cells.size();
    const std::size_t longest_row = longest_row_ + longest_carried(rows);
    const std::size_t rows_a_piece = std::max<std::size_t>(1, piece_size / longest_row);
    // Pieces are formatted side by side and written in order: the bytes do not depend on the threads.
    for (std::size_t row = 0; row < count && file_.status();) {
        const std::size_t pieces = std::min(pieces_at_once, (count - row + rows_a_piece - 1) / rows_a_piece);
        if (pieces_.size() < pieces) pieces_.resize(pieces);
        for (std::size_t i = 0; i < pieces; ++i) {
            const std::size_t most = std::min(rows_a_piece, count - row) * longest_row;
            if (pieces_[i].size() < most) pieces_[i].resize(most);
        }
        std::array<std::size_t, pieces_at_once> sizes{};
        // Whoever waits here must not begin other work of the caller: its stages wait for this one.
        tbb::this_task_arena::isolate([&] {
            tbb::parallel_for(std::size_t{0}, pieces, [&](std::size_t i) {
                const ExactEnvironment of_task;  // the arena is the caller's
                const std::size_t first = row + i * rows_a_piece;
                char* const begin = pieces_[i].data();
                sizes[i] =
                    static_cast<std::size_t>(format(rows, first, std::min(first + rows_a_piece, count), begin) - begin);
            });
        });
        for (std::size_t i = 0; i < pieces; ++i) file_.write({pieces_[i].data(), sizes[i]});
        row = std::min(count, row + pieces * rows_a_piece);
    }
    return file_.status();
}

}  // namespace

Result<std::unique_ptr<TableSink>> open_csv_sink(const std::string& path, const TableFormat& format) {
    auto sink = std::make_unique<CsvSink>(path, format);
    if (Status begun = sink->begin(); !begun) return begun.error();
    return std::unique_ptr<TableSink>(std::move(sink));
}

}  // namespace barycert::io
