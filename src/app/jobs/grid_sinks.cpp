#include "app/jobs/grid_sinks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "app/jobs/job_files.hpp"
#include "app/jobs/stream.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/figure.hpp"
#include "barycert/grid.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "files/output_file.hpp"
#include "io/npy/npy.hpp"
#include "io/vti/vti.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/out_file.hpp"

namespace barycert::jobs {

using base::FormatKind;

namespace {

static_assert(std::endian::native == std::endian::little, "NPY files are written as numbers stand in memory");

[[noreturn]] void refuse_label(const ColumnFormat& column, const std::string& path, const char* expected,
                               const char* remedy) {
    refuse_member("field.type", "job.fields", path, "the format has no place for a label of cells", expected,
                  base::quoted(column.name) + (column.type == Column::Type::text ? ", texts" : ", integers"), remedy);
}

/// VTK's image data: an array for each field, and what VTK's own probes give besides.
Sink open_vti(const std::string& path, const TableFormat& format, const Grid& grid) {
    std::vector<io::ArrayFormat> arrays;
    for (const TableField& f : format.fields) arrays.push_back({f.name, f.components, io::NumberType::float64});
    if (format.distances) arrays.push_back({"distance", 1, io::NumberType::float64});
    arrays.push_back({"vtkValidPointMask", 1, io::NumberType::int8});
    arrays.push_back({"cell", 1, io::NumberType::int32});
    for (const ColumnFormat& column : format.carried) {
        if (column.type == Column::Type::text)
            refuse_label(column, path, "numbers", "write .csv, or leave the label out of job.fields");
        const bool integer = column.type == Column::Type::integer;
        arrays.push_back({column.name, 1, integer ? io::NumberType::int64 : io::NumberType::float64});
    }
    const std::shared_ptr<io::VtiWriter> file =
        io::VtiWriter::open(path, {grid.counts, grid.origin, grid.spacing}, arrays, format.vtk_data).value();
    const auto write = [file, fields = format.fields, columns = format.columns().size(),
                        numbers = std::vector<double>(),
                        mask = std::vector<std::int8_t>()](const TableView& rows) mutable {
        std::size_t array = 0, first = 0;
        Status done = Done{};
        const auto put = [&](const auto& values) {
            if (done) done = file->write(array++, std::as_bytes(std::span(values)));
        };
        for (const TableField& field : fields) {
            const auto n = static_cast<std::size_t>(field.components);
            if (n == columns) {  // as they stand
                put(rows.values);
                break;
            }
            numbers.resize(n * rows.cells.size());
            for (std::size_t i = 0; i < rows.cells.size(); ++i)
                std::copy_n(&rows.values[columns * i + first], n, &numbers[n * i]);
            put(numbers);
            first += n;
        }
        if (!rows.distances.empty()) put(rows.distances);
        mask.resize(rows.cells.size());
        for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = rows.cells[i] >= 0 ? 1 : 0;
        put(mask);
        put(rows.cells);
        for (const Column& column : rows.carried) {  // texts were refused
            const auto* const integers = std::get_if<std::vector<std::int64_t>>(&column.values);
            integers != nullptr ? put(*integers) : put(std::get<std::vector<double>>(column.values));
        }
        return done;
    };
    return sink_of(write, [file] { return file->commit(); });
}

/// One array of float64, z slowest: its bytes are the values as they come.
Sink open_array(const std::string& path, const Grid& grid, std::size_t columns) {
    std::vector<std::uint64_t> shape(grid.counts.rend() - grid.dimension, grid.counts.rend());
    if (columns > 1) shape.push_back(columns);
    const auto file = std::make_shared<base::OutputFile>(path);
    file->write(io::npy_header_of("'<f8'", shape));
    const auto write = [file](const TableView& rows) {
        file->write({reinterpret_cast<const char*>(rows.values.data()), rows.values.size_bytes()});
        return file->status();
    };
    return sink_of(write, [file] { return file->commit(); });
}

/// A picture of one column. It is kept in memory: its colours depend on all of it.
Sink open_picture(const ResampleJob& a, const std::string& path, const std::vector<std::string>& columns,
                  const Grid& grid, std::optional<FigureCounts>& counts) {
    // The two axes of a grid in a plane.
    std::vector<std::size_t> axes;
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) {
        if (grid.counts[k] > 1 || grid.dimension == 2) axes.push_back(k);
    }
    if (axes.size() != 2)
        refuse_member("picture.too-large", "job.counts", path, "a picture shows one layer",
                      "one point along exactly one axis, such as job.counts 800x600x1",
                      fmt::format("{} points", fmt::join(grid.counts, " x ")),
                      "choose the layer with job.bounds: it lies in the middle of the bounds");
    constexpr std::int64_t max = 1000000;
    const std::size_t w = axes[0], h = axes[1];
    if (grid.counts[w] > max || grid.counts[h] > max)
        refuse_member("picture.too-large", "job.counts", path, "too many points for a picture",
                      "at most 1000000 along each axis", fmt::format("{} x {}", grid.counts[w], grid.counts[h]),
                      "choose a coarser grid");
    if (columns.size() != 1)
        refuse_member("field.component", "job.fields", path, "a picture shows one column",
                      "a field of one component, chosen by job.fields",
                      columns.empty() ? "no field" : fmt::format("{}", fmt::join(columns, ", ")),
                      columns.empty() ? "add one by job.field_files NAME=FILE" : "name one in job.fields");
    FigureGrid picture;
    picture.width = static_cast<std::size_t>(grid.counts[w]);
    picture.height = static_cast<std::size_t>(grid.counts[h]);
    picture.origin = {grid.origin[w], grid.origin[h]};
    if (grid.spacing[w] > 0 && grid.spacing[h] > 0) picture.spacing = {grid.spacing[w], grid.spacing[h]};
    FigureOptions options = a.figure;
    options.axis_names = {std::string{"xyz"[w]}, std::string{"xyz"[h]}};
    if (options.bar_title.empty()) options.bar_title = columns.front();
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) {
        if (k != w && k != h && options.title.empty() && options.axes != Axes::none)
            options.title = fmt::format("{} = {}", "xyz"[k], base::shortest(grid.origin[k]));
    }
    const auto values = std::make_shared<std::vector<double>>();
    const auto valid = std::make_shared<std::vector<std::uint8_t>>();
    const auto write = [values, valid](const TableView& rows) -> Status {
        values->insert(values->end(), rows.values.begin(), rows.values.end());
        // A point outside is transparent only where it has got no value.
        for (std::size_t i = 0; i < rows.cells.size(); ++i)
            valid->push_back(rows.cells[i] >= 0 || std::isfinite(rows.values[i]) ? 1 : 0);
        return Done{};
    };
    return sink_of(write, [=, &counts]() mutable {
        picture.values = *values;
        picture.valid = *valid;
        return write_figure(path, {.dimension = 2, .grid = picture, .options = options}, &counts.emplace());
    });
}

}  // namespace

std::array<double, 3> point_of(const Grid& grid, std::uint64_t i) {
    const auto nx = static_cast<std::uint64_t>(grid.counts[0]);
    const std::array<std::uint64_t, 3> at{i % nx, i % grid.layer_size() / nx, i / grid.layer_size()};
    std::array<double, 3> point{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k)
        point[k] = grid.coordinate(k, static_cast<std::int64_t>(at[k]));
    return point;
}

Sink open_grid_sink(const ResampleJob& job, const std::string& path, const TableFormat& format, const Grid& grid,
                    std::optional<FigureCounts>& picture) {
    const std::vector<std::string> columns = format.columns();
    const bool png = is_figure_name(path), array = base::kind_of(path) == FormatKind::npy;
    if (!format.carried.empty() && (png || array))
        refuse_label(format.carried.front(), path, "fields",
                     "write .csv, or integers to .vti, or leave the label out of job.fields");
    if (png) return open_picture(job, path, columns, grid, picture);
    if (array && columns.empty())
        refuse_member("option.missing", "job.field_files", path, "no field to write", "", "",
                      "add one by job.field_files NAME=FILE; .vti and .csv can be written without fields");
    if (array) return open_array(path, grid, columns.size());
    if (base::kind_of(path) == FormatKind::vti) return open_vti(path, format, grid);
    // With the points of the grid, as rows of points from a file have them.
    const auto add_points = [grid, points = std::vector<double>()](TableView& block) mutable {
        const auto d = static_cast<std::size_t>(grid.dimension);
        points.clear();
        for (std::size_t i = 0; i < block.cells.size(); ++i) {
            const std::array<double, 3> point = point_of(grid, block.first_row + i);
            points.insert(points.end(), point.data(), point.data() + d);
        }
        block.points = points;
    };
    return changed(open_rows(path, format), add_points);
}

}  // namespace barycert::jobs
