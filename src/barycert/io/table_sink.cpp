#include <algorithm>
#include <set>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/vtk/out_file.hpp"

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
    if (good && degenerate != rows.features.end()) {
        return Error{
            .what = "a row in a degenerate cell",
            .file = path,
            .expected = "interior, face, edge, vertex or outside",
            .found = "degenerate, in row " + std::to_string(degenerate - rows.features.begin()) + " of a block",
            .remedy = "degenerate cells contain no points: mark the row as outside"};
    }
    if (good) return Done{};
    return Error{.what = "the parts of a block of rows have different sizes",
                 .file = path,
                 .expected = "for each cell " + std::to_string(format.dimension) + " coordinates, a feature, " +
                             std::to_string(columns) + " values" + (format.distances ? ", a distance" : "") + ", " +
                             std::to_string(format.carried.size()) + " carried values of the types that were told",
                 .found = std::to_string(count) + " cells, " + std::to_string(rows.points.size()) + " coordinates, " +
                          std::to_string(rows.features.size()) + " features, " + std::to_string(rows.values.size()) +
                          " values, " + std::to_string(rows.distances.size()) + " distances" +
                          (carried ? "" : ", other carried columns"),
                 .remedy = "pass whole rows in the format of the sink"};
}

}  // namespace io

TableSink::~TableSink() = default;

Result<std::unique_ptr<TableSink>> open_table(const std::string& path, const TableFormat& format) {
    const ExactEnvironment environment;
    if (format.dimension != 2 && format.dimension != 3) {
        return Error{.what = "points of rows can have 2 or 3 coordinates",
                     .file = path,
                     .expected = "2 or 3",
                     .found = std::to_string(format.dimension),
                     .remedy = {}};
    }
    std::set<std::string> names;
    for (const std::string& name : format.columns()) {
        if (names.insert(name).second) continue;
        return Error{.what = "two columns of the rows would have the same name",
                     .file = path,
                     .expected = "fields whose columns differ (components are NAME.0, NAME.1, ...)",
                     .found = base::quoted(name) + " twice",
                     .remedy = "rename a field, or leave it out"};
    }
    const Result<io::FileFormat> kind = io::format_of(path);
    if (kind && *kind == io::FileFormat::csv) return io::open_csv_sink(path, format);
    if (kind && *kind == io::FileFormat::npy) return io::open_npy_sink(path, format);
    if (kind && *kind == io::FileFormat::vtu) return io::open_vtu_sink(path, format);
    return Error{.what = "cannot write rows in the format of that suffix",
                 .file = path,
                 .expected = ".csv, .npy or .vtu, or - for CSV on the standard output",
                 .found = kind ? "a format for points alone" : kind.error().found,
                 .remedy = "name a .csv, .npy or .vtu file"};
}

}  // namespace barycert
