/// Rules that answer cases of their own, as those on surfaces do: a tally for each group of cases and rule.
#pragma once

#include <mutex>

#include "barycert/audit/asking.hpp"

namespace barycert::audit {

/// judge(group, index, tallies of the rules) for audit.count cases of each group, on audit.threads, which is set.
/// Tallies merge in any order. `name`: of a group, for the progress.
template <class Tally, class Audit, class Name, class Judge>
std::vector<std::vector<Tally>> tallies_of(Audit& audit, std::size_t groups, std::size_t rules, const Name& name,
                                           const Judge& judge) {
    constexpr std::uint64_t block = 256;  // cases that a thread takes at once
    audit.threads = base::threads_for(audit.threads);
    const auto blocks = static_cast<std::size_t>((audit.count + block - 1) / block);
    std::vector<std::vector<Tally>> tallies(groups, std::vector<Tally>(rules));
    std::mutex merging;
    std::uint64_t done = 0;
    on_threads(audit.threads, groups * blocks, [&](std::size_t work) {
        const std::size_t group = work / blocks;
        std::vector<Tally> found(rules);
        const std::uint64_t first = work % blocks * block;
        for (std::uint64_t i = first; i < std::min(first + block, audit.count); ++i) judge(group, i, found);
        const std::lock_guard lock(merging);
        for (std::size_t r = 0; r < rules; ++r) tallies[group][r].merge(found[r]);
        done += std::min(block, audit.count - first);
        if (audit.progress) audit.progress({done, groups * audit.count, name(group)});
    });
    return tallies;
}

}  // namespace barycert::audit
