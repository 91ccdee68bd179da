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
#include "app/jobs/sample_checks.hpp"
#include "app/jobs/sampled_mesh.hpp"
#include "app/jobs/stream.hpp"
#include "app/jobs/surface_rows.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/figure.hpp"
#include "barycert/map.hpp"
#include "barycert/mesh.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "core/base/finite.hpp"
#include "files/input_file.hpp"
#include "io/paths.hpp"
#include "io/polygons/triangles.hpp"

namespace barycert {
namespace {

using jobs::refuse_member;
using jobs::SampledMesh;

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

SampleReport at_surface(const SampleJob& job, Surface surface, double seconds_to_read) {
    jobs::add_fields(job.field_files, surface);
    return jobs::sample_surface(job, surface, seconds_to_read);
}

/// A surface by its name, or else what the file holds, a mesh or a surface.
SampleReport sampled(const SampleJob& job) {
    const base::RunFiles run_files;
    const jobs::ThreadLimit limit(job.options.threads);
    const bool polygons = io::is_polygons_file(job.mesh);
    if (polygons) jobs::refuse_what_is_of_meshes(job);
    std::vector<jobs::Step> steps = polygons ? std::vector<jobs::Step>() : jobs::find_steps(job);
    jobs::check_sample_job(job, steps);
    const bool list_grids =
        !(job.map.empty() && job.save_map.empty()) || job.all.value_or(false) || jobs::needs_listed_grids(job);
    SampledMesh mesh(job, std::move(steps), "sample", list_grids);
    jobs::tell_stage(job, "reading " + job.mesh);
    jobs::Stopwatch watch;
    std::variant<Mesh, Surface> read =
        read_mesh_or_surface(job.mesh, jobs::read_options(job.options.threads, mesh.first_step(), list_grids)).value();
    if (auto* const surface = std::get_if<Surface>(&read)) {
        if (!polygons) jobs::refuse_what_is_of_meshes(job);
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
