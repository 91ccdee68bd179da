// Fields at points.

#include <filesystem>
#include <system_error>
#include <utility>

#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/map.hpp"
#include "barycert/pipeline/engine.hpp"
#include "barycert/pipeline/job_files.hpp"
#include "barycert/pipeline/stream.hpp"
#include "barycert/pipeline/user_rows.hpp"

namespace barycert {
namespace {

using pipeline::Engine;
using pipeline::Run;

Status check_job(const SampleJob& job) {
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
    if (Status known = pipeline::check_rows_format(job.output); !known) return known;
    std::vector<base::NamedFile> inputs{{"--map", job.map}};
    if (job.map.empty()) inputs = {{"--points", job.points}};
    std::error_code ignored;
    // Not the file itself, but the stem of a mesh.
    if (job.map.empty() && job.points != "-" && !std::filesystem::exists(job.points, ignored) &&
        !io::format_of(job.points))
        inputs = base::named_files("the mesh of --points", mesh_files(job.points));
    return pipeline::check_files(job, inputs, {{"--output", job.output}, {"--save-map", job.save_map}});
}

/// Opens the output of the job; `carried`: columns of the points.
pipeline::SinkFactory rows_of(Run& run, const SampleJob& job, const Engine& engine,
                              std::vector<ColumnFormat> carried = {}) {
    return [&run, &job, &engine, carried = std::move(carried)](
               const TableFormat& format) -> Result<std::unique_ptr<TableSink>> {
        const Result<TableFormat> shown = pipeline::user_format(engine, format, carried);
        if (!shown) return shown.error();
        for (const ColumnFormat& column : shown->carried) run.summary.carried.push_back(column.name);
        Result<std::unique_ptr<TableSink>> sink = pipeline::open_rows(job, *shown);
        if (!sink) return sink;
        return pipeline::user_rows(engine, std::move(*sink));
    };
}

Status at_points(Run& run, const SampleJob& job, Engine& engine) {
    const bool csv = job.output == "-" || io::has_suffix(job.output, ".csv");
    auto source = open_points(job.points, engine.mesh().dimension,
                              {.columns = job.columns, .keep = job.keep, .typed = !csv});
    if (!source) return source.error();
    const Notes notes = (*source)->notes();
    run.summary.notes.insert(run.summary.notes.end(), notes.begin(), notes.end());
    run.summary.points = job.points;
    run.summary.all = job.all.value_or(false);
    return pipeline::sample_stream(run, engine, **source, rows_of(run, job, engine, (*source)->carried()), job.save_map);
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
    return pipeline::sample_map(run, engine, *map, rows_of(run, job, engine));
}

}  // namespace

Result<SampleSummary> sample_files(const SampleJob& job) {
    if (Status ok = check_job(job); !ok) return ok.error();
    return pipeline::run_job("sample", job, [&](Run& run, Engine& engine) {
        return job.map.empty() ? at_points(run, job, engine) : at_points_of_map(run, job, engine);
    });
}

}  // namespace barycert
