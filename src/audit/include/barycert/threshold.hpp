/// Thresholds: figures of a kernel above which an audit fails.
///
/// Example:
///
///     const AuditReport report = run_audit({.kernels = kernels_matching("*"), .families = all_families()},
///     {}).value(); const std::vector<Threshold> rules{parse_threshold("false_inside").value(), {"wrong_cases", 100}};
///     const bool failed = !violations(report, rules).empty();
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/result.hpp"

namespace barycert {

/// A kernel fails if its figure `name` exceeds `limit`.
struct Threshold {
    std::string name;
    double limit = 0;
};

/// A figure of a kernel that exceeds its threshold.
struct Violation {
    std::string kernel, figure;
    double value = 0, limit = 0;
};

/// NAME or NAME>NUMBER, NUMBER 0 by default. NAME: a class of finding, `wrong_cases` or `any` (cases with a finding),
/// an error in ulps or a residual: threshold_names(). Error sizes are taken over the cases that have one; without any,
/// because weights were not finite or the simplex was wrongly declared degenerate, they are infinite.
Result<Threshold> parse_threshold(std::string_view text);

std::vector<Violation> violations(const AuditReport& report, const std::vector<Threshold>& rules);

/// The names that parse_threshold() accepts.
std::vector<std::string> threshold_names();

}  // namespace barycert
