// The worst-case search: what it must find, that it repeats, that it ends, that plain witnesses show what they say.

#include "barycert/audit_search.hpp"
#include "barycert/gaps.hpp"
#include "barycert/mutants.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "audit/search/moves.hpp"
#include "core/base/ulp.hpp"
#include "tests/audit/audit_helpers.hpp"

namespace barycert::audit {
namespace {

SearchReport searched(const Kernel& kernel, std::uint64_t steps, std::uint64_t seed = 1, int threads = 2) {
    SearchOptions o;
    o.kernel = kernel;
    o.steps = steps;
    o.seed = seed;
    o.threads = threads;
    return search_worst_case(o).value();
}

SearchReport searched(const std::string& kernel, std::uint64_t steps, std::uint64_t seed = 1, int threads = 2) {
    return searched(kernel_named(kernel), steps, seed, threads);
}

const SearchFind* find_named(const SearchReport& r, const std::string& reason) {
    for (const SearchFind& f : r.finds) {
        if (f.reason == reason) return &f;
    }
    return nullptr;
}

bool same_case(const Case& a, const Case& b) {
    return a.vertices == b.vertices && a.point == b.point && a.values == b.values;
}

TEST(Search, SameSeedAndStepsFindTheSameOnAnyNumberOfThreads) {
    const SearchReport one = searched("tetrahedron.signed-volume", 60000, 5, 1);
    const SearchReport two = searched("tetrahedron.signed-volume", 60000, 5, 3);
    EXPECT_EQ(one.steps, 60000U);
    EXPECT_FALSE(one.stopped);
    ASSERT_EQ(one.finds.size(), two.finds.size());
    EXPECT_EQ(one.wrong_cases, two.wrong_cases);
    EXPECT_EQ(one.plain_steps, two.plain_steps);
    for (std::size_t i = 0; i < one.finds.size(); ++i) {
        EXPECT_EQ(one.finds[i].reason, two.finds[i].reason);
        EXPECT_EQ(one.finds[i].cases, two.finds[i].cases);
        EXPECT_TRUE(same_case(one.finds[i].found.c, two.finds[i].found.c)) << one.finds[i].reason;
        EXPECT_TRUE(same_case(one.finds[i].plain.c, two.finds[i].plain.c)) << one.finds[i].reason;
    }
    const SearchReport other = searched("tetrahedron.signed-volume", 60000, 6, 2);
    EXPECT_NE(one.wrong_cases, other.wrong_cases);
}

// The families are where it starts: it must not end below them, and it goes beyond them.
TEST(Search, GoesBeyondTheFamilies) {
    const SearchReport r = searched("triangle.relative-to-point", 200000);
    std::vector<Family> families;
    for (const Family& f : all_families()) {
        if (!f.needs_mesh && !f.perspective) families.push_back(f);
    }
    const KernelStatistics s =
        audit_of({kernel_named("triangle.relative-to-point")}, families, 200).kernels.at(0).total;
    const SearchFind* const ulps = find_named(r, "worst_weight_ulp");
    ASSERT_NE(ulps, nullptr);
    EXPECT_GT(ulps->weight_ulp, s.weight_ulp.value);
    for (const Finding f : {Finding::opposite_sign, Finding::false_zero, Finding::false_nonzero, Finding::false_inside,
                            Finding::false_outside, Finding::missed_degenerate})
        EXPECT_NE(find_named(r, std::string(name(f))), nullptr) << name(f);
}

TEST(Search, FindsNothingWrongWithExactKernels) {
    for (const char* kernel :
         {"segment.exact", "triangle.exact", "triangle3d.exact", "tetrahedron.exact", "triangle.perspective-exact"}) {
        const SearchReport r = searched(kernel, 40000);
        EXPECT_EQ(r.wrong_cases, 0U) << kernel;
        EXPECT_TRUE(r.finds.empty()) << kernel << ": " << (r.finds.empty() ? "" : r.finds[0].reason);
        EXPECT_EQ(r.steps, 40000U);
    }
}

/// Right but where a weight is within 2^-400 of zero and not zero.
int wrong_next_to_zero(const double* v, const double* p, double* w) {
    const int status = kernel_named("triangle.exact").weights(v, p, w);
    for (int i = 0; i < 3; ++i) {
        if (w[i] != 0 && std::fabs(w[i]) < 0x1p-400) w[i] = -w[i];
    }
    return status;
}

// Guided by the zeros of weights it finds what chance does not.
TEST(Search, FindsAFaultBesideTheZeroSet) {
    Kernel k = kernel_named("triangle.exact");
    k.name = "triangle.wrong-next-to-zero";
    k.weights = wrong_next_to_zero;
    k.certifies = false;
    k.interpolate = nullptr;
    const SearchReport r = searched(k, 100000);
    EXPECT_NE(find_named(r, "opposite_sign"), nullptr);
}

TEST(Search, KeepsToTheExponentsGiven) {
    SearchOptions o;
    o.kernel = kernel_named("tetrahedron.cramer");
    o.steps = 60000;
    o.min_exponent = -3;
    o.max_exponent = 2;
    const SearchReport r = search_worst_case(o).value();
    ASSERT_FALSE(r.finds.empty());
    for (const SearchFind& f : r.finds) {
        EXPECT_TRUE(admissible(f.found.c, {-3, 2})) << f.reason;
        EXPECT_TRUE(admissible(f.plain.c, {-3, 2})) << f.reason;
    }
    // Nothing under- or overflows there: what is wrong is cancellation alone.
    EXPECT_EQ(find_named(r, "not_finite"), nullptr);
    EXPECT_NE(find_named(r, "opposite_sign"), nullptr);
}

TEST(Search, WitnessesShowWhatTheySay) {
    for (const char* kernel : {"tetrahedron.signed-volume", "triangle.signed-area", "segment.projection",
                               "triangle3d.gram", "triangle.perspective-varying", "tetrahedron.vtk-tolerance"}) {
        const SearchReport r = searched(kernel, 30000);
        ASSERT_FALSE(r.finds.empty()) << kernel;
        for (const SearchFind& f : r.finds) {
            EXPECT_EQ(replay_witness(f.found, catalogue()).not_reproduced, "") << kernel << " " << f.reason;
            EXPECT_EQ(replay_witness(f.plain, catalogue()).not_reproduced, "") << kernel << " " << f.reason;
            int bits = 0;
            for (int k = 0; k < coordinate_count(f.found.c); ++k) bits += significant_bits(coordinate(f.found.c, k));
            EXPECT_LE(f.plain_bits, bits) << kernel << " " << f.reason;
        }
        const SearchFind* const ulps = find_named(r, "worst_weight_ulp");
        ASSERT_NE(ulps, nullptr);
        EXPECT_GE(ulps->plain_weight_ulp, ulps->weight_ulp / 1024);
    }
}

TEST(Search, PlainWitnessesAreFewBits) {
    // A point on an edge of tenths: the fault needs no more than a few bits.
    const SearchReport r = searched("triangle.signed-area", 100000);
    const SearchFind* const inside = find_named(r, "false_inside");
    ASSERT_NE(inside, nullptr);
    EXPECT_LT(inside->plain_bits, 150);  // of 8 numbers of 53 each
}

TEST(Search, AWitnessWithoutItsReasonComesBackAsItIs) {
    Witness w;
    w.kernel = "triangle.signed-area";
    w.reason = "false_inside";
    w.c.simplex = Simplex::triangle;
    w.c.vertices = {0.1, 0.2, 1.3, 0.4, 0.5, 1.6};
    w.c.point = {0.6, 0.7, 0};
    EXPECT_TRUE(same_case(plainest_witness(kernel_named(w.kernel), w).c, w.c));
    w.reason = "no such reason";
    EXPECT_TRUE(same_case(plainest_witness(kernel_named(w.kernel), w).c, w.c));
}

TEST(Search, EndsWhenToldTo) {
    SearchOptions o;
    o.kernel = kernel_named("triangle.signed-area");
    o.steps = std::uint64_t{1} << 40;
    int calls = 0;
    o.progress = [&](const SearchProgress& p) {
        EXPECT_EQ(p.steps_total, o.steps);
        return ++calls < 3;
    };
    const SearchReport told = search_worst_case(o).value();
    EXPECT_TRUE(told.stopped);
    EXPECT_EQ(calls, 3);
    EXPECT_FALSE(told.finds.empty());
    o.progress = {};
    o.seconds = 0.05;
    const SearchReport timed = search_worst_case(o).value();
    EXPECT_TRUE(timed.stopped);
    EXPECT_GT(timed.steps, 0U);
}

TEST(Search, FewStepsAreExactlyThose) {
    for (const std::uint64_t steps : {1U, 7U, 100U, 1001U})
        EXPECT_EQ(searched("triangle.bilinear", steps).steps, steps);
}

TEST(Search, RefusesWhatItCannotDo) {
    SearchOptions o;
    EXPECT_FALSE(search_worst_case(o));
    o.kernel = kernel_named("triangle.bilinear");
    o.steps = 0;
    EXPECT_FALSE(search_worst_case(o));
    o.steps = 1;
    o.min_exponent = 3;
    o.max_exponent = 2;
    EXPECT_FALSE(search_worst_case(o));
    o.min_exponent = -1075;
    EXPECT_FALSE(search_worst_case(o));
}

// From ordinary cells and points, where no weight is near zero.
TEST(Search, SecantsLeadToZerosOfWeightsAndOfCells) {
    const Kernel& kernel = kernel_named("tetrahedron.signed-volume");
    const Evaluation* last = nullptr;
    Evaluation answer;
    int asked = 0;
    const Ask ask = [&](const Case& c) {
        ++asked;
        answer = evaluate(kernel, c);
        return last = &answer;
    };
    int near = 0, flat = 0;
    constexpr int tries = 100;
    for (std::uint64_t i = 0; i < tries; ++i) {
        const Case c = make_case(family_named("random.inside"), Simplex::tetrahedron, 1, i, {});
        const Evaluation at = evaluate(kernel, c);
        const std::size_t weight = i % 4;
        Case on_face = c;
        const int of_point = vertex_numbers(c) + static_cast<int>(i % 3);
        to_zero(on_face, at, {weight, false, of_point}, first_step(c, of_point), {}, ask);
        if (std::fabs(evaluate(kernel, on_face).exact.weights[weight]) < 0x1p-45) ++near;
        Case cell = c;
        const int of_vertex = 3 * static_cast<int>(weight) + static_cast<int>(i % 3);
        to_zero(cell, at, {weight, true, of_vertex}, first_step(c, of_vertex), {}, ask);
        const Evaluation e = evaluate(kernel, cell);
        if (e.exact.region == Region::degenerate || std::fabs(e.exact.weights[weight]) > 0x1p45) ++flat;
    }
    EXPECT_GT(near, tries * 9 / 10);
    EXPECT_GT(flat, tries * 9 / 10);
    EXPECT_LE(asked, 8 * tries);  // determinants are linear: a secant or two
    EXPECT_NE(last, nullptr);
}

RC_GTEST_PROP(Coordinates, PlacesAreOrderedAndRoundTrip, ()) {
    const auto bits = *rc::gen::arbitrary<std::uint64_t>();
    const double x = std::bit_cast<double>(bits);
    RC_PRE(std::isfinite(x));
    const auto n = *rc::gen::inRange<std::int64_t>(-5000, 5000);
    const double y = base::places_above(x, n);
    RC_ASSERT((n > 0) == (y > x));
    RC_ASSERT((n < 0) == (y < x));
    if (std::isfinite(y)) {
        RC_ASSERT(base::places_above(y, -n) == x);
    }
    RC_ASSERT(base::places_above(x, 1) == std::nextafter(x, HUGE_VAL));
}

TEST(Coordinates, SignificantBits) {
    EXPECT_EQ(significant_bits(0), 0);
    EXPECT_EQ(significant_bits(-0x1p-1074), 1);
    EXPECT_EQ(significant_bits(0x1p1023), 1);
    EXPECT_EQ(significant_bits(10), 3);
    EXPECT_EQ(significant_bits(0.1), 52);
    EXPECT_EQ(significant_bits(0x1.fffffffffffffp+3), 53);
    EXPECT_EQ(rounded_to(0x1.8p0, 1), 2);
    EXPECT_EQ(rounded_to(0x1.3p0, 1), 1);
    EXPECT_EQ(rounded_to(-0x1.3p0, 2, 1), -0.5);  // -1, plus a unit of the second bit
}

}  // namespace
}  // namespace barycert::audit
