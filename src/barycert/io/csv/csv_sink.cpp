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

// The longest text of a double is -2.2250738585072014e-308, that of an int32 -2147483648, that of a feature
// degenerate; and a comma or line end.
constexpr std::size_t longest_double = 24 + 1;
constexpr std::size_t longest_cell = 11 + 1;
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

/// A name as a field of CSV.
std::string as_field(const std::string& name) {
    if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
    std::string text = "\"";
    for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
    return text + '"';
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
        rows_a_piece_ = std::max<std::size_t>(1, piece_size / longest_row_);
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
    std::size_t longest_row_ = 0;
    std::size_t rows_a_piece_ = 0;
    std::vector<std::vector<char>> pieces_;
    Error error_;  // rows that do not fit
};

Status CsvSink::begin() {
    std::string header = format_.dimension == 2 ? "x,y,cell,feature" : "x,y,z,cell,feature";
    for (const std::string& column : format_.columns()) header += ',' + as_field(column);
    file_.write(header + (format_.distances ? ",distance\n" : "\n"));
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
        *at++ = '\n';
    }
    return at;
}

Status CsvSink::write(const TableView& rows) {
    const ExactEnvironment environment;
    if (!error_.what.empty()) return error_;
    if (Status fits = check_rows(rows, format_, path_); !fits) return error_ = fits.error();
    const std::size_t count = rows.cells.size();
    // Pieces are formatted side by side and written in order: the bytes do not depend on the threads.
    for (std::size_t row = 0; row < count && file_.status();) {
        const std::size_t pieces = std::min(pieces_at_once, (count - row + rows_a_piece_ - 1) / rows_a_piece_);
        while (pieces_.size() < pieces) pieces_.emplace_back(rows_a_piece_ * longest_row_);
        std::array<std::size_t, pieces_at_once> sizes{};
        // Whoever waits here must not begin other work of the caller: its stages wait for this one.
        tbb::this_task_arena::isolate([&] {
            tbb::parallel_for(std::size_t{0}, pieces, [&](std::size_t i) {
                const ExactEnvironment of_task;  // the arena is the caller's
                const std::size_t first = row + i * rows_a_piece_;
                char* const begin = pieces_[i].data();
                sizes[i] = static_cast<std::size_t>(format(rows, first, std::min(first + rows_a_piece_, count), begin) -
                                                    begin);
            });
        });
        for (std::size_t i = 0; i < pieces; ++i) file_.write({pieces_[i].data(), sizes[i]});
        row = std::min(count, row + pieces * rows_a_piece_);
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
