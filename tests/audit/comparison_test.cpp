// One kernel's answer against the oracle's: every class of finding, one at a time.

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "audit_helpers.hpp"
#include "compared_weights.hpp"

namespace barycert::audit {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// The triangle (0,0) (4,0) (0,4): weights of (x, y) are 1 - (x + y)/4, x/4, y/4.
Case triangle(double x, double y) {
    Case c;
    c.simplex = Simplex::triangle;
    c.vertices = {0, 0, 4, 0, 0, 4};
    c.point = {x, y, 0};
    c.values = {1, 2, 4, 0};
    return c;
}

Comparison compared(const Case& c, std::array<double, 4> weights, int status = 0, bool certifies = false) {
    Kernel k = kernel_named("triangle.signed-area");
    k.certifies = certifies;
    return compare(k, c, ask_oracle(c), status, weights);
}

void expect_only(const Comparison& r, std::vector<std::pair<Finding, int>> expected) {
    std::array<int, finding_count> counts{};
    for (const auto& [f, n] : expected) counts[static_cast<std::size_t>(f)] = n;
    for (std::size_t f = 0; f < finding_count; ++f) EXPECT_EQ(r.counts[f], counts[f]) << finding_texts[f].name;
}

TEST(Comparison, CorrectlyRoundedWeightsHaveNoFinding) {
    const Comparison r = compared(triangle(1, 1), {0.5, 0.25, 0.25});
    expect_only(r, {});
    EXPECT_EQ(r.claimed, Region::interior);
    EXPECT_EQ(r.weight_ulps[0], 0);
    EXPECT_EQ(r.weight_ulps[3], -1);  // a triangle has no fourth weight
    EXPECT_EQ(r.value_ulp, 0);
}

TEST(Comparison, OppositeSignAndFalseOutside) {
    const Comparison r = compared(triangle(1, 1), {0.5, -0.25, 0.25});
    expect_only(r, {{Finding::opposite_sign, 1}, {Finding::false_outside, 1}});
    EXPECT_EQ(r.weight_error, 0.5);
}

TEST(Comparison, NoAnswerIsAnErrorBeyondAnyButOnWhatIsDegenerate) {
    Statement none;
    none.answered = false;
    Case flat = triangle(1, 1);
    flat.vertices = {0, 0, 1, 1, 2, 2};
    const Kernel kernel = kernel_named("triangle.signed-area");
    EXPECT_EQ(compare(kernel, triangle(1, 1), ask_oracle(triangle(1, 1)), none).relative_error, infinity);
    EXPECT_EQ(compare(kernel, flat, ask_oracle(flat), none).relative_error, -1);
}

int said = 0;

// A region that is none of the four is taken for the least that a kernel can say.
TEST(Comparison, RegionsThatAKernelSays) {
    Kernel k = kernel_named("triangle.signed-area");
    k.rule = RegionRule::own;
    k.classify = [](const double*, const double*, const double*) { return said; };
    const auto claimed = [&](int number) {
        said = number;
        Statement statement;
        complete(statement, k, triangle(1, 1));
        return statement.claimed;
    };
    const ExactEnvironment environment;
    for (int i = 0; i < 4; ++i) EXPECT_EQ(claimed(i), all_regions[static_cast<std::size_t>(i)]);
    for (const int i : {-1, 4, 5, 256, std::numeric_limits<int>::min()}) EXPECT_EQ(claimed(i), Region::degenerate) << i;
}

TEST(Comparison, ErrorRelativeToOneOrTheLargestWeight) {
    EXPECT_EQ(compared(triangle(1, 1), {0.5, 0.25, 0.25}).relative_error, 0);
    EXPECT_EQ(compared(triangle(1, 1), {0.5, 0.25, 0.375}).relative_error, 0.125);
    // At (64, 0) the weights are -15, 16, 0.
    EXPECT_EQ(compared(triangle(64, 0), {-15, 16, 0}).relative_error, 0);
    EXPECT_EQ(compared(triangle(64, 0), {-15, 20, 0}).relative_error, 0.25);
    EXPECT_EQ(compared(triangle(64, 0), {-15, 16, 0x1p-1070}).relative_error, 0x1p-1074);
    EXPECT_GT(compared(triangle(64, 0), {-15, 16, 5e-324}).relative_error, 0);
    EXPECT_EQ(compared(triangle(1, 1), {0.5, nan, 0.25}).relative_error, infinity);
    EXPECT_EQ(compared(triangle(1, 1), {0.5, 0.25, 0.25}, 1).relative_error, infinity);
    constexpr double max = std::numeric_limits<double>::max();
    EXPECT_EQ(compared(triangle(1, 1), {-max, max, 0.25}).relative_error, max);
    // 2^1021 and -2^1024, of which the difference is no double: 9 times the largest weight.
    EXPECT_DOUBLE_EQ(compared(triangle(0x1p1023, 0), {-0x1p1021, -max, 0}).relative_error, 9);
    Case flat = triangle(1, 1);
    flat.vertices = {0, 0, 1, 1, 2, 2};
    EXPECT_EQ(compared(flat, {0.5, 0.25, 0.25}).relative_error, -1);
}

TEST(Comparison, OppositeSignAndFalseInside) {
    const Comparison r = compared(triangle(-1, 1), {1, 0.25, 0.25});
    expect_only(r, {{Finding::opposite_sign, 1}, {Finding::false_inside, 1}});
}

TEST(Comparison, BoundaryClaimedForAnOutsidePointIsFalseInside) {
    expect_only(compared(triangle(-1, 1), {1, 0, 0.25}), {{Finding::false_zero, 1}, {Finding::false_inside, 1}});
}

TEST(Comparison, FalseZeroInTheInterior) {
    const Comparison r = compared(triangle(1, 1), {0.5, 0, 0.25});
    expect_only(r, {{Finding::false_zero, 1}});
    EXPECT_EQ(r.claimed, Region::boundary);
}

TEST(Comparison, FalseNonzeroOnAnEdge) {
    const Comparison r = compared(triangle(0, 1), {0.75, 1e-17, 0.25});
    expect_only(r, {{Finding::false_nonzero, 1}});
    EXPECT_EQ(r.weight_ulps[1], -1);  // zero has no ulp to measure by
    EXPECT_EQ(r.weight_error, 1e-17);
}

TEST(Comparison, NegativeOnAnEdgeIsFalseOutside) {
    expect_only(compared(triangle(0, 1), {0.75, -1e-17, 0.25}),
                {{Finding::false_nonzero, 1}, {Finding::false_outside, 1}});
}

TEST(Comparison, NegativeZeroIsZero) {
    expect_only(compared(triangle(0, 1), {0.75, -0.0, 0.25}), {});
}

TEST(Comparison, NotFinite) {
    const Comparison r = compared(triangle(1, 1), {nan, 0.25, infinity});
    expect_only(r, {{Finding::not_finite, 2}});
    EXPECT_EQ(r.claimed, Region::degenerate);
    EXPECT_EQ(r.weight_error, infinity);
}

TEST(Comparison, FalseDeclaration) {
    expect_only(compared(triangle(1, 1), {0.5, 0.25, 0.25}, 1), {{Finding::false_declaration, 1}});
}

TEST(Comparison, DegenerateDeclaredOrNotFiniteIsRight) {
    Case c = triangle(1, 1);
    c.vertices = {0, 0, 1, 1, 3, 3};
    expect_only(compared(c, {}, 1), {});
    expect_only(compared(c, {nan, nan, nan, 0}), {});
}

TEST(Comparison, DegenerateWeighedIsMissed) {
    Case c = triangle(1, 1);
    c.vertices = {0, 0, 1, 1, 3, 3};
    const Comparison r = compared(c, {0.5, 0.25, 0.25});
    expect_only(r, {{Finding::missed_degenerate, 1}});
    EXPECT_EQ(r.weight_ulps[0], -1);
}

TEST(Comparison, UlpsAreThoseOfTheRoundedWeight) {
    const double off = 0.25 + 3 * 0x1p-54;  // ulp(0.25) = 2^-54
    const Comparison r = compared(triangle(1, 1), {0.5, off, 0.25});
    expect_only(r, {});
    EXPECT_EQ(r.weight_ulps[1], 3);
    EXPECT_EQ(r.weight_error, 3 * 0x1p-54);
}

// A kernel that certifies is held to the last bit, and to every declaration.
TEST(Comparison, ACertificateIsFalseOneUlpOff) {
    expect_only(compared(triangle(1, 1), {0.5, 0.25, 0.25}, 0, true), {});
    expect_only(compared(triangle(1, 1), {0.5, 0.25 + 0x1p-54, 0.25}, 0, true), {{Finding::false_certificate, 1}});
    Case flat = triangle(1, 1);
    flat.vertices = {0, 0, 1, 1, 3, 3};
    expect_only(compared(flat, {}, 1, true), {});
    expect_only(compared(flat, {1, 0, 0, 0}, 0, true),
                {{Finding::missed_degenerate, 1}, {Finding::false_certificate, 1}});
}

// Weights that round to zero or infinity are right as they are, although their signs cannot be read any more.
TEST(Comparison, CorrectRoundingToZeroOrInfinityIsNoFinding) {
    Case c;
    c.simplex = Simplex::triangle;
    c.vertices = {0, 0, 0x1p1000, 0, 0, 0x1p1000};
    c.point = {0x1p-1000, 0x1p-1000, 0};
    const OracleAnswer a = ask_oracle(c);
    ASSERT_EQ(a.region, Region::interior);
    ASSERT_EQ(a.weights[1], 0);
    expect_only(compared(c, a.weights, 0, true), {});

    c.vertices = {0, 0, 0x1p-1000, 0, 0, 0x1p-1000};
    c.point = {0x1p1000, 0x1p1000, 0};
    const OracleAnswer b = ask_oracle(c);
    ASSERT_EQ(b.weights[1], infinity);
    expect_only(compared(c, b.weights, 0, true), {});
}

TEST(Comparison, TolerantRuleSaysInsideJustOutside) {
    const Case c = [] {
        Case t;
        t.vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
        t.point = {-0x1p-11, 0.25, 0.25};  // weight -2^-11 > -0.001
        return t;
    }();
    const Kernel& k = kernel_named("tetrahedron.vtk-tolerance");
    const OracleAnswer a = ask_oracle(c);
    ASSERT_EQ(a.region, Region::outside);
    const Comparison r = compare(k, c, a, 0, a.weights);
    expect_only(r, {{Finding::false_inside, 1}});
    EXPECT_EQ(r.claimed, Region::interior);
}

}  // namespace
}  // namespace barycert::audit
