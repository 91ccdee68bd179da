#include "io/point_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "core/base/finite.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "io/csv/csv_rows.hpp"
#include "io/errors.hpp"
#include "io/npy/npy_rows.hpp"
#include "io/paths.hpp"
#include "io/streams.hpp"
#include "io/table_format.hpp"
#include "io/tetgen/node_table.hpp"
#include "mesh/columns.hpp"

namespace barycert::io {
namespace {

class TableSource final : public ColumnSource {
public:
    TableSource(std::vector<double> points, int dimension, std::vector<Column> columns = {}, Notes notes = {})
        : ColumnSource(dimension),
          points_(std::move(points)),
          count_(points_.size() / dimension_),
          columns_(std::move(columns)) {
        notes_ = std::move(notes);
        for (const Column& column : columns_) formats_.push_back(mesh::format_of(column));
    }

    std::optional<std::uint64_t> count() const override { return count_; }

private:
    std::size_t next(std::size_t max_points, std::vector<double>& out) override {
        const std::size_t taken = std::min(max_points, count_ - next_);
        const double* const first = points_.data() + next_ * dimension_;
        out.insert(out.end(), first, first + taken * dimension_);
        for (std::size_t k = 0; k < columns_.size(); ++k) mesh::move_values(columns_[k], next_, taken, carried_[k]);
        next_ += taken;
        return taken;
    }

    std::vector<double> points_;
    std::size_t count_, next_ = 0;
    std::vector<Column> columns_;
};

/// A column: the numbers numbers[step * i], or a label; neither of one that is not read.
struct Place {
    const std::vector<double>* numbers = nullptr;
    std::size_t first = 0, step = 0;
    Column* label = nullptr;
};

PointTable nodes_of(Mesh mesh) {
    PointTable table;
    table.dimension = mesh.dimension;
    table.points = std::move(mesh.points);
    table.fields = std::move(mesh.point_fields);
    if (!mesh.point_markers.empty()) table.labels.push_back({"marker", std::move(mesh.point_markers)});
    table.notes = std::move(mesh.notes);
    return table;
}

std::unique_ptr<PointSource> open_any(const std::string& path, int dimension, const PointOptions& options) {
    const auto source_of = [&](PointTable table) {
        return points_of_table(std::move(table), path, dimension, options);
    };
    if (is_vtk_file(path)) {
        const bool arrays = !options.keep.empty() || !options.columns.empty();
        return source_of(read_vtk_table(path, arrays, options.nonfinite_points).value());
    }
    const Result<FormatKind> format = format_of_points(path);
    if (format)
        return (*format == FormatKind::csv   ? open_csv_source
                : *format == FormatKind::npy ? open_npy_source
                                             : open_node_source)(path, dimension, options);
    // A stem, or the file of a mesh; what is neither is told as a file of points that is not known.
    if (std::ranges::any_of(mesh_files(path), exists))
        return source_of(nodes_of(read_mesh(path, {.faces = false, .neighbours = false}).value()));
    Error unknown = format.error();
    unknown.expected = "points (" + base::suffix_list_read(base::Use::points) + ", - for CSV from stdin) or a mesh";
    throw Exception(unknown);
}

}  // namespace

std::unique_ptr<PointSource> open_node_source(const std::string& path, int dimension, const PointOptions& options) {
    NodeTable nodes = read_node_table(path, dimension, options);
    return points_of_table(std::move(nodes.points), nodes.file, dimension, options);
}

std::unique_ptr<PointSource> points_of_table(PointTable table, const std::string& file, int dimension,
                                             const PointOptions& options) {
    const auto size = static_cast<std::size_t>(table.dimension);
    TableColumns all{.names = {}, .file = file, .coordinates = size};
    std::vector<Place> places;
    const auto add = [&](std::string name, const Place& place) {
        all.names.push_back(std::move(name));
        places.push_back(place);
    };
    for (std::size_t axis = 0; axis < size; ++axis) add(std::string(1, "xyz"[axis]), {&table.points, axis, size});
    for (const Field& field : table.fields) {
        const std::vector<std::string> names = column_names({{field.name, field.components}});
        for (std::size_t c = 0; c < names.size(); ++c) add(names[c], {&field.data, c, names.size()});
    }
    for (Column& label : table.labels) add(label.name, {.label = &label});
    for (const std::string& name : table.unread) add(name, {});

    PointColumns chosen = choose_columns(all, dimension, options);
    const auto number = [](const Place& p, std::size_t i) { return (*p.numbers)[p.first + p.step * i]; };
    const std::size_t count = table.points.size() / size, d = chosen.axes.size();
    std::vector<double> points(d * count);
    for (std::size_t axis = 0; axis < d; ++axis) {
        const std::size_t column = chosen.axes[axis];
        if (places[column].label != nullptr)
            throw Exception(
                about("options.columns",
                      file_error("column.type", file,
                                 table.of_nodes ? "a marker cannot be a coordinate"
                                                : "a column of texts or large integers cannot be a coordinate",
                                 {}, base::quoted(all.names[column]), "name a column of numbers in options.columns")));
        for (std::size_t i = 0; i < count; ++i) {
            const double x = points[d * i + axis] = number(places[column], i);
            if (options.nonfinite_points == NonfinitePoints::error && !std::isfinite(x))
                throw Exception(
                    about(nonfinite_points,
                          file_error("point.not-finite", file, "a point that is not finite", "finite coordinates",
                                     base::shortest(x) + " in " + base::quoted(all.names[column]) + " of point " +
                                         std::to_string(i) + ", counted from 0",
                                     std::string("remove the point, give it coordinates") + or_nan_for_it)));
        }
    }
    for (std::size_t i = 0; chosen.zero && i < count; ++i) {
        const double z = number(places[*chosen.zero], i);
        if (z != 0 && base::all_finite({&points[d * i], d}))
            refuse_off_plane(file, (table.of_nodes ? "node " : "point ") + std::to_string(i) + ", counted from 0",
                             base::shortest(z));
    }
    std::vector<Column> columns;
    for (PointColumns::Kept& kept : chosen.kept) {
        const Place& place = places[kept.column];
        if (place.label != nullptr) {
            columns.push_back({std::move(kept.name), std::move(place.label->values)});
            continue;
        }
        std::vector<double> values(count);
        for (std::size_t i = 0; i < count; ++i) values[i] = number(place, i);
        columns.push_back({std::move(kept.name), std::move(values)});
    }
    Notes notes = std::move(table.notes);
    notes.insert(notes.end(), chosen.notes.begin(), chosen.notes.end());
    return std::make_unique<TableSource>(std::move(points), dimension, std::move(columns), std::move(notes));
}

}  // namespace barycert::io

namespace barycert {

std::unique_ptr<PointSource> memory_points(std::vector<double> points, int dimension) {
    return std::make_unique<io::TableSource>(std::move(points), dimension);
}

PointSource::~PointSource() = default;

Result<std::unique_ptr<PointSource>> open_points(const std::string& path, int dimension, const PointOptions& options) {
    if (dimension != 2 && dimension != 3)
        return file_error("point.dimension", path, "points can have 2 or 3 coordinates", "2 or 3",
                          std::to_string(dimension));
    return io::read_guarded(path, [&] { return io::open_any(path, dimension, options); });
}

}  // namespace barycert
