// Rules on triangles in space, compared with the oracle.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "audit/rule_loop.hpp"
#include "barycert/environment.hpp"
#include "barycert/oracle.hpp"
#include "barycert/surface_rules.hpp"
#include "core/base/ulp.hpp"

namespace barycert {

using namespace audit;

namespace {

/// The right answer; nothing where either answer is right.
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
    if (audit.rules.empty()) audit.rules = surface_rules();
    const std::vector<SurfaceFamily>& families = surface_families();
    const auto fits = [&](std::size_t f, const SurfaceRule& rule) { return rule.question == families[f].question; };
    audit_rules(audit, families, 1, fits, [&](std::size_t f, std::uint64_t i, const auto& each) {
        const SurfaceCase c = make_surface_case(families[f], audit.seed, i);
        const std::optional<double> exact = exact_answer(families[f].question, c);
        if (!exact) return;
        each(
            [&](const SurfaceRule& rule, SurfaceTally& tally) { tally.add(rule.question, rule.answer(c), *exact, i); });
    });
}

}  // namespace barycert
