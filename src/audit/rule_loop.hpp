/// Runs rules on all families of cases, on threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "audit/asking.hpp"
#include "barycert/rule_audit.hpp"
#include "core/base/workers.hpp"

namespace barycert::audit {

/// Fills audit.results, and sets audit.threads. Groups of cases are the families, once for each of `variants`, in turn.
/// fits(group, rule): it answers these cases. judge(group, index, each) makes a case and calls each(use) for use(rule,
/// tally) of these rules, unless nothing is right.
template <class Rule, class Tally, class Families, class Fits, class Judge>
void audit_rules(RuleAudit<Rule, Tally>& audit, const Families& families, std::size_t variants, const Fits& fits,
                 const Judge& judge) {
    constexpr std::uint64_t block = 256;  // cases that a thread takes at once
    audit.threads = base::threads_for(audit.threads);
    const std::vector<Rule>& rules = audit.rules;
    const std::size_t groups = variants * families.size();
    const auto blocks = static_cast<std::size_t>((audit.count + block - 1) / block);
    // Threads merge into them, in any order.
    std::vector<std::vector<Tally>> tallies(groups, std::vector<Tally>(rules.size()));
    std::mutex merging;
    std::uint64_t done = 0;
    on_threads(audit.threads, groups * blocks, [&](std::size_t work) {
        const std::size_t group = work / blocks;
        std::vector<Tally> found(rules.size());
        const auto each = [&](const auto& use) {
            for (std::size_t r = 0; r < rules.size(); ++r) {
                if (fits(group, rules[r])) use(rules[r], found[r]);
            }
        };
        const std::uint64_t first = work % blocks * block;
        for (std::uint64_t i = first; i < std::min(first + block, audit.count); ++i) judge(group, i, each);
        const std::lock_guard lock(merging);
        for (std::size_t r = 0; r < rules.size(); ++r) tallies[group][r].merge(found[r]);
        done += std::min(block, audit.count - first);
        if (audit.progress) audit.progress({done, groups * audit.count, families[group % families.size()].name});
    });
    audit.results.clear();
    for (std::size_t r = 0; r < rules.size(); ++r) {
        RuleResult<Rule, Tally>& result = audit.results.emplace_back();
        result.rule = rules[r];
        for (std::size_t group = 0; group < groups; ++group) {
            if (!fits(group, rules[r])) continue;
            tallies[group][r].family = group % families.size();
            result.total.merge(tallies[group][r]);
            result.families.push_back(tallies[group][r]);
        }
    }
}

}  // namespace barycert::audit
