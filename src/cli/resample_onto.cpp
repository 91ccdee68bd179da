// Onto the nodes of another mesh.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "barycert/io.hpp"
#include "barycert/io/vtk/vtk_missing.hpp"
#include "command.hpp"
#include "files.hpp"
#include "resample.hpp"
#include "sampling_files.hpp"
#include "sampling_run.hpp"

#ifdef BARYCERT_WITH_VTK
#include "barycert/vtk.hpp"
#endif

namespace barycert::cli {
namespace {

bool is_rows(const std::string& path) {
    return path == "-" || has_suffix(path, ".csv") || has_suffix(path, ".npy");
}

/// The other mesh with what was sampled at its nodes, written when all is there.
class MeshSink final : public points::Sink {
public:
    MeshSink(Mesh mesh, std::string path, const std::vector<FieldChoice>& fields)
        : mesh_(std::move(mesh)), path_(std::move(path)) {
        mesh_.point_fields.clear();
        for (const FieldChoice& f : fields) mesh_.point_fields.push_back({f.field->name, f.field->components, {}});
        mask_ = {"vtkValidPointMask", 1, {}};
        cell_ = {"cell", 1, {}};
        distance_ = {"distance", 1, {}};
    }

    Status write(const points::Rows& rows) override {
        const double* at = rows.values.data();
        for (const std::int32_t cell : rows.cells) {
            for (Field& f : mesh_.point_fields) {
                f.data.insert(f.data.end(), at, at + f.components);
                at += f.components;
            }
            mask_.data.push_back(cell >= 0 ? 1 : 0);
            cell_.data.push_back(cell);
        }
        distance_.data.insert(distance_.data.end(), rows.distances.begin(), rows.distances.end());
        return Done{};
    }

    Status commit() override { return is_vtk_file(path_) ? write_vtk_file() : write_tetgen_files(); }

private:
    Status write_vtk_file() {
        if (!distance_.data.empty()) mesh_.point_fields.push_back(std::move(distance_));
        mesh_.point_fields.push_back(std::move(mask_));
        mesh_.point_fields.push_back(std::move(cell_));
#ifdef BARYCERT_WITH_VTK
        return write_vtk(mesh_, path_);
#else
        return vtk_missing(path_);
#endif
    }

    Status write_tetgen_files() {
        for (const Field& f : mesh_.point_fields) {
            const auto it = std::find_if(f.data.begin(), f.data.end(), [](double x) { return !std::isfinite(x); });
            if (it == f.data.end()) continue;
            const auto node = static_cast<std::size_t>(it - f.data.begin()) / static_cast<std::size_t>(f.components);
            return Error{
                .what = fmt::format("field \"{}\" is not finite at node {}, counted from 0", f.name, node),
                .file = path_,
                .expected = "finite attributes: a .node file holds no others",
                .remedy = "choose --outside nearest, extrapolate or fill=V for nodes outside, or another format"};
        }
        return write_tetgen(mesh_, tetgen_stem(path_));
    }

    Mesh mesh_;
    std::string path_;
    Field mask_, cell_, distance_;
};

}  // namespace

std::vector<std::string> files_of_onto(const ResampleArguments& a) {
    if (is_rows(a.output) || is_vtk_file(a.output)) return {a.output};
    const std::string stem = tetgen_stem(a.output);
    return {stem + ".node", stem + ".ele"};
}

Status check_onto_output(const ResampleArguments& a) {
    if (a.range) return Error{.what = "--range beside --onto", .remedy = "it is for pictures: leave it out"};
    if (is_rows(a.output)) return Done{};
    if (has_suffix(a.output, ".vtu") || has_suffix(a.output, ".vtk")) {
#ifndef BARYCERT_WITH_VTK
        return vtk_missing(a.output);
#endif
        return Done{};
    }
    const std::size_t dot = a.output.find_last_of("./");
    const std::string suffix = dot == std::string::npos || a.output[dot] == '/' ? "" : a.output.substr(dot);
    // part.1 is a stem: only what others use as a suffix is refused.
    const bool digits = suffix.find_first_not_of("0123456789", 1) == std::string::npos;
    if (digits || suffix == ".node" || suffix == ".ele") return Done{};
    return Error{.what = "--output in a format that is not known by its suffix",
                 .file = a.output,
                 .expected = ".vtu, .vtk, .node, .csv or .npy, a stem of TetGen's files, or - for CSV on stdout",
                 .found = '"' + suffix + '"',
                 .remedy = "choose another name"};
}

Status resample_onto(const ResampleArguments& a, SamplingEngine& engine, SampleRun& run, Progress& progress) {
    progress.stage("reading " + a.onto);
    Stopwatch watch;
    const bool rows = is_rows(a.output);
    Result<Mesh> other = load_mesh(a.onto, {.faces = !rows, .neighbours = !rows, .threads = a.options.threads});
    if (!other) return other.error();
    const int d = engine.mesh().dimension;
    if (other->dimension != d)
        return Error{.what = "the meshes have different dimensions",
                     .file = a.onto,
                     .expected = fmt::format("{}, as {} has", d, a.mesh),
                     .found = std::to_string(other->dimension),
                     .remedy = "resample between meshes of triangles, or between meshes of tetrahedra"};
    run.from = PointsFrom::mesh;
    run.points = a.onto;
    const auto source = points::memory_source(other->points, d);
    run.seconds.read = watch.lap();
    const SinkFactory to_mesh = [&](const SamplingEngine& e) -> Result<std::unique_ptr<points::Sink>> {
        return std::unique_ptr<points::Sink>(std::make_unique<MeshSink>(std::move(*other), a.output, e.fields()));
    };
    return sample_stream(a, engine, *source, rows ? rows_to_output(a) : to_mesh, "", run, progress);
}

}  // namespace barycert::cli
