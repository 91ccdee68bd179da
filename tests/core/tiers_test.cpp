// Which tier answers: each test names the one that must.
#include "barycert/simplex.hpp"

#include "barycert/predicates.hpp"
#include "barycert/weights.hpp"
#include "tests/audit/exact/cases.hpp"
#include "tests/core/environments.hpp"
#include "tests/core/rational.hpp"

namespace barycert {
namespace {

using testing_cases::describe;
using testing_cases::Kind;
using testing_cases::random_case;
using testing_environments::Columns;

Tier sign_tier(const Case& c) {
    TierCounts tiers;
    weight_signs(c.simplex, c.vertices.data(), c.point.data(), &tiers);
    EXPECT_EQ(tiers.cases(), 1U);
    EXPECT_EQ(tiers.double_double, 0U);  // signs have no middle tier
    return tiers.filter != 0 ? Tier::filter : Tier::exact;
}
Tier weight_tier(const Case& c) {
    return barycentric_weights(c.simplex, c.vertices.data(), c.point.data()).value().tier;
}
Tier value_tier(const Case& c) {
    return interpolate(c.simplex, c.vertices.data(), c.point.data(), c.values.data()).value().tier;
}

/// A cell of round shape with the point inside, no coordinate a round number.
Case easy(Simplex s) {
    Case c{.simplex = s,
           .vertices = {.013, .021, .034, 1.1, .077, .053, .19, 1.3, .081, .23, .17, 1.7},
           .point = {.31, .37, .29},
           .values = {1.1, 2.3, 3.7, 4.9}};
    if (s == Simplex::triangle) c.vertices = {.013, .021, 1.1, .077, .19, 1.3};
    return c;
}

TEST(TierCounts, EasyCasesNeedTheCheapestAlone) {
    for (const Simplex s : all_simplices) {
        EXPECT_EQ(sign_tier(easy(s)), Tier::filter) << name(s);
        EXPECT_EQ(weight_tier(easy(s)), Tier::double_double) << name(s);
        EXPECT_EQ(value_tier(easy(s)), Tier::double_double) << name(s);
    }
}

// No floating-point bound can tell that a number is zero.
TEST(TierCounts, ExactZerosNeedIntegers) {
    for (const Simplex s : all_simplices) {
        Case c = easy(s);
        for (int k = 0; k < space_dimension(s); ++k) c.point[static_cast<std::size_t>(k)] = c.vertex(0, k);
        EXPECT_EQ(sign_tier(c), Tier::exact) << name(s);
        EXPECT_EQ(weight_tier(c), Tier::exact) << name(s);
        c = easy(s);
        for (int k = 0; k < space_dimension(s); ++k) c.vertex(1, k) = c.vertex(0, k);
        if (vertex_count(s) > 2) {
            for (int k = 0; k < space_dimension(s); ++k) c.vertex(2, k) = c.vertex(0, k);
        }
        EXPECT_EQ(sign_tier(c), Tier::exact) << name(s);  // degenerate
        EXPECT_EQ(weight_tier(c), Tier::exact) << name(s);
        EXPECT_EQ(value_tier(c), Tier::exact) << name(s);
    }
}

// One ulp beside a zero, 2^-53 against a bound of some 2^-52 times the extents: not provable in double. The weight it
// gives is a quotient of few bits; that the middle tier may give up on it is of no promise.
TEST(TierCounts, SignsNextToZeroNeedIntegers) {
    for (const Simplex s : all_simplices) {
        Case c = easy(s);
        for (int k = 0; k < space_dimension(s); ++k) c.point[static_cast<std::size_t>(k)] = c.vertex(0, k);
        c.point[0] = std::nextafter(c.point[0], 1);
        EXPECT_EQ(sign_tier(c), Tier::exact) << name(s);
    }
}

// At a tie both neighbours are equally near: an interval about it never rounds to one double.
TEST(TierCounts, TiesNeedIntegers) {
    for (const Simplex s : all_simplices) {
        Case c = easy(s);
        for (int k = 0; k < space_dimension(s); ++k) {
            c.vertex(0, k) = k + 1;
            c.vertex(1, k) = 2 * k + 6;
            c.point[static_cast<std::size_t>(k)] = (3 * k + 7) * 0.5;
        }
        c.values = {1, 1 + 0x1p-52, 3, 4};
        EXPECT_EQ(value_tier(c), Tier::exact) << name(s);
    }
}

TEST(TierCounts, ExtentsOutOfRangeNeedIntegers) {
    for (const Simplex s : all_simplices) {
        for (const int shift : {-1000, -700, 700, 1000}) {
            Case c = easy(s);
            for (double& x : c.vertices) x = std::ldexp(x, shift);
            for (double& x : c.point) x = std::ldexp(x, shift);
            EXPECT_EQ(sign_tier(c), Tier::exact) << name(s) << shift;
            EXPECT_EQ(weight_tier(c), Tier::exact) << name(s) << shift;
            EXPECT_EQ(value_tier(c), Tier::exact) << name(s) << shift;
        }
        Case c = easy(s);
        c.values[1] = 1e300;  // beyond 2^900
        EXPECT_EQ(value_tier(c), Tier::exact) << name(s);
        c.values = {1e-300, 1e-300, 1e-300, 1e-300};  // below 2^-800
        EXPECT_EQ(value_tier(c), Tier::exact) << name(s);
    }
}

// Flatter than 2^-36 of its extents: beyond what the middle tier has a proof for.
TEST(TierCounts, SliversNeedIntegers) {
    Case t{.simplex = Simplex::triangle,
           .vertices = {.1, .1, 1.3, 1.3, .7, .7 + 0x1p-45},
           .point = {.7, .71},
           .values = {1, 2, 3}};
    EXPECT_EQ(weight_tier(t), Tier::exact);
    EXPECT_EQ(value_tier(t), Tier::exact);
    t.vertex(2, 1) = .9;
    EXPECT_EQ(weight_tier(t), Tier::double_double);
    EXPECT_EQ(value_tier(t), Tier::double_double);
    Case c{.simplex = Simplex::tetrahedron,
           .vertices = {.1, .2, .3, 1.3, .4, 1.7, .3, 1.9, 2.2, .7, .6, 1.3 + 0x1p-45},
           .point = {.5, .5, 1.5},
           .values = {1, 2, 3, 4}};  // all but flat in z = x + y
    EXPECT_EQ(weight_tier(c), Tier::exact);
    EXPECT_EQ(value_tier(c), Tier::exact);
    c.vertex(3, 2) = 3;
    EXPECT_EQ(weight_tier(c), Tier::double_double);
}

struct Counts {
    TierCounts signs, weights, values;
};

Counts count(Simplex s, const std::vector<Case>& cases) {
    const Columns columns(s, cases);
    Counts counts;
    std::vector<WeightSigns> signs(cases.size());
    std::vector<double> w(cases.size() * static_cast<std::size_t>(vertex_count(s))), v(cases.size());
    EXPECT_TRUE(weight_signs(columns.arrays(), signs, &counts.signs));
    EXPECT_TRUE(barycentric_weights(columns.arrays(), w, &counts.weights));
    EXPECT_TRUE(interpolate(columns.arrays(), columns.values(), v, &counts.values));
    return counts;
}

// Good cells: vertices jittered by a tenth of an edge, points within. A value's error bound is about
// 4 (100 k + 50) u b + 4 * 172 u^2 (1 + L) B(V)/|d|, at most some 2^14 u^2 here (k <= 4, b and the rest below 10); it
// straddles a tie between doubles with a chance of 2 * 2^14 u^2 / u, 2^-38 a case: none of 20000 should fail. Asked is
// what users rely on, 99.9 %, all the same.
TEST(TierCounts, NearlyAllValuesOfGoodCellsComeFromDoubleDouble) {
    for (const Simplex s : all_simplices) {
        constexpr std::uint64_t total = 20000;
        std::vector<Case> cases;
        for (std::uint64_t k = 0; k < total; ++k) {
            base::Random r = base::Random::stream(8, base::hash64("good"), k);
            Case c = easy(s);
            for (double& x : c.vertices) x += r.uniform(-0.1, 0.1);
            for (double& x : c.point) x += r.uniform(-0.1, 0.1);
            for (double& x : c.values) x = r.uniform(-1, 1);
            cases.push_back(c);
        }
        const Counts counts = count(s, cases);
        EXPECT_EQ(counts.signs.cases(), total);
        EXPECT_EQ(counts.weights.cases(), total);
        EXPECT_EQ(counts.values.cases(), total);
        EXPECT_EQ(counts.values.filter + counts.weights.filter, 0U);
        EXPECT_GE(counts.signs.filter, 999 * total / 1000) << name(s);
        EXPECT_GE(counts.weights.double_double, 999 * total / 1000) << name(s);
        EXPECT_GE(counts.values.double_double, 999 * total / 1000) << name(s);
        EXPECT_EQ(counts.values.degenerate + counts.weights.degenerate + counts.signs.degenerate, 0U);
        RecordProperty(std::string(name(s)) + "_exact_values", static_cast<int>(counts.values.exact));
    }
}

TEST(TierCounts, DegenerateAndNotFiniteAreCountedWithinTheCases) {
    for (const Simplex s : all_simplices) {
        std::vector<Case> cases(40, easy(s));
        for (const std::size_t j : {3U, 17U, 39U}) cases[j].vertices.fill(0.3);
        for (const std::size_t j : {4U, 20U}) cases[j].values[1] = HUGE_VAL;
        const Counts counts = count(s, cases);
        EXPECT_EQ(counts.signs, (TierCounts{.filter = 37, .exact = 3, .degenerate = 3}));
        EXPECT_EQ(counts.weights, (TierCounts{.double_double = 37, .exact = 3, .degenerate = 3}));
        EXPECT_EQ(counts.values, (TierCounts{.double_double = 35, .exact = 5, .degenerate = 3, .not_finite = 2}));
    }
}

TEST(TierCounts, SumsAndNames) {
    TierCounts a{1, 2, 3, 4, 5};
    a.add(Tier::filter);
    a.add(Tier::double_double, 10);
    a.add(Tier::exact, 100);
    EXPECT_EQ(a, (TierCounts{2, 12, 103, 4, 5}));
    a.add(TierCounts{1, 2, 3, 4, 5});
    EXPECT_EQ(a, (TierCounts{3, 14, 106, 8, 10}));
    EXPECT_EQ(a.cases(), 123U);
    EXPECT_EQ(name(Tier::filter), "filter");
    EXPECT_EQ(name(Tier::double_double), "double-double");
    EXPECT_EQ(name(Tier::exact), "exact");
}

}  // namespace
}  // namespace barycert
