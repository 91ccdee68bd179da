// The rules on triangles in space, held against the oracle.

#include <cmath>
#include <mutex>

#include "barycert/audit/asking.hpp"
#include "barycert/base/ulp.hpp"

namespace barycert {

namespace {

constexpr std::uint64_t block = 256;  ///< cases that a thread takes at once

/// What is right; nothing where either answer is.
std::optional<double> exact_answer(SurfaceQuestion question, const SurfaceCase& c) {
    if (question == SurfaceQuestion::distance) return oracle_distance(c.triangles[0], c.point.data());
    if (question == SurfaceQuestion::meet) return oracle_meet(c.triangles[0], c.triangles[1]);
    const int side = oracle_side(c.triangles, c.point.data());
    return side == 0 ? std::nullopt : std::optional<double>(side > 0);
}

}  // namespace

void SurfaceTally::add(SurfaceQuestion question, double answer, double exact, std::uint64_t index) {
    const ExactEnvironment environment;
    const bool is_distance = question == SurfaceQuestion::distance;
    const bool is_yes = is_distance ? exact == 0 : exact != 0, says_yes = is_distance ? answer == 0 : answer != 0;
    const std::uint64_t before = wrong_cases();
    ++cases;
    yes += is_yes;
    if (std::isfinite(answer)) {
        false_yes += says_yes && !is_yes;
        false_no += !says_yes && is_yes;
    } else {
        ++not_finite;
    }
    if (is_distance && !is_yes && std::isfinite(answer)) {
        const double error = base::ulp_error_here(answer, exact);
        ulps.add(error);
        worst.include(error, index);
    }
    if (wrong_cases() != before) wrong.include(1, index);
}

void SurfaceTally::merge(const SurfaceTally& other) {
    using S = SurfaceTally;
    for (const auto count : {&S::cases, &S::yes, &S::false_yes, &S::false_no, &S::not_finite})
        this->*count += other.*count;
    ulps.merge(other.ulps);
    worst.include(other.worst.value, other.worst.index);
    wrong.include(other.wrong.value, other.wrong.index);
}

void audit_surfaces(SurfaceAudit& audit) {
    const ExactEnvironment environment;
    audit.threads = base::threads_for(audit.threads);
    const std::vector<SurfaceRule>& rules = surface_rules();
    const std::vector<SurfaceFamily>& families = surface_families();
    const std::size_t blocks = static_cast<std::size_t>((audit.count + block - 1) / block);
    // A tally for each family and rule of its question; threads merge into them, in any order.
    std::vector<std::vector<SurfaceTally>> tallies(families.size(), std::vector<SurfaceTally>(rules.size()));
    std::mutex merging;
    std::uint64_t done = 0;
    audit::on_threads(audit.threads, families.size() * blocks, [&](std::size_t work) {
        const std::size_t f = work / blocks;
        const SurfaceFamily& family = families[f];
        std::vector<SurfaceTally> found(rules.size());
        const std::uint64_t first = work % blocks * block;
        for (std::uint64_t i = first; i < std::min(first + block, audit.count); ++i) {
            const SurfaceCase c = make_surface_case(family, audit.seed, i);
            const std::optional<double> exact = exact_answer(family.question, c);
            if (!exact) continue;
            for (std::size_t r = 0; r < rules.size(); ++r) {
                if (rules[r].question == family.question) found[r].add(family.question, rules[r].answer(c), *exact, i);
            }
        }
        const std::lock_guard lock(merging);
        for (std::size_t r = 0; r < rules.size(); ++r) tallies[f][r].merge(found[r]);
        done += std::min(block, audit.count - first);
        if (audit.progress) audit.progress({done, families.size() * audit.count, family.name});
    });
    audit.results.clear();
    for (std::size_t r = 0; r < rules.size(); ++r) {
        SurfaceResult& result = audit.results.emplace_back(SurfaceResult{rules[r], {}, {}});
        for (std::size_t f = 0; f < families.size(); ++f) {
            if (families[f].question != rules[r].question) continue;
            tallies[f][r].family = f;
            result.total.merge(tallies[f][r]);
            result.families.push_back(tallies[f][r]);
        }
    }
}

}  // namespace barycert
