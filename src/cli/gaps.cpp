// barycert gaps: which points of a mesh a kernel loses between cells, gives to several, or to a wrong one.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <optional>

#include "audit_inputs.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/base/named_limit.hpp"
#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"
#include "barycert/check.hpp"
#include "barycert/io.hpp"
#include "command.hpp"
#include "files.hpp"
#include "names.hpp"
#include "options.hpp"

namespace barycert::cli {
namespace {

struct GapsArguments {
    std::string mesh, json;
    std::vector<std::string> kernels, libraries, fail_on, rule_names;
    GapsOptions options;
    Curved curved = Curved::straight;
    bool quiet = false, no_check = false;
    std::shared_ptr<KernelRules> rules = std::make_shared<KernelRules>();
};

struct GapsLimit {
    ClaimFault fault = ClaimFault::gap;
    double most = 0;
};

/// FAULT or FAULT>NUMBER.
Result<GapsLimit> parse_gaps_limit(const std::string& text) {
    const base::NamedLimit limit = base::named_limit(text);
    for (std::size_t f = 0; f < claim_fault_count; ++f) {
        const auto fault = static_cast<ClaimFault>(f);
        if (name(fault) == limit.name && limit.most) return GapsLimit{fault, *limit.most};
    }
    return Error{.what = "unknown rule",
                 .expected = "gaps, several, wrong, wrong_first or outside_claimed, perhaps >NUMBER",
                 .found = '"' + text + '"',
                 .remedy = base::did_you_mean(limit.name, claim_fault_names())};
}

Status check_gaps_files(const GapsArguments& a, bool table) {
    std::vector<base::NamedFile> inputs, outputs{{"--json", a.json}};
    for (base::NamedFile& file : base::named_files("the mesh", mesh_files(a.mesh))) inputs.push_back(std::move(file));
    for (const std::string& library : a.libraries) inputs.push_back({"--kernel-library", library});
    if (table) outputs.push_back({"the table", "-"});
    return base::check_outputs(inputs, std::move(outputs));
}

/// Kernels of the cells alone: a glob may have chosen others as well.
Result<GapsReport> gaps_of(GapsArguments& a) {
    // --class-tolerance is the tolerance of a rule here, not a rule of the kernels.
    KernelRules rules = *a.rules;
    if (rules.class_tolerance) a.options.tolerance = *rules.class_tolerance;
    rules.class_tolerance.reset();
    Result<std::vector<Kernel>> kernels = select_kernels(a.kernels, a.libraries, rules);
    if (!kernels) return kernels.error();
    a.options.kernels = std::move(*kernels);
    for (const ClaimRule rule : all_claim_rules) {
        if (std::find(a.rule_names.begin(), a.rule_names.end(), name(rule)) != a.rule_names.end())
            a.options.rules.push_back(rule);
    }
    const Result<Mesh> mesh = read_mesh(a.mesh, {.faces = false, .neighbours = false, .threads = a.options.threads});
    if (!mesh) return mesh.error();
    if (const Status ok = check_curved(*mesh, a.mesh, a.curved); !ok) return ok.error();
    if (!a.quiet) tell_important(mesh->notes);
    Verdict verdict = Verdict::not_checked;
    if (!a.no_check) {
        CheckOptions check;
        check.verdict_only = true;
        check.threads = a.options.threads;
        verdict = check_mesh(*mesh, check).certificate.verdict_on(*mesh);
    }
    return find_gaps(a.options, *mesh, a.mesh, verdict);
}

int run_gaps(GapsArguments& a) {
    std::vector<GapsLimit> limits;
    for (const std::string& text : a.fail_on) {
        const Result<GapsLimit> limit = parse_gaps_limit(text);
        if (!limit) return fail(limit.error());
        limits.push_back(*limit);
    }
    const bool table = !a.quiet && a.json != "-";
    if (const Status ok = check_gaps_files(a, table); !ok) return fail(ok.error());
    const Result<GapsReport> report = gaps_of(a);
    if (!report) return fail(report.error());
    std::vector<Status> written;
    if (!a.json.empty()) written.push_back(write_output(a.json, gaps_json(*report)));
    if (!a.quiet && !table) tell_curved(report->curved);
    if (table) {
        TerminalStyle style;
        style.colour = colour_on_stdout();
        written.push_back(write_output("-", gaps_text(*report, style)));
    }
    if (const Status ok = all_written(written); !ok) return fail(ok.error());
    bool fails = false;
    for (const ClaimResult& r : report->results) {
        for (const GapsLimit& limit : limits) {
            const std::uint64_t count = r.total().of(limit.fault);
            if (r.kernel.empty() || static_cast<double>(count) <= limit.most) continue;
            fails = true;
            tell(fmt::format("fails: {}, {}: {} = {}, limit {}\n", r.kernel, name(r.rule), name(limit.fault), count,
                             base::shortest(limit.most)));
        }
    }
    return fails ? exit_findings : exit_clean;
}

}  // namespace

void add_gaps(CLI::App& app, int& exit_code) {
    auto* sub = app.add_subcommand(
        "gaps",
        "Count points on shared faces, edges and vertices of a mesh that no cell claims, several, or a wrong one");
    sub->footer("Exit codes: 0 done; 1 a limit of --fail-on is exceeded; 2 usage or input error.");
    const auto a = std::make_shared<GapsArguments>();
    file_option(*sub, "MESH", a->mesh, "A mesh, as for barycert sample")->required();
    sub->add_option("--kernel", a->kernels, "Kernels that match, those for the cells of the mesh; may be repeated")
        ->type_name("KERNEL|GLOB")
        ->allow_extra_args(false);
    file_option(*sub, "--kernel-library", a->libraries,
                "A shared library with a kernel of yours (see barycert/kernel.h); alone unless --kernel is given");
    sub->add_option("--rule", a->rule_names, "Show only this rule; may be repeated")
        ->check(one_of(claim_rule_names()))
        ->type_name(joined(claim_rule_names()))
        ->allow_extra_args(false);
    sub->add_option("--class-tolerance", a->rules->class_tolerance,
                    "Of the rule tolerant: a cell claims a point if all weights are >= -X; 1e-10 unless given")
        ->check(finite_at_least(0))
        ->type_name("X");
    add_containment(*sub, a->rules);
    sub->add_option("--count", a->options.count, "Points on faces, on edges and on vertices each")
        ->capture_default_str()
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40).description(""))
        ->type_name("N");
    sub->add_option("--seed", a->options.seed, "The same seed gives the same points on every machine")
        ->capture_default_str()
        ->check(whole_number())
        ->type_name("S");
    curved_option(*sub, a->curved);
    threads_option(*sub, a->options.threads);
    file_option(*sub, "--json", a->json, "Write the report as JSON; - is stdout and suppresses the table");
    sub->add_option(
           "--fail-on", a->fail_on,
           "Exit with 1 if a kernel has more than NUMBER (0 if omitted) such points under a rule that is shown; "
           "FAULT is gaps, several, wrong, wrong_first or outside_claimed; may be repeated")
        ->type_name("FAULT[>NUMBER]")
        ->allow_extra_args(false);
    sub->add_flag("--no-check", a->no_check, "Do not check whether the mesh is a partition (see `barycert check`)");
    sub->add_flag("--quiet", a->quiet, "Print no table");
    sub->callback([a, &exit_code] { exit_code = run_gaps(*a); });
}

}  // namespace barycert::cli
