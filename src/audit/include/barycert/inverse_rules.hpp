/// Inverse maps: which point of the reference hexahedron, wedge, pyramid or quadrilateral is taken to a point, and the
/// value there.
///
/// Newton's method as it is in use is held against barycert's own maps, whose answers are proved
/// (CellInterpolation::multilinear); a test holds these against Newton's method in 100 digits.
///
/// Example:
///
///     const InverseCase c = make_inverse_case(inverse_families().front(), 12, 1, 0);
///     const ExactInverse exact = exact_inverse(c);
///     for (const InverseRule& rule : inverse_rules()) {
///         if (rule.type == c.type) rule.answer(c);
///     }
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "barycert/family.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"

namespace barycert {

struct InverseCase {
    std::uint8_t type = 12;  ///< VTK's number: 9 of a quadrilateral in the plane, 12 hexahedron, 13 wedge, 14 pyramid
    std::vector<double> nodes;   ///< in VTK's order, 3 coordinates a node, 2 in the plane
    std::vector<double> values;  ///< one a node
    std::vector<double> point;
};

struct InverseAnswer {
    bool found = false;         ///< else there is no answer
    bool inside = false;        ///< the point is in the cell or on its boundary
    std::array<double, 3> x{};  ///< of the reference cell, 0 to 1
    double value = 0;
};

/// The right answer. Without a proof that the map is injective the region is `degenerate`, and there is nothing else.
struct ExactInverse {
    Region region = Region::degenerate;
    /// Correctly rounded, of points in the cell; of x, of a pyramid the third alone, the others 0. NaN: not proved.
    std::array<double, 3> x{};
    double value = 0;
};

/// Requires: a type of the rules (9, 12, 13, 14), and as many numbers as its nodes and axes ask for.
ExactInverse exact_inverse(const InverseCase& c);

struct InverseRule {
    std::string name;  ///< `shape.rule`
    std::uint8_t type = 12;
    std::string formula, source, fails;  ///< one line each, as those of Kernel
    std::function<InverseAnswer(const InverseCase&)> answer = {};
};

struct InverseFamily {
    std::string name, tests;  ///< one line
    /// Sets nodes and point of a case of that type, all else zero; the map is proved to be injective.
    void (*make)(InverseCase& c, base::Random& random) = nullptr;
};

/// All, in a fixed order.
const std::vector<InverseRule>& inverse_rules();
const std::vector<InverseFamily>& inverse_families();

/// Depends on these alone. Values are random, from -1 to 1. Requires: a type of the rules (9, 12, 13, 14).
InverseCase make_inverse_case(const InverseFamily& family, std::uint8_t type, std::uint64_t seed, std::uint64_t index);

/// Counts of a rule's answers to the cases of a family.
struct InverseTally {
    std::size_t family = 0;  ///< index into inverse_families()
    std::uint64_t cases = 0;
    /// [exact region: interior, boundary, outside][inside, outside, no answer]
    std::array<std::array<std::uint64_t, 3>, 3> told{};
    LogHistogram x_ulps, value_ulps;  ///< errors of points rightly told inside, of numbers that are exactly not 0
    WorstCase x_ulp, value_ulp;
    ErrorSizes errors;  ///< of these values, relative to the range of the values at the nodes
    WorstCase wrong;    ///< the first wrong case; value 1

    /// Points of the cell told outside or without an answer; points outside told inside.
    std::uint64_t wrong_cases() const;
    void add(const InverseAnswer& answer, const ExactInverse& exact, const InverseCase& c, std::uint64_t index);
    void merge(const InverseTally& other);
};

using InverseAudit = RuleAudit<InverseRule, InverseTally>;

/// Likewise.
void audit_inverses(InverseAudit& audit);

}  // namespace barycert
