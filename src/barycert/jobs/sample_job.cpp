// Fields at points.

#include <algorithm>
#include <array>
#include <variant>

#include "barycert/base/finite.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/jobs/stream.hpp"
#include "barycert/map.hpp"

namespace barycert {
namespace {

using jobs::refuse;
using jobs::SampledMesh;

void check_job(const SampleJob& job, const std::vector<jobs::Step>& steps) {
    if (job.points.empty() == job.map.empty())
        refuse("", job.points.empty() ? "no points" : "job.points and job.map",
               "one of job.points FILE and job.map FILE", job.points.empty() ? "neither" : "both",
               "a map contains its points");
    if (!job.map.empty() && !job.save_map.empty())
        refuse(job.save_map, "job.save_map cannot be combined with job.map", "", "", "copy the map");
    if (!job.map.empty() && !(job.columns.empty() && job.keep.empty()))
        refuse(job.map, std::string(job.keep.empty() ? "job.columns" : "job.keep") + " cannot be combined with job.map",
               "", "", "a map has points and cells alone: name the file of the points by job.points");
    if (job.map == "-" || job.save_map == "-")
        refuse("", "a map cannot come from stdin or go to stdout", "", "", "name a file");
    if (job.output.empty() && job.weights.empty())
        refuse("", "no output", "job.output FILE, job.weights FILE, or both", "neither");
    if (job.output.empty() &&
        !(job.fields.empty() && job.field_files.empty() && job.series.empty() && job.keep.empty()))
        refuse("", "fields or columns without job.output", "", "",
               "weights depend on no field: leave fields out, or name job.output too");
    if (!job.output.empty() && job.output != "-" && !jobs::has_suffix_of(job.output, {".csv", ".npy", ".vtu"}))
        jobs::refuse_output(job.output, ".csv, .npy or .vtu, or - for CSV on stdout");
    std::vector<base::NamedFile> inputs{{"job.map", job.map}};
    if (job.map.empty()) inputs = {{"job.points", job.points}};
    // Not the file itself, but the stem of a mesh.
    if (job.map.empty() && job.points != "-" && !io::exists(job.points) && !io::format_of_points(job.points))
        inputs = base::named_files("the mesh of job.points", mesh_files(job.points));
    jobs::check_files(job, steps, inputs, {{"job.output", job.output}, {"job.save_map", job.save_map}});
}

/// Rows of a map, which must stay. Those of one point follow one another, their cells ascending.
jobs::RowSource rows_of_map(MapReader& map) {
    const auto read = [&map, cell = Mesh::Index{-1}, before = std::array<double, 3>()](std::size_t most,
                                                                                       jobs::Block& block) mutable {
        block.size = map.read(most, block.rows).value();
        LocationCounts& locations = block.locations.emplace();
        const Table& rows = block.rows;
        const auto d = static_cast<std::size_t>(rows.dimension);
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            const double* const at = rows.points.data() + d * i;
            const bool same = cell >= 0 && rows.cells[i] > cell && std::equal(at, at + d, before.begin());
            if (!same) locations.add(rows.features[i]);
            if (!same && !base::all_finite({at, d})) ++locations.not_finite;
            std::copy(at, at + d, before.begin());
            cell = rows.cells[i];
        }
    };
    // The reader tells that the map is of another mesh.
    const auto again = [&map](const SampledMesh& mesh) {
        map = MapReader::open(mesh.report.points, mesh.mesh()).value();
    };
    return {.located = true, .count = map.rows(), .read = read, .begin_again = again};
}

/// The outputs of the job; `carried`: columns of the points.
jobs::OpenRows outputs_of(SampledMesh& mesh, const SampleJob& job, const std::vector<ColumnFormat>& carried) {
    return [&mesh, &job, carried](const TableFormat& format, const std::string& path) {
        if (path.empty()) return jobs::Sink();
        const bool all = job.keep == std::vector<std::string>{"all"};
        return open_user_rows(mesh, format, carried, all,
                              [&](const TableFormat& shown) { return jobs::open_rows(path, shown); });
    };
}

void at_points(SampledMesh& mesh, const SampleJob& job) {
    const auto open = [&] {
        const bool csv = job.output == "-" || io::has_suffix(job.output, ".csv");
        return open_points(job.points, mesh.mesh().dimension,
                           {.columns = job.columns,
                            .keep = job.keep,
                            .nonfinite_points = job.options.nonfinite_points,
                            .typed = !csv})
            .value();
    };
    jobs::Stopwatch watch;
    std::unique_ptr<PointSource> points = open();
    SampleReport& report = mesh.report;
    report.seconds.read += watch.lap();  // some files are read as a whole, and some twice
    const Notes notes = points->notes();
    report.notes.insert(report.notes.end(), notes.begin(), notes.end());
    report.points = job.points;
    report.all = job.all.value_or(false);
    jobs::RowSource rows = jobs::rows_of_points(points);
    rows.begin_again = [&](const SampledMesh&) {
        if (jobs::is_read_once(job.points))
            refuse(job.points, "the mesh changes from step to step, and points of a pipe can be read once", "", "",
                   "save the points to a file, or choose one step: job.step N");
        points = open();
    };
    sample_rows(mesh, rows, outputs_of(mesh, job, points->carried()), job.save_map);
}

void at_points_of_map(SampledMesh& mesh, const SampleJob& job) {
    MapReader map = MapReader::open(job.map, mesh.mesh()).value();
    const auto word = [](bool all) { return all ? "all" : "lowest"; };
    if (job.all && *job.all != map.all())
        refuse(job.map, "job.all differs from the map", word(map.all()), word(*job.all),
               "leave the option out, or save another map");
    mesh.report.from = PointsFrom::map;
    mesh.report.points = job.map;
    mesh.report.all = map.all();
    mesh.prepare_without_search(FoundBy::map, "cells are those of the map");
    sample_rows(mesh, rows_of_map(map), outputs_of(mesh, job, {}));
}

/// Nothing if the mesh is one, or cannot be read as a surface either.
std::optional<Result<SampleReport>> at_surface(const SampleJob& job) {
    try {
        jobs::Stopwatch watch;
        const Result<std::variant<Mesh, Surface>> read =
            read_mesh_or_surface(job.mesh, {.threads = job.options.threads});
        if (!read && io::is_surface_file(job.mesh)) return read.error();
        const auto* const surface = read ? std::get_if<Surface>(&*read) : nullptr;
        if (surface == nullptr) return std::nullopt;
        check_job(job, {});
        return jobs::sample_surface(job, *surface, watch.lap());
    } catch (const Exception& problem) {
        return problem.error();
    }
}

}  // namespace

Result<SampleReport> sample_files(const SampleJob& asked) {
    SampleJob job = asked;
    // What a map holds was let in when it was made.
    if (!job.map.empty()) job.options.nonfinite_points = NonfinitePoints::nan;
    if (io::is_surface_file(job.mesh)) {
        if (const auto surface = at_surface(job)) return *surface;
    }
    Result<SampleReport> sampled = jobs::sample_mesh(
        job, "sample", [&](const auto& steps) { check_job(job, steps); },
        [&](SampledMesh& mesh) { job.map.empty() ? at_points(mesh, job) : at_points_of_map(mesh, job); });
    if (!sampled && sampled.error().file == job.mesh) {
        // Triangles off the plane are found when they are read.
        if (const auto surface = at_surface(job)) return *surface;
    }
    return sampled;
}

}  // namespace barycert
