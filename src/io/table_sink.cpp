#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "files/output_file.hpp"
#include "io/csv/csv_rows.hpp"
#include "io/npy/npy_rows.hpp"
#include "io/parallel.hpp"
#include "io/paths.hpp"
#include "io/streams.hpp"
#include "io/table_format.hpp"
#include "io/vtk/out_file.hpp"

namespace barycert {
namespace io {

Status check_rows(const TableView& rows, const TableFormat& format, const std::string& path) {
    const std::size_t count = rows.cells.size();
    const std::size_t columns = format.columns().size();
    const bool carried = std::equal(rows.carried.begin(), rows.carried.end(), format.carried.begin(),
                                    format.carried.end(), [&](const Column& column, const ColumnFormat& of) {
                                        return column.type() == of.type && column.size() == count;
                                    });
    const bool good = carried && rows.dimension == format.dimension &&
                      rows.points.size() == count * static_cast<std::size_t>(format.dimension) &&
                      rows.features.size() == count && rows.values.size() == count * columns &&
                      rows.distances.size() == (format.distances ? count : 0);
    const auto degenerate = std::find(rows.features.begin(), rows.features.end(), Feature::degenerate);
    if (good && degenerate != rows.features.end())
        return file_error("point.degenerate", path, "a row in a degenerate cell",
                          "interior, face, edge, vertex or outside",
                          "degenerate, in row " + std::to_string(degenerate - rows.features.begin()) + " of a block",
                          "degenerate cells contain no points: mark the row as outside");
    if (good) return Done{};
    return file_error("argument.size", path, "the parts of a block of rows have different sizes",
                      "for each cell " + std::to_string(format.dimension) + " coordinates, a feature, " +
                          std::to_string(columns) + " values" + (format.distances ? ", a distance" : "") + ", " +
                          std::to_string(format.carried.size()) + " carried values of the types that were told",
                      std::to_string(count) + " cells, " + std::to_string(rows.points.size()) + " coordinates, " +
                          std::to_string(rows.features.size()) + " features, " + std::to_string(rows.values.size()) +
                          " values, " + std::to_string(rows.distances.size()) + " distances" +
                          (carried ? "" : ", other carried columns"),
                      "pass whole rows in the format of the sink");
}

RowSink::RowSink(const std::string& path, TableFormat format)
    : path_(path == "-" ? "standard output" : path),
      format_(std::move(format)),
      columns_(format_.columns().size()),
      file_(path == "-" ? base::OutputFile::standard_output() : base::OutputFile(path)) {}

Status RowSink::write(const TableView& rows) {
    // A thread lays out one piece at a time: large enough that handing it over costs nothing.
    constexpr std::size_t piece_size = std::size_t{1} << 18, pieces_at_once = 16;
    const ExactEnvironment environment;
    if (error_) return *error_;
    Status fits = check_rows(rows, format_, path_);
    if (fits) fits = check(rows);
    if (!fits) return *(error_ = fits.error());
    const std::size_t count = rows.cells.size(), longest = longest_row(rows);
    const std::size_t rows_a_piece = std::max<std::size_t>(1, piece_size / longest);
    // Pieces are laid out side by side and written in order: the bytes do not depend on the threads.
    for (std::size_t row = 0; row < count && file_.status();) {
        const std::size_t pieces = std::min(pieces_at_once, (count - row + rows_a_piece - 1) / rows_a_piece);
        if (pieces_.size() < pieces) pieces_.resize(pieces);
        std::array<std::string_view, pieces_at_once> texts;
        in_parallel(pieces, [&](std::size_t i) {
            const std::size_t first = row + i * rows_a_piece, last = std::min(first + rows_a_piece, count);
            char* const piece = pieces_[i].of((last - first) * longest);
            texts[i] = {piece, put_rows(rows, first, last, piece)};
        });
        for (std::size_t i = 0; i < pieces; ++i) file_.write(texts[i]);
        row = std::min(count, row + pieces * rows_a_piece);
    }
    return file_.status();
}

}  // namespace io

TableSink::~TableSink() = default;

Result<std::unique_ptr<TableSink>> open_table(const std::string& path, const TableFormat& format) try {
    const ExactEnvironment environment;
    if (format.dimension != 2 && format.dimension != 3)
        return file_error("point.dimension", path, "points of rows can have 2 or 3 coordinates", "2 or 3",
                          std::to_string(format.dimension));
    std::set<std::string> names;
    for (const std::string& name : format.columns()) {
        if (names.insert(name).second) continue;
        return file_error("column.duplicate", path, "two columns of the rows would have the same name",
                          "fields whose columns differ (components are NAME.0, NAME.1, ...)",
                          base::quoted(name) + " twice", "rename a field, or leave it out");
    }
    const Result<io::FormatKind> kind = io::format_of_table(path);
    if (kind && *kind == io::FormatKind::vtu) return io::open_vtu_sink(path, format);
    if (!kind || (path != "-" && !base::is_written_as(path, base::Use::rows)))
        return file_error("file.suffix", path, "cannot write rows in the format of that suffix",
                          base::suffixes_written(base::Use::rows) + ", or - for CSV on the standard output",
                          kind ? "a format for points alone" : kind.error().found,
                          "name a file with one of these suffixes");
    return *kind == io::FormatKind::csv ? io::open_csv_sink(path, format) : io::open_npy_sink(path, format);
} catch (const Exception& problem) {
    return problem.error();
}

}  // namespace barycert
