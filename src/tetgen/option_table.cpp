#include "options.hpp"

#include <CLI/CLI.hpp>

#include "options/parser.hpp"

namespace barycert {

void add_options(CLI::App& app, OptionTable& table) {
    app.footer("Exit codes: 0 meshed; 2 usage or input error, or TetGen failed.");
    app.set_version_flag("--version", "barycert-tetgen " BARYCERT_VERSION " (TetGen 1.5)");
    app.add_option("INPUT", table.input, "The PLC: .poly, .smesh, .off, .stl or .ply")->type_name("FILE")->required();
    app.add_option("--output", table.output,
                   "Stem of the output files, with or without .node; default: stem of INPUT plus .1")
        ->type_name("FILE");
    auto* quality = app.add_option("--quality", table.ratio, "Max radius-edge ratio, default 2 (TetGen -q)")
                        ->expected(0, 1)
                        ->type_name("[RATIO]");
    auto* dihedral = app.add_option("--min-dihedral", table.min_dihedral, "Min dihedral angle to aim for, in degrees")
                         ->type_name("DEGREES");
    auto* volume = app.add_option("--max-volume", table.max_volume, "Max volume of a cell (TetGen -a)")->type_name("V");
    auto* order = app.add_option("--order", table.order, "2: second-order cells of ten nodes (TetGen -o2)")
                      ->check(cli::one_of({"1", "2"}))
                      ->type_name("1|2");
    auto* keep = app.add_flag("--keep-boundary", table.keep_boundary, "Add no nodes on the boundary (TetGen -Y)");
    auto* raw = app.add_option("--switches", table.switches,
                               "TetGen's own switches instead of these options, such as pq1.4a0.1")
                    ->type_name("STRING");
    app.add_option("--index-base", table.index_base, "Number from 0 or 1; default: as INPUT does")
        ->check(cli::one_of({"0", "1"}))
        ->type_name("0|1");
    app.add_flag("--quiet", table.quiet, "Print no summary");
    app.add_option("--timeout", table.timeout, "Stop after this time")->type_name("SECONDS");
    for (auto* option : {quality, dihedral, volume, order, keep}) raw->excludes(option);
}

}  // namespace barycert
