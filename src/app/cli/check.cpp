// barycert check: is a mesh a partition of its domain? Proved in exact arithmetic, or the reasons why not.

#include <cstddef>

#include "app/cli/check_parts.hpp"
#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "app/report/check/check_words.hpp"
#include "barycert/check_job.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"

namespace barycert::cli {
namespace {

int run_check(Arguments<CheckJob>& a) {
    a.reports.begin(a.job);
    a.job.plot = !a.reports.path("--plot").empty();
    return a.reports.end(checked_files(a.job), [&](const CheckedMesh& c) {
        const FixedMesh* const fixed = c.copied ? &*c.fixed : nullptr;
        Told told{.text =
                      [&c, fixed](bool colour) {
                          const TerminalStyle style{.colour = colour, .command = command_name()};
                          return check_text(c.report, c.mesh, c.name, style) + (fixed ? fix_text(*fixed, style) : "");
                      },
                  .ci = [&c] { return check_outcomes(c.report, c.mesh, c.name, c.artifact, measure_environment()); },
                  .notes = c.report.surface ? c.surface.notes : c.mesh.notes,
                  .curved = {c.report.curved},
                  .clean = c.certified(),
                  .written = c.written};
        if (c.fixed && !c.copied) {
            Error error = c.written.error();
            if (error.code == "mesh.fix-empty")
                error.found = fmt::format("{}", fmt::join(report::fix_sentences(*c.fixed), "; "));
            told.written = error;
            return told;  // without the copy the reports would say less than was asked for
        }
        told.files["--json"] = [&, fixed] { return check_json(c.report, a.job.mesh, measure_environment(), fixed); };
        told.files["--html"] = [&c, fixed] { return checked_page(c, fixed); };
        told.files["--plot"] = [&a, &c] { return checked_plot(c, a.reports.path("--plot")); };
        return told;
    });
}

}  // namespace

void add_check(const Options& program) {
    const auto& [o, a] = program.command(
        "check",
        "Prove in exact arithmetic that a mesh is a partition of its domain, or a surface closed and without "
        "self-intersections, or report why it is not",
        R"(Exit codes: 0 certified, 1 not certified, 2 usage or input error; with --fix by the copy,
while --junit, --sarif and --annotations tell of the mesh as it was.
Certified: any two cells meet in a common face or not at all, and the files .neigh and .face, if present, agree with
the cells. Second-order cells are checked with straight sides.
A surface is certified if any two triangles meet in a common node or edge or not at all, and each edge has two or more;
a PLC, if it is valid and encloses a region: then TetGen can mesh it. --delaunay, --conforms-to and --fix are for meshes.)",
        run_check);
    CheckJob& job = a.job;
    o.text("MESH", job.mesh,
           mesh_help() + ", TetGen's with .face and .neigh if present; or a surface or a PLC for TetGen: " +
               base::suffix_list_read(base::Use::plc) + ", or triangles in space in any of these")
        ->required();
    o.step(job.step);
    o.flag("--delaunay", job.options.delaunay, "Also test exactly whether every interior facet is locally Delaunay");
    o.text("--conforms-to", job.plc,
           "Also test whether the facets of this PLC (" + base::suffix_list_read(base::Use::plc) +
               ") are unions of faces of cells",
           "PLC");
    o.integer<std::size_t>("--examples", job.options.examples, 0, 1000000, "Max number of places listed per defect");
    o.integer<std::size_t>("--contacts", job.options.contacts, 0, 1000000,
                           "Max number of overlapping or touching pairs listed with a witness");
    o.curved(job.curved);
    o.threads(job.options.threads);
    a.reports.file(o, "--json", json_instead);
    a.reports.file(
        o, "--html",
        "Write the report as an HTML page with histograms and pictures of cells; - is stdout and suppresses the table");
    a.reports.picture(o, "--plot", "Draw the histograms of volumes, angles and ratios");
    o.text("--vtu", job.measures,
           "Write the mesh with measures and defects of each cell as VTU (a surface: .vtp), for ParaView");
    o.text("--picture", job.picture, "Draw a surface from two sides, triangles with defects red: .png");
    auto* const all =
        o.text("--fix", job.fix,
               "Write a copy with what has one right answer repaired, and check it: coincident nodes "
               "merged, degenerate and duplicate cells dropped, negative cells turned: " +
                   base::suffix_list_written(base::Use::mesh) + ", or TetGen's STEM.node, STEM.ele (.face, .neigh)");
    o.number("--merge-within", job.merge_within, 0, "With --fix, merge nodes of cells at most so far apart",
             "DISTANCE");
    o.text("--fix-orientation", job.fix_orientation, "Write a copy with negative cells turned, and no other repair")
        ->excludes(all);
    o.number("--near", job.options.near, 0,
             "Tell boundary nodes apart by at most RATIO times the shortest boundary edge at either; 0: none", "RATIO")
        ->default_str(base::shortest(job.options.near));
    o.vtk_data(job.vtk_data);
    a.reports.ci(o, "what breaks the certificate");
    a.reports.quiet(o, "Print no table and no progress");
}

}  // namespace barycert::cli
