/// Rules that turn a report into a verdict: `NAME` or `NAME>NUMBER`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "barycert/audit/runner.hpp"
#include "barycert/core/result.hpp"

namespace barycert::audit {

/// A kernel fails if its figure `name` exceeds `limit`.
struct Rule {
    std::string name;
    double limit = 0;
};

/// A figure of a kernel that a rule refused.
struct Violation {
    std::string kernel;
    std::string figure;
    double value = 0;
    double limit = 0;
};

/// NAME is a class of finding (counts), `wrong_cases` or `any` (cases with any finding), `worst_weight_ulp`,
/// `p999_weight_ulp`, `worst_value_ulp`, `p999_value_ulp`, `worst_partition_residual` or `worst_reproduction_residual`.
/// NUMBER is 0 if left out. Sizes of errors are taken over what could be measured; where that is nothing because
/// weights were not finite or the simplex was falsely declared degenerate, they are infinite. Pair them with `any`.
Result<Rule> parse_rule(std::string_view text);

std::vector<Violation> violations(const Report& report, const std::vector<Rule>& rules);

/// The names that parse_rule() knows, for help texts.
std::vector<std::string> rule_names();

}  // namespace barycert::audit
