#include "sampling_files.hpp"

#include <unistd.h>

#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io/vtk/vtk_missing.hpp"
#include "command.hpp"

#ifdef BARYCERT_WITH_VTK
#include "barycert/vtk.hpp"
#endif

namespace barycert::cli {
namespace {

#ifdef BARYCERT_WITH_VTK
/// Rows to one .vtu file. They are kept in memory until the commit: the format has its arrays one after the other.
class VtkSink final : public points::Sink {
public:
    VtkSink(std::string path, int dimension, const std::vector<FieldChoice>& fields, bool distances)
        : path_(std::move(path)), dimension_(dimension), distances_(distances) {
        for (const FieldChoice& c : fields) fields_.push_back({c.field->name, c.field->components, {}});
    }

    Status write(const points::Rows& rows) override {
        points_.insert(points_.end(), rows.points.begin(), rows.points.end());
        cells_.insert(cells_.end(), rows.cells.begin(), rows.cells.end());
        features_.insert(features_.end(), rows.features.begin(), rows.features.end());
        away_.insert(away_.end(), rows.distances.begin(), rows.distances.end());
        for (const std::int32_t cell : rows.cells) inside_.push_back(cell >= 0 ? 1 : 0);
        const double* at = rows.values.data();
        for (std::size_t i = 0; i < rows.cells.size(); ++i) {
            for (Field& f : fields_) {
                f.data.insert(f.data.end(), at, at + f.components);
                at += f.components;
            }
        }
        return Done{};
    }

    Status commit() override {
        PointRows rows{.dimension = dimension_,
                       .points = points_,
                       .cells = cells_,
                       .features = features_,
                       .inside = inside_,
                       .fields = std::move(fields_),
                       .distances = {}};
        if (distances_) rows.distances = away_;
        return write_vtk_points(path_, rows);
    }

private:
    std::string path_;
    int dimension_;
    bool distances_;
    std::vector<double> points_, away_;
    std::vector<Mesh::Index> cells_;
    std::vector<Feature> features_;
    std::vector<std::uint8_t> inside_;
    std::vector<Field> fields_;
};
#endif

}  // namespace

std::vector<NamedFile> inputs_of(const SamplingArguments& a) {
    std::vector<NamedFile> files = files_of_mesh("the mesh", a.mesh);
    for (const FieldFile& f : a.field_files) files.push_back({"field " + f.name, f.path});
    return files;
}

Status check_files(const SamplingArguments& a, const std::vector<NamedFile>& more_inputs,
                   std::vector<NamedFile> outputs) {
    std::vector<NamedFile> inputs = inputs_of(a);
    inputs.insert(inputs.end(), more_inputs.begin(), more_inputs.end());
    outputs.push_back({"--json", a.json});
    std::vector<NamedFile> to_read = inputs;
    // The reader of meshes has hints at what may be meant.
    std::erase_if(to_read, [](const NamedFile& f) { return f.what.starts_with("the mesh"); });
    if (Status readable = check_inputs(to_read); !readable) return readable;
    return check_outputs(inputs, std::move(outputs));
}

Result<std::unique_ptr<points::Source>> open_points(const std::string& path, int dimension) {
    if (!is_vtk_file(path)) return points::open_source(path, dimension);
#ifdef BARYCERT_WITH_VTK
    Result<std::vector<double>> all = read_vtk_points(path, dimension);
    if (!all) return all.error();
    return points::memory_source(std::move(*all), dimension);
#else
    return vtk_missing(path);
#endif
}

Status check_rows_format(const std::string& path) {
    if (path == "-" || has_suffix(path, ".csv") || has_suffix(path, ".npy")) return Done{};
    if (has_suffix(path, ".vtu")) {
#ifndef BARYCERT_WITH_VTK
        return vtk_missing(path);
#endif
        return Done{};
    }
    const std::size_t dot = path.find_last_of("./");
    const bool suffix = dot != std::string::npos && path[dot] == '.';
    return Error{.what = "--output in a format that is not known by its suffix",
                 .file = path,
                 .expected = ".csv, .npy or .vtu, or - for CSV on stdout",
                 .found = suffix ? '"' + path.substr(dot) + '"' : "no suffix",
                 .remedy = "choose another name"};
}

Result<std::unique_ptr<points::Sink>> open_rows(const std::string& path, int dimension,
                                                const std::vector<FieldChoice>& fields,
                                                const std::vector<std::string>& columns, const OutsidePolicy& outside) {
    const bool distances = outside.kind == Outside::nearest || outside.kind == Outside::extrapolate;
    std::vector<std::string> heads = columns;
    if (path == "-" && isatty(STDOUT_FILENO) == 1) {
        for (std::string& head : heads) head = printable(head);
    }
    if (!has_suffix(path, ".vtu")) return points::open_sink(path, {dimension, heads, distances});
#ifdef BARYCERT_WITH_VTK
    return std::unique_ptr<points::Sink>(std::make_unique<VtkSink>(path, dimension, fields, distances));
#else
    static_cast<void>(fields);
    return vtk_missing(path);
#endif
}

}  // namespace barycert::cli
