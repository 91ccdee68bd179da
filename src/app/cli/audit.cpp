// barycert audit: run kernels over families of cases against the oracle and report.

#include "barycert/audit.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/cli/audit_inputs.hpp"
#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "barycert/audit_job.hpp"
#include "barycert/audit_pictures.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/baseline.hpp"
#include "barycert/family.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mutants.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/threshold.hpp"
#include "files/named_file.hpp"

namespace barycert::cli {
namespace {

struct AuditArguments : Arguments<AuditJob> {
    std::vector<std::string> meshes, others;
    std::vector<Threshold> rules;
    bool mutants = false, surfaces = false, inverses = false, wide = false;
};

void check_files(const AuditArguments& a) {
    std::vector<base::NamedFile> inputs = library_files(a.job.kernels);
    for (const NamedMesh& mesh : a.job.meshes) {
        for (const std::string& path : audited_files(mesh.path)) inputs.push_back({"the mesh", path});
    }
    for (const std::string& file : a.others) inputs.push_back({"--with", file});
    if (!a.job.baseline.empty()) inputs.push_back({"--baseline", a.job.baseline});
    a.reports.check(inputs);
    if (!a.others.empty() && a.reports.path("--html").empty())
        throw Exception({.code = "option.missing", .what = "--with needs --html", .remedy = "it adds to the page"});
}

/// Refuses options about kernels, their cases and reports on them in modes that audit something else.
void check_alone(const AuditArguments& a) {
    const auto check = [&](const char* mode, const char* audited, std::initializer_list<std::string_view> fits) {
        const std::string other = given_option(*a.app, fits, true);
        if (!other.empty())
            throw Exception({.code = "option.conflict",
                             .what = fmt::format("{} and {}", mode, other),
                             .remedy = fmt::format("leave {} out: {} audits {}", other, mode, audited)});
    };
    if (a.mutants)
        check("--mutants", "kernels of its own",
              {"MESH", "--family", "--oracle", "--count", "--seed", "--threads", "--json", "--mutants", "--no-check",
               "--quiet"});
    if (a.surfaces)
        check("--surfaces", "rules on triangles in space, on cases of their own",
              {"--surfaces", "--count", "--seed", "--threads", "--json", "--html", "--quiet"});
    if (a.inverses)
        check("--inverse-maps", "Newton's method on cells, on cases of its own",
              {"--inverse-maps", "--count", "--seed", "--threads", "--json", "--html", "--quiet"});
    constexpr std::array<std::string_view, 4> shapes_with_maps{"quadrilateral", "hexahedron", "wedge", "pyramid"};
    for (const std::string& name : a.job.kernels.names) {
        if (std::ranges::count(shapes_with_maps, std::string_view(name).substr(0, name.find('.'))) != 0)
            throw Exception({.code = "kernel.unknown",
                             .what = "no kernel of simplices",
                             .found = name,
                             .remedy = "--inverse-maps audits those"});
    }
}

std::function<void(const AuditProgress&)> progress_of(AuditArguments& a) {
    return [&progress = a.reports.begin_progress()](const AuditProgress& p) {
        if (!progress.due()) return;
        progress.stage(fmt::format("{:3d} %  {} of {} cases, {}", p.cases_done * 100 / p.cases_total, p.cases_done,
                                   p.cases_total, p.family));
    };
}

Told told_of(const AuditArguments& a, const PreparedAudit& prepared, const AuditReport& report,
             const BaselineComparison* comparison, const std::vector<OtherResults>& others) {
    TerminalStyle style = style_to_repeat(a.reports, a.job.kernels, colour_on_stdout());
    style.mesh_arguments = a.meshes;
    style.wide = a.wide;
    const auto page = [=, &a, &prepared, &report, &others]() -> Result<std::string> {
        std::vector<Kernel> kernels;
        for (const KernelResult& k : report.kernels) kernels.push_back(k.kernel);
        AuditPage with{.style = style, .command_line = command_line(), .signs = sign_pictures(kernels)};
        with.maps = mesh_maps(kernels, prepared.meshes, a.job.options.seed, a.job.options.threads);
        with.others = others;
        return audit_html(report, with);
    };
    const std::vector<Violation> broken = violations(report, a.rules);
    return {
        .files = {{"--json", [&report] { return audit_json(report); }},
                  {"--html", page},
                  {"--witnesses", [&report] { return witnesses_json(report); }},
                  {"--plot", [&report] { return condition_plot(report); }}},
        .text = [=, &report](bool /*on_stdout*/) { return audit_text(report, style); },
        .ci = [=, &a, &report, &prepared] { return audit_outcomes(report, a.rules, comparison, prepared.libraries); },
        .curved = report.curved,
        .failures = (comparison ? baseline_text(*comparison, prepared.baseline->path) : "") + failures_of(broken),
        .clean = broken.empty() && (comparison == nullptr || comparison->worse.empty())};
}

int run_audit(AuditArguments& a) {
    check_alone(a);
    if (a.surfaces) return run_surface_rules({a.reports, a.job.options, progress_of(a)});
    if (a.inverses) return run_inverse_rules({a.reports, a.job.options, progress_of(a)});
    const auto meshes = meshes_or_own(a.meshes);
    if (meshes) a.job.meshes = *meshes;
    check_files(a);
    std::vector<OtherResults> others;
    for (const std::string& file : a.others) others.push_back(read_other_results(file).value());
    a.job.meshes_asked = !a.meshes.empty();
    PreparedAudit prepared = prepare_audit(a.job, read_audited, certify_audited).value();
    if (!meshes && std::ranges::any_of(prepared.options.families, &Family::needs_mesh)) return fail(meshes.error());
    for (const Kernel& kernel : prepared.options.kernels) {
        if (prepared.libraries.contains(kernel.name)) tell_note(prepared.libraries.at(kernel.name), kernel);
    }
    if (!a.reports.is_quiet()) tell_important(prepared.notes);
    prepared.options.progress = progress_of(a);
    if (a.mutants)
        return a.reports.end(audit_mutants(prepared.options, prepared.meshes), [](const MutantReport& report) {
            return Told{.files = {{"--json", [&] { return mutants_json(report); }}},
                        .text = [&](bool colour) { return mutants_text(report, {.colour = colour}); },
                        .clean = report.caught() == report.mutants.size()};
        });
    std::optional<BaselineComparison> comparison;
    return a.reports.end(barycert::run_audit(prepared.options, prepared.meshes), [&](const AuditReport& report) {
        Status compared = Done{};
        if (prepared.baseline) {
            auto with = compare_with_baseline(report, *prepared.baseline);
            if (with) comparison = std::move(*with);
            if (!with) compared = with.error();
        }
        Told told = told_of(a, prepared, report, comparison ? &*comparison : nullptr, others);
        if (!compared) told.ci = {};
        told.written = compared;
        return told;
    });
}

}  // namespace

void add_audit(const Options& program) {
    const auto& [o, a] = program.command(
        "audit", "Count how often each floating-point kernel is wrong, and by how much, against exact arithmetic",
        "Exit codes: 0 done; 1 a rule of --fail-on is broken, a figure is worse than in the baseline, or a mutant is\n"
        "not caught; 2 usage or input error.",
        run_audit);
    AuditJob& job = a.job;
    o.text("MESH", a.meshes,
           "Meshes for the families mesh.*, in the formats of barycert sample; default: barycert's own")
        ->allow_extra_args(true);
    o.text("--kernel", job.kernels.names, "Audit only kernels that match; may be repeated", "KERNEL|GLOB");
    o.text("--family", job.families, "Use only families that match; may be repeated", "FAMILY|GLOB");
    o.text("--kernel-library", job.kernels.libraries,
           "A shared library with a kernel of yours (see barycert/kernel.h); audited alone unless --kernel is given");
    add_kernel_rules(o, job.kernels);
    o.choice<OracleChoice>(
        "--oracle", job.options.oracle,
        {{"integers", OracleChoice::integers}, {"cgal", OracleChoice::cgal}, {"both", OracleChoice::both}},
        "Who says what is right: exact integers, CGAL's exact kernel (Epeck), or both, who must agree; without it "
        "integers, or barycert's core where it judges others, and CGAL confirms a sample and the hard cases");
    add_count(o, job.options.count, 48, "Cases per family and simplex");
    add_seed(o, job.options.seed, "The same seed gives the same cases on every machine");
    o.curved(job.curved);
    o.threads(job.options.threads);
    a.reports.file(o, "--json", json_instead);
    a.reports.file(o, "--html",
                   "Write the report as an HTML page with pictures, histograms and witnesses; - is stdout and "
                   "suppresses the table");
    o.text("--with", a.others,
           "Also show on that page what `./run flags --json FILE` or `./run systems --json FILE` wrote");
    a.reports.file(o, "--witnesses", "Write the worst cases as JSON, for `barycert replay`; - is stdout");
    a.reports.file(o, "--plot",
                   "Plot the errors of the kernels over the condition numbers of the cells, as SVG; - is stdout");
    o.each("--fail-on", "RULE[>NUMBER]",
           fmt::format("Exit with 1 if this figure of a kernel exceeds NUMBER (0 if omitted); may be repeated. RULE is "
                       "one of: {}",
                       fmt::join(threshold_names(), " ")),
           [&rules = a.rules](const std::string& text) { rules.push_back(parse_threshold(text).value()); });
    o.text("--baseline", job.baseline,
           "Compare with the --json report of an earlier audit of the same seed, count and meshes; exit with 1 if a "
           "figure got worse");
    a.reports.ci(o, "broken rules and what got worse than the baseline");
    o.flag("--mutants", a.mutants,
           "Audit kernels with seeded faults instead, and show which family catches which; exit with 1 if one is not "
           "caught");
    o.flag("--surfaces", a.surfaces,
           "Audit rules on triangles in space instead: the distance of a point, inside or outside of a closed surface, "
           "whether two triangles meet; with --count, --seed, --threads, --json, --html and --quiet alone");
    o.flag(
        "--inverse-maps", a.inverses,
        "Audit Newton's method for the inverse maps of hexahedra, wedges, pyramids and quadrilaterals instead, as it "
        "is in use; with the same options");
    o.flag("--wide", a.wide, "Print all counts, the families and a witness of each kernel: 160 columns");
    o.flag("--no-check", job.check, "Do not check whether the meshes are partitions (see `barycert check`)", false);
    a.reports.quiet(o, "Print no table and no progress");
}

}  // namespace barycert::cli
