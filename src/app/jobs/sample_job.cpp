// Fields at points.

#include "barycert/sample_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/jobs/field_files.hpp"
#include "app/jobs/job_files.hpp"
#include "app/jobs/points_of_job.hpp"
#include "app/jobs/profile.hpp"
#include "app/jobs/sampled_mesh.hpp"
#include "app/jobs/stream.hpp"
#include "app/jobs/surface_rows.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/figure.hpp"
#include "barycert/map.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "files/format.hpp"
#include "files/input_file.hpp"
#include "files/named_file.hpp"
#include "io/in_space.hpp"
#include "io/paths.hpp"
#include "io/polygons/triangles.hpp"
#include "io/table_format.hpp"

namespace barycert {

using base::FormatKind;
using base::Use;
namespace {

using jobs::refuse_member;
using jobs::SampledMesh;

void check_job(const SampleJob& job, const std::vector<jobs::Step>& steps) {
    const int given = (job.points.empty() ? 0 : 1) + (job.map.empty() ? 0 : 1) + (job.line ? 1 : 0);
    if (given != 1)
        refuse_member(given == 0 ? ErrorCode("option.missing") : ErrorCode("option.conflict"), "job.points", "",
                      given == 0 ? "no points" : "job.points, job.map and job.line",
                      "one of job.points FILE, job.map FILE and job.line A:B", given == 0 ? "none" : "several",
                      "a map contains its points");
    if (job.line && !(job.columns.empty() && job.keep.empty()))
        refuse_member("option.conflict", "job.line", "",
                      std::string(job.keep.empty() ? "job.columns" : "job.keep") + " cannot be combined with job.line",
                      "", "", "points of a line have no columns");
    if (!job.plot.empty() && !is_figure_name(job.plot))
        jobs::refuse_output(job.plot, base::suffixes_written(Use::picture));
    if (!job.plot.empty() && (job.all_steps || jobs::has_step_place(job.output)))
        refuse_member("option.conflict", "job.plot", job.plot, "a plot of outputs of steps",
                      "the steps of a field as columns of one output", "",
                      "leave {step} out, and name the field as NAME@PATTERN");
    if (!job.plot.empty() && !job.weights.empty() && job.output.empty())
        refuse_member("option.missing", "job.output", job.plot,
                      "job.weights without job.output takes no fields to plot", "job.output FILE", "none");
    if (!job.map.empty() && !job.save_map.empty())
        refuse_member("option.conflict", "job.save_map", job.save_map, "job.save_map cannot be combined with job.map",
                      "", "", "copy the map");
    if (!job.map.empty() && !(job.columns.empty() && job.keep.empty()))
        refuse_member("option.conflict", "job.map", job.map,
                      std::string(job.keep.empty() ? "job.columns" : "job.keep") + " cannot be combined with job.map",
                      "", "", "a map has points and cells alone: name the file of the points by job.points");
    if (job.map == "-" || job.save_map == "-")
        refuse_member("option.value", "job.map", "", "a map cannot come from stdin or go to stdout", "", "",
                      "name a file");
    if (job.output.empty() && job.weights.empty() && job.plot.empty())
        refuse_member("option.missing", "job.output", "", "no output",
                      "job.output FILE, job.weights FILE or job.plot FILE", "none");
    if (job.output.empty() && job.plot.empty() &&
        !(job.fields.empty() && job.field_files.empty() && job.series.empty() && job.keep.empty()))
        refuse_member("option.missing", "job.output", "", "fields or columns without job.output", "", "",
                      "weights depend on no field: leave fields out, or name job.output too");
    if (!job.output.empty() && job.output != "-" && !base::is_written_as(job.output, Use::rows))
        jobs::refuse_output(job.output, base::suffixes_written(Use::rows) + ", or - for CSV on stdout");
    std::vector<base::NamedFile> inputs;
    if (!job.map.empty()) inputs = {{"job.map", job.map}};
    if (!job.points.empty()) inputs = {{"job.points", job.points}};
    // Not the file itself, but the stem of a mesh.
    if (!job.points.empty() && job.points != "-" && !io::exists(job.points) && !io::format_of_points(job.points))
        inputs = base::named_files("the mesh of job.points", mesh_files(job.points), true);
    jobs::check_files(job, steps, inputs,
                      {{"job.output", job.output}, {"job.save_map", job.save_map}, {"job.plot", job.plot}});
}

/// Rows of a map, which must stay. Rows of one point follow one another, their cells ascending.
jobs::RowSource rows_of_map(MapReader& map) {
    const auto read = [&map, cell = Mesh::Index{-1}, before = std::array<double, 3>()](
                          std::size_t most, jobs::BlockOfRows& block) mutable {
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
        map = MapReader::open(mesh.report.points, mesh.mesh(), jobs::build_options(mesh.job, 0)).value();
    };
    return {.located = true, .count = map.rows(), .read = read, .begin_again = again};
}

/// The outputs of the job; `carried`: columns of the points.
jobs::OpenRows outputs_of(SampledMesh& mesh, const SampleJob& job, const std::vector<ColumnFormat>& carried) {
    return [&mesh, &job, carried](const std::string& path) {
        const bool all = job.keep == std::vector<std::string>{"all"};
        jobs::Sink rows =
            path.empty() ? jobs::Sink() : open_user_rows(mesh, carried, all, [&](const TableFormat& format) {
                return jobs::open_rows(path, format);
            });
        return job.plot.empty() ? std::move(rows)
                                : jobs::plotted(std::move(rows), job, mesh.format().columns(), mesh.report);
    };
}

void at_points(SampledMesh& mesh, const SampleJob& job) {
    const auto open = [&] { return jobs::points_of(job, mesh.mesh().dimension, job.options.nonfinite_points); };
    jobs::Stopwatch watch;
    std::unique_ptr<PointSource> points = open();
    SampleReport& report = mesh.report;
    report.seconds.read += watch.lap();  // some files are read as a whole, and some twice
    std::ranges::copy(points->notes(), std::back_inserter(report.notes));
    report.points = job.line ? "line" : job.points;
    report.all = job.all.value_or(false);
    jobs::RowSource rows = jobs::rows_of_points(points);
    rows.begin_again = [&](const SampledMesh&) {
        if (io::is_read_once(job.points))
            refuse_member("series.differs", "job.points", job.points,
                          "the mesh changes from step to step, and points of a pipe can be read once", "", "",
                          "save the points to a file, or choose one step: job.step N");
        points = open();
    };
    sample_rows(mesh, rows, outputs_of(mesh, job, points->carried()), job.save_map);
}

void at_points_of_map(SampledMesh& mesh, const SampleJob& job) {
    MapReader map = MapReader::open(job.map, mesh.mesh(), jobs::build_options(job, 0)).value();
    const auto word = [](bool all) { return all ? "all" : "lowest"; };
    if (job.all && *job.all != map.all())
        refuse_member("map.cells", "job.all", job.map, "job.all differs from the map", word(map.all()), word(*job.all),
                      "leave the option out, or save another map");
    mesh.report.from = PointsFrom::map;
    mesh.report.points = job.map;
    mesh.report.all = map.all();
    mesh.prepare_without_search(FoundBy::map, "cells are those of the map");
    sample_rows(mesh, rows_of_map(map), outputs_of(mesh, job, {}));
}

void refuse_what_is_of_meshes(const SampleJob& job) {
    const auto only_meshes = [&](bool given, const char* member) {
        if (given)
            refuse_member("option.unfit", std::string(member), job.mesh, std::string(member) + " is for meshes", "",
                          "a surface", "leave it out");
    };
    only_meshes(job.all.has_value(), "job.all");
    only_meshes(!job.plot.empty(), "job.plot");
    only_meshes(job.all_steps || (io::is_surface_file(job.mesh) && job.step.made()), "job.step");
    only_meshes(!job.series.empty(), "a series of fields");
    only_meshes(job.options.rounding == Rounding::plain, "job.rounding");
    const Outside outside = job.options.outside.kind;
    if (outside != Outside::nan && outside != Outside::nearest)
        refuse_member("option.unfit", "job.outside", job.mesh, "a surface has no inside for job.outside",
                      "nearest, or nearest=DISTANCE", "", "values are those at the nearest point");
}

void check_surface_job(const SampleJob& job) {
    refuse_what_is_of_meshes(job);
    check_job(job, {});
}

SampleReport at_surface(const SampleJob& job, Surface surface, double seconds_to_read) {
    jobs::add_fields(job.field_files, surface);
    return jobs::sample_surface(job, surface, seconds_to_read);
}

/// A surface by its name, or else what the file holds, a mesh or a surface.
SampleReport sampled(const SampleJob& job) {
    const base::RunFiles run_files;
    const jobs::ThreadLimit limit(job.options.threads);
    jobs::Stopwatch watch;
    if (io::is_polygons_file(job.mesh)) {
        check_surface_job(job);
        return at_surface(job, read_surface(job.mesh, {.threads = job.options.threads}).value(), watch.lap());
    }
    std::vector<jobs::Step> steps = jobs::find_steps(job);
    check_job(job, steps);
    const bool list_grids =
        !(job.map.empty() && job.save_map.empty()) || job.all.value_or(false) || jobs::needs_listed_grids(job);
    SampledMesh mesh(job, std::move(steps), "sample", list_grids);
    jobs::tell_stage(job, "reading " + job.mesh);
    std::variant<Mesh, Surface> read =
        read_mesh_or_surface(job.mesh, jobs::read_options(job.options.threads, mesh.first_step(), list_grids)).value();
    if (auto* const surface = std::get_if<Surface>(&read)) {
        check_surface_job(job);
        return at_surface(job, std::move(*surface), watch.lap());
    }
    mesh.report.seconds.mesh = watch.lap();
    mesh.open(std::move(std::get<Mesh>(read)));
    job.map.empty() ? at_points(mesh, job) : at_points_of_map(mesh, job);
    return mesh.finish();
}

}  // namespace

Result<SampleReport> sample_files(const SampleJob& asked) try {
    SampleJob job = asked;
    // Accepts all points of a map: they were accepted when it was made.
    if (!job.map.empty()) job.options.nonfinite_points = NonfinitePoints::nan;
    return sampled(job);
} catch (const Exception& e) {
    return e.error();
}

}  // namespace barycert
