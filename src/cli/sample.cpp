// barycert sample: the fields of a mesh at points, row by row.

#include <CLI/CLI.hpp>

#include <memory>

#include "barycert/jobs.hpp"
#include "command.hpp"
#include "files.hpp"
#include "options/choice.hpp"
#include "sampling_options.hpp"

namespace barycert::cli {

void add_sample(CLI::App& app, int& exit_code) {
    auto* sub = app.add_subcommand("sample", "Sample the fields of a mesh at points, correctly rounded");
    sub->footer(
        "Rows: x,y,z,cell,feature, then one column per component of each field (NAME, or NAME.0, NAME.1, ...): node\n"
        "fields, cell fields, lengths; then with --outside nearest or extrapolate the distance to the mesh, then "
        "labels of cells "
        "named\n"
        "in --fields (texts, large integers), then columns of the points (--keep). cell: the number in the file, from\n"
        "0, of the first cell that contains the point; -1 outside. feature: interior, face, edge, vertex or outside,\n"
        "exact. TetGen's node attributes are named attribute0, attribute1, ... Rows are points again: --points takes\n"
        "the output of another run.\n"
        "Files appear whole or not at all; rows already printed to stdout stay. Exit codes: 0 done, 2 usage or input\n"
        "error.");
    const auto a = std::make_shared<SampleJob>();
    const auto quiet = std::make_shared<bool>(false);
    file_option(*sub, "MESH", a->mesh, mesh_help)->required();
    file_option(*sub, "--points", a->points,
                "Points: .csv .txt .npy .node .vtu .vtp .vtk .vti .vtr .vts, or the nodes of another mesh; - is CSV "
                "from stdin, "
                "and so is any pipe");
    sub->add_option(
           "--columns", a->columns,
           "The columns of the coordinates, by name or by number from 1, such as 2,3,4 or lon,lat,depth; needed "
           "where the file does not name x,y,z and has more columns than the mesh has dimensions")
        ->allow_extra_args(false)
        ->type_name("A,B,C");
    sub->add_option("--keep", a->keep,
                    "Columns of the points that rows are to have, as they are: names; or all: every column but the "
                    "coordinates and those that rows have anyway; NEW=NAME gives a column another name")
        ->allow_extra_args(false)
        ->type_name("NAMES|all");
    file_option(*sub, "--output", a->output, "Rows: .csv .npy .vtu; - is CSV on stdout");
    add_sampling_options(*sub, *a, *quiet);
    nonfinite_option(*sub, a->options.nonfinite_points);
    choice_option<std::optional<bool>>(
        *sub, "--on-boundary", a->all, {{"lowest", false}, {"all", true}},
        "If several cells contain a point: one row for the cell of lowest index (default), or one row per cell");
    file_option(*sub, "--save-map", a->save_map, "Write the cell of each point to a file for --map");
    file_option(*sub, "--map", a->map,
                "Instead of --points: take points and cells from this map; for other fields on the same mesh");
    sub->callback([=, &exit_code] { exit_code = run_sampling(*a, *quiet, [&] { return sample_files(*a); }); });
}

}  // namespace barycert::cli
