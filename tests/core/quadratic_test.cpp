// Laws V1, V2 and D1 of quadratic fields: against the oracle and against exact rationals rounded by the definition.
#include "barycert/core/quadratic.hpp"

#include "barycert/core/simd.hpp"
#include "barycert/exact/quadratic.hpp"
#include "core/environments.hpp"
#include "core/field_cases.hpp"
#include "core/rational.hpp"

namespace barycert {
namespace {

using testing_cases::all_kinds;
using testing_cases::Kind;
using testing_cases::random_case;
using testing_environments::Columns;
using testing_fields::edge;
using testing_fields::QuadraticCase;
using testing_fields::stretched_cell;
using testing_rational::any_finite;
using testing_rational::bits;
using testing_rational::infinity;
using testing_rational::largest;
using testing_rational::nearest;

constexpr std::array<Simplex, 2> full{Simplex::triangle, Simplex::tetrahedron};
constexpr double tiny = 0x1p-1074;

Value value_of(const QuadraticCase& q) {
    const Case& c = q.linear;
    return interpolate_quadratic(c.simplex, c.vertices.data(), c.point.data(), q.nodal().data()).value();
}

void expect_as_oracle(const QuadraticCase& q, const Value& v) {
    const double exact = exact::quadratic_value(q.linear, q.mids);
    ASSERT_EQ(v.degenerate, std::isnan(exact)) << describe(q);
    if (v.degenerate) {
        EXPECT_TRUE(std::isnan(v.value));
    } else {
        EXPECT_EQ(bits(v.value), bits(exact)) << hexadecimal(v.value) << ' ' << hexadecimal(exact) << describe(q);
    }
}

void expect_law(const QuadraticCase& q) {
    const Value v = value_of(q);
    expect_as_oracle(q, v);
    const auto exact = testing_fields::exact_quadratic(q);
    ASSERT_EQ(v.degenerate, !exact) << describe(q);
    if (exact) {
        EXPECT_TRUE(nearest(v.value, *exact)) << describe(q);
    }
}

QuadraticCase with_mids(Random& r, const Case& c, Kind kind) {
    QuadraticCase q{c, {}};
    const Kind of_mids = r.coin() ? kind : Kind::ordinary;
    for (int e = 0; e < mid_node_count(c.simplex); ++e) q.mids.push_back(testing_cases::number(r, of_mids, 0));
    return q;
}

QuadraticCase stretched_case(Random& r, Simplex s, int flattest) {
    QuadraticCase q{stretched_cell(r, s, flattest), {}};
    for (int e = 0; e < mid_node_count(s); ++e) q.mids.push_back(testing_fields::nodal_value(r));
    return q;
}

TEST(LawV1Quadratic, every_kind_of_number) {
    for (const Simplex s : full) {
        for (const Kind kind : all_kinds) {
            for (std::uint64_t k = 0; k < 400 && !HasFailure(); ++k) {
                Random r = Random::stream(32, hash64("quadratic"), k);
                const Case c = random_case(r, s, kind);
                expect_law(with_mids(r, c, kind));
            }
        }
    }
}

// Where double-double works hardest, inside and outside of the cell; most are decided there.
TEST(LawV1Quadratic, flat_cells_far_from_the_origin) {
    for (const Simplex s : full) {
        std::uint64_t easy = 0;
        for (std::uint64_t k = 0; k < 6000 && !HasFailure(); ++k) {
            Random r = Random::stream(32, hash64("flat quadratic"), k);
            const QuadraticCase q = stretched_case(r, s, 46);
            const Value v = value_of(q);
            easy += v.tier == Tier::double_double ? 1 : 0;
            expect_as_oracle(q, v);
        }
        EXPECT_GT(easy, 3500U) << name(s);
    }
}

TEST(LawV1Quadratic, far_outside) {
    for (const Simplex s : full) {
        for (std::uint64_t k = 0; k < 1000 && !HasFailure(); ++k) {
            Random r = Random::stream(32, hash64("far outside"), k);
            QuadraticCase q = stretched_case(r, s, 10);
            const double factor = r.scaled(1, 2, 0, 60);
            for (double& x : q.linear.point) x *= factor;
            expect_as_oracle(q, value_of(q));
        }
    }
}

// The widest integers: all 2098 bits of coordinates and values are in use.
TEST(LawV1Quadratic, the_widest_integers) {
    for (const Simplex s : full) {
        for (std::uint64_t k = 0; k < 60 && !HasFailure(); ++k) {
            Random r = Random::stream(32, hash64("widest"), k);
            const auto extreme = [&]() {
                const int how = r.integer(0, 3);
                const double sign = r.coin() ? 1 : -1;
                return how < 2 ? sign * largest : how == 2 ? sign * r.integer(1, 1 << 20) * tiny : any_finite(r);
            };
            QuadraticCase q{Case{.simplex = s}, {}};
            for (double& x : q.linear.vertices) x = extreme();
            for (double& x : q.linear.point) x = extreme();
            for (double& f : q.linear.values) f = extreme();
            for (int e = 0; e < mid_node_count(s); ++e) q.mids.push_back(extreme());
            expect_as_oracle(q, value_of(q));
        }
    }
    // The largest numerators that there are, by their signs.
    QuadraticCase q{Case{.simplex = Simplex::tetrahedron}, {-largest, largest, -largest, largest, -largest, largest}};
    const double x = largest;
    q.linear.vertices = {x, x, -x, x, -x, x, -x, x, x, -x, -x, -x};
    q.linear.point = {-x, x, -tiny};
    q.linear.values = {x, -x, x, tiny};
    expect_law(q);
}

// A quadratic polynomial with short coefficients is given back to the bit, at any point whose value is a double.
TEST(LawV1Quadratic, quadratic_polynomials_are_given_back) {
    for (const Simplex s : full) {
        const int n = vertex_count(s), d = space_dimension(s);
        for (std::uint64_t k = 0; k < 2000; ++k) {
            Random r = Random::stream(33, hash64("polynomial"), k);
            std::array<double, 10> a{};
            for (double& x : a) x = r.integer(-8, 8);
            const auto f = [&](const double* x) {
                const double z = d == 3 ? x[2] : 0;
                return a[0] + a[1] * x[0] + a[2] * x[1] + a[3] * z + a[4] * x[0] * x[0] + a[5] * x[0] * x[1] +
                       a[6] * x[1] * x[1] + a[7] * x[0] * z + a[8] * x[1] * z + a[9] * z * z;
            };
            QuadraticCase q{Case{.simplex = s}, {}};
            Case& c = q.linear;
            for (double& x : c.vertices) x = 2 * r.integer(-500, 500);
            for (double& x : c.point) x = r.integer(-4000, 4000) * 0.25;
            for (int i = 0; i < n; ++i)
                c.values[static_cast<std::size_t>(i)] = f(&c.vertices[static_cast<std::size_t>(d * i)]);
            for (std::size_t e = 0; e < static_cast<std::size_t>(mid_node_count(s)); ++e) {
                const auto [i, j] = edge(e);
                double mid[3] = {};
                for (int m = 0; m < d; ++m) mid[m] = (c.vertex(i, m) + c.vertex(j, m)) / 2;
                q.mids.push_back(f(mid));
            }
            const Value v = value_of(q);
            if (v.degenerate) continue;
            EXPECT_EQ(v.value, f(c.point.data())) << describe(q);
        }
    }
}

// With the mean of its corners amid each edge, exactly, the field is the linear one.
TEST(LawV1Quadratic, is_the_linear_value_where_the_field_is_linear) {
    for (const Simplex s : full) {
        for (std::uint64_t k = 0; k < 1000; ++k) {
            Random r = Random::stream(33, hash64("linear"), k);
            QuadraticCase q{k % 2 == 0 ? stretched_cell(r, s) : random_case(r, s, Kind::lattice), {}};
            Case& c = q.linear;
            for (double& f : c.values) f = r.integer(-1000000, 1000000) * 0x1p-3;
            for (std::size_t e = 0; e < static_cast<std::size_t>(mid_node_count(s)); ++e) {
                const auto [i, j] = edge(e);
                q.mids.push_back((c.values[static_cast<std::size_t>(i)] + c.values[static_cast<std::size_t>(j)]) / 2);
            }
            const Value v = value_of(q);
            const Value linear = interpolate(s, c.vertices.data(), c.point.data(), c.values.data()).value();
            ASSERT_EQ(v.degenerate, linear.degenerate);
            if (!v.degenerate) {
                EXPECT_EQ(bits(v.value), bits(linear.value)) << describe(q);
            }
        }
    }
}

/// A lattice cell whose corners and edge middles are doubles, with nodal values of any kind.
QuadraticCase even_cell(Random& r, Simplex s) {
    QuadraticCase q{Case{.simplex = s}, {}};
    for (double& x : q.linear.vertices) x = 2 * r.integer(-20, 20);
    const bool wild = r.coin();
    for (double& f : q.linear.values) f = wild ? any_finite(r) : testing_fields::nodal_value(r);
    for (int e = 0; e < mid_node_count(s); ++e) q.mids.push_back(wild ? any_finite(r) : testing_fields::nodal_value(r));
    return q;
}

TEST(LawV2Quadratic, nodes_have_their_own_values) {
    for (const Simplex s : full) {
        for (std::uint64_t k = 0; k < 400; ++k) {
            Random r = Random::stream(34, hash64("nodes"), k);
            QuadraticCase q = even_cell(r, s);
            Case& c = q.linear;
            for (int i = 0; i < vertex_count(s); ++i) {
                for (int m = 0; m < space_dimension(s); ++m) c.point[static_cast<std::size_t>(m)] = c.vertex(i, m);
                const Value v = value_of(q);
                if (!v.degenerate) {
                    EXPECT_EQ(bits(v.value), bits(c.values[static_cast<std::size_t>(i)]));
                }
            }
            for (std::size_t e = 0; e < q.mids.size(); ++e) {
                const auto [i, j] = edge(e);
                for (int m = 0; m < space_dimension(s); ++m)
                    c.point[static_cast<std::size_t>(m)] = (c.vertex(i, m) + c.vertex(j, m)) / 2;
                const Value v = value_of(q);
                if (!v.degenerate) {
                    EXPECT_EQ(bits(v.value), bits(q.mids[e]));
                }
            }
        }
    }
}

// Cells on both sides of a facet, corners in different orders, a point of the facet: the same bits, and those of the
// facet's own nodes alone.
TEST(LawV2Quadratic, both_cells_of_a_facet_agree) {
    for (const Simplex s : full) {
        const auto n = static_cast<std::size_t>(vertex_count(s)), d = n - 1;
        std::uint64_t compared = 0, easy = 0;
        for (std::uint64_t k = 0; k < 2000; ++k) {
            Random r = Random::stream(34, hash64("facets"), k);
            const QuadraticCase q = even_cell(r, s);
            QuadraticCase other = even_cell(r, s);
            // Corner i of the other cell is corner order[i] of this one, but the last of this one is not in it.
            std::array<std::size_t, 4> order{0, 1, 2, 3};
            for (std::size_t i = n - 1; i > 0; --i) std::swap(order[i], order[r.below(i + 1)]);
            for (std::size_t i = 0; i < n; ++i) {
                if (order[i] == n - 1) continue;
                other.linear.values[i] = q.linear.values[order[i]];
                for (std::size_t m = 0; m < d; ++m)
                    other.linear.vertices[d * i + m] = q.linear.vertices[d * order[i] + m];
            }
            for (std::size_t e = 0; e < q.mids.size(); ++e) {
                for (std::size_t g = 0; g < q.mids.size(); ++g) {
                    const auto [i, j] = edge(e);
                    const auto [a, b] = edge(g);
                    const std::size_t from = order[static_cast<std::size_t>(i)],
                                      to = order[static_cast<std::size_t>(j)];
                    const bool same = (from == static_cast<std::size_t>(a) && to == static_cast<std::size_t>(b)) ||
                                      (from == static_cast<std::size_t>(b) && to == static_cast<std::size_t>(a));
                    if (same && from != n - 1 && to != n - 1) other.mids[e] = q.mids[g];
                }
            }
            // A point of the facet by weights in sixteenths: exact, as coordinates are small integers.
            int left = 16;
            std::array<double, 3> w{};
            for (std::size_t i = 0; i + 1 < d; ++i) {
                const int part = r.integer(0, left);
                w[i] = part;
                left -= part;
            }
            w[d - 1] = left;
            QuadraticCase here = q;
            for (std::size_t m = 0; m < d; ++m) {
                double p = 0;
                for (std::size_t i = 0; i < d; ++i) p += w[i] / 16 * q.linear.vertices[d * i + m];
                here.linear.point[m] = other.linear.point[m] = p;
            }
            const Value v = value_of(here), u = value_of(other);
            if (v.degenerate || u.degenerate) continue;
            ++compared;
            easy += v.tier == Tier::double_double ? 1 : 0;
            ASSERT_EQ(bits(v.value), bits(u.value)) << describe(here) << describe(other);
        }
        EXPECT_GT(compared, 1800U);
        EXPECT_GT(easy, 300U);
    }
}

TEST(LawV1Quadratic, ties_and_the_ends_of_the_range) {
    // At the middle of edge 12 of the unit triangle's neighbour, l = (1/2, 1/4, 1/4) gives weights of the nodes
    // 0, -1/8, -1/8; 1/2, 1/4, 1/2.
    QuadraticCase q{Case{.simplex = Simplex::triangle}, {0, 0, 0}};
    Case& c = q.linear;
    c.vertices = {0, 0, 4, 0, 0, 4};
    c.point = {1, 1};
    const auto ask = [&](std::array<double, 3> corners, std::vector<double> mids) {
        c.values = {corners[0], corners[1], corners[2], 0};
        q.mids = std::move(mids);
        expect_law(q);
        return value_of(q);
    };
    EXPECT_EQ(ask({5, 8, 0}, {0, 0, 0}).value, -1);
    EXPECT_EQ(ask({5, 0, 0}, {2, 4, 6}).value, 5);
    const double odd = 0x1p-52;
    EXPECT_EQ(ask({0, 0, 0}, {1, 0, 1 + odd}).value, 1);  // a tie
    EXPECT_EQ(ask({0, 0, 0}, {1 + odd, 0, 1 + 2 * odd}).value, 1 + 2 * odd);
    EXPECT_EQ(ask({0, 0, 0}, {1 + odd, 0, 1 + 2 * odd}).tier, Tier::exact);
    EXPECT_EQ(ask({0, 0, 0}, {tiny, 0, 0}).value, 0);
    EXPECT_TRUE(std::signbit(ask({0, 0, 0}, {-tiny, 0, 0}).value));
    EXPECT_EQ(ask({0, 0, 0}, {tiny, 2 * tiny, 0}).value, tiny);
    EXPECT_EQ(ask({0, -largest, -largest}, {largest, largest, largest}).value, infinity);  // 3/2 of the largest
    EXPECT_EQ(ask({0, largest, largest}, {largest, largest, largest}).value, largest);
    EXPECT_EQ(bits(ask({7, -0.0, -0.0}, {-0.0, -0.0, -0.0}).value), 0U);
    EXPECT_EQ(bits(ask({-0.0, -0.0, -0.0}, {-0.0, -0.0, -0.0}).value), 0U);
    EXPECT_EQ(value_of(q).tier, Tier::double_double);
    EXPECT_EQ(ask({1, 2, 3}, {4.1, 5.3, 6.7}).tier, Tier::double_double);
}

/// A mesh of the cells of cases, each with nodes of its own, mid-edge nodes behind all corners.
struct QuadraticMesh {
    Columns columns;
    std::size_t n, m, count, stride;
    std::vector<std::int32_t> mid_nodes;
    std::vector<double> values;

    QuadraticMesh(Simplex s, const std::vector<QuadraticCase>& cases, int components, Random& r)
        : columns(s, linear(cases)),
          n(static_cast<std::size_t>(vertex_count(s))),
          m(static_cast<std::size_t>(mid_node_count(s))),
          count(cases.size()),
          stride(static_cast<std::size_t>(components)),
          values((n + m) * count * stride) {
        for (double& f : values) f = testing_fields::nodal_value(r);
        for (std::size_t j = 0; j < count; ++j) {
            for (std::size_t e = 0; e < m; ++e) mid_nodes.push_back(static_cast<std::int32_t>(n * count + m * j + e));
            const auto f = cases[j].nodal();
            for (std::size_t i = 0; i < n + m; ++i) values[stride * node(j, i)] = f[i];
        }
    }
    static std::vector<Case> linear(const std::vector<QuadraticCase>& cases) {
        std::vector<Case> all;
        for (const QuadraticCase& q : cases) all.push_back(q.linear);
        return all;
    }
    /// Node i of case j, corners first.
    std::size_t node(std::size_t j, std::size_t i) const { return i < n ? n * j + i : n * count + m * j + (i - n); }

    Status ask(std::vector<double>& out, Tiers* tiers, Rounding rounding = Rounding::correct) const {
        out.assign(count * stride, -1);
        return interpolate_quadratic(columns.mesh(), mid_nodes, {values, static_cast<int>(stride)}, out, tiers,
                                     rounding);
    }
    Value single(const Case& c, std::size_t j, std::size_t component) const {
        std::vector<double> f;
        for (std::size_t i = 0; i < n + m; ++i) f.push_back(values[stride * node(j, i) + component]);
        return interpolate_quadratic(c.simplex, c.vertices.data(), c.point.data(), f.data()).value();
    }
};

TEST(QuadraticBatch, is_single_calls_on_every_target) {
    for (const Simplex s : full) {
        for (const std::size_t count : {0, 1, 2, 7, 8, 9, 127, 128, 129, 300}) {
            for (const int components : {1, 2, 3}) {
                Random r = Random::stream(35, hash64("batch"), 10 * count + static_cast<std::size_t>(components));
                std::vector<QuadraticCase> cases;
                for (std::size_t j = 0; j < count; ++j) {
                    const Kind kind = all_kinds[r.below(all_kinds.size())];
                    const bool easy = r.integer(0, 3) != 0;
                    if (easy) {
                        cases.push_back(stretched_case(r, s, 30));
                    } else {
                        const Case c = random_case(r, s, kind);
                        cases.push_back(with_mids(r, c, kind));
                    }
                }
                const QuadraticMesh mesh(s, cases, components, r);
                Tiers expected;
                std::vector<std::uint64_t> words;
                for (std::size_t j = 0; j < count; ++j) {
                    Tier highest = Tier::double_double;
                    bool degenerate = false;
                    for (std::size_t c = 0; c < mesh.stride; ++c) {
                        const Value v = mesh.single(cases[j].linear, j, c);
                        highest = std::max(highest, v.tier);
                        degenerate = v.degenerate;
                        words.push_back(v.degenerate ? 0 : bits(v.value));
                    }
                    expected.add(highest);
                    expected.degenerate += degenerate ? 1 : 0;
                }
                for (const std::string& target : simd_targets()) {
                    ASSERT_TRUE(use_simd_target(target));
                    std::vector<double> out;
                    Tiers tiers;
                    ASSERT_TRUE(mesh.ask(out, &tiers));
                    EXPECT_EQ(tiers, expected) << target;
                    for (std::size_t i = 0; i < out.size(); ++i)
                        EXPECT_EQ(std::isnan(out[i]) ? 0 : bits(out[i]), words[i]) << target << ' ' << i;
                }
                use_simd_target("");
            }
        }
    }
}

TEST(QuadraticTiers, ordinary_cells_need_double_double_alone) {
    for (const Simplex s : full) {
        Random r = Random::stream(35, hash64("ordinary"), 0);
        std::vector<QuadraticCase> cases;
        for (int j = 0; j < 20000; ++j) {
            QuadraticCase q{Case{.simplex = s}, {}};
            for (double& x : q.linear.vertices) x = r.uniform(-1, 1);
            for (double& x : q.linear.point) x = r.uniform(-1, 1);
            for (double& f : q.linear.values) f = r.uniform(-1, 1);
            for (int e = 0; e < mid_node_count(s); ++e) q.mids.push_back(r.uniform(-1, 1));
            cases.push_back(q);
        }
        const QuadraticMesh mesh(s, cases, 1, r);
        std::vector<double> out, plain;
        Tiers tiers, none;
        ASSERT_TRUE(mesh.ask(out, &tiers));
        EXPECT_LE(tiers.exact, 20U) << name(s);
        EXPECT_EQ(tiers.cases(), cases.size());
        // Plain rounding is near, and counts nothing.
        ASSERT_TRUE(mesh.ask(plain, &none, Rounding::plain));
        EXPECT_EQ(none, Tiers{});
        std::size_t near = 0, same = 0;
        for (std::size_t j = 0; j < out.size(); ++j) {
            near += std::fabs(plain[j] - out[j]) <= 1e-10 * (1 + std::fabs(out[j])) ? 1 : 0;
            same += plain[j] == out[j] ? 1 : 0;
        }
        EXPECT_GT(near, 19000U);
        EXPECT_LT(same, 15000U);  // it is not the correct one under another name
    }
}

TEST(QuadraticTiers, out_of_range_needs_integers) {
    Random r = Random::stream(35, hash64("range"), 0);
    for (const Simplex s : full) {
        const QuadraticCase q = stretched_case(r, s, 0);
        ASSERT_EQ(value_of(q).tier, Tier::double_double);
        for (const double scale : {0x1p-810, 0x1p710}) {
            QuadraticCase other = q;
            for (double& f : other.linear.values) f *= scale;
            for (double& f : other.mids) f *= scale;
            EXPECT_EQ(value_of(other).tier, Tier::exact);
            EXPECT_EQ(value_of(other).value, value_of(q).value * scale);
        }
    }
}

TEST(QuadraticBatch, degenerate_and_not_finite_are_counted) {
    for (const Simplex s : full) {
        Random r = Random::stream(35, hash64("counted"), 0);
        std::vector<QuadraticCase> cases;
        for (int j = 0; j < 20; ++j) cases.push_back(stretched_case(r, s, 0));
        for (int k = 0; k < space_dimension(s); ++k) cases[3].linear.vertex(0, k) = cases[3].linear.vertex(1, k);
        QuadraticMesh mesh(s, cases, 2, r);
        mesh.values[2 * mesh.node(5, 2)] = infinity;               // component 0, a corner
        mesh.values[2 * mesh.node(7, mesh.n) + 1] = std::nan("");  // component 1, amid an edge
        mesh.values[2 * mesh.node(3, 1)] = -infinity;              // of the degenerate one
        std::vector<double> out;
        Tiers tiers;
        ASSERT_TRUE(mesh.ask(out, &tiers));
        EXPECT_EQ(tiers.degenerate, 1U);
        EXPECT_EQ(tiers.not_finite, 3U);
        EXPECT_EQ(tiers.exact, 3U);
        EXPECT_EQ(tiers.double_double, 17U);
        for (std::size_t j = 0; j < cases.size(); ++j) {
            for (std::size_t c = 0; c < 2; ++c) {
                const bool bad = j == 3 || (j == 5 && c == 0) || (j == 7 && c == 1);
                EXPECT_EQ(std::isnan(out[2 * j + c]), bad) << j << ' ' << c;
            }
        }
        EXPECT_EQ(bits(out[2 * 5 + 1]), bits(mesh.single(cases[5].linear, 5, 1).value));
        EXPECT_EQ(bits(out[2 * 7]), bits(value_of(cases[7]).value));
        EXPECT_TRUE(std::isnan(mesh.single(cases[5].linear, 5, 0).value));
        EXPECT_FALSE(mesh.single(cases[5].linear, 5, 0).degenerate);
    }
}

TEST(QuadraticBatch, errors_are_told) {
    const std::array<double, 6> v{0, 0, 1, 0, 0, 1};
    const std::array<double, 2> p{0.25, 0.25};
    const std::array<double, 6> f{0, 1, 2, 3, 4, 5};
    const std::array<std::int32_t, 3> corners{0, 1, 2}, mids{3, 4, 5};
    const std::array<std::int32_t, 1> cells{0};
    std::array<double, 1> out{};
    Tiers tiers;
    MeshQueries q{Simplex::triangle, v, corners, cells, p};
    EXPECT_TRUE(interpolate_quadratic(q, mids, {f, 1}, out, &tiers));
    EXPECT_EQ(tiers.cases(), 1U);
    const auto what = [&](std::span<const std::int32_t> mid_nodes, int components, std::span<double> to) {
        const Status status = interpolate_quadratic(q, mid_nodes, {f, components}, to, &tiers);
        return status ? std::string() : status.error().what;
    };
    EXPECT_EQ(what({mids.data(), 2}, 1, out), "number of mid-edge nodes");
    EXPECT_EQ(what({}, 1, out), "number of mid-edge nodes");
    EXPECT_EQ(what(mids, 0, out), "number of components");
    EXPECT_EQ(what(mids, 1, {}), "size of the output");
    q.points = {p.data(), 1};
    EXPECT_EQ(what(mids, 1, out), "size of the points");
    for (const Simplex s : {Simplex::segment, Simplex::triangle3d}) {
        q.simplex = s;
        EXPECT_EQ(what(mids, 1, out), "quadratic interpolation in a simplex that does not fill its space");
        EXPECT_FALSE(interpolate_quadratic(s, v.data(), p.data(), f.data()));
    }
    const std::array<double, 2> far{0.25, infinity};
    q = {Simplex::triangle, v, corners, cells, far};
    EXPECT_EQ(what(mids, 1, out), "case 0: coordinate 1 of the point");
    EXPECT_EQ(interpolate_quadratic(Simplex::triangle, v.data(), far.data(), f.data()).error().what,
              "coordinate 1 of the point");
    EXPECT_EQ(tiers.cases(), 1U);
}

TEST(QuadraticEnvironment, what_could_not_round_is_refused) {
    const std::array<double, 6> v{0, 0, 1, 0, 0, 1};
    const std::array<double, 2> p{0.25, 0.25};
    const std::array<double, 6> f{0, 1, 2, 3, 4, 5};
    const std::array<std::int32_t, 3> corners{0, 1, 2}, mids{3, 4, 5};
    const std::array<std::int32_t, 1> cells{0};
    const MeshQueries q{Simplex::triangle, v, corners, cells, p};
    for (const auto& environment : testing_environments::all_environments()) {
        std::array<double, 1> out{};
        std::string single, batch;
        {
            const testing_environments::Changed changed(environment);
            const auto value = interpolate_quadratic(Simplex::triangle, v.data(), p.data(), f.data());
            const auto status = interpolate_quadratic(q, mids, {f, 1}, out);
            if (!value) single = value.error().found;
            if (!status) batch = status.error().found;
        }
        EXPECT_EQ(single, environment.found) << environment.name;
        EXPECT_EQ(batch, environment.found) << environment.name;
    }
}

}  // namespace
}  // namespace barycert
