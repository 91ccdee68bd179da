// Perspective-correct weights, depths and values against ray casting in rationals: rounded once, whatever the numbers.
#include "barycert/perspective.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <optional>

#include "barycert/environment.hpp"
#include "core/exact_tier.hpp"
#include "tests/audit/exact/cases.hpp"
#include "tests/audit/exact/second_path.hpp"
#include "tests/core/field_cases.hpp"
#include "tests/core/rational.hpp"

namespace barycert {
namespace {

using testing_cases::all_kinds;
using testing_cases::describe;
using testing_cases::Kind;
using testing_cases::random_perspective_case;
using testing_rational::infinity;
using testing_rational::nearest;
using testing_rational::Q;

/// All three answers to a case, held against ray casting. Returns whether there are weights.
bool check(const Case& c) {
    SCOPED_TRACE(describe(c));
    const double* const v = c.vertices.data();
    const auto w = perspective_weights(v, c.point.data());
    const auto z = perspective_depth(v, c.point.data());
    const auto f = perspective_value(v, c.point.data(), c.values.data());
    EXPECT_TRUE(w && z && f);
    const auto exact = second_path::cast_ray(c);
    EXPECT_EQ(w->degenerate, !exact);
    EXPECT_EQ(z->degenerate, !exact);
    EXPECT_EQ(f->degenerate, !exact);
    if (!exact) {
        for (const double x : w->weights) EXPECT_TRUE(std::isnan(x));
        EXPECT_TRUE(std::isnan(z->value) && std::isnan(f->value));
        return false;
    }
    // The last tier by itself: mostly it is not asked.
    double weights[3], depth[1], values[1];
    using core::PerspectiveAnswer, core::exact_perspective;
    EXPECT_TRUE(exact_perspective(PerspectiveAnswer::weights, v, c.point.data(), nullptr, 1, weights));
    EXPECT_TRUE(exact_perspective(PerspectiveAnswer::depth, v, c.point.data(), nullptr, 1, depth));
    EXPECT_TRUE(exact_perspective(PerspectiveAnswer::values, v, c.point.data(), c.values.data(), 1, values));
    EXPECT_EQ(testing_cases::bits(depth[0]), testing_cases::bits(z->value));
    EXPECT_EQ(testing_cases::bits(values[0]), testing_cases::bits(f->value));
    Q value(0);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(testing_cases::bits(weights[i]), testing_cases::bits(w->weights[i]));
        EXPECT_TRUE(nearest(w->weights[i], (*exact)[i]));
        value += (*exact)[i] * Q(c.values[i]);
    }
    EXPECT_TRUE(nearest(z->value, (*exact)[3]));
    EXPECT_TRUE(nearest(f->value, value));
    return true;
}

TEST(Perspective, AnswersAreExactAndRoundedOnce) {
    for (const Kind kind : all_kinds) {
        int proper = 0;
        const std::uint64_t count = kind == Kind::bit_patterns ? 300 : 1500;
        for (std::uint64_t k = 0; k < count; ++k) {
            base::Random r = base::Random::stream(11, base::hash64(testing_cases::name(kind)), k);
            proper += check(random_perspective_case(r, kind)) ? 1 : 0;
            ASSERT_FALSE(HasFailure()) << testing_cases::name(kind) << ' ' << k;
        }
        EXPECT_GT(proper, 100) << testing_cases::name(kind);
    }
}

// Each width of integers to its last bit: 61 and 125 bits fit one and two limbs, one more does not.
TEST(Perspective, WidthsOfIntegersHoldToTheirEnds) {
    for (const int coordinate_bits : {60, 61, 62, 63, 64, 124, 125, 126, 127, 128}) {
        for (const int depth_bits : {1, 60, 61, 62, 63, 64, 125, 126, 127, 128}) {
            for (const int value_bits : {53, 61, 62, 63, 64, 130}) {
                for (std::uint64_t k = 0; k < 8; ++k) {
                    base::Random r = base::Random::stream(11, base::hash64("widths"), k);
                    const Case plain =
                        testing_fields::case_of_widths(r, Simplex::triangle, coordinate_bits, value_bits);
                    Case c = plain;
                    c.perspective = true;
                    for (int i = 0; i < 3; ++i) {
                        for (int axis = 0; axis < 2; ++axis) c.vertex(i, axis) = plain.vertex(i, axis);
                        c.depth(i) = std::max(1.0, std::fabs(testing_fields::of_width(r, depth_bits)));
                    }
                    c.depth(r.integer(0, 2)) = 1;
                    check(c);
                    ASSERT_FALSE(HasFailure()) << coordinate_bits << ' ' << depth_bits << ' ' << value_bits;
                }
            }
        }
    }
}

// The ends of the range all at once: numbers of 2098 bits in every place.
TEST(Perspective, EndsOfTheRange) {
    const double max = std::numeric_limits<double>::max(), tiny = 0x1p-1074;
    Case c{.simplex = Simplex::triangle};
    c.perspective = true;
    c.vertices = {-max, tiny, tiny, max, -max, max, tiny, max, 1};
    c.point = {tiny, 3 * tiny, 0};
    c.values = {-max, tiny, max, 0};
    EXPECT_TRUE(check(c));
    c.point = {max, -tiny, 0};
    EXPECT_TRUE(check(c));
    c.vertices = {0, 0, tiny, 1, 0, max, 0, 1, tiny};
    c.point = {1, 0, 0};
    EXPECT_TRUE(check(c));
    c.point = {0.5, 0.25, 0};
    EXPECT_TRUE(check(c));
}

Case unit_case() {
    Case c{.simplex = Simplex::triangle};
    c.perspective = true;
    c.vertices = {0, 0, 1, 8, 0, 3, 0, 8, 2};
    c.point = {4, 0, 0};
    c.values = {0, 1, 5, 0};
    return c;
}

TEST(Perspective, ByHand) {
    const Case c = unit_case();
    const auto w = perspective_weights(c.vertices.data(), c.point.data());
    EXPECT_EQ(w->weights, (std::array{0.75, 0.25, 0.0}));
    EXPECT_FALSE(std::signbit(w->weights[2]));
    EXPECT_EQ(perspective_depth(c.vertices.data(), c.point.data())->value, 1.5);
    EXPECT_EQ(perspective_value(c.vertices.data(), c.point.data(), c.values.data())->value, 0.25);
    // At a vertex: the vertex, to the bit.
    const double at[2] = {8, 0};
    EXPECT_EQ(perspective_weights(c.vertices.data(), at)->weights, (std::array{0.0, 1.0, 0.0}));
    EXPECT_EQ(perspective_depth(c.vertices.data(), at)->value, 3);
    const double horizon[2] = {12, 0}, beyond[2] = {16, 0};
    EXPECT_TRUE(perspective_weights(c.vertices.data(), horizon)->degenerate);
    EXPECT_TRUE(perspective_depth(c.vertices.data(), horizon)->degenerate);
    EXPECT_EQ(perspective_weights(c.vertices.data(), beyond)->weights, (std::array{3.0, -2.0, 0.0}));
    EXPECT_EQ(perspective_depth(c.vertices.data(), beyond)->value, -3);
}

// With equal depths there is no perspective: the bits of weights.hpp.
RC_GTEST_PROP(Perspective, EqualDepthsGiveTheWeightsOfTheWindow, ()) {
    base::Random r(*rc::gen::arbitrary<std::uint64_t>());
    const Case plain = testing_fields::stretched_cell(r, Simplex::triangle);
    Case c = plain;
    c.perspective = true;
    const double w = r.scaled(1, 2, -30, 30);
    for (int i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 2; ++axis) c.vertex(i, axis) = plain.vertex(i, axis);
        c.depth(i) = w;
    }
    const auto found = perspective_weights(c.vertices.data(), c.point.data());
    const auto expected = barycentric_weights(Simplex::triangle, plain.vertices.data(), plain.point.data());
    RC_ASSERT(found && expected);
    RC_ASSERT(found->degenerate == expected->degenerate);
    if (found->degenerate) return;
    for (std::size_t i = 0; i < 3; ++i)
        RC_ASSERT(testing_cases::bits(found->weights[i]) == testing_cases::bits(expected->weights[i]));
    RC_ASSERT(perspective_depth(c.vertices.data(), c.point.data())->value == w);
}

// Depths in another unit, by any power of two, change no weight; in another order of vertices they change with them.
RC_GTEST_PROP(Perspective, UnitsAndOrdersChangeNoBit, ()) {
    base::Random r(*rc::gen::arbitrary<std::uint64_t>());
    const Case c = random_perspective_case(r, Kind::ordinary);
    const auto w = perspective_weights(c.vertices.data(), c.point.data());
    Case turned = c;
    const double scale = std::ldexp(1, r.integer(-40, 40));
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) turned.vertex((i + 1) % 3, k) = c.vertex(i, k) * (k == 2 ? scale : 1);
    }
    const auto other = perspective_weights(turned.vertices.data(), turned.point.data());
    RC_ASSERT(w->degenerate == other->degenerate);
    for (std::size_t i = 0; i < 3 && !w->degenerate; ++i)
        RC_ASSERT(testing_cases::bits(w->weights[i]) == testing_cases::bits(other->weights[(i + 1) % 3]));
}

// V2: pixel centres on a shared edge have the same values and depths from both sides, whatever the third vertices.
RC_GTEST_PROP(Perspective, ASharedEdgeHasOneValue, ()) {
    base::Random r(*rc::gen::arbitrary<std::uint64_t>());
    Case left{.simplex = Simplex::triangle};
    left.perspective = true;
    const double step[2] = {static_cast<double>(r.integer(-99, 99)), static_cast<double>(r.integer(1, 99))};
    for (int k = 0; k < 2; ++k) {
        const double p = r.integer(0, 1000) + 0.5;
        left.point[static_cast<std::size_t>(k)] = p;
        left.vertex(0, k) = p - 3 * step[k] / 8;
        left.vertex(1, k) = p + 5 * step[k] / 8;
    }
    for (int i = 0; i < 3; ++i) {
        left.depth(i) = r.uniform(1, 10);
        left.values[static_cast<std::size_t>(i)] = r.uniform(-1, 1);
    }
    Case right = left;
    for (int k = 0; k < 2; ++k) {
        left.vertex(2, k) = r.uniform(0, 1000);
        right.vertex(2, k) = r.uniform(0, 1000);
    }
    right.depth(2) = r.uniform(1, 10);
    right.values[2] = r.uniform(-1, 1);
    const auto f = perspective_value(left.vertices.data(), left.point.data(), left.values.data());
    const auto g = perspective_value(right.vertices.data(), right.point.data(), right.values.data());
    RC_PRE(!f->degenerate && !g->degenerate);
    RC_ASSERT(testing_cases::bits(f->value) == testing_cases::bits(g->value));
    RC_ASSERT(testing_cases::bits(perspective_depth(left.vertices.data(), left.point.data())->value) ==
              testing_cases::bits(perspective_depth(right.vertices.data(), right.point.data())->value));
}

TEST(Perspective, BatchesGiveTheSameBitsAndCount) {
    for (const Kind kind : all_kinds) {
        base::Random r = base::Random::stream(11, base::hash64("batch"), static_cast<std::uint64_t>(kind));
        const Case c = random_perspective_case(r, kind);
        constexpr int components = 3;
        std::vector<double> points, values;
        for (int j = 0; j < 40; ++j) {
            for (std::size_t k = 0; k < 2; ++k)
                points.push_back(j % 4 == 0 ? c.vertex(j % 3, static_cast<int>(k))
                                            : testing_cases::number(r, kind, static_cast<int>(k)));
        }
        for (int i = 0; i < 3 * components; ++i) values.push_back(r.uniform(-1, 1));
        values[1] = infinity;
        std::vector<double> out(40 * components);
        TierCounts tiers;
        ASSERT_TRUE(perspective_values(c.vertices.data(), points, values, components, out, &tiers));
        EXPECT_EQ(tiers.cases(), 40U);
        std::uint64_t degenerate = 0, not_finite = 0;
        for (std::size_t j = 0; j < 40; ++j) {
            for (std::size_t k = 0; k < components; ++k) {
                const double f[3] = {values[k], values[components + k], values[2 * components + k]};
                const auto one = perspective_value(c.vertices.data(), points.data() + 2 * j, f);
                if (std::isnan(one->value)) {
                    EXPECT_TRUE(std::isnan(out[components * j + k]));
                    not_finite += k == 1 ? 1 : 0;  // what is degenerate is counted, too
                } else {
                    EXPECT_EQ(testing_cases::bits(out[components * j + k]), testing_cases::bits(one->value));
                }
                degenerate += k == 0 && one->degenerate ? 1 : 0;
            }
        }
        EXPECT_EQ(tiers.degenerate, degenerate);
        EXPECT_EQ(tiers.not_finite, not_finite);
        EXPECT_GE(not_finite, 10U);  // at vertex 0, and elsewhere but on the edge opposite
    }
}

// The tier that is meant for them decides ordinary cases; ties, zeros and what is degenerate are left to integers.
TEST(Perspective, TiersDecideWhatTheyAreFor) {
    int double_double = 0;
    for (std::uint64_t k = 0; k < 1000; ++k) {
        base::Random r = base::Random::stream(11, base::hash64("tiers"), k);
        Case c{.simplex = Simplex::triangle};
        c.perspective = true;
        for (double& x : c.vertices) x = r.uniform(1, 1000);
        for (double& f : c.values) f = r.uniform(-1, 1);
        for (std::size_t i = 0; i < 2; ++i) c.point[i] = r.uniform(1, 1000);
        const auto w = perspective_weights(c.vertices.data(), c.point.data());
        const auto z = perspective_depth(c.vertices.data(), c.point.data());
        const auto f = perspective_value(c.vertices.data(), c.point.data(), c.values.data());
        double_double += w->tier == Tier::double_double && z->tier == w->tier && f->tier == w->tier ? 1 : 0;
    }
    EXPECT_GT(double_double, 990);
    // 3/4 and 1/4 of the ends of an edge: the exact value lies in the middle between 1 and the next double.
    Case c = unit_case();
    c.values = {1, 1 + 0x1p-51, 7, 0};
    const auto tie = perspective_value(c.vertices.data(), c.point.data(), c.values.data());
    EXPECT_EQ(tie->tier, Tier::exact);
    EXPECT_EQ(tie->value, 1);
    EXPECT_TRUE(check(c));
    EXPECT_EQ(perspective_weights(c.vertices.data(), c.point.data())->tier, Tier::exact);  // a zero
    // Fields of zeros are zero, whatever the signs.
    c.values = {-0.0, 0.0, -0.0, 0};
    const auto zero = perspective_value(c.vertices.data(), c.point.data(), c.values.data());
    EXPECT_EQ(testing_cases::bits(zero->value), 0U);
}

// Just beside a tie, at distances down to what no double-double can tell.
TEST(Perspective, NearTiesRoundToTheirSide) {
    Case c{.simplex = Simplex::triangle};
    c.perspective = true;
    c.vertices = {0, 0, 1, 8, 0, 1, 0, 8, 1};
    c.point = {2, 2, 0};  // weights 1/2, 1/4, 1/4
    int exact = 0;
    for (int k = 54; k < 200; ++k) {
        for (const double side : {-1.0, 1.0}) {
            c.values = {2, 0x1p-51, side * std::ldexp(1, -k), 0};
            const auto f = perspective_value(c.vertices.data(), c.point.data(), c.values.data());
            EXPECT_EQ(f->value, side > 0 ? 1 + 0x1p-52 : 1) << k;
            exact += f->tier == Tier::exact ? 1 : 0;
        }
    }
    EXPECT_GT(exact, 100);
    EXPECT_LT(exact, 270);
}

// A triangle without an area has weights nowhere, though 1/Z of the formula need not vanish.
TEST(Perspective, AFlatTriangleIsDegenerateForEveryPoint) {
    for (std::uint64_t k = 0; k < 500; ++k) {
        base::Random r = base::Random::stream(11, base::hash64("flat"), k);
        Case c{.simplex = Simplex::triangle};
        c.perspective = true;
        const double x = r.integer(-9, 9);
        const double y = r.integer(-9, 9);
        for (int i = 0; i < 3; ++i) {
            const double t = r.integer(-9, 9);
            c.vertex(i, 0) = 3 + t * x;
            c.vertex(i, 1) = 5 + t * y;
            c.depth(i) = r.uniform(1, 10);
        }
        for (std::size_t i = 0; i < 2; ++i) c.point[i] = r.uniform(-99, 99);
        EXPECT_TRUE(perspective_weights(c.vertices.data(), c.point.data())->degenerate);
        EXPECT_TRUE(perspective_depth(c.vertices.data(), c.point.data())->degenerate);
        EXPECT_TRUE(perspective_value(c.vertices.data(), c.point.data(), c.values.data())->degenerate);
    }
}

// D1: the same bits, and the same tiers, on every target of this build and on every machine.
TEST(Perspective, AnswersAndTiersArePinnedOnEveryTarget) {
    for (const std::string& target : simd_targets()) {
        ASSERT_TRUE(use_simd_target(target));
        std::uint64_t hash = 0;
        const auto add = [&](std::uint64_t word) { hash = base::mix64(hash ^ word); };
        for (std::uint64_t k = 0; k < 4000; ++k) {
            base::Random r = base::Random::stream(13, base::hash64("pinned"), k);
            const Case c = random_perspective_case(r, all_kinds[k % all_kinds.size()]);
            const auto w = perspective_weights(c.vertices.data(), c.point.data());
            const auto z = perspective_depth(c.vertices.data(), c.point.data());
            const auto f = perspective_value(c.vertices.data(), c.point.data(), c.values.data());
            add(static_cast<std::uint64_t>(w->tier) + 4 * static_cast<std::uint64_t>(z->tier) +
                16 * static_cast<std::uint64_t>(f->tier));
            if (w->degenerate) continue;
            for (const double x : w->weights) add(testing_cases::bits(x));
            add(testing_cases::bits(z->value));
            add(testing_cases::bits(f->value));
        }
        EXPECT_EQ(hash, 0x4c3fb2d3e7476bfULL) << target;
    }
    use_simd_target("");
}

TEST(Perspective, WhatCannotBeIsNamed) {
    const auto message = [](const Case& c) {
        const auto w = perspective_weights(c.vertices.data(), c.point.data());
        EXPECT_FALSE(w);
        EXPECT_FALSE(perspective_depth(c.vertices.data(), c.point.data()));
        EXPECT_FALSE(perspective_value(c.vertices.data(), c.point.data(), c.values.data()));
        double out[1];
        TierCounts tiers;
        EXPECT_FALSE(perspective_values(c.vertices.data(), {c.point.data(), 2}, {c.values.data(), 3}, 1, out, &tiers));
        EXPECT_EQ(tiers.cases(), 0U);
        return w ? std::string() : w.error().message();
    };
    for (const double bad : {std::nan(""), infinity, -infinity, 0.0, -0.0, -1.0}) {
        Case c = unit_case();
        c.depth(1) = bad;
        EXPECT_TRUE(message(c).starts_with("depth w of vertex 1: expected a finite number above 0")) << message(c);
    }
    for (const double bad : {std::nan(""), infinity, -infinity}) {
        Case c = unit_case();
        c.vertex(2, 1) = bad;
        EXPECT_TRUE(message(c).starts_with("coordinate 1 of vertex 2: expected a finite number")) << message(c);
        c = unit_case();
        c.point[1] = bad;
        EXPECT_TRUE(message(c).starts_with("coordinate 1 of the point: expected a finite number")) << message(c);
        c = unit_case();
        c.values[1] = bad;
        const auto f = perspective_value(c.vertices.data(), c.point.data(), c.values.data());
        ASSERT_TRUE(f);
        EXPECT_TRUE(std::isnan(f->value) && !f->degenerate);
    }
    const Case c = unit_case();
    double out[2];
    EXPECT_FALSE(perspective_values(c.vertices.data(), {c.point.data(), 3}, {c.values.data(), 3}, 1, out));
    EXPECT_FALSE(perspective_values(c.vertices.data(), {c.point.data(), 2}, {c.values.data(), 2}, 1, {out, 1}));
    EXPECT_FALSE(perspective_values(c.vertices.data(), {c.point.data(), 2}, {c.values.data(), 3}, 1, {out, 2}));
    EXPECT_FALSE(perspective_values(c.vertices.data(), {c.point.data(), 2}, {c.values.data(), 3}, 0, {out, 0}));
    EXPECT_TRUE(perspective_values(c.vertices.data(), {}, {c.values.data(), 3}, 1, {}));
}

}  // namespace
}  // namespace barycert
