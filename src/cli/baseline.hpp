/// An audit held against an earlier one: --baseline; and both as reports for continuous integration.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/result.hpp"
#include "ci.hpp"

namespace barycert::cli {

/// Before the work: the baseline, if there is one, and whether the audit will meet its cases. An empty path: none.
Result<std::optional<Baseline>> read_comparable_baseline(const std::string& path, const AuditOptions& options,
                                                         const MeshSource& meshes);

/// After it: what got worse goes to stderr, reports to their files; each write's status is added. Returns true if
/// something is worse than the baseline.
Result<bool> write_audit_ci(const CiOptions& o, const AuditReport& report, const std::vector<Threshold>& rules,
                            const std::optional<Baseline>& baseline, const std::vector<Kernel>& kernels,
                            const std::vector<std::string>& libraries, std::vector<Status>& written);

}  // namespace barycert::cli
