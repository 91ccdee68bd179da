// barycert audit: run kernels over families of cases against the oracle and report.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <utility>

#include "audit_inputs.hpp"
#include "barycert/audit.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io.hpp"
#include "baseline.hpp"
#include "command.hpp"
#include "files.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace barycert::cli {
namespace {

struct AuditArguments {
    CiOptions ci;
    std::string baseline;
    bool mutants = false;
    std::vector<std::string> meshes, kernels, families, libraries, fail_on;
    std::uint64_t count = 10000;
    std::uint64_t seed = 1;
    int threads = 0;
    std::string json, html, witnesses, plot;
    std::vector<std::string> others;
    bool quiet = false, no_check = false, wide = false;
    OracleChoice oracle = OracleChoice::automatic;
    Curved curved = Curved::straight;
    std::shared_ptr<KernelRules> rules = std::make_shared<KernelRules>();
};

/// The callback that shows how far the audit is.
std::function<void(const AuditProgress&)> shown_on(Progress& progress) {
    return [&progress](const AuditProgress& p) {
        if (!progress.due()) return;
        progress.stage(fmt::format("{:3d} %  {} of {} cases, {}", p.cases_done * 100 / p.cases_total, p.cases_done,
                                   p.cases_total, p.family));
    };
}

/// What can be known of files before the work.
Status check_files(const AuditArguments& a, bool table) {
    std::vector<base::NamedFile> inputs;
    Result<std::vector<std::string>> meshes = a.meshes;
    if (a.meshes.empty()) meshes = own_meshes();
    if (meshes) {
        for (const std::string& mesh : *meshes) {
            for (base::NamedFile& file : base::named_files("the mesh", mesh_files(mesh)))
                inputs.push_back(std::move(file));
        }
    }
    for (const std::string& library : a.libraries) inputs.push_back({"--kernel-library", library});
    for (const std::string& file : a.others) inputs.push_back({"--with", file});
    std::vector<base::NamedFile> outputs{
        {"--json", a.json}, {"--html", a.html}, {"--witnesses", a.witnesses}, {"--plot", a.plot}};
    if (!a.baseline.empty()) inputs.push_back({"--baseline", a.baseline});
    add_ci_outputs(a.ci, table, outputs);
    return base::check_outputs(inputs, std::move(outputs));
}

/// The page, with the pictures of signs and the maps in the order of the report.
Status write_page(const AuditReport& report, const AuditArguments& a, const TerminalStyle& style,
                  const MeshSource& meshes, const std::vector<OtherResults>& others) {
    std::vector<Kernel> kernels;
    for (const KernelResult& k : report.kernels) kernels.push_back(k.kernel);
    const Result<std::string> page = audit_html(report, {.style = style,
                                                         .command_line = command_line(),
                                                         .signs = sign_pictures(kernels),
                                                         .maps = mesh_maps(kernels, meshes, a.seed, a.threads),
                                                         .others = others});
    return page ? write_output(a.html, *page) : Status(page.error());
}

/// The files of --with.
Result<std::vector<OtherResults>> read_others(const AuditArguments& a) {
    std::vector<OtherResults> others;
    if (!a.others.empty() && a.html.empty())
        return Error{.what = "--with needs --html", .remedy = "it adds to the page"};
    for (const std::string& file : a.others) {
        Result<OtherResults> read = read_other_results(file);
        if (!read) return read.error();
        others.push_back(std::move(*read));
    }
    return others;
}

/// The mutation score of the families.
int run_mutants(const AuditArguments& a, const AuditOptions& options, const MeshSource& meshes, Progress& progress,
                bool table) {
    const Result<MutantReport> report = audit_mutants(options, meshes);
    progress.clear();
    if (!report) return fail(report.error());
    std::vector<Status> written;
    if (!a.json.empty()) written.push_back(write_output(a.json, mutants_json(*report)));
    if (table)
        written.push_back(
            write_output("-", mutants_text(*report, {.colour = colour_on_stdout(), .command = command_name()})));
    if (const Status ok = all_written(written); !ok) return fail(ok.error());
    return report->caught() == report->mutants.size() ? exit_clean : exit_findings;
}

/// Other options than these say something of kernels under audit, or of reports on them.
Status check_mutants_alone(const CLI::App& sub) {
    static constexpr std::array<std::string_view, 10> with_mutants{"MESH",       "--family",  "--oracle", "--count",
                                                                   "--seed",     "--threads", "--json",   "--mutants",
                                                                   "--no-check", "--quiet"};
    if (sub.count("--mutants") == 0) return Done{};
    for (const CLI::Option* option : sub.get_options()) {
        const std::string name = option->get_name();
        if (option->count() != 0 && std::find(with_mutants.begin(), with_mutants.end(), name) == with_mutants.end())
            return Error{.what = "--mutants and " + name,
                         .remedy = "leave " + name + " out: --mutants audits kernels of its own"};
    }
    return Done{};
}

int run_audit(const AuditArguments& a) {
    std::vector<Threshold> rules;
    for (const std::string& text : a.fail_on) {
        const Result<Threshold> rule = parse_threshold(text);
        if (!rule) return fail(rule.error());
        rules.push_back(*rule);
    }
    const bool table =
        !a.quiet && a.json != "-" && a.html != "-" && a.witnesses != "-" && a.plot != "-" && !a.ci.on_stdout();
    if (const Status ok = check_files(a, table); !ok) return fail(ok.error());
    const auto others = read_others(a);
    if (!others) return fail(others.error());
    AuditOptions options;
    options.count = a.count;
    options.seed = a.seed;
    options.threads = a.threads;
    options.oracle = a.oracle;
    const auto kernels = select_kernels(a.kernels, a.libraries, *a.rules);
    if (!kernels) return fail(kernels.error());
    options.kernels = *kernels;
    const auto families = select_families(a.families);
    if (!families) return fail(families.error());
    options.families = *families;
    // Without a family that draws from meshes barycert's own need not be there.
    const bool wanted = std::any_of(families->begin(), families->end(), [](const Family& f) { return f.needs_mesh; });
    const Result<MeshSource> meshes =
        wanted || !a.meshes.empty() ? load_meshes(a.meshes, !a.no_check, a.threads, a.quiet, a.curved) : MeshSource();
    if (!meshes) return fail(meshes.error());
    const auto baseline = read_comparable_baseline(a.baseline, options, *meshes);
    if (!baseline) return fail(baseline.error());

    Progress progress(!a.quiet && stderr_is_terminal());
    options.progress = shown_on(progress);
    if (a.mutants) return run_mutants(a, options, *meshes, progress, table);
    const Result<AuditReport> report = barycert::run_audit(options, *meshes);
    progress.clear();
    if (!report) return fail(report.error());

    // Files first: whoever reads the table may stop reading (`| head`). A file that could not be written does not cost
    // the user the table, the fruit of the whole run.
    std::vector<Status> written;
    if (!a.json.empty()) written.push_back(write_output(a.json, audit_json(*report)));
    if (!a.witnesses.empty()) written.push_back(write_output(a.witnesses, witnesses_json(*report)));
    if (!a.plot.empty()) written.push_back(write_output(a.plot, condition_plot(*report)));
    const std::string witnesses = a.witnesses.empty() ? a.json : a.witnesses;
    const TerminalStyle style{.colour = colour_on_stdout(),
                              .command = command_name(),
                              .witness_path = witnesses == "-" ? std::string() : witnesses,
                              .mesh_arguments = a.meshes,
                              .library_arguments = a.libraries,
                              .kernel_arguments = words_of(*a.rules),
                              .wide = a.wide};
    if (!a.html.empty()) written.push_back(write_page(*report, a, style, *meshes, *others));
    if (table) written.push_back(write_output("-", audit_text(*report, style)));
    if (!a.quiet && !table) {
        for (const CurvedCells& curved : report->curved) tell_curved(curved);
    }
    const Result<bool> worse = write_audit_ci(a.ci, *report, rules, *baseline, options.kernels, a.libraries, written);
    if (const Status ok = all_written(written); !ok) return fail(ok.error());
    if (!worse) return fail(worse.error());
    const auto broken = violations(*report, rules);
    for (const Violation& v : broken)
        tell(fmt::format("fails: {}: {} = {}, limit {}\n", v.kernel, v.figure, base::shortest(v.value),
                         base::shortest(v.limit)));
    return broken.empty() && !*worse ? exit_clean : exit_findings;
}

}  // namespace

void add_audit(CLI::App& app, int& exit_code) {
    auto* sub = app.add_subcommand(
        "audit", "Count how often each floating-point kernel is wrong, and by how much, against exact arithmetic");
    sub->footer(
        "Exit codes: 0 done; 1 a rule of --fail-on is broken, a figure is worse than in the baseline, or a mutant is\n"
        "not caught; 2 usage or input error.");
    const auto a = std::make_shared<AuditArguments>();
    file_option(*sub, "MESH", a->meshes,
                "Meshes for the families mesh.*, in the formats of barycert sample; default: barycert's own")
        ->allow_extra_args(true);
    sub->add_option("--kernel", a->kernels, "Audit only kernels that match; may be repeated")
        ->type_name("KERNEL|GLOB")
        ->allow_extra_args(false);
    sub->add_option("--family", a->families, "Use only families that match; may be repeated")
        ->type_name("FAMILY|GLOB")
        ->allow_extra_args(false);
    file_option(
        *sub, "--kernel-library", a->libraries,
        "A shared library with a kernel of yours (see barycert/kernel.h); audited alone unless --kernel is given");
    add_kernel_rules(*sub, a->rules);
    choice_option<OracleChoice>(
        *sub, "--oracle", a->oracle,
        {{"integers", OracleChoice::integers}, {"cgal", OracleChoice::cgal}, {"both", OracleChoice::both}},
        "Who says what is right: exact integers, CGAL's exact kernel (Epeck), or both, who must agree; without it "
        "integers, or barycert's core where it judges others, and CGAL confirms a sample and the hard cases");
    sub->add_option("--count", a->count, "Cases per family and simplex")
        ->capture_default_str()
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 48).description(""))
        ->type_name("N");
    sub->add_option("--seed", a->seed, "The same seed gives the same cases on every machine")
        ->capture_default_str()
        ->check(whole_number())
        ->type_name("S");
    curved_option(*sub, a->curved);
    threads_option(*sub, a->threads);
    file_option(*sub, "--json", a->json, "Write the report as JSON; - is stdout and suppresses the table");
    file_option(*sub, "--html", a->html,
                "Write the report as an HTML page with pictures, histograms and witnesses; - is stdout and suppresses "
                "the table");
    file_option(*sub, "--with", a->others,
                "Also show on that page what `./run flags --json FILE` or `./run systems --json FILE` wrote");
    file_option(*sub, "--witnesses", a->witnesses, "Write the worst cases as JSON, for `barycert replay`; - is stdout");
    file_option(*sub, "--plot", a->plot,
                "Plot the errors of the kernels over the condition numbers of the cells, as SVG; - is stdout");
    std::string names;
    for (const std::string& rule : threshold_names()) names += " " + rule;
    sub->add_option("--fail-on", a->fail_on,
                    "Exit with 1 if this figure of a kernel exceeds NUMBER (0 if omitted); may be repeated. RULE is "
                    "one of:" +
                        names)
        ->type_name("RULE[>NUMBER]")
        ->allow_extra_args(false);
    file_option(*sub, "--baseline", a->baseline,
                "Compare with the --json report of an earlier audit of the same seed, count and meshes; exit with 1 if "
                "a figure got worse");
    add_ci_options(*sub, a->ci, "broken rules and what got worse than the baseline");
    sub->add_flag("--mutants", a->mutants,
                  "Audit kernels with seeded faults instead, and show which family catches which; exit with 1 if one "
                  "is not caught");
    sub->add_flag("--wide", a->wide, "Print all counts, the families and a witness of each kernel: 160 columns");
    sub->add_flag("--no-check", a->no_check, "Do not check whether the meshes are partitions (see `barycert check`)");
    sub->add_flag("--quiet", a->quiet, "Print no table and no progress");
    sub->callback([a, sub, &exit_code] {
        const Status ok = check_mutants_alone(*sub);
        exit_code = ok ? run_audit(*a) : fail(ok.error());
    });
}

}  // namespace barycert::cli
