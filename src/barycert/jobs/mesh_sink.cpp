#include "barycert/jobs/resampled.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"

namespace barycert::jobs {
namespace {

/// The other mesh with what was sampled at its nodes, written when all is there.
class MeshSink final : public TableSink {
public:
    MeshSink(Mesh mesh, std::string path, const TableFormat& format)
        : mesh_(std::move(mesh)), path_(std::move(path)), data_(format.vtk_data) {
        mesh_.point_fields.clear();
        for (const TableField& f : format.fields) mesh_.point_fields.push_back({f.name, f.components, {}});
    }

    Status write(const TableView& rows) override {
        append_rows(rows, mesh_.point_fields);
        for (const Mesh::Index cell : rows.cells) {
            mask_.data.push_back(cell >= 0 ? 1 : 0);
            cell_.data.push_back(cell);
        }
        distance_.data.insert(distance_.data.end(), rows.distances.begin(), rows.distances.end());
        return Done{};
    }

    Status commit() override {
        const Result<io::MeshFormat> format = io::mesh_output_format(path_);
        if (!format) return format.error();
        if (*format == io::MeshFormat::tetgen) return write_tetgen_files();
        // Where there is room for what else is known of each node. In Gmsh each field is a picture of its own: `cell`
        // tells what the mask does, too.
        if (!distance_.data.empty()) mesh_.point_fields.push_back(std::move(distance_));
        if (*format == io::MeshFormat::vtk) mesh_.point_fields.push_back(std::move(mask_));
        mesh_.point_fields.push_back(std::move(cell_));
        return write_mesh(mesh_, path_, {.comment = {}, .data = data_});
    }

private:
    Status write_tetgen_files() {
        for (const Field& f : mesh_.point_fields) {
            const auto it = std::find_if(f.data.begin(), f.data.end(), [](double x) { return !std::isfinite(x); });
            if (it == f.data.end()) continue;
            const auto node = static_cast<std::size_t>(it - f.data.begin()) / static_cast<std::size_t>(f.components);
            return refusal(path_, fmt::format("field \"{}\" is not finite at node {}, counted from 0", f.name, node),
                           "finite attributes: a .node file cannot hold NaN or infinity", "",
                           "choose job.outside nearest, extrapolate or fill=V for nodes outside, or another format");
        }
        return write_tetgen(mesh_, tetgen_stem(path_));
    }

    Mesh mesh_;
    std::string path_;
    VtkData data_;
    Field mask_{"vtkValidPointMask", 1, {}}, cell_{"cell", 1, {}}, distance_{"distance", 1, {}};
};

}  // namespace

bool is_rows_output(const std::string& path) {
    return path == "-" || has_suffix_of(path, ".csv .npy");
}

std::vector<std::string> files_of_mesh_output(const ResampleJob& job) {
    const Result<io::MeshFormat> format = io::mesh_output_format(job.output);
    if (is_rows_output(job.output) || (format && *format != io::MeshFormat::tetgen)) return {job.output};
    const std::string stem = tetgen_stem(job.output);
    return {stem + ".node", stem + ".ele"};
}

Status check_mesh_output(const ResampleJob& job) {
    if (job.range)
        return Error{.what = "job.range cannot be combined with job.onto",
                     .remedy = "it is for pictures: leave it out"};
    if (is_rows_output(job.output) || io::mesh_output_format(job.output)) return Done{};
    return unknown_output(job.output,
                          ".vtu, .vtk, .msh, .node, .csv or .npy, a stem of TetGen's files, or - for CSV on stdout");
}

Result<std::unique_ptr<TableSink>> mesh_sink(Mesh mesh, const std::string& path, const TableFormat& format,
                                             Notes& notes) {
    if (!format.carried.empty())
        return refusal(path, "a mesh has no labels of nodes", "fields",
                       "label " + base::quoted(format.carried.front().name),
                       "leave labels out of job.fields, or write rows: .csv or .npy");
    const Result<io::MeshFormat> kind = io::mesh_output_format(path);
    if (kind && *kind == io::MeshFormat::tetgen) io::note_lost_names(format.columns(), "a .node", notes);
    return std::unique_ptr<TableSink>(std::make_unique<MeshSink>(std::move(mesh), path, format));
}

}  // namespace barycert::jobs
