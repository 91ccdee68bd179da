#include "ci.hpp"

#include <CLI/CLI.hpp>

#include <map>
#include <utility>

#include "command.hpp"
#include "files.hpp"

namespace barycert::cli {

void add_ci_options(CLI::App& sub, CiOptions& o) {
    file_option(sub, "--baseline", o.baseline,
                "Compare with the --json report of an earlier audit of the same seed, count and meshes; exit with 1 if "
                "a figure got worse");
    file_option(sub, "--junit", o.junit, "Write rules and baseline as JUnit XML; - is stdout and suppresses the table");
    file_option(sub, "--sarif", o.sarif,
                "Write findings, broken rules and baseline as SARIF 2.1.0; - is stdout likewise");
    sub.add_flag("--annotations", o.annotations,
                 "Print broken rules and what got worse as annotations of GitHub's workflows, after the table");
}

void add_ci_files(const CiOptions& o, std::vector<base::NamedFile>& inputs, std::vector<base::NamedFile>& outputs) {
    if (!o.baseline.empty()) inputs.push_back({"--baseline", o.baseline});
    outputs.push_back({"--junit", o.junit});
    outputs.push_back({"--sarif", o.sarif});
}

Result<std::optional<Baseline>> read_ci_baseline(const CiOptions& o, const AuditOptions& options,
                                                 const MeshSource& meshes) {
    if (o.baseline.empty()) return std::optional<Baseline>();
    Result<Baseline> baseline = read_baseline(o.baseline);
    if (!baseline) return baseline.error();
    if (const Status ok = check_comparable(*baseline, options, meshes); !ok) return ok.error();
    return std::optional<Baseline>(std::move(*baseline));
}

Result<bool> write_ci(const CiOptions& o, const AuditReport& report, const std::vector<Threshold>& rules,
                      const std::optional<Baseline>& baseline, const std::vector<Kernel>& kernels,
                      const std::vector<std::string>& libraries, std::vector<Status>& written) {
    std::optional<BaselineComparison> comparison;
    if (baseline) {
        Result<BaselineComparison> compared = compare_with_baseline(report, *baseline);
        if (!compared) return compared.error();
        comparison = std::move(*compared);
        tell(baseline_text(*comparison, o.baseline));
    }
    // Libraries' kernels stand behind those of the catalogue, in their order.
    std::map<std::string, std::string> artifacts;
    for (std::size_t i = 0; i < libraries.size() && libraries.size() <= kernels.size(); ++i)
        artifacts[kernels[kernels.size() - libraries.size() + i].name] = libraries[i];
    const CiReport ci = audit_outcomes(report, rules, comparison ? &*comparison : nullptr, artifacts);
    if (!o.junit.empty()) written.push_back(write_output(o.junit, ci_junit(ci)));
    if (!o.sarif.empty()) written.push_back(write_output(o.sarif, ci_sarif(ci)));
    if (o.annotations) written.push_back(write_output("-", ci_annotations(ci)));
    return comparison && !comparison->worse.empty();
}

}  // namespace barycert::cli
