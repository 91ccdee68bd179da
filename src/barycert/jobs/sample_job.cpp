// Fields at points.

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "barycert/base/run_files.hpp"
#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/jobs/engine.hpp"
#include "barycert/jobs/job_files.hpp"
#include "barycert/jobs/kept_columns.hpp"
#include "barycert/jobs/stream.hpp"
#include "barycert/jobs/user_rows.hpp"
#include "barycert/map.hpp"

namespace barycert {
namespace {

using jobs::Engine;
using jobs::Run;

Status check_job(const SampleJob& job, const std::vector<jobs::Step>& steps) {
    if (job.points.empty() == job.map.empty())
        return Error{.what = job.points.empty() ? "no points" : "--points and --map",
                     .expected = "one of --points FILE and --map FILE",
                     .found = job.points.empty() ? "neither" : "both",
                     .remedy = "a map contains its points"};
    if (!job.map.empty() && !job.save_map.empty())
        return Error{
            .what = "--save-map cannot be combined with --map", .file = job.save_map, .remedy = "copy the map"};
    if (!job.map.empty() && !(job.columns.empty() && job.keep.empty()))
        return Error{.what = std::string(job.keep.empty() ? "--columns" : "--keep") + " cannot be combined with --map",
                     .file = job.map,
                     .remedy = "a map has points and cells alone: name the file of the points by --points"};
    if (job.map == "-" || job.save_map == "-")
        return Error{.what = "a map cannot come from stdin or go to stdout", .remedy = "name a file"};
    if (job.output.empty()) {
        if (job.weights.empty())
            return Error{.what = "no output", .expected = "--output FILE, --weights FILE, or both", .found = "neither"};
        if (!job.fields.empty() || !job.field_files.empty() || !job.series.empty() || !job.keep.empty())
            return Error{.what = "fields or columns without --output",
                         .remedy = "weights depend on no field: leave fields out, or name --output too"};
    } else if (Status known = jobs::check_rows_format(job.output); !known) {
        return known;
    }
    std::vector<base::NamedFile> inputs{{"--map", job.map}};
    if (job.map.empty()) inputs = {{"--points", job.points}};
    std::error_code ignored;
    // Not the file itself, but the stem of a mesh.
    if (job.map.empty() && job.points != "-" && !std::filesystem::exists(job.points, ignored) &&
        !io::format_of_points(job.points))
        inputs = base::named_files("the mesh of --points", mesh_files(job.points));
    return jobs::check_files(job, steps, inputs, {{"--output", job.output}, {"--save-map", job.save_map}});
}

/// Opens an output of the job; `carried`: columns of the points.
jobs::SinkFactory rows_to(Run& run, const SampleJob& job, const Engine& engine, const std::string& output,
                          const std::vector<ColumnFormat>& carried) {
    return [&run, &job, &engine, output, carried](const TableFormat& format) -> Result<std::unique_ptr<TableSink>> {
        if (output.empty()) return std::unique_ptr<TableSink>();
        std::vector<ColumnFormat> columns = carried;
        std::vector<bool> kept(columns.size(), true);
        if (job.keep == std::vector<std::string>{"all"}) kept = jobs::columns_to_keep(engine, format, columns);
        const bool all = std::find(kept.begin(), kept.end(), false) == kept.end();
        const Note left = all ? Note{} : jobs::leave_out(kept, columns, job.points);
        if (!all && std::find(run.summary.notes.begin(), run.summary.notes.end(), left) == run.summary.notes.end())
            run.summary.notes.push_back(left);
        const Result<TableFormat> shown = jobs::user_format(engine, format, columns);
        if (!shown) return shown.error();
        run.summary.carried.clear();
        for (const ColumnFormat& column : shown->carried) run.summary.carried.push_back(column.name);
        SampleJob one = job;
        one.output = output;
        Result<std::unique_ptr<TableSink>> sink = jobs::open_rows(one, *shown);
        if (!sink) return sink;
        std::unique_ptr<TableSink> rows = jobs::user_rows(engine, std::move(*sink));
        return all ? std::move(rows) : jobs::rows_without(kept, std::move(rows));
    };
}

/// What is done with the first rows, and then with those of further steps. `locate` finds the points, once for each
/// mesh.
Status in_steps(Run& run, const SampleJob& job, Engine& engine, const std::vector<ColumnFormat>& carried,
                const std::function<Status(const jobs::StreamTargets&)>& locate) {
    jobs::KnownRows known;
    const bool further = run.step_by_step() && run.steps.size() > 1;
    const auto sink_to = [&](const std::string& path) { return rows_to(run, job, engine, path, carried); };
    const std::string output = run.step_by_step() ? output_of_step(job.output, run.steps.front()) : job.output;
    const jobs::StreamTargets targets{sink_to(output), job.save_map, job.weights, further ? &known : nullptr};
    if (Status done = locate(targets); !done) return done;
    return further ? jobs::sample_further_steps(run, engine, known, sink_to, locate) : Status(Done{});
}

Status at_points(Run& run, const SampleJob& job, Engine& engine) {
    const bool csv = job.output == "-" || io::has_suffix(job.output, ".csv");
    jobs::Stopwatch watch;
    const auto open = [&] {
        return open_points(job.points, engine.mesh().dimension,
                           {.columns = job.columns,
                            .keep = job.keep,
                            .nonfinite_points = job.options.nonfinite_points,
                            .typed = !csv});
    };
    auto source = open();
    if (!source) return source.error();
    run.summary.seconds.read += watch.lap();  // some files are read as a whole, and some twice
    const Notes notes = (*source)->notes();
    run.summary.notes.insert(run.summary.notes.end(), notes.begin(), notes.end());
    run.summary.points = job.points;
    run.summary.all = job.all.value_or(false);
    bool taken = false;
    return in_steps(run, job, engine, (*source)->carried(), [&](const jobs::StreamTargets& targets) -> Status {
        if (std::exchange(taken, true)) {
            if (!job.weights.empty()) return jobs::of_one_mesh("--weights", job.weights);
            if (!job.save_map.empty()) return jobs::of_one_mesh("--save-map", job.save_map);
            std::error_code ignored;
            if (job.points == "-" || std::filesystem::is_fifo(job.points, ignored))
                return Error{.what = "the mesh changes from step to step, and points of a pipe can be read once",
                             .file = job.points,
                             .remedy = "save the points to a file, or choose one step: --step N"};
            source = open();
            if (!source) return source.error();
        }
        return jobs::sample_stream(run, engine, **source, targets);
    });
}

Status at_points_of_map(Run& run, const SampleJob& job, Engine& engine) {
    auto map = MapReader::open(job.map, engine.mesh());
    if (!map) return map.error();
    if (job.all && *job.all != map->all())
        return Error{.what = "--on-boundary differs from the map",
                     .file = job.map,
                     .expected = map->all() ? "all" : "lowest",
                     .found = *job.all ? "all" : "lowest",
                     .remedy = "leave the option out, or save another map"};
    run.summary.from = PointsFrom::map;
    run.summary.points = job.map;
    run.summary.all = map->all();
    if (Status ready = engine.prepare_without_search(FoundBy::map, "cells are those of the map"); !ready) return ready;
    bool taken = false;
    return in_steps(run, job, engine, {}, [&](const jobs::StreamTargets& targets) -> Status {
        if (std::exchange(taken, true)) {  // of another mesh, which the reader tells
            map = MapReader::open(job.map, engine.mesh());
            if (!map) return map.error();
        }
        return jobs::sample_map(run, engine, *map, targets);
    });
}

}  // namespace

Result<SampleReport> sample_files(const SampleJob& asked) {
    const base::RunFiles files;
    SampleJob job = asked;
    // What a map holds was let in when it was made.
    if (!job.map.empty()) job.options.nonfinite_points = NonfinitePoints::nan;
    auto steps = jobs::find_steps(job);
    if (!steps) return steps.error();
    if (Status ok = check_job(job, *steps); !ok) return ok.error();
    return jobs::run_job("sample", job, std::move(*steps), [&](Run& run, Engine& engine) {
        return job.map.empty() ? at_points(run, job, engine) : at_points_of_map(run, job, engine);
    });
}

}  // namespace barycert
