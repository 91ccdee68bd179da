// barycert render iso, slice: where a field has a value, in a mesh or on one segment; a plane through a mesh.

#include <cstdint>
#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "barycert/contour_job.hpp"
#include "barycert/figure.hpp"
#include "barycert/report.hpp"
#include "barycert/scene.hpp"
#include "barycert/weights.hpp"
#include "core/base/text.hpp"

namespace barycert::cli {
namespace {

struct ContourArguments : Arguments<ContourJob> {
    std::vector<std::vector<double>> ends;  ///< of --segment
    std::vector<double> values;             ///< --values
};

void add_contour_options(const Options& o, ContourArguments& a) {
    o.step(a.job.step);
    o.field_files(a.job.field_files, "--field-file");
    o.text("--fields", a.job.fields, "Fields to carry along: A,B,...; default: all", "NAMES");
    o.curved(a.job.curved);
    o.threads(a.job.threads);
    o.vtk_data(a.job.vtk_data);
    a.reports.file(o, "--json", json_summary);
    a.reports.quiet(o, "Print no summary and no progress");
}

int run_contour(ContourArguments& a) {
    const std::string of_picture = given_option(*a.app, figure_options);
    if (!of_picture.empty() && !a.job.output.empty() && !is_figure_name(a.job.output))
        return fail({.code = "option.unfit",
                     .what = of_picture + " is for pictures",
                     .remedy = "leave it out, or name a file with one of " + pictures_help()});
    return a.reports.summarise(a.job, contour_files, contour_json, contour_text);
}

void add_segment(const Options& o, ContourArguments& a) {
    o.parsed("--segment", "A:B", "Instead of a mesh: the ends of one segment; with --values",
             "XA,YA,ZA:XB,YB,ZB, finite numbers, as many at both ends (one to three)", a.ends,
             [](Text text) { return segment_of(text, 1); });
    o.parsed("--values", "FA,FB", "The values at the ends of the segment", "two finite numbers, FA,FB", a.values,
             numbers(',', finite, 2, 2));
}

/// t and the point, on one line.
int on_segment(const ContourArguments& a) {
    if (a.values.empty() || !a.job.value)
        return fail({.code = "option.missing",
                     .what = "--segment needs the values at its ends and the one to look for",
                     .expected = "--values FA,FB --value V"});
    if (!a.job.mesh.empty())
        return fail(
            {.code = "option.conflict", .what = "--segment cannot be combined with a mesh", .found = a.job.mesh});
    const std::string of_mesh = given_option(*a.app, {"--segment", "--values", "--value"}, true);
    if (!of_mesh.empty())
        return fail({.code = "option.conflict", .what = "--segment cannot be combined with " + of_mesh});
    std::vector<double> point(a.ends[0].size());
    const Parameter t = point_of_value(a.ends[0], a.ends[1], a.values[0], a.values[1], *a.job.value, point).value();
    std::string text;
    if (t.undetermined) {
        const bool all = a.values[0] == *a.job.value;
        text = fmt::format("undetermined: both ends have the value {}: {}\n", base::shortest(a.values[0]),
                           all ? "so has every point" : "no point has the one looked for");
    } else {
        text = "t " + base::shortest(t.t) + "\npoint " + base::joined(point, ",", base::shortest);
        text += t.t < 0 || t.t > 1 ? "\noutside the segment, on its line\n" : "\n";
    }
    write_output("-", text).value();
    return exit_clean;
}

int run_iso(ContourArguments& a) {
    if (!a.ends.empty()) return on_segment(a);
    if (!a.values.empty()) return fail({.code = "option.missing", .what = "--values needs --segment"});
    if (a.job.mesh.empty() || a.job.field.empty() || !a.job.value || a.job.output.empty())
        return fail({.code = "option.missing",
                     .what = "something is missing",
                     .expected = "MESH --field NAME --value V --output FILE, or --segment A:B --values FA,FB --value V",
                     .remedy = "`barycert render iso --help` explains them"});
    return run_contour(a);
}

void add_iso(const Options& render) {
    const auto& [o, a] = render.command(
        "iso", "Where a field has a value: the iso-surface of a mesh, the iso-lines of a mesh of triangles",
        "The boundary of the set where the field is at least the value, exactly; watertight, normals towards lower\n"
        "values. Points are on edges of the mesh, their coordinates and the fields carried along correctly rounded.\n"
        "Files, by the suffix: .vtp, .ply (all fields), .off (no fields, no lines); .png, .svg, .pdf (the surface, "
        "lit).\n"
        "--segment A:B --values FA,FB prints the parameter t of one segment (0 at A, 1 at B) and the point.\n"
        "Exit codes: 0 done, an empty surface included; 2 usage or input error, a picture of nothing included.",
        run_iso);
    ContourJob& job = a.job;
    o.text("MESH", job.mesh, mesh_help());
    o.text("--field", job.field,
           "The field of nodes, or what is made of it, as sample names it: NAME.x or NAME.0, |NAME| (at the nodes)",
           "NAME");
    o.parsed("--value", "V", "Its value", "a finite number", job.value, finite);
    o.text("--output", job.output, "The surface: " + contours_help());
    add_contour_options(o, a);
    o.text("--colours", job.colours,
           "Picture: the field of nodes or cells that colours the surface; default: none, it is grey", "NAME");
    o.figure(job.figure, "Picture: ");
    o.view(job.figure, "Picture: ");
    o.edges(job.edges, job.outline, "Picture: ");
    add_segment(o, a);
}

void add_slice(const Options& render) {
    const auto& [o, a] = render.command(
        "slice", "Cut a mesh of tetrahedra by a plane: a picture of a field, or a surface",
        "Sides of nodes are exact, for the four numbers of the plane as they are read. By the suffix of the output:\n"
        ".png .svg .pdf  the field in colours, on axes; seen from where the normal points to, z upwards. With\n"
        "             --samples 1 values are exact at the pixels' middles, which are rounded to doubles.\n"
        ".vtp .ply    triangles with all fields, correctly rounded; .off: without fields. Normals along the plane's.\n"
        "Exit codes: 0 done; 2 usage or input error, a picture of nothing included.",
        run_contour);
    ContourJob& job = a.job;
    o.mesh(job.mesh);
    o.parsed("--plane", "NX,NY,NZ,D", "All points with NX x + NY y + NZ z = D; or of one axis: x=D, y=D, z=D",
             "an axis and where, such as z=0.5, or NX,NY,NZ,D, finite numbers, a normal that is not zero, such as "
             "0,0,1,0.5",
             job.plane, plane_of)
        ->required();
    o.text("--field", job.field,
           "Picture: the field of nodes or cells that it shows, or what is made of it, as sample names it: NAME.x or "
           "NAME.0, |NAME|. Surface: carry this one only",
           "NAME");
    o.text("--output", job.output, "The section: " + contours_help())->required();
    o.integer<std::int64_t>("--width", job.width, 1, 1000000, "Picture: pixels across the section", "PIXELS");
    o.integer("--samples", job.figure.samples, 1, max_samples,
              "Picture: of each pixel, across and up; 1: exact values");
    o.figure(job.figure, "Picture: ");
    o.flag("--edges", job.edges, "Picture: the edges of cells");
    add_contour_options(o, a);
}

}  // namespace

void add_render_contours(const Options& render) {
    add_iso(render);
    add_slice(render);
}

}  // namespace barycert::cli
