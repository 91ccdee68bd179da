// Fields on a regular grid, or at the nodes of another mesh.

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "barycert/base/run_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/jobs/engine.hpp"
#include "barycert/jobs/grid_sinks.hpp"
#include "barycert/jobs/integrals.hpp"
#include "barycert/jobs/job_files.hpp"
#include "barycert/jobs/mesh_sink.hpp"
#include "barycert/jobs/stream.hpp"
#include "barycert/jobs/user_rows.hpp"

namespace barycert {
namespace {

using jobs::Engine;
using jobs::Run;
using jobs::Stopwatch;

Error wrong_axes(const std::string& option, int dimension, const std::string& expected, std::size_t found) {
    return {.what = option + " does not fit the mesh",
            .expected = fmt::format("{} for a mesh of dimension {}", expected, dimension),
            .found = std::to_string(found)};
}

Result<Grid> grid_of(const ResampleJob& a, const Mesh& mesh) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    Bounds3 box = bounds_of_cells(mesh);
    if (!a.bounds.empty()) {
        if (a.bounds.size() != 2 * d)
            return wrong_axes("--bounds", mesh.dimension, fmt::format("{} numbers", 2 * d), a.bounds.size());
        for (std::size_t k = 0; k < d; ++k) {
            box.low[k] = a.bounds[2 * k];
            box.high[k] = a.bounds[2 * k + 1];
        }
    }
    if (!a.counts.empty()) {
        const bool one_layer = d == 2 && a.counts.size() == 3 && a.counts[2] == 1;
        if (a.counts.size() != d && !one_layer)
            return wrong_axes("--grid", mesh.dimension, fmt::format("{} numbers of points", d), a.counts.size());
        std::array<std::int64_t, 3> counts{1, 1, 1};
        for (std::size_t k = 0; k < d; ++k) counts[k] = a.counts[k];
        return grid_over(mesh.dimension, counts, box.low, box.high);
    }
    if (a.spacing.size() != 1 && a.spacing.size() != d)
        return wrong_axes("--spacing", mesh.dimension, fmt::format("one number or {}", d), a.spacing.size());
    std::array<double, 3> spacing{};
    for (std::size_t k = 0; k < d; ++k) spacing[k] = a.spacing[a.spacing.size() == 1 ? 0 : k];
    return grid_spaced(mesh.dimension, spacing, box.low, box.high);
}

std::vector<double> point_of(const Grid& grid, std::uint64_t i) {
    const auto nx = static_cast<std::uint64_t>(grid.counts[0]), ny = static_cast<std::uint64_t>(grid.counts[1]);
    const std::array<std::uint64_t, 3> at{i % nx, i / nx % ny, i / (nx * ny)};
    std::vector<double> point;
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k)
        point.push_back(grid.coordinate(k, static_cast<std::int64_t>(at[k])));
    return point;
}

Status check_job(const ResampleJob& job, const std::vector<jobs::Step>& steps) {
    const int targets = (job.counts.empty() ? 0 : 1) + (job.spacing.empty() ? 0 : 1) + (job.onto.empty() ? 0 : 1);
    if (targets != 1)
        return Error{.what = targets == 0 ? "no target" : "more than one target",
                     .expected = "one of --grid, --spacing and --onto",
                     .found = targets == 0 ? "none" : "several",
                     .remedy = "`barycert resample --help` explains them"};
    if (!job.bounds.empty() && !job.onto.empty())
        return Error{.what = "--bounds cannot be combined with --onto",
                     .remedy = "bounds are for --grid and --spacing: leave them out"};
    if (!job.weights.empty() && job.onto.empty())
        return Error{.what = "--weights needs --onto here",
                     .file = job.weights,
                     .remedy =
                         "for the points of a grid, write them to a file first (--output grid.csv), and use "
                         "`barycert sample --points grid.csv --weights`"};
    if (job.onto.empty()) {
        if (Status known = jobs::check_grid_output(job); !known) return known;
        return jobs::check_files(job, steps, {}, {{"--output", job.output}});
    }
    if (Status known = jobs::check_mesh_output(job); !known) return known;
    return jobs::check_files(job, steps, base::named_files("the mesh of --onto", mesh_files(job.onto)),
                             base::named_files("--output", jobs::files_of_mesh_output(job)));
}

Result<TableFormat> user_format(Run& run, const Engine& engine, const TableFormat& of_rows) {
    Result<TableFormat> format = jobs::user_format(engine, of_rows, {});
    if (!format) return format;
    run.summary.carried.clear();
    for (const ColumnFormat& column : format->carried) run.summary.carried.push_back(column.name);
    return format;
}

/// What its reader told, and the fields of nodes that the sampled ones replace.
void note_the_other(Run& run, const ResampleJob& job, const Mesh& other) {
    Notes& notes = run.summary.notes;
    notes.insert(notes.end(), other.notes.begin(), other.notes.end());
    if (other.point_fields.empty()) return;
    std::string text = other.point_fields.size() == 1 ? "field " : "fields ";
    for (std::size_t i = 0; i < other.point_fields.size(); ++i)
        text += (i == 0 ? "" : ", ") + other.point_fields[i].name;
    notes.push_back({Note::Kind::left_out, text + " of its nodes", job.onto});
}

/// The fields as they are now. Points of a new mesh are counted.
Status onto_grid(Run& run, const ResampleJob& job, Engine& engine, bool new_mesh) {
    SampleReport& summary = run.summary;
    const std::optional<Grid>& grid = summary.grid;
    Stopwatch watch, within;
    const Result<TableFormat> format = user_format(run, engine, engine.format());
    if (!format) return format.error();
    auto output = jobs::open_grid_sink(job, *format, *grid);
    if (!output) return output.error();
    output->sink = jobs::user_rows(engine, std::move(output->sink));
    double writing = 0;
    const bool refuse = job.options.outside.kind == Outside::error;
    const std::string what = fmt::format("points of {}", grid->point_count());
    const auto sink = [&](const TableView& rows) -> Status {
        const auto outside = refuse ? std::find(rows.cells.begin(), rows.cells.end(), -1) : rows.cells.end();
        if (outside != rows.cells.end()) {
            const std::uint64_t i =
                rows.first_row + static_cast<std::uint64_t>(std::distance(rows.cells.begin(), outside));
            return jobs::outside_error("point " + std::to_string(i) + " of the grid", point_of(*grid, i), "");
        }
        summary.nan_values += jobs::count_nan(rows);
        within.lap();
        Status written = output->sink->write(rows);
        writing += within.lap();
        run.count(what, rows.first_row + rows.row_count());
        return written;
    };
    Result<SampleCounts> counts = resample(engine.sampler(), *grid, jobs::without_refusal(job.options), sink);
    if (!counts) return counts.error();
    if (new_mesh) {
        summary.counts.add(*counts);
        summary.rows += grid->point_count();
    }
    summary.seconds.sample += watch.lap() - writing;
    Status committed = output->sink->commit();
    summary.seconds.write += writing + watch.lap();
    if (output->picture != nullptr) summary.picture = *output->picture;
    return committed;
}

Status onto_grid_in_steps(Run& run, const ResampleJob& job, Engine& engine) {
    Result<Grid> grid = grid_of(job, engine.mesh());
    if (!grid) return grid.error();
    if (io::has_suffix(job.output, ".vti")) *grid = as_in_vti(*grid);
    run.summary.from = PointsFrom::grid;
    run.summary.grid = *grid;
    const auto prepare = [&] {
        return engine.prepare_without_search(FoundBy::grid, "each cell finds the points that it holds");
    };
    if (Status ready = prepare(); !ready) return ready;
    if (!run.step_by_step()) return onto_grid(run, job, engine, true);
    for (std::size_t i = 0; i < run.steps.size(); ++i) {
        run.count("steps", i);
        if (i != 0) {
            Status ready = engine.go_to(run.steps[i]);
            if (ready && engine.is_another_mesh()) {
                ready = prepare();
                if (run.summary.meshes == 2 && job.bounds.empty())
                    run.summary.notes.push_back({Note::Kind::guessed,
                                                 "the grid of all steps lies in the box of the mesh of the first one: "
                                                 "--bounds names another box",
                                                 job.mesh, true});
            }
            if (!ready) return ready;
        }
        ResampleJob step = job;
        step.output = output_of_step(job.output, run.steps[i]);
        if (Status done = onto_grid(run, step, engine, i == 0 || engine.is_another_mesh()); !done) return done;
    }
    return Done{};
}

Status onto_mesh(Run& run, const ResampleJob& job, Engine& engine) {
    run.stage("reading " + job.onto);
    Stopwatch watch;
    const bool to_rows = jobs::is_rows_output(job.output);
    Result<Mesh> other =
        read_mesh(job.onto, {.faces = !to_rows, .neighbours = !to_rows, .threads = job.options.threads});
    if (!other) return other.error();
    const int d = engine.mesh().dimension;
    if (other->dimension != d)
        return Error{.what = "the meshes have different dimensions",
                     .file = job.onto,
                     .expected = fmt::format("{}, as {} has", d, job.mesh),
                     .found = std::to_string(other->dimension),
                     .remedy = "resample between meshes of triangles, or between meshes of tetrahedra"};
    const auto curved = take_as_straight(*other, job.onto, job.curved);
    if (!curved) return curved.error();
    run.summary.onto_curved = *curved;
    run.summary.from = PointsFrom::mesh;
    run.summary.points = job.onto;
    const bool further = run.step_by_step() && run.steps.size() > 1;
    const std::vector<double> points = further ? other->points : std::vector<double>();
    auto source = memory_points(other->points, d);
    run.summary.seconds.read = watch.lap();
    note_the_other(run, job, *other);
    jobs::note_cell_fields(run, engine, further);
    const auto sink_to = [&](const std::string& output) -> jobs::SinkFactory {
        return [&, output](const TableFormat& of_rows) -> Result<std::unique_ptr<TableSink>> {
            const Result<TableFormat> format = user_format(run, engine, of_rows);
            if (!format) return format.error();
            ResampleJob step = job;
            step.output = output;
            const auto open = [&]() -> Result<std::unique_ptr<TableSink>> {
                auto sink =
                    to_rows ? jobs::open_rows(step, *format)
                            : jobs::mesh_sink(further ? *other : std::move(*other), output, *format, run.summary.notes);
                if (!sink) return sink;
                return jobs::user_rows(engine, std::move(*sink));
            };
            // Of a series there would be integrals of each step.
            return further ? open() : jobs::with_integrals(run, engine, *other, of_rows, open);
        };
    };
    jobs::KnownRows known;
    const std::string output = run.step_by_step() ? output_of_step(job.output, run.steps.front()) : job.output;
    jobs::StreamTargets targets;
    targets.rows = sink_to(output);
    targets.weights = job.weights;
    targets.known = further ? &known : nullptr;
    Status first = jobs::sample_stream(run, engine, *source, targets);
    if (!first || !further) return first;
    return jobs::sample_further_steps(run, engine, known, sink_to, [&](const jobs::StreamTargets& anew) -> Status {
        if (!job.weights.empty()) return jobs::of_one_mesh("--weights", job.weights);
        source = memory_points(points, d);
        return jobs::sample_stream(run, engine, *source, anew);
    });
}

}  // namespace

Result<SampleReport> resample_files(const ResampleJob& job) {
    const base::RunFiles files;
    auto steps = jobs::find_steps(job);
    if (!steps) return steps.error();
    if (Status ok = check_job(job, *steps); !ok) return ok.error();
    return jobs::run_job("resample", job, std::move(*steps), [&](Run& run, Engine& engine) {
        return job.onto.empty() ? onto_grid_in_steps(run, job, engine) : onto_mesh(run, job, engine);
    });
}

}  // namespace barycert
