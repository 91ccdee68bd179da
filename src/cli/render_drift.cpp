// barycert render drift, barycert render texels: what the shortcuts of rasterisers cost, against exact arithmetic.

#include <CLI/CLI.hpp>
#include <memory>

#include "audit_inputs.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/base/named_file.hpp"
#include "command.hpp"
#include "files.hpp"

namespace barycert::cli {
namespace {

struct DriftArguments {
    std::vector<std::string> kernels, libraries;
    std::string output, json;
    std::uint64_t count = 10000;
    std::uint64_t seed = 1;
    bool quiet = false;
    std::shared_ptr<KernelRules> rules = std::make_shared<KernelRules>();
};

int run_drift(const DriftArguments& a) {
    if (a.output.ends_with(".png"))
        return fail({.what = "the plot is a drawing, not a picture of pixels",
                     .expected = "a name that ends in .svg",
                     .found = '"' + a.output + '"',
                     .remedy = "browsers and most programs show SVG"});
    const bool table = !a.quiet && a.json != "-" && a.output != "-";
    std::vector<base::NamedFile> inputs, outputs{{"--output", a.output}, {"--json", a.json}};
    for (const std::string& library : a.libraries) inputs.push_back({"--kernel-library", library});
    if (table) outputs.push_back({"the table", "-"});
    if (const Status ok = base::check_outputs(inputs, std::move(outputs)); !ok) return fail(ok.error());
    DriftOptions options{.kernels = {}, .count = a.count, .seed = a.seed};
    const std::vector<std::string> usual{"triangle.scanline-increments.float32", "triangle.scanline-increments",
                                         "triangle.bilinear", "triangle.signed-area", "triangle.exact"};
    const auto kernels =
        select_kernels(a.kernels.empty() && a.libraries.empty() ? usual : a.kernels, a.libraries, *a.rules);
    if (!kernels) return fail(kernels.error());
    options.kernels = *kernels;
    const Result<DriftReport> report = measure_drift(options);
    if (!report) return fail(report.error());
    if (!a.json.empty()) {
        if (const Status written = write_output(a.json, drift_json(*report)); !written) return fail(written.error());
    }
    if (!a.output.empty()) {
        if (const Status written = write_output(a.output, drift_plot(*report)); !written) return fail(written.error());
    }
    if (table) {
        TerminalStyle style;
        style.colour = colour_on_stdout();
        if (const Status written = write_output("-", drift_text(*report, style)); !written)
            return fail(written.error());
    }
    return exit_clean;
}

struct TexelArguments {
    std::string json;
    std::uint64_t count = 100000;
    std::uint64_t seed = 1;
};

int run_texels(const TexelArguments& a) {
    const std::vector<TexelResult> results = audit_texels(texel_rules(), a.count, a.seed);
    if (!a.json.empty()) {
        if (const Status written = write_output(a.json, texels_json(results)); !written) return fail(written.error());
    }
    if (a.json == "-") return exit_clean;
    TerminalStyle style;
    style.colour = colour_on_stdout();
    const Status written = write_output("-", texels_text(results, style));
    return written ? exit_clean : fail(written.error());
}

void seed_and_count(CLI::App& sub, std::uint64_t& count, std::uint64_t& seed, const char* what) {
    sub.add_option("--count", count, what)
        ->capture_default_str()
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32).description(""))
        ->type_name("N");
    sub.add_option("--seed", seed, "The same seed gives the same cases on every machine")
        ->capture_default_str()
        ->check(whole_number())
        ->type_name("S");
}

}  // namespace

void add_render_drift(CLI::App& render, int& exit_code) {
    auto* sub = render.add_subcommand(
        "drift", "Measure how far values that are stepped from pixel to pixel drift from the exact ones");
    sub->footer(done_or_error);
    const auto a = std::make_shared<DriftArguments>();
    file_option(*sub, "--output", a->output, "Plot the errors over the size of the triangle, as SVG; - is stdout");
    file_option(*sub, "--json", a->json, "Write the figures as JSON; - is stdout and suppresses the table");
    sub->add_option("--kernel", a->kernels,
                    "Kernels on triangles (not triangle.perspective-*); may be repeated; default: increments in float "
                    "and double, bilinear, signed-area, exact")
        ->type_name("KERNEL|GLOB")
        ->allow_extra_args(false);
    file_option(*sub, "--kernel-library", a->libraries,
                "A shared library with a kernel of yours; alone without --kernel");
    add_containment(*sub, a->rules);
    seed_and_count(*sub, a->count, a->seed, "Cases per size");
    sub->add_flag("--quiet", a->quiet, "Print no table");
    sub->callback([a, &exit_code] { exit_code = run_drift(*a); });
}

void add_render_texels(CLI::App& render, int& exit_code) {
    auto* sub = render.add_subcommand(
        "texels", "Count how often rules for the texel of a texture coordinate are wrong or leave the texture");
    sub->footer(done_or_error);
    const auto a = std::make_shared<TexelArguments>();
    file_option(*sub, "--json", a->json, "Write the figures as JSON; - is stdout and suppresses the table");
    seed_and_count(*sub, a->count, a->seed, "Coordinates");
    sub->callback([a, &exit_code] { exit_code = run_texels(*a); });
}

}  // namespace barycert::cli
