// Gradients of quadratic fields: against exact rationals by the product rule, rounded by the definition.
#include <limits>

#include "tests/core/quadratic_cases.hpp"

namespace barycert::core {
namespace {

using testing_cases::all_kinds;
using testing_cases::Kind;
using testing_cases::random_case;
using testing_fields::edge;
using testing_fields::exact_gradient;
using testing_fields::full;
using testing_fields::QuadraticCase;
using testing_fields::stretched_case;
using testing_fields::with_mids;
using testing_rational::nearest;
using testing_rational::Q;

Gradient gradient_of(const QuadraticCase& q, Rounding rounding = Rounding::correct) {
    const Case& c = q.linear;
    return quadratic_gradient(c.simplex, c.vertices.data(), c.point.data(), q.nodal().data(), rounding).value();
}

/// sum (4 l_i - 1) f_i grad l_i + sum 4 (l_j grad l_i + l_i grad l_j) f_ij; nothing if degenerate.
std::optional<std::vector<Q>> true_gradient(const QuadraticCase& q) {
    const auto l = second_path::weights(q.linear);
    if (!l) return std::nullopt;
    std::vector<std::vector<Q>> of_weight;
    for (std::size_t i = 0; i < l->size(); ++i) {
        Case unit = q.linear;
        unit.values.fill(0);
        unit.values[i] = 1;
        of_weight.push_back(*exact_gradient(unit));
    }
    std::vector<Q> g(of_weight[0].size(), Q(0));
    for (std::size_t k = 0; k < g.size(); ++k) {
        for (std::size_t i = 0; i < l->size(); ++i) g[k] += (4 * (*l)[i] - 1) * Q(q.linear.values[i]) * of_weight[i][k];
        for (std::size_t e = 0; e < q.mids.size(); ++e) {
            const auto i = static_cast<std::size_t>(edge(e)[0]), j = static_cast<std::size_t>(edge(e)[1]);
            g[k] += 4 * ((*l)[j] * of_weight[i][k] + (*l)[i] * of_weight[j][k]) * Q(q.mids[e]);
        }
    }
    return g;
}

void expect_gradient(const QuadraticCase& q) {
    const Gradient g = gradient_of(q);
    const auto exact = true_gradient(q);
    ASSERT_EQ(g.degenerate, !exact) << describe(q);
    for (std::size_t k = 0; k < static_cast<std::size_t>(space_dimension(q.linear.simplex)); ++k) {
        if (exact) {
            EXPECT_TRUE(nearest(g.gradient[k], (*exact)[k])) << k << ' ' << describe(q);
        } else {
            EXPECT_TRUE(std::isnan(g.gradient[k])) << k << ' ' << describe(q);
        }
    }
}

TEST(LawG1Quadratic, EveryKindOfNumber) {
    for (const Simplex s : full) {
        for (const Kind kind : all_kinds) {
            for (std::uint64_t k = 0; k < 300 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(41, base::hash64("quadratic gradients"), k);
                const Case c = random_case(r, s, kind);
                expect_gradient(with_mids(r, c, kind));
            }
        }
    }
}

TEST(LawG1Quadratic, FlatCellsFarFromTheOrigin) {
    for (const Simplex s : full) {
        for (std::uint64_t k = 0; k < 600 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(41, base::hash64("flat quadratic gradients"), k);
            expect_gradient(stretched_case(r, s, 46));
        }
    }
}

TEST(LawG1Quadratic, OfLinearValuesIsThatOfLinearFields) {
    // Dyadic values, so that the means at mid-edge nodes are exact.
    for (const Simplex s : full) {
        for (std::uint64_t k = 0; k < 200 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(42, base::hash64("linear"), k);
            QuadraticCase q = stretched_case(r, s, 20);
            for (double& f : q.linear.values) f = r.integer(-1000, 1000);
            for (std::size_t e = 0; e < q.mids.size(); ++e)
                q.mids[e] = (q.linear.values[static_cast<std::size_t>(edge(e)[0])] +
                             q.linear.values[static_cast<std::size_t>(edge(e)[1])]) /
                            2;
            const Gradient found = gradient_of(q);
            const Gradient linear = gradient(s, q.linear.vertices.data(), q.linear.values.data()).value();
            EXPECT_EQ(found.gradient, linear.gradient) << describe(q);
        }
    }
}

// In the unit cell, with small dyadic numbers, nothing is rounded.
TEST(LawG1Quadratic, PlainIsTheSameFormula) {
    base::Random r = base::Random::stream(43, base::hash64("plain"), 0);
    for (const Simplex s : full) {
        const int n = vertex_count(s), d = space_dimension(s);
        for (int k = 0; k < 100; ++k) {
            QuadraticCase q;
            q.linear.simplex = s;
            for (int i = 1; i < n; ++i) q.linear.vertex(i, i - 1) = 1;
            for (int i = 0; i < d; ++i) q.linear.point[static_cast<std::size_t>(i)] = r.integer(-16, 16) / 8.0;
            for (int i = 0; i < n; ++i) q.linear.values[static_cast<std::size_t>(i)] = r.integer(-100, 100);
            for (int e = 0; e < mid_node_count(s); ++e) q.mids.push_back(r.integer(-100, 100));
            EXPECT_EQ(gradient_of(q, Rounding::plain).gradient, gradient_of(q).gradient) << describe(q);
        }
    }
}

TEST(LawG1Quadratic, WhatIsNotFinite) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    QuadraticCase q;
    q.linear.simplex = Simplex::triangle;
    q.linear.vertices = {0, 0, 1, 0, 0, 1};
    q.linear.point = {0.25, 0.25};
    q.mids = {0, 0, infinity};
    for (const Rounding rounding : {Rounding::correct, Rounding::plain})
        EXPECT_TRUE(std::isnan(gradient_of(q, rounding).gradient[0]));
    EXPECT_FALSE(gradient_of(q).degenerate);
    const std::array<double, 6> values{};
    const std::array<double, 2> nowhere{nan, 0};
    EXPECT_FALSE(quadratic_gradient(Simplex::triangle, q.linear.vertices.data(), nowhere.data(), values.data()));
    EXPECT_FALSE(quadratic_gradient(Simplex::segment, q.linear.vertices.data(), nowhere.data(), values.data()));
}

}  // namespace
}  // namespace barycert::core
