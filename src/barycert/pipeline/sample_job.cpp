// Fields at points.

#include "barycert/io.hpp"
#include "barycert/map.hpp"
#include "barycert/pipeline/engine.hpp"
#include "barycert/pipeline/job_files.hpp"
#include "barycert/pipeline/stream.hpp"

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
    if (job.map == "-" || job.save_map == "-")
        return Error{.what = "a map cannot come from stdin or go to stdout", .remedy = "name a file"};
    if (Status known = pipeline::check_rows_format(job.output); !known) return known;
    return pipeline::check_files(
        job, {job.map.empty() ? base::NamedFile{"--points", job.points} : base::NamedFile{"--map", job.map}},
        {{"--output", job.output}, {"--save-map", job.save_map}});
}

/// Opens the output of the job.
pipeline::SinkFactory rows_of(const SampleJob& job) {
    return [&job](const TableFormat& format) { return pipeline::open_rows(job, format); };
}

Status at_points(Run& run, const SampleJob& job, Engine& engine) {
    auto source = open_points(job.points, engine.mesh().dimension);
    if (!source) return source.error();
    run.summary.points = job.points;
    run.summary.all = job.all.value_or(false);
    return pipeline::sample_stream(run, engine, **source, rows_of(job), job.save_map);
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
    return pipeline::sample_map(run, engine, *map, rows_of(job));
}

}  // namespace

Result<SampleSummary> sample_files(const SampleJob& job) {
    if (Status ok = check_job(job); !ok) return ok.error();
    return pipeline::run_job("sample", job, [&](Run& run, Engine& engine) {
        return job.map.empty() ? at_points(run, job, engine) : at_points_of_map(run, job, engine);
    });
}

}  // namespace barycert
