#include "barycert/jobs/resampled.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"

namespace barycert::jobs {
namespace {

/// The other mesh, and what was sampled at its nodes besides its fields.
struct SampledNodes {
    Mesh mesh;
    Field mask{"vtkValidPointMask", 1, {}}, cell{"cell", 1, {}}, distance{"distance", 1, {}};
};

Status write_tetgen_files(const Mesh& mesh, const std::string& path) {
    for (const Field& f : mesh.point_fields) {
        const auto it = std::find_if(f.data.begin(), f.data.end(), [](double x) { return !std::isfinite(x); });
        if (it == f.data.end()) continue;
        const auto node = static_cast<std::size_t>(it - f.data.begin()) / static_cast<std::size_t>(f.components);
        return refusal(path, fmt::format("field \"{}\" is not finite at node {}, counted from 0", f.name, node),
                       "finite attributes: a .node file cannot hold NaN or infinity", "",
                       "choose job.outside nearest, extrapolate or fill=V for nodes outside, or another format");
    }
    return write_tetgen(mesh, tetgen_stem(path));
}

Status write_all(SampledNodes& of, const std::string& path, VtkData data) {
    const Result<io::MeshFormat> format = io::mesh_output_format(path);
    if (!format) return format.error();
    if (*format == io::MeshFormat::tetgen) return write_tetgen_files(of.mesh, path);
    // Where there is room for what else is known of each node. In Gmsh each field is a picture of its own: `cell` tells
    // what the mask does, too.
    if (!of.distance.data.empty()) of.mesh.point_fields.push_back(std::move(of.distance));
    if (*format == io::MeshFormat::vtk) of.mesh.point_fields.push_back(std::move(of.mask));
    of.mesh.point_fields.push_back(std::move(of.cell));
    return write_mesh(of.mesh, path, {.comment = {}, .data = data});
}

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

OpenedSink mesh_sink(Mesh mesh, const std::string& path, const TableFormat& format, Notes& notes) {
    if (!format.carried.empty())
        return refusal(path, "a mesh has no labels of nodes", "fields",
                       "label " + base::quoted(format.carried.front().name),
                       "leave labels out of job.fields, or write rows: .csv or .npy");
    const Result<io::MeshFormat> kind = io::mesh_output_format(path);
    if (kind && *kind == io::MeshFormat::tetgen) io::note_lost_names(format.columns(), "a .node", notes);
    mesh.point_fields.clear();
    for (const TableField& f : format.fields) mesh.point_fields.push_back({f.name, f.components, {}});
    const auto of = std::make_shared<SampledNodes>();
    of->mesh = std::move(mesh);
    const auto write = [of](const TableView& rows) -> Status {
        append_rows(rows, of->mesh.point_fields);
        for (const Mesh::Index cell : rows.cells) {
            of->mask.data.push_back(cell >= 0 ? 1 : 0);
            of->cell.data.push_back(cell);
        }
        of->distance.data.insert(of->distance.data.end(), rows.distances.begin(), rows.distances.end());
        return Done{};
    };
    return sink_of(write, [of, path, data = format.vtk_data] { return write_all(*of, path, data); });
}

}  // namespace barycert::jobs
