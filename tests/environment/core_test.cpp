// Public entries of core: the same answers, counts and signs of zeros in every floating-point environment.
#include "barycert/barycert.hpp"

#include <array>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "core/base/ulp.hpp"
#include "tests/core/same_everywhere.hpp"

namespace barycert {
namespace {

using testing_environments::Answers;
using testing_environments::Columns;
using testing_environments::expect_same_everywhere;

constexpr double unit = 0x1p-1074;

/// Ordinary numbers, small integers and subnormals; points inside, on faces and at vertices.
std::vector<Case> cases_of(Simplex s) {
    std::vector<Case> cases;
    for (std::uint64_t k = 0; k < 60; ++k) {
        base::Random r = base::Random::stream(77, static_cast<std::uint64_t>(s), k);
        Case c;
        c.simplex = s;
        const double scale = k % 3 == 0 ? unit : k % 3 == 1 ? 1 : 0x1p-1030;
        for (double& x : c.vertices) x = r.integer(-50, 50) * scale;
        for (double& x : c.point) x = r.integer(-20, 20) * scale;
        for (double& x : c.values) x = k % 2 == 0 ? r.integer(-9, 9) * unit : r.uniform(-1, 1);
        if (k % 5 == 0) {
            for (int a = 0; a < space_dimension(s); ++a) c.point[static_cast<std::size_t>(a)] = c.vertex(1, a);
        }
        cases.push_back(c);
    }
    return cases;
}

void add(Answers& out, const TierCounts& t) {
    for (const std::uint64_t n : {t.filter, t.double_double, t.exact, t.degenerate, t.not_finite}) out.add(n);
}

TEST(EveryEnvironment, Signs) {
    for (const Simplex s : all_simplices) {
        const std::vector<Case> cases = cases_of(s);
        const Columns columns(s, cases);
        expect_same_everywhere("signs of " + std::string(name(s)), [&](Answers& out) {
            TierCounts tiers, single;
            std::vector<WeightSigns> signs(cases.size());
            for (const Status& done :
                 {weight_signs(columns.arrays(), signs, &tiers), weight_signs(columns.mesh(), signs, &tiers)})
                out.add(done.has_value());
            add(out, tiers);
            for (std::size_t i = 0; i < cases.size(); ++i) {
                const Case& c = cases[i];
                out.add(weight_signs(s, c.vertices.data(), c.point.data(), &single) == signs[i]);
                out.add(static_cast<int>(signs[i].feature(s)));
                if (s == Simplex::tetrahedron) {
                    const double* const v = c.vertices.data();
                    out.add(static_cast<int>(orient3d(v, v + 3, v + 6, v + 9)));
                    out.add(static_cast<int>(insphere(v, v + 3, v + 6, v + 9, c.point.data())));
                    out.add(static_cast<int>(orient2d(v, v + 2, v + 4)));
                    out.add(static_cast<int>(incircle(v, v + 2, v + 4, v + 6)));
                    out.add(static_cast<int>(det3d(v, v + 3, v + 6, v + 9, v, c.point.data())));
                }
            }
            add(out, single);
        });
    }
}

TEST(EveryEnvironment, WeightsAndValues) {
    for (const Simplex s : all_simplices) {
        const std::vector<Case> cases = cases_of(s);
        const Columns columns(s, cases);
        const auto n = static_cast<std::size_t>(vertex_count(s));
        expect_same_everywhere("weights and values of " + std::string(name(s)), [&](Answers& out) {
            TierCounts tiers;
            std::vector<double> w(n * cases.size()), v(cases.size());
            out.add(barycentric_weights(columns.arrays(), w, &tiers).has_value());
            out.add_all(w);
            out.add(barycentric_weights(columns.mesh(), w, &tiers).has_value());
            out.add_all(w);
            for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
                out.add(interpolate(columns.arrays(), columns.values(), v, &tiers, rounding).has_value());
                out.add_all(v);
                out.add(interpolate(columns.mesh(), columns.nodal_values(), v, &tiers, rounding).has_value());
                out.add_all(v);
            }
            add(out, tiers);
            for (const Case& c : cases) {
                const auto weights = barycentric_weights(s, c.vertices.data(), c.point.data());
                const auto value = interpolate(s, c.vertices.data(), c.point.data(), c.values.data());
                out.add(weights.has_value());
                if (!weights || !value) continue;
                for (std::size_t i = 0; i < n; ++i) out.add(weights->weights[i]);
                out.add(static_cast<int>(weights->tier));
                out.add(value->value);
                out.add(static_cast<int>(value->tier));
                const auto side = compare_value(s, c.vertices.data(), c.point.data(), c.values.data(), value->value);
                out.add(side ? static_cast<int>(*side) : 9);
                double point[3];
                out.add(point_from_weights(s, c.vertices.data(), c.values.data(), point).has_value());
                for (int k = 0; k < space_dimension(s); ++k) out.add(point[k]);
            }
        });
    }
}

TEST(EveryEnvironment, GradientsAndQuadraticFields) {
    for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
        const std::vector<Case> cases = cases_of(s);
        const Columns columns(s, cases);
        const auto n = static_cast<std::size_t>(vertex_count(s)), d = static_cast<std::size_t>(space_dimension(s));
        const std::size_t mids = n * (n - 1) / 2;
        std::vector<std::int32_t> mid_nodes(mids * cases.size());
        for (std::size_t i = 0; i < mid_nodes.size(); ++i)
            mid_nodes[i] = static_cast<std::int32_t>(n * (i / mids) + i % n);
        expect_same_everywhere("fields of " + std::string(name(s)), [&](Answers& out) {
            TierCounts tiers;
            const MeshQueries mesh = columns.mesh();
            std::vector<double> g(d * cases.size()), v(cases.size());
            out.add(gradients(s, mesh.nodes, mesh.corners, columns.nodal_values(), g, &tiers).has_value());
            out.add_all(g);
            for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
                out.add(
                    interpolate_quadratic(mesh, mid_nodes, columns.nodal_values(), v, &tiers, rounding).has_value());
                out.add_all(v);
            }
            add(out, tiers);
            for (const Case& c : cases) {
                const auto one = gradient(s, c.vertices.data(), c.values.data());
                const double values[10] = {unit, 2 * unit, 3, 4, 5, 6 * unit, 7, 8, 9, 10};
                const auto value = interpolate_quadratic(s, c.vertices.data(), c.point.data(), values);
                for (std::size_t k = 0; k < d; ++k) out.add(one->gradient[k]);
                out.add(value->value);
                for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
                    const auto of_quadratic =
                        quadratic_gradient(s, c.vertices.data(), c.point.data(), values, rounding);
                    for (std::size_t k = 0; k < d; ++k) out.add(of_quadratic->gradient[k]);
                }
            }
        });
    }
}

TEST(EveryEnvironment, Perspective) {
    // Depths made here: where subnormals are flushed they would be zero.
    struct InWindow {
        double vertices[9];
        Case plain;
    };
    std::vector<InWindow> cases;
    for (const Case& plain : cases_of(Simplex::triangle)) {
        InWindow c{{}, plain};
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 2; ++k) c.vertices[3 * i + k] = plain.vertex(i, k);
            c.vertices[3 * i + 2] = (i + 1) * (cases.size() % 2 == 0 ? unit : 0.1);
        }
        cases.push_back(c);
    }
    expect_same_everywhere("perspective", [&](Answers& out) {
        TierCounts tiers;
        for (const auto& [v, plain] : cases) {
            const auto w = perspective_weights(v, plain.point.data());
            const auto z = perspective_depth(v, plain.point.data());
            const auto f = perspective_value(v, plain.point.data(), plain.values.data());
            out.add(w && z && f);
            if (!w || !z || !f) continue;
            for (const double x : w->weights) out.add(x);
            out.add(z->value);
            out.add(f->value);
            double values[1];
            out.add(perspective_values(v, {plain.point.data(), 2}, {plain.values.data(), 3}, 1, values, &tiers)
                        .has_value());
            out.add(values[0]);
        }
        add(out, tiers);
    });
}

TEST(EveryEnvironment, ConditionNumbers) {
    const double found[6] = {unit, 0, 2 * unit, 1000 * unit, 3 * unit, 2001 * unit};
    EXPECT_EQ(condition_number(Simplex::triangle, found), 8004);
    for (const Simplex s : {Simplex::triangle, Simplex::tetrahedron}) {
        const std::vector<Case> cases = cases_of(s);
        expect_same_everywhere("condition of " + std::string(name(s)), [&](Answers& out) {
            out.add(condition_number(Simplex::triangle, found));
            for (const Case& c : cases) out.add(condition_number(s, c.vertices.data()));
        });
    }
}

TEST(EveryEnvironment, TextUlpsAndRandomNumbers) {
    std::vector<double> numbers{0.0, -0.0, unit, -unit, 0x1p-1022, 1, 0.1, 1.0 / 3, 123456.789, 0x1p1023, -7 * unit};
    base::Random r(5);
    for (int i = 0; i < 500; ++i) {
        const double x = std::bit_cast<double>(r.bits() >> (i % 60));
        if ((std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff) != 0x7ff) numbers.push_back(x);
    }
    std::vector<std::string> texts{"1e-400",           "4.9e-324", "0.1", "-2.2250738585072011e-308",
                                   "9007199254740993", "1e309"};
    for (const double x : numbers) {
        texts.push_back(base::shortest(x));
        texts.push_back(base::hexadecimal(x));
    }
    expect_same_everywhere("text", [&](Answers& out) {
        for (const double x : numbers) {
            out.add(std::string_view(base::shortest(x)));
            out.add(std::string_view(base::hexadecimal(x)));
            out.add(base::next_up(x));
            out.add(base::next_down(x));
            out.add(base::ulp_error(x, numbers[7]));
            out.add(base::ulp_error(x, numbers[10]));
        }
        for (const std::string& text : texts) out.add(base::parse_double(text).value_or(7));
        base::Random random(9);
        for (int i = 0; i < 100; ++i) {
            out.add(random.uniform(-0.3, 0.7));
            out.add(random.scaled(1, 2, -1074, 900));
        }
    });
}

// An exact zero is +0, in every environment: rounded downward, x - x is -0.
TEST(EveryEnvironment, AnExactZeroIsPositive) {
    const Case c{.simplex = Simplex::triangle, .vertices = {0, 0, 3, 0, 0, 3}, .point = {1, 0}, .values = {1, -0.5, 9}};
    for (const auto& e : testing_environments::all_environments()) {
        Result<Weights> w = Weights{};
        Result<Value> v = Value{};
        {
            const testing_environments::Changed changed(e);
            w = barycentric_weights(c.simplex, c.vertices.data(), c.point.data());
            v = interpolate(c.simplex, c.vertices.data(), c.point.data(), std::array{1.0, -2.0, 9.0}.data());
        }
        EXPECT_EQ(std::bit_cast<std::uint64_t>(w->weights[2]), 0U) << e.name;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(v->value), 0U) << e.name;
    }
}

}  // namespace
}  // namespace barycert
