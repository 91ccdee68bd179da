/// Rules on triangles in space: how far a point is from a triangle, whether it is inside a closed surface, whether two
/// triangles meet.
///
/// Rules that are in use are held against CGAL's exact answers, on cases where such code is known to fail; barycert's
/// own stand among them.
///
/// Example:
///
///     const SurfaceFamily& family = surface_families().front();
///     const SurfaceCase c = make_surface_case(family, 1, 0);
///     for (const SurfaceRule& rule : surface_rules()) {
///         if (rule.question == family.question) rule.answer(c);
///     }
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/family.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"

namespace barycert {

enum class SurfaceQuestion : std::uint8_t {
    distance,  ///< of the point from the only triangle
    inside,    ///< 1 if the point is inside the closed surface, else 0; of a point on it either is right
    meet,      ///< 1 if the two triangles have a point in common, else 0
};

constexpr std::string_view name(SurfaceQuestion q) {
    constexpr std::array<std::string_view, 3> names{"distance", "inside", "meet"};
    return names[static_cast<std::size_t>(q)];
}

using TriangleInSpace = std::array<double, 9>;  ///< corner after corner

struct SurfaceCase {
    std::vector<TriangleInSpace> triangles;  ///< of non-zero area
    std::array<double, 3> point{};
};

struct SurfaceRule {
    std::string name;  ///< `question.rule`
    SurfaceQuestion question{};
    std::string formula, source, fails;  ///< one line each, as those of Kernel
    double (*answer)(const SurfaceCase&) = nullptr;
};

struct SurfaceFamily {
    std::string name;  ///< `question.family`
    SurfaceQuestion question{};
    std::string tests;                                    ///< one line
    SurfaceCase (*make)(base::Random& random) = nullptr;  ///< case i depends on (seed, family, i) alone
};

/// All, in a fixed order.
const std::vector<SurfaceRule>& surface_rules();
const std::vector<SurfaceFamily>& surface_families();

SurfaceCase make_surface_case(const SurfaceFamily& family, std::uint64_t seed, std::uint64_t index);

/// Counts of a rule's answers to the cases of a family.
struct SurfaceTally {
    std::size_t family = 0;                     ///< index into surface_families()
    std::uint64_t cases = 0, yes = 0;           ///< the exact answer is yes; of a distance: it is 0
    std::uint64_t false_yes = 0, false_no = 0;  ///< the rule says yes, and it is no; and the reverse
    std::uint64_t not_finite = 0;               ///< of a distance
    LogHistogram ulps;                          ///< errors of finite distances that are exactly not 0
    WorstCase worst;                            ///< of them
    WorstCase wrong;                            ///< the first case with one of the three; value 1

    std::uint64_t wrong_cases() const { return false_yes + false_no + not_finite; }
    void add(SurfaceQuestion question, double answer, double exact, std::uint64_t index);
    void merge(const SurfaceTally& other);
};

using SurfaceAudit = RuleAudit<SurfaceRule, SurfaceTally>;

/// Fills `results`, the same for any number of threads, which it sets.
void audit_surfaces(SurfaceAudit& audit);

}  // namespace barycert
