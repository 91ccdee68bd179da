// barycert render drift, barycert render texels: what the shortcuts of rasterisers cost, against exact arithmetic.

#include <string>
#include <vector>

#include "app/cli/audit_inputs.hpp"
#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "barycert/audit_pictures.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/choices.hpp"
#include "barycert/result.hpp"

namespace barycert::cli {
namespace {

struct TableArguments : Arguments<DriftOptions> {  // of texels count and seed alone
    KernelChoice kernels;
};

constexpr const char* json_figures = "Write the figures as JSON; - is stdout and suppresses the table";

int run_drift(TableArguments& a) {
    if (const std::string& plot = a.reports.path("--output"); plot.ends_with(".png"))
        return fail(file_error("file.suffix", {}, "the plot is a drawing, not a picture of pixels",
                               "a name that ends in .svg", '"' + plot + '"', "browsers and most programs show SVG"));
    a.reports.check(library_files(a.kernels));
    if (a.kernels.names.empty() && a.kernels.libraries.empty())
        a.kernels.names = {"triangle.scanline-increments.float32", "triangle.scanline-increments", "triangle.bilinear",
                           "triangle.signed-area", "triangle.exact"};
    a.job.kernels = chosen_kernels(a.kernels).value();
    return a.reports.end(measure_drift(a.job), [](const DriftReport& report) {
        return Told{
            .files = {{"--json", [&] { return drift_json(report); }}, {"--output", [&] { return drift_plot(report); }}},
            .text = [&](bool colour) { return drift_text(report, {.colour = colour}); }};
    });
}

int run_texels(TableArguments& a) {
    const std::vector<TexelResult> results = audit_texels(texel_rules(), a.job.count, a.job.seed);
    return a.reports.write({.files = {{"--json", [&] { return texels_json(results); }}},
                            .text = [&](bool colour) { return texels_text(results, {.colour = colour}); }});
}

void add_count_and_seed(const Options& o, TableArguments& a, const char* what) {
    add_count(o, a.job.count, 32, what);
    add_seed(o, a.job.seed, "The same seed gives the same cases on every machine");
}

}  // namespace

void add_render_tables(const Options& render) {
    const auto& [drift, a] =
        render.command("drift", "Measure how far values that are stepped from pixel to pixel drift from the exact ones",
                       done_or_error, run_drift);
    a.reports.file(drift, "--output", "Plot the errors over the size of the triangle, as SVG; - is stdout");
    a.reports.file(drift, "--json", json_figures);
    drift.text("--kernel", a.kernels.names,
               "Kernels on triangles (not triangle.perspective-*); may be repeated; default: increments in float and "
               "double, bilinear, signed-area, exact",
               "KERNEL|GLOB");
    drift.text("--kernel-library", a.kernels.libraries,
               "A shared library with a kernel of yours; alone without --kernel");
    add_containment(drift, a.kernels);
    add_count_and_seed(drift, a, "Cases per size");
    a.reports.quiet(drift, "Print no table");
    const auto& [texels, t] = render.command(
        "texels", "Count how often rules for the texel of a texture coordinate are wrong or leave the texture",
        done_or_error, run_texels);
    t.job.count = 100000;
    t.reports.file(texels, "--json", json_figures);
    add_count_and_seed(texels, t, "Coordinates");
}

}  // namespace barycert::cli
