/// What an audit found, for the systems that run it (see ci.hpp).
///
/// An outcome fails where a rule of --fail-on is broken, or a figure is worse than the baseline's. Findings without a
/// rule against them are told and pass.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/audit_baseline.hpp"
#include "barycert/ci.hpp"

namespace barycert {

/// The outcomes of an audit. `comparison` may be null. `artifacts`: kernel to file, of kernels from libraries.
CiReport audit_outcomes(const AuditReport& report, const std::vector<Threshold>& rules,
                        const BaselineComparison* comparison, const std::map<std::string, std::string>& artifacts);

/// What got worse and better, some lines of each; what could not be compared.
std::string baseline_text(const BaselineComparison& comparison, const std::string& path);

}  // namespace barycert
