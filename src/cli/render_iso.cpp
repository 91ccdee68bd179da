// barycert render iso: where a field has a value, in a mesh or on one segment.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "barycert/base/text.hpp"
#include "barycert/weights.hpp"
#include "command.hpp"
#include "contour_options.hpp"
#include "files.hpp"
#include "options.hpp"
#include "render.hpp"
#include "render_options.hpp"

namespace barycert::cli {
namespace {

struct IsoArguments {
    ContourJob job;
    bool quiet = false;
    std::vector<double> ends, values;  ///< of --segment, end after end, and --values
    std::string of_mesh;               ///< an option that was given and has no meaning for a segment
};

void add_segment(CLI::App& sub, IsoArguments& a) {
    sub.add_option_function<std::string>(
           "--segment",
           [&a](const std::string& text) {
               const std::size_t colon = text.find(':');
               const auto first = finite_numbers(std::string_view(text).substr(0, colon), ',');
               const auto second = colon == std::string::npos
                                       ? std::nullopt
                                       : finite_numbers(std::string_view(text).substr(colon + 1), ',');
               if (!first || !second || first->size() != second->size() || first->size() > 3)
                   throw CLI::ValidationError(
                       "--segment",
                       "expected XA,YA,ZA:XB,YB,ZB, finite numbers, as many at both ends (one to three), found \"" +
                           text + '"');
               a.ends = *first;
               a.ends.insert(a.ends.end(), second->begin(), second->end());
           },
           "Instead of a mesh: the ends of one segment; with --values")
        ->type_name("A:B");
    sub.add_option_function<std::string>(
           "--values",
           [&a](const std::string& text) {
               const auto numbers = finite_numbers(text, ',');
               if (!numbers || numbers->size() != 2)
                   throw CLI::ValidationError("--values", "expected two finite numbers, FA,FB, found \"" + text + '"');
               a.values = *numbers;
           },
           "The values at the ends of the segment")
        ->type_name("FA,FB");
}

/// Of a picture.
void add_view(CLI::App& sub, ContourJob& job) {
    sub.add_option("--colours", job.colours,
                   "Picture: the field of nodes or cells that colours the surface; default: none, it is grey")
        ->type_name("NAME");
    sub.add_option_function<std::string>(
           "--range",
           [&job](const std::string& text) {
               const auto ends = finite_numbers(text, ',');
               if (!ends || ends->size() != 2 || !((*ends)[0] < (*ends)[1]))
                   refuse_option("--range", "MIN,MAX, finite numbers, MIN < MAX", text);
               job.range = {(*ends)[0], (*ends)[1]};
           },
           "Picture: the values of the first and the last colour; default: min and max of the values drawn")
        ->type_name("MIN,MAX");
    const auto angle = [&sub](const char* name, double& degrees, const char* help) {
        sub.add_option_function<std::string>(
               name,
               [name, &degrees](const std::string& text) {
                   const auto x = finite(text);
                   if (!x) refuse_option(name, "degrees, a finite number", text);
                   degrees = *x;
               },
               help)
            ->type_name("DEGREES");
    };
    angle("--azimuth", job.view.azimuth,
          "Picture: where the camera stands, from the x axis towards the y axis; default: 30");
    angle("--elevation", job.view.elevation, "Picture: how far above the xy plane; default: 25");
    add_size_option(sub, job.view.size);
}

/// t and the point, on one line.
int on_segment(const IsoArguments& a) {
    if (a.values.empty() || !a.job.value)
        return fail({.what = "--segment needs the values at its ends and the one to look for",
                     .expected = "--values FA,FB --value V"});
    if (!a.job.mesh.empty()) return fail({.what = "--segment cannot be combined with a mesh", .found = a.job.mesh});
    if (!a.of_mesh.empty()) return fail({.what = "--segment cannot be combined with " + a.of_mesh});
    const std::size_t d = a.ends.size() / 2;
    const std::span<const double> ends(a.ends);
    std::vector<double> point(d);
    const auto t = point_of_value(ends.first(d), ends.subspan(d), a.values[0], a.values[1], *a.job.value, point);
    if (!t) return fail(t.error());
    std::string text;
    if (t->undetermined) {
        const bool all = a.values[0] == *a.job.value;
        text = fmt::format("undetermined: both ends have the value {}: {}\n", base::shortest(a.values[0]),
                           all ? "so has every point" : "no point has the one looked for");
    } else {
        text = "t " + base::shortest(t->t) + "\npoint ";
        for (std::size_t k = 0; k < d; ++k) text += (k == 0 ? "" : ",") + base::shortest(point[k]);
        text += t->t < 0 || t->t > 1 ? "\noutside the segment, on its line\n" : "\n";
    }
    const Status told = write_output("-", text);
    return told ? exit_clean : fail(told.error());
}

int run_iso(IsoArguments& a) {
    if (!a.ends.empty()) return on_segment(a);
    if (!a.values.empty()) return fail({.what = "--values needs --segment"});
    if (a.job.mesh.empty() || a.job.field.empty() || !a.job.value || a.job.output.empty())
        return fail({.what = "something is missing",
                     .expected = "MESH --field NAME --value V --output FILE, or --segment A:B --values FA,FB --value V",
                     .remedy = "`barycert render iso --help` explains them"});
    return run_contour(a.job, a.quiet);
}

}  // namespace

void add_render_iso(CLI::App& render, int& exit_code) {
    auto* sub = render.add_subcommand(
        "iso", "Where a field has a value: the iso-surface of a mesh, the iso-lines of a mesh of triangles");
    sub->footer(
        "The boundary of the set where the field is at least the value, exactly; watertight, normals towards lower\n"
        "values. Points are on edges of the mesh, their coordinates and the fields carried along correctly rounded.\n"
        "Files, by the suffix: .vtp (all fields), .ply (all fields), .off (no fields, no lines), .png (the surface, "
        "lit).\n"
        "--segment A:B --values FA,FB prints the parameter t of one segment (0 at A, 1 at B) and the point.\n"
        "Exit codes: 0 done, an empty surface included; 2 usage or input error, a picture of nothing included.");
    const auto a = std::make_shared<IsoArguments>();
    file_option(*sub, "MESH", a->job.mesh, mesh_help);
    sub->add_option(
           "--field", a->job.field,
           "The field of nodes, or what is made of it, as sample names it: NAME.x or NAME.0, |NAME| (at the nodes)")
        ->type_name("NAME");
    sub->add_option_function<std::string>(
           "--value",
           [a](const std::string& text) {
               const auto numbers = finite_numbers(text, ',');
               if (!numbers || numbers->size() != 1)
                   throw CLI::ValidationError("--value", "expected a finite number, found \"" + text + '"');
               a->job.value = numbers->front();
           },
           "Its value")
        ->type_name("V");
    file_option(*sub, "--output", a->job.output, "The surface: .vtp .ply .off .png");
    add_contour_options(*sub, a->job, a->quiet);
    add_view(*sub, a->job);
    add_segment(*sub, *a);
    sub->callback([=, &exit_code] {
        for (const CLI::Option* option : sub->get_options()) {
            const std::string name = option->get_name();
            const bool of_segment = name == "--segment" || name == "--values" || name == "--value";
            if (option->count() > 0 && !of_segment && name.starts_with('-')) a->of_mesh = name;
        }
        if (const Status ok = check_picture_only(*sub, a->job.output, {"--azimuth", "--elevation", "--size"}); !ok) {
            exit_code = fail(ok.error());
            return;
        }
        exit_code = run_iso(*a);
    });
}

}  // namespace barycert::cli
