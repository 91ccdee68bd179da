// barycert sample: the fields of a mesh at points, row by row.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <memory>
#include <utility>

#include "barycert/core/text.hpp"
#include "command.hpp"
#include "sampling.hpp"
#include "sampling_engine.hpp"
#include "sampling_files.hpp"
#include "sampling_run.hpp"

namespace barycert::cli {
namespace {

struct SampleArguments : SamplingArguments {
    std::string points;
    bool all = false;
};

Status check_files(const SampleArguments& a) {
    if (Status known = check_rows_format(a.output); !known) return known;
    std::vector<NamedFile> inputs = inputs_of(a);
    inputs.push_back({"--points", a.points});
    std::vector<NamedFile> outputs{{"--output", a.output}};
    if (!a.json.empty()) outputs.push_back({"--json", a.json});
    return check_files(inputs, outputs);
}

Status run_sample(const SampleArguments& a) {
    if (Status ok = check_files(a); !ok) return ok;
    const ThreadLimit limit(a.options.threads);
    Progress progress(wants_progress(a));
    Stopwatch whole;
    auto engine = SamplingEngine::open(a, progress);
    if (!engine) return engine.error();
    auto source = open_points(a.points, (*engine)->mesh().dimension);
    if (!source) return source.error();
    report::SampleRun run = run_of("sample", a);
    run.points = a.points;
    run.all = a.all;
    if (Status done = sample_stream(a, **engine, **source, run, progress); !done) return done;
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
    sub->add_option("MESH", a->mesh, "A TetGen mesh (.node/.ele; Triangle's for 2D), or a VTK file (.vtu .vtk)")
        ->required();
    file_option(*sub, "--points", a->points, "Points: .csv .npy .node .vtu .vtp .vtk; - is CSV from stdin")->required();
    file_option(*sub, "--output", a->output, "Rows: .csv .npy .vtu; - is CSV on stdout")->required();
    add_sampling_options(*sub, *a);
    sub->add_option_function<std::string>(
           "--on-boundary", [a](const std::string& text) { a->all = text == "all"; },
           "Where several cells hold a point: a row for that of lowest number (default), or for each of them")
        ->check(CLI::IsMember({"lowest", "all"}).description(""))
        ->type_name("lowest|all");
    sub->callback([a, &exit_code] {
        const Status done = run_sample(*a);
        exit_code = done ? exit_clean : fail(done.error());
    });
}

}  // namespace barycert::cli
