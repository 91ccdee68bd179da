// Zeros have a sign, and one rule tells it (barycert.hpp): an exact zero is +0, whatever zeros it was made of; what is
// not zero but rounds to it keeps its sign.
#include <gtest/gtest.h>

#include <vector>

#include "barycert/barycert.hpp"
#include "tests/core/environments.hpp"
#include "tests/core/field_cases.hpp"
#include "tests/core/rational.hpp"

namespace barycert::testing_fields {
namespace {

using testing_environments::Columns;
using testing_rational::bits;
using testing_rational::nearest;
using testing_rational::Q;
using testing_rational::rational;

/// Few numbers, so that zeros are frequent; both zeros among them.
double small_number(base::Random& r) {
    constexpr std::array numbers{-0.0, 0.0, -0.0, 0.0, 1.0, -1.0, 2.0, -2.0};
    return numbers[r.below(numbers.size())];
}

/// Lattice cells, the point on a lattice point, a vertex or amid an edge; sizes 2^-600 to 2^600, values about 1 or so
/// small that they round to zero when weighed.
Case lattice_case(Simplex s, std::uint64_t k) {
    base::Random r = base::Random::stream(3, base::hash64("zeros"), k);
    Case c{.simplex = s};
    for (double& x : c.vertices) x = small_number(r);
    for (double& x : c.point) x = small_number(r);
    for (double& x : c.values) x = small_number(r);
    const int on = r.integer(0, 3), size = 300 * r.integer(-2, 2), value_size = r.coin() ? 0 : -1074;
    for (int i = 0; i < space_dimension(s); ++i) {
        double& x = c.point[static_cast<std::size_t>(i)];
        if (on == 1) x = c.vertex(1, i);
        if (on == 2) x = c.vertex(0, i) * 0.5 + c.vertex(1, i) * 0.5;
    }
    for (double& x : c.vertices) x = std::ldexp(x, size);
    for (double& x : c.point) x = std::ldexp(x, size);
    for (double& x : c.values) x = std::ldexp(x, value_size);
    return c;
}

/// How often each zero came, so that a test can say that it has seen it.
struct Zeros {
    int positive = 0, negative = 0;
    void see(double x) {
        if (x == 0) ++(std::signbit(x) ? negative : positive);
    }
};

constexpr std::uint64_t count = 3000;

TEST(Zeros, OfWeightsAndValuesSingleAndInBatches) {
    for (const Simplex s : all_simplices) {
        const auto n = static_cast<std::size_t>(vertex_count(s));
        std::vector<Case> cases;
        std::vector<std::vector<Q>> exact;
        for (std::uint64_t k = 0; cases.size() < count; ++k) {
            const Case c = lattice_case(s, k);
            const auto weights = second_path::weights(c);
            if (!weights) continue;
            cases.push_back(c);
            exact.push_back(*weights);
            exact.back().push_back(0);
            for (std::size_t i = 0; i < n; ++i) exact.back()[n] += (*weights)[i] * Q(c.values[i]);
        }
        const Columns columns(s, cases);
        for (const std::string& target : simd_targets()) {
            SCOPED_TRACE(std::string(name(s)) + " on " + target);
            use_simd_target(target);
            Zeros seen;
            std::vector<double> w(n * count), mesh_w(n * count), v(count), mesh_v(count);
            ASSERT_TRUE(barycentric_weights(columns.arrays(), w));
            ASSERT_TRUE(barycentric_weights(columns.mesh(), mesh_w));
            ASSERT_TRUE(interpolate(columns.arrays(), columns.values(), v));
            ASSERT_TRUE(interpolate(columns.mesh(), columns.nodal_values(), mesh_v));
            for (std::size_t j = 0; j < count; ++j) {
                const Case& c = cases[j];
                const Weights one = barycentric_weights(s, c.vertices.data(), c.point.data()).value();
                const Value value = interpolate(s, c.vertices.data(), c.point.data(), c.values.data()).value();
                for (std::size_t i = 0; i < n; ++i) {
                    ASSERT_TRUE(nearest(one.weights[i], exact[j][i])) << testing_cases::describe(c);
                    ASSERT_EQ(bits(w[n * j + i]), bits(one.weights[i])) << testing_cases::describe(c);
                    ASSERT_EQ(bits(mesh_w[n * j + i]), bits(one.weights[i])) << testing_cases::describe(c);
                }
                ASSERT_TRUE(nearest(value.value, exact[j][n])) << testing_cases::describe(c);
                ASSERT_EQ(bits(v[j]), bits(value.value)) << testing_cases::describe(c);
                ASSERT_EQ(bits(mesh_v[j]), bits(value.value)) << testing_cases::describe(c);
                seen.see(value.value);
            }
            EXPECT_GT(seen.positive, 500);
            EXPECT_GT(seen.negative, 20);
        }
        use_simd_target("");
    }
}

TEST(Zeros, OfGradientsAndQuadraticFieldsSingleAndInBatches) {
    for (const Simplex s : full) {
        const auto d = static_cast<std::size_t>(space_dimension(s)), m = static_cast<std::size_t>(mid_node_count(s));
        // The mid-edge nodes of case j stand behind all corners; only their values count.
        std::vector<QuadraticCase> cases;
        for (std::uint64_t k = 0; cases.size() < count; ++k) {
            QuadraticCase q{lattice_case(s, k), {}};
            if (!second_path::weights(q.linear)) continue;
            base::Random r(k);
            // As the values at the corners, or their sum would not round to zero.
            const bool tiny = std::fabs(q.linear.values[0]) < 0.5;
            for (std::size_t e = 0; e < m; ++e) q.mids.push_back(small_number(r) * (tiny ? 0x1p-1074 : 1));
            cases.push_back(q);
        }
        std::vector<Case> linear;
        for (const QuadraticCase& q : cases) linear.push_back(q.linear);
        const Columns columns(s, linear);
        const MeshQueries mesh = columns.mesh();
        std::vector<double> values(columns.nodal_values().data.begin(), columns.nodal_values().data.end());
        std::vector<std::int32_t> mid_nodes;
        for (const QuadraticCase& q : cases) {
            for (const double f : q.mids) {
                mid_nodes.push_back(static_cast<std::int32_t>(values.size()));
                values.push_back(f);
            }
        }
        for (const std::string& target : simd_targets()) {
            SCOPED_TRACE(std::string(name(s)) + " on " + target);
            use_simd_target(target);
            Zeros seen_slopes, seen_values;
            std::vector<double> slopes(d * count), found(count);
            ASSERT_TRUE(gradients(s, mesh.nodes, mesh.corners, columns.nodal_values(), slopes));
            ASSERT_TRUE(interpolate_quadratic(mesh, mid_nodes, NodalValues<double>{values, 1}, found));
            for (std::size_t j = 0; j < count; ++j) {
                const QuadraticCase& q = cases[j];
                const Case& c = q.linear;
                const Gradient one = gradient(s, c.vertices.data(), c.values.data()).value();
                const auto exact = exact_gradient(c);
                for (std::size_t k = 0; k < d; ++k) {
                    ASSERT_TRUE(nearest(one.gradient[k], (*exact)[k])) << describe(q);
                    ASSERT_EQ(bits(slopes[d * j + k]), bits(one.gradient[k])) << describe(q);
                    seen_slopes.see(one.gradient[k]);
                }
                const Value value =
                    interpolate_quadratic(s, c.vertices.data(), c.point.data(), q.nodal().data()).value();
                ASSERT_TRUE(nearest(value.value, *exact_quadratic(q))) << describe(q);
                ASSERT_EQ(bits(found[j]), bits(value.value)) << describe(q);
                seen_values.see(value.value);
            }
            EXPECT_GT(seen_slopes.positive, 500);
            EXPECT_GT(seen_slopes.negative, 20);
            EXPECT_GT(seen_values.positive, 200);
            EXPECT_GT(seen_values.negative, 5);
        }
        use_simd_target("");
    }
}

TEST(Zeros, OfTheInverse) {
    Zeros parameters, points;
    for (std::uint64_t k = 0; k < 20000; ++k) {
        base::Random r(k);
        const int size = r.coin() ? 0 : -1074;
        double a[2], b[2], at[2];
        for (double* const p : {a, b}) {
            for (int i = 0; i < 2; ++i) p[i] = std::ldexp(small_number(r), size);
        }
        const double from = small_number(r) * 0x1p1000, to = small_number(r) * 0x1p1000;
        const double value = small_number(r) * (r.coin() ? 0x1p1000 : 0x1p-1000);
        const Parameter t = point_of_value(a, b, from, to, value, at).value();
        ASSERT_EQ(t.undetermined, from == to);
        if (t.undetermined) continue;
        const Q exact = (Q(value) - Q(from)) / (Q(to) - Q(from));
        ASSERT_TRUE(nearest(t.t, exact));
        ASSERT_EQ(bits(parameter_of_value(from, to, value).value().t), bits(t.t));
        parameters.see(t.t);
        for (int i = 0; i < 2; ++i) {
            ASSERT_TRUE(nearest(at[i], Q(a[i]) + exact * (Q(b[i]) - Q(a[i]))));
            points.see(at[i]);
        }
    }
    EXPECT_GT(parameters.positive, 500);
    EXPECT_GT(parameters.negative, 500);
    EXPECT_GT(points.positive, 500);
    EXPECT_GT(points.negative, 20);
}

TEST(Zeros, OfPointsFromWeights) {
    Zeros seen;
    for (const Simplex s : all_simplices) {
        for (std::uint64_t k = 0; k < 5000; ++k) {
            const Case c = lattice_case(s, k);
            base::Random r(k);
            double weights[4], point[3];
            for (double& w : weights) w = std::ldexp(small_number(r), r.coin() ? 0 : -700);
            ASSERT_TRUE(point_from_weights(s, c.vertices.data(), weights, point));
            for (int axis = 0; axis < space_dimension(s); ++axis) {
                Q exact = 0;
                for (int i = 0; i < vertex_count(s); ++i) exact += Q(weights[i]) * Q(c.vertex(i, axis));
                ASSERT_TRUE(nearest(point[axis], exact)) << testing_cases::describe(c);
                seen.see(point[axis]);
            }
        }
    }
    EXPECT_GT(seen.positive, 500);
    EXPECT_GT(seen.negative, 500);
}

}  // namespace
}  // namespace barycert::testing_fields
