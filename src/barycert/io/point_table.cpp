#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "barycert/base/finite.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/streams.hpp"
#include "barycert/table.hpp"

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

/// Where the values of a column stand.
struct Place {
    const Field* field = nullptr;  ///< else a coordinate or a label
    std::size_t component = 0;     ///< or the coordinate, or the label
    bool label = false;
};

class Choice {
public:
    Choice(PointTable& table, const std::string& file)
        : table_(table), size_(static_cast<std::size_t>(table.dimension)) {
        all_.file = file;
        all_.coordinates = size_;
        for (std::size_t axis = 0; axis < size_; ++axis) add(std::string(1, "xyz"[axis]), {nullptr, axis});
        for (const Field& field : table.fields) {
            const std::vector<std::string> names = column_names({{field.name, field.components}});
            for (std::size_t c = 0; c < names.size(); ++c) add(names[c], {&field, c});
        }
        for (std::size_t i = 0; i < table.labels.size(); ++i) add(table.labels[i].name, {nullptr, i, true});
        for (const std::string& name : table.unread) add(name, {});
    }

    Source source(int dimension, const PointOptions& options) {
        PointColumns chosen = choose_columns(all_, dimension, options);
        const std::size_t count = table_.points.size() / size_, d = chosen.axes.size();
        std::vector<double> points(d * count);
        for (std::size_t axis = 0; axis < d; ++axis) {
            const Place& place = places_[chosen.axes[axis]];
            if (place.label) refuse_label(chosen.axes[axis]);
            for (std::size_t i = 0; i < count; ++i) {
                points[d * i + axis] = number(place, i);
                if (options.nonfinite_points == NonfinitePoints::error && !std::isfinite(points[d * i + axis]))
                    refuse_point(chosen.axes[axis], i);
            }
        }
        for (std::size_t i = 0; chosen.zero && i < count; ++i) {
            const double z = number(places_[*chosen.zero], i);
            if (z != 0 && base::all_finite({&points[d * i], d}))
                throw Exception(off_plane(
                    all_.file, 0, (table_.of_nodes ? "node " : "point ") + std::to_string(i) + ", counted from 0",
                    base::shortest(z)));
        }
        std::vector<Column> columns;
        for (PointColumns::Kept& kept : chosen.kept) columns.push_back(column(places_[kept.column], kept.name, count));
        Notes notes = std::move(table_.notes);
        notes.insert(notes.end(), chosen.notes.begin(), chosen.notes.end());
        return std::make_unique<TableSource>(std::move(points), dimension, std::move(columns), std::move(notes));
    }

private:
    void add(std::string name, Place place) {
        all_.names.push_back(std::move(name));
        places_.push_back(place);
    }
    double number(const Place& place, std::size_t i) const {
        if (place.field == nullptr) return table_.points[size_ * i + place.component];
        return place.field->data[static_cast<std::size_t>(place.field->components) * i + place.component];
    }
    Column column(const Place& place, std::string name, std::size_t count) {
        if (place.label) {
            Column out = std::move(table_.labels[place.component]);
            out.name = std::move(name);
            return out;
        }
        std::vector<double> values(count);
        for (std::size_t i = 0; i < count; ++i) values[i] = number(place, i);
        return {std::move(name), std::move(values)};
    }
    [[noreturn]] void refuse_label(std::size_t column) const {
        refuse_file(all_.file,
                    table_.of_nodes ? "a marker cannot be a coordinate"
                                    : "a column of texts or large integers cannot be a coordinate",
                    {}, base::quoted(all_.names[column]), "name a column of numbers in options.columns");
    }
    [[noreturn]] void refuse_point(std::size_t column, std::size_t point) const {
        refuse_file(all_.file, "a point that is not finite", "finite coordinates",
                    base::shortest(number(places_[column], point)) + " in " + base::quoted(all_.names[column]) +
                        " of point " + std::to_string(point) + ", counted from 0",
                    std::string("remove the point, give it coordinates") + or_nan_for_it);
    }

    PointTable& table_;
    std::size_t size_;
    TableColumns all_;
    std::vector<Place> places_;
};

/// True if a file that a mesh may be in is there.
bool names_a_mesh(const std::string& path) {
    const std::vector<std::string> files = mesh_files(path);
    std::error_code ignored;
    return std::any_of(files.begin(), files.end(),
                       [&](const std::string& file) { return std::filesystem::exists(file, ignored); });
}

/// The nodes of a mesh.
PointTable nodes_of(Mesh mesh) {
    PointTable table;
    table.dimension = mesh.dimension;
    table.points = std::move(mesh.points);
    table.fields = std::move(mesh.point_fields);
    if (!mesh.point_markers.empty()) table.labels.push_back({"marker", std::move(mesh.point_markers)});
    table.notes = std::move(mesh.notes);
    return table;
}

Source open_any(const std::string& path, int dimension, const PointOptions& options) {
    const auto source_of = [&](PointTable table) {
        return points_of_table(std::move(table), path, dimension, options);
    };
    if (is_vtk_points_file(path)) {
        const bool arrays = !options.keep.empty() || !options.columns.empty();
        return source_of(read_vtk_table(path, arrays, options.nonfinite_points).value());
    }
    const Result<FileFormat> format = format_of_points(path);
    if (format)
        return (*format == FileFormat::csv   ? open_csv_source
                : *format == FileFormat::npy ? open_npy_source
                                             : open_node_source)(path, dimension, options);
    // A stem, or the file of a mesh; what is neither is told as a file of points that is not known.
    if (names_a_mesh(path)) return source_of(nodes_of(read_mesh(path, {.faces = false, .neighbours = false}).value()));
    Error unknown = format.error();
    unknown.expected = "points (.csv .txt .npy .node .vtu .vtp .vtk .vti .vtr .vts, - for CSV from stdin) or a mesh";
    throw Exception(unknown);
}

}  // namespace

Source points_of_table(PointTable table, const std::string& file, int dimension, const PointOptions& options) {
    return Choice(table, file).source(dimension, options);
}

}  // namespace barycert::io

namespace barycert {

std::unique_ptr<PointSource> memory_points(std::vector<double> points, int dimension) {
    return std::make_unique<io::TableSource>(std::move(points), dimension);
}

PointSource::~PointSource() = default;

Result<std::unique_ptr<PointSource>> open_points(const std::string& path, int dimension, const PointOptions& options) {
    if (dimension != 2 && dimension != 3)
        return file_error(path, "points can have 2 or 3 coordinates", "2 or 3", std::to_string(dimension));
    return io::read_guarded(
        path, [&]() -> Result<std::unique_ptr<PointSource>> { return io::open_any(path, dimension, options); });
}

}  // namespace barycert
