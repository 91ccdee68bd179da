/// Options for continuous integration: --baseline, --junit, --sarif, --annotations.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "barycert/audit_baseline.hpp"
#include "barycert/audit_ci.hpp"
#include "barycert/base/named_file.hpp"
#include "barycert/result.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace barycert::cli {

struct CiOptions {
    std::string baseline, junit, sarif;
    bool annotations = false;

    /// True if a report takes stdout for itself.
    bool on_stdout() const { return junit == "-" || sarif == "-"; }
};

void add_ci_options(CLI::App& sub, CiOptions& o);

/// The files, for check_outputs().
void add_ci_files(const CiOptions& o, std::vector<base::NamedFile>& inputs, std::vector<base::NamedFile>& outputs);

/// Before the work: the baseline, if there is one, and whether the audit will meet its cases.
Result<std::optional<Baseline>> read_ci_baseline(const CiOptions& o, const AuditOptions& options,
                                                 const MeshSource& meshes);

/// After it: what is asked for, the annotations last, on stdout. What got worse goes to stderr. Each
/// write's status is added. Returns true if something is worse than the baseline.
Result<bool> write_ci(const CiOptions& o, const AuditReport& report, const std::vector<Threshold>& rules,
                      const std::optional<Baseline>& baseline, const std::vector<Kernel>& kernels,
                      const std::vector<std::string>& libraries, std::vector<Status>& written);

}  // namespace barycert::cli
