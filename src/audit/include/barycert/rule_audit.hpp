/// Audits of rules that answer cases of their own. A tally has what a rule answers to the cases of a family.
///
/// Example:
///
///     #include <cstdio>
///     #include "barycert/surface_rules.hpp"
///     SurfaceAudit audit{.count = 1000};
///     audit_surfaces(audit);
///     for (const auto& result : audit.results) std::printf("%s %lu\n", result.rule.name.c_str(),
///     result.total.wrong_cases());
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "barycert/audit.hpp"

namespace barycert {

template <class Rule, class Tally>
struct RuleResult {
    Rule rule;
    std::vector<Tally> families;
    Tally total;  ///< indices of cases mean nothing here
};

template <class Rule, class Tally>
struct RuleAudit {
    std::uint64_t seed = 1, count = 10000;                    ///< cases of each family, and shape
    int threads = 0;                                          ///< 0: one per core
    std::function<void(const AuditProgress&)> progress = {};  ///< called from one thread at a time
    std::vector<Rule> rules = {};                             ///< empty: all
    std::vector<RuleResult<Rule, Tally>> results = {};        ///< in the order of the rules
};

}  // namespace barycert
