// barycert sample: the fields of a mesh at points, row by row.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <utility>

#include "barycert/map.hpp"
#include "command.hpp"
#include "sampling.hpp"
#include "sampling_engine.hpp"
#include "sampling_files.hpp"
#include "sampling_run.hpp"

namespace barycert::cli {
namespace {

struct SampleArguments : SamplingArguments {
    std::string points, map, save_map;
    std::optional<bool> all;  ///< a row for each cell that holds a point
};

Status check_arguments(const SampleArguments& a) {
    if (a.points.empty() == a.map.empty())
        return Error{.what = a.points.empty() ? "no points" : "--points and --map",
                     .expected = "one of --points FILE and --map FILE",
                     .found = a.points.empty() ? "neither" : "both",
                     .remedy = "a map has the points for which it was made"};
    if (!a.map.empty() && !a.save_map.empty())
        return Error{.what = "--save-map beside --map", .file = a.save_map, .remedy = "copy the map"};
    if (a.map == "-" || a.save_map == "-")
        return Error{.what = "a map cannot come from stdin or go to stdout", .remedy = "name a file"};
    if (Status known = check_rows_format(a.output); !known) return known;
    return check_files(a, {a.map.empty() ? NamedFile{"--points", a.points} : NamedFile{"--map", a.map}},
                       {{"--output", a.output}, {"--save-map", a.save_map}});
}

Status with_points(const SampleArguments& a, SamplingEngine& engine, SampleRun& run, Progress& progress) {
    auto source = open_points(a.points, engine.mesh().dimension);
    if (!source) return source.error();
    run.points = a.points;
    run.all = a.all.value_or(false);
    return sample_stream(a, engine, **source, rows_to_output(a), a.save_map, run, progress);
}

Status with_map(const SampleArguments& a, SamplingEngine& engine, SampleRun& run, Progress& progress) {
    auto map = MapReader::open(a.map, engine.mesh());
    if (!map) return map.error();
    if (a.all && *a.all != map->all())
        return Error{.what = "--on-boundary is not that of the map",
                     .file = a.map,
                     .expected = map->all() ? "all" : "lowest",
                     .found = *a.all ? "all" : "lowest",
                     .remedy = "leave the option out, or save another map"};
    run.from = PointsFrom::map;
    run.points = a.map;
    run.all = map->all();
    Status ready = engine.prepare_without_search(FoundBy::map, "cells are those of the map", progress);
    if (!ready) return ready;
    return sample_map(a, engine, *map, rows_to_output(a), run, progress);
}

Status run_sample(const SampleArguments& a) {
    if (Status ok = check_arguments(a); !ok) return ok;
    const ThreadLimit limit(a.options.threads);
    Progress progress(wants_progress(a));
    Stopwatch whole;
    auto engine = SamplingEngine::open(a, progress);
    if (!engine) return engine.error();
    SampleRun run = run_of("sample", a);
    Status done = a.map.empty() ? with_points(a, **engine, run, progress) : with_map(a, **engine, run, progress);
    if (!done) return done;
    if (a.quiet && a.json.empty()) return done;
    (*engine)->tell(run);
    run.seconds.total = whole.lap();
    progress.clear();
    return write_reports(a, run);
}

}  // namespace

void add_sample(CLI::App& app, int& exit_code) {
    auto* sub = app.add_subcommand("sample", "Sample the fields of a mesh at points, correctly rounded");
    sub->footer(
        "Rows: x,y,z,cell,feature, then a column for each component of each field (NAME, or NAME.0, NAME.1, ...), "
        "those of\n"
        "nodes first, and with --outside nearest or extrapolate the distance to the mesh. cell: the cell of lowest "
        "number\n"
        "that holds the point, counted from 0 in the order of the file; -1 outside. feature: interior, face, edge, "
        "vertex\n"
        "or outside, exactly. Attributes of TetGen's nodes are attribute0, attribute1, ...\n"
        "Files appear whole or not at all; rows on stdout cannot be taken back. Exit codes: 0 done, 2 usage or input "
        "error.");
    const auto a = std::make_shared<SampleArguments>();
    file_option(*sub, "MESH", a->mesh, "A TetGen mesh (.node/.ele; Triangle's for 2D), or a VTK file (.vtu .vtk)")
        ->required();
    file_option(*sub, "--points", a->points, "Points: .csv .npy .node .vtu .vtp .vtk; - is CSV from stdin");
    file_option(*sub, "--output", a->output, "Rows: .csv .npy .vtu; - is CSV on stdout")->required();
    add_sampling_options(*sub, *a);
    sub->add_option_function<std::string>(
           "--on-boundary", [a](const std::string& text) { a->all = text == "all"; },
           "Where several cells hold a point: a row for that of lowest number (default), or for each of them")
        ->check(CLI::IsMember({"lowest", "all"}).description(""))
        ->type_name("lowest|all");
    file_option(*sub, "--save-map", a->save_map, "Write which cell holds each point, for --map");
    file_option(
        *sub, "--map", a->map,
        "In place of --points: the points of that map and the cells it names, for other fields on the same mesh");
    sub->callback([a, &exit_code] {
        const Status done = run_sample(*a);
        exit_code = done ? exit_clean : fail(done.error());
    });
}

}  // namespace barycert::cli
