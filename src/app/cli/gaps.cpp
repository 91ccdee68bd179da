// barycert gaps: which points of a mesh a kernel loses between cells, gives to several, or to a wrong one.

#include "barycert/gaps.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/audit_inputs.hpp"
#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "app/options/parser.hpp"
#include "barycert/audit_job.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/choices.hpp"
#include "core/base/text.hpp"
#include "files/named_file.hpp"

namespace barycert::cli {
namespace {

struct GapsArguments : Arguments<GapsJob> {
    KernelChoice kernels;
    std::vector<std::string> rules;
    std::vector<GapsLimit> limits;
};

std::string broken_limits(const GapsReport& report, const std::vector<GapsLimit>& limits) {
    std::string lines;
    for (const ClaimResult& r : report.results) {
        for (const GapsLimit& limit : limits) {
            const std::uint64_t count = r.total().of(limit.fault);
            if (r.kernel.empty() || static_cast<double>(count) <= limit.most) continue;
            lines += failure(fmt::format("{}, {}: {}", r.kernel, name(r.rule), name(limit.fault)),
                             std::to_string(count), base::shortest(limit.most));
        }
    }
    return lines;
}

int run_gaps(GapsArguments& a) {
    std::vector<base::NamedFile> inputs = base::named_files("the mesh", audited_files(a.job.mesh));
    for (base::NamedFile& file : library_files(a.kernels)) inputs.push_back(std::move(file));
    a.reports.check(inputs);
    a.job.options.kernels = chosen_kernels(a.kernels).value();
    std::ranges::copy_if(all_claim_rules, std::back_inserter(a.job.options.rules),
                         [&](ClaimRule rule) { return std::ranges::count(a.rules, name(rule)) != 0; });
    return a.reports.end(gaps_file(a.job, read_audited, certify_audited), [&](const GapsReport& report) {
        const std::string failures = broken_limits(report, a.limits);
        return Told{.files = {{"--json", [&] { return gaps_json(report); }}},
                    .text = [&](bool colour) { return gaps_text(report, {.colour = colour}); },
                    .notes = report.notes,
                    .curved = {report.curved},
                    .failures = failures,
                    .clean = failures.empty()};
    });
}

}  // namespace

void add_gaps(const Options& program) {
    const auto& [o, a] = program.command(
        "gaps",
        "Count points on shared faces, edges and vertices of a mesh that no cell claims, several, or a wrong one",
        "Exit codes: 0 done; 1 a limit of --fail-on is exceeded; 2 usage or input error.", run_gaps);
    GapsOptions& options = a.job.options;
    o.text("MESH", a.job.mesh, "A mesh, as for barycert sample")->required();
    o.text("--kernel", a.kernels.names, "Kernels that match, those for the cells of the mesh; may be repeated",
           "KERNEL|GLOB");
    o.text("--kernel-library", a.kernels.libraries,
           "A shared library with a kernel of yours (see barycert/kernel.h); alone unless --kernel is given");
    o.text("--rule", a.rules, "Show only this rule; may be repeated", joined(names_of(all_claim_rules)))
        ->check(one_of(names_of(all_claim_rules)));
    o.number("--class-tolerance", options.tolerance, 0,
             "Of the rule tolerant: a cell claims a point if all weights are >= -X; 1e-10 unless given", "X");
    add_containment(o, a.kernels);
    add_count(o, options.count, 40, "Points on faces, on edges and on vertices each");
    add_seed(o, options.seed, "The same seed gives the same points on every machine");
    o.curved(a.job.curved);
    o.threads(options.threads);
    a.reports.file(o, "--json", json_instead);
    o.each("--fail-on", "FAULT[>NUMBER]",
           "Exit with 1 if a kernel has more than NUMBER (0 if omitted) such points under a rule that is shown; FAULT "
           "is gaps, several, wrong, wrong_first or outside_claimed; may be repeated",
           [&limits = a.limits](const std::string& text) { limits.push_back(parse_gaps_limit(text).value()); });
    o.flag("--no-check", a.job.check, "Do not check whether the mesh is a partition (see `barycert check`)", false);
    a.reports.quiet(o, "Print no table");
}

}  // namespace barycert::cli
