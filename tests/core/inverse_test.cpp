// The other way round: places of values, points of weights, each against exact rationals.
#include "barycert/weights.hpp"

#include "tests/audit/exact/cases.hpp"
#include "tests/core/environments.hpp"
#include "tests/core/rational.hpp"

namespace barycert {
namespace {

using testing_cases::all_kinds;
using testing_cases::Kind;
using testing_cases::random_case;
using testing_rational::any_finite;
using testing_rational::bits;
using testing_rational::infinity;
using testing_rational::max;
using testing_rational::nearest;
using testing_rational::Q;

TEST(PointOfValue, ByHand) {
    const double a[2] = {1, 1}, b[2] = {2, 2};
    double p[2] = {};
    const Parameter t = point_of_value(a, b, 5, 6, 5.5, p).value();
    EXPECT_EQ(t.t, 0.5);
    EXPECT_FALSE(t.undetermined);
    EXPECT_EQ(p[0], 1.5);
    EXPECT_EQ(p[1], 1.5);
    // The ends, and beyond them.
    EXPECT_EQ(bits(point_of_value(a, b, 5, 6, 5, p).value().t), 0U);
    EXPECT_EQ(p[0], 1);
    EXPECT_EQ(point_of_value(a, b, 5, 6, 6, p).value().t, 1);
    EXPECT_EQ(p[1], 2);
    EXPECT_EQ(point_of_value(a, b, 5, 6, 8, p).value().t, 3);
    EXPECT_EQ(p[0], 4);
    EXPECT_EQ(point_of_value(a, b, 5, 6, 3, p).value().t, -2);
    EXPECT_EQ(p[0], -1);
    EXPECT_EQ(parameter_of_value(5, 6, 5.5).value().t, 0.5);
}

TEST(PointOfValue, EqualValuesLeaveItUndetermined) {
    const double a[3] = {1, 2, 3}, b[3] = {4, 5, 6};
    for (const double f : {0.0, 5.0, 1e308, 0x1p-1074}) {
        for (const double value : {f, 7.0}) {
            double p[3] = {1, 1, 1};
            const Parameter t = point_of_value(a, b, f, f, value, p).value();
            EXPECT_TRUE(t.undetermined);
            EXPECT_TRUE(std::isnan(t.t));
            for (const double x : p) EXPECT_TRUE(std::isnan(x));
        }
    }
    EXPECT_TRUE(parameter_of_value(0.0, -0.0, 1).value().undetermined);
}

/// t and the point from rationals; and the same with the ends exchanged.
void expect_point(const std::array<double, 3>& a, const std::array<double, 3>& b, double f, double g, double value) {
    std::array<double, 3> p{}, q{};
    const Parameter t = point_of_value(a, b, f, g, value, p).value();
    const Parameter back = point_of_value(b, a, g, f, value, q).value();
    ASSERT_EQ(t.undetermined, f == g);
    if (f == g) return;
    const Q exact = (Q(value) - Q(f)) / (Q(g) - Q(f));
    EXPECT_TRUE(nearest(t.t, exact)) << base::hexadecimal(f) << ' ' << base::hexadecimal(g) << ' '
                                     << base::hexadecimal(value);
    EXPECT_TRUE(nearest(back.t, 1 - exact));
    EXPECT_EQ(bits(parameter_of_value(f, g, value).value().t), bits(t.t));
    for (std::size_t k = 0; k < 3; ++k) {
        // From the exact t: catches a point made of the rounded one.
        EXPECT_TRUE(nearest(p[k], Q(a[k]) + exact * (Q(b[k]) - Q(a[k])))) << k;
        EXPECT_EQ(bits(q[k]), bits(p[k])) << k;
    }
}

TEST(PointOfValue, RoundedFromRationals) {
    for (const Kind kind : all_kinds) {
        for (std::uint64_t k = 0; k < 400 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(9, base::hash64("inverse"), k);
            const Case c = random_case(r, Simplex::tetrahedron, kind);
            const double value = r.integer(0, 3) == 0 ? c.values[0] / 2 + c.values[1] / 2 : c.values[2];
            expect_point({c.vertices[0], c.vertices[1], c.vertices[2]}, {c.vertices[3], c.vertices[4], c.vertices[5]},
                         c.values[0], c.values[1], value);
        }
    }
    for (std::uint64_t k = 0; k < 400 && !HasFailure(); ++k) {
        base::Random r = base::Random::stream(9, base::hash64("inverse, values of any kind"), k);
        expect_point({any_finite(r), 1, 0x1p-1074}, {any_finite(r), max, 3 * 0x1p-1074}, any_finite(r), any_finite(r),
                     any_finite(r));
    }
}

TEST(PointOfValue, EndsOfTheRange) {
    const double tiny = 0x1p-1074;
    expect_point({0, -max, tiny}, {1, max, 0}, -max, max, 0);
    expect_point({0, 0, 0}, {1, max, tiny}, 0, tiny, max);
    expect_point({0, 0, 0}, {1, tiny, -tiny}, 0, 2, 1);  // ties at half of the smallest subnormal
    expect_point({0, 0, 0}, {1, 1, 1}, 0, max, tiny);
    EXPECT_EQ(parameter_of_value(0, tiny, 1).value().t, infinity);
    EXPECT_EQ(parameter_of_value(0, max, -tiny).value().t, 0);
    EXPECT_TRUE(std::signbit(parameter_of_value(0, max, -tiny).value().t));
}

TEST(PointOfValue, WhatIsNoNumberIsNamed) {
    const double a[2] = {1, 1}, b[2] = {2, 2};
    double p[2];
    for (const double bad : {std::nan(""), infinity, -infinity}) {
        EXPECT_FALSE(parameter_of_value(bad, 1, 2));
        EXPECT_FALSE(parameter_of_value(1, bad, 2));
        const auto third = parameter_of_value(1, 2, bad);
        ASSERT_FALSE(third);
        EXPECT_EQ(third.error().what, "attribute value 2");
        const double spoilt[2] = {1, bad};
        const auto first = point_of_value(spoilt, b, 1, 2, 3, p), second = point_of_value(a, spoilt, 1, 2, 3, p);
        ASSERT_FALSE(first || second);
        EXPECT_EQ(first.error().what, "coordinate of the first end, 1");
        EXPECT_EQ(second.error().what, "coordinate of the second end, 1");
        EXPECT_EQ(second.error().expected, "a finite number");
    }
}

void expect_dot(const Case& c, const std::array<double, 4>& w) {
    double p[3] = {};
    ASSERT_TRUE(point_from_weights(c.simplex, c.vertices.data(), w.data(), p));
    for (int k = 0; k < space_dimension(c.simplex); ++k) {
        Q sum(0);
        for (int i = 0; i < vertex_count(c.simplex); ++i) sum += Q(w[static_cast<std::size_t>(i)]) * Q(c.vertex(i, k));
        EXPECT_TRUE(nearest(p[k], sum)) << testing_cases::describe(c);
    }
}

// Weights of every kind, not scaled to a sum of 1; cancellation, ties and zeros by lattices.
TEST(PointFromWeights, IsTheDotProductRoundedOnce) {
    for (const Simplex s : all_simplices) {
        for (const Kind kind : all_kinds) {
            for (std::uint64_t k = 0; k < 200 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(9, base::hash64("dot"), k);
                const Case c = random_case(r, s, kind), other = random_case(r, s, all_kinds[r.below(all_kinds.size())]);
                expect_dot(c, other.values);
                expect_dot(c, {0.5, -0.5, 0x1p-53, 1 - 0x1p-53});
                expect_dot(c, {-0.0, 0.0, 0.0, -0.0});
            }
        }
    }
}

TEST(PointFromWeights, WhatIsNoNumberIsNamed) {
    for (const Simplex s : all_simplices) {
        const auto n = static_cast<std::size_t>(vertex_count(s)), d = static_cast<std::size_t>(space_dimension(s));
        double p[3];
        for (std::size_t i = 0; i < n * d; ++i) {
            std::array<double, 12> v{};
            const std::array<double, 4> w{1, 1, 1, 1};
            v[i] = std::nan("");
            const auto status = point_from_weights(s, v.data(), w.data(), p);
            ASSERT_FALSE(status);
            EXPECT_EQ(status.error().what, "coordinate of the vertices, " + std::to_string(i));
        }
        for (std::size_t i = 0; i < n; ++i) {
            const std::array<double, 12> v{};
            std::array<double, 4> w{};
            w[i] = -infinity;
            const auto status = point_from_weights(s, v.data(), w.data(), p);
            ASSERT_FALSE(status);
            EXPECT_EQ(status.error().what, "weight " + std::to_string(i));
        }
    }
}

// "Whatever the floating-point environment": the same bits in all of them.
TEST(PointOfValue, IsTheSameInEveryEnvironment) {
    for (std::uint64_t k = 0; k < 200; ++k) {
        base::Random r = base::Random::stream(9, base::hash64("inverse environments"), k);
        const Case c = random_case(r, Simplex::tetrahedron, all_kinds[k % all_kinds.size()]);
        const std::span<const double> a(c.vertices.data(), 3), b(c.vertices.data() + 3, 3);
        std::array<double, 3> right{};
        const double t = point_of_value(a, b, c.values[0], c.values[1], c.values[2], right).value().t;
        std::array<double, 3> right_point{};
        ASSERT_TRUE(point_from_weights(c.simplex, c.vertices.data(), c.values.data(), right_point.data()));
        for (const auto& environment : testing_environments::all_environments()) {
            std::array<double, 3> p{}, q{};
            double other = 0;
            {
                const testing_environments::Changed changed(environment);
                other = point_of_value(a, b, c.values[0], c.values[1], c.values[2], p)->t;
                (void)point_from_weights(c.simplex, c.vertices.data(), c.values.data(), q.data()).has_value();
            }
            ASSERT_EQ(bits(other), bits(t)) << environment.name;
            for (std::size_t i = 0; i < 3; ++i) {
                ASSERT_EQ(bits(p[i]), bits(right[i])) << environment.name;
                ASSERT_EQ(bits(q[i]), bits(right_point[i])) << environment.name;
            }
        }
    }
}

}  // namespace
}  // namespace barycert
