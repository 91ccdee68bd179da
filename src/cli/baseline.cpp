#include "baseline.hpp"

#include <map>
#include <utility>

#include "command.hpp"

namespace barycert::cli {

Result<std::optional<Baseline>> read_comparable_baseline(const std::string& path, const AuditOptions& options,
                                                         const MeshSource& meshes) {
    if (path.empty()) return std::optional<Baseline>();
    Result<Baseline> baseline = read_baseline(path);
    if (!baseline) return baseline.error();
    if (const Status ok = check_comparable(*baseline, options, meshes); !ok) return ok.error();
    return std::optional<Baseline>(std::move(*baseline));
}

Result<bool> write_audit_ci(const CiOptions& o, const AuditReport& report, const std::vector<Threshold>& rules,
                            const std::optional<Baseline>& baseline, const std::vector<Kernel>& kernels,
                            const std::vector<std::string>& libraries, std::vector<Status>& written) {
    std::optional<BaselineComparison> comparison;
    if (baseline) {
        Result<BaselineComparison> compared = compare_with_baseline(report, *baseline);
        if (!compared) return compared.error();
        comparison = std::move(*compared);
        tell(baseline_text(*comparison, baseline->path));
    }
    if (o.asked()) {
        // Libraries' kernels stand behind those of the catalogue, in their order.
        std::map<std::string, std::string> artifacts;
        for (std::size_t i = 0; i < libraries.size() && libraries.size() <= kernels.size(); ++i)
            artifacts[kernels[kernels.size() - libraries.size() + i].name] = libraries[i];
        write_ci(o, audit_outcomes(report, rules, comparison ? &*comparison : nullptr, artifacts), written);
    }
    return comparison && !comparison->worse.empty();
}

}  // namespace barycert::cli
