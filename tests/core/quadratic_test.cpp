// Laws V1 and V2 of quadratic fields: against the oracle and against exact rationals rounded by the definition.
#include "core/exact_tier.hpp"
#include "tests/core/quadratic_cases.hpp"

namespace barycert::core {
namespace {

using testing_cases::all_kinds;
using testing_cases::Kind;
using testing_cases::random_case;
using testing_fields::edge;
using testing_fields::expect_as_oracle;
using testing_fields::expect_law;
using testing_fields::full;
using testing_fields::QuadraticCase;
using testing_fields::stretched_case;
using testing_fields::stretched_cell;
using testing_fields::value_of;
using testing_fields::with_mids;
using testing_rational::any_finite;
using testing_rational::bits;
using testing_rational::infinity;
using testing_rational::max;

constexpr double min_double = 0x1p-1074;

TEST(LawV1Quadratic, EveryKindOfNumber) {
    for (const Simplex s : full) {
        for (const Kind kind : all_kinds) {
            for (std::uint64_t k = 0; k < 400 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(32, base::hash64("quadratic"), k);
                const Case c = random_case(r, s, kind);
                expect_law(with_mids(r, c, kind));
            }
        }
    }
}

// Where double-double works hardest, inside and outside of the cell; most are decided there.
TEST(LawV1Quadratic, FlatCellsFarFromTheOrigin) {
    for (const Simplex s : full) {
        std::uint64_t easy = 0;
        for (std::uint64_t k = 0; k < 6000 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(32, base::hash64("flat quadratic"), k);
            const QuadraticCase q = stretched_case(r, s, 46);
            const Value v = value_of(q);
            easy += v.tier == Tier::double_double ? 1 : 0;
            expect_as_oracle(q, v);
        }
        EXPECT_GT(easy, 3500U) << name(s);
    }
}

TEST(LawV1Quadratic, FarOutside) {
    for (const Simplex s : full) {
        for (std::uint64_t k = 0; k < 1000 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(32, base::hash64("far outside"), k);
            QuadraticCase q = stretched_case(r, s, 10);
            const double factor = r.scaled(1, 2, 0, 60);
            for (double& x : q.linear.point) x *= factor;
            expect_as_oracle(q, value_of(q));
        }
    }
}

// The last tier alone, where integers of one limb give way to two, and two to more.
TEST(LawV1Quadratic, IntegersOfEveryWidth) {
    for (const Simplex s : full) {
        for (const int coordinate_bits : {3, 58, 60, 61, 62, 63, 64, 122, 124, 125, 126, 127, 128, 400}) {
            for (const int value_bits : {3, 59, 60, 61, 62, 63, 64, 122, 123, 124, 125, 126, 128, 900}) {
                for (std::uint64_t k = 0; k < 30 && !HasFailure(); ++k) {
                    base::Random r = base::Random::stream(33, base::hash64("widths"), k);
                    QuadraticCase q{testing_fields::case_of_widths(r, s, coordinate_bits, value_bits), {}};
                    for (int e = 0; e < mid_node_count(s); ++e)
                        q.mids.push_back(testing_fields::of_width(r, value_bits));
                    const Case& c = q.linear;
                    Value v;
                    v.degenerate =
                        !exact_quadratic(s, c.vertices.data(), c.point.data(), q.nodal().data(), 1, &v.value);
                    if (v.degenerate) v.value = std::nan("");
                    expect_as_oracle(q, v);
                }
            }
        }
    }
}

// The widest integers: all 2098 bits of coordinates and values are in use.
TEST(LawV1Quadratic, TheWidestIntegers) {
    for (const Simplex s : full) {
        for (std::uint64_t k = 0; k < 60 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(32, base::hash64("widest"), k);
            const auto extreme = [&]() {
                const int how = r.integer(0, 3);
                const double sign = r.coin() ? 1 : -1;
                return how < 2 ? sign * max : how == 2 ? sign * r.integer(1, 1 << 20) * min_double : any_finite(r);
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
    QuadraticCase q{Case{.simplex = Simplex::tetrahedron}, {-max, max, -max, max, -max, max}};
    const double x = max;
    q.linear.vertices = {x, x, -x, x, -x, x, -x, x, x, -x, -x, -x};
    q.linear.point = {-x, x, -min_double};
    q.linear.values = {x, -x, x, min_double};
    expect_law(q);
}

// A quadratic polynomial with short coefficients is given back to the bit, at any point whose value is a double.
TEST(LawV1Quadratic, QuadraticPolynomialsAreGivenBack) {
    for (const Simplex s : full) {
        const int n = vertex_count(s), d = space_dimension(s);
        for (std::uint64_t k = 0; k < 2000; ++k) {
            base::Random r = base::Random::stream(33, base::hash64("polynomial"), k);
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
TEST(LawV1Quadratic, IsTheLinearValueWhereTheFieldIsLinear) {
    for (const Simplex s : full) {
        for (std::uint64_t k = 0; k < 1000; ++k) {
            base::Random r = base::Random::stream(33, base::hash64("linear"), k);
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
QuadraticCase even_cell(base::Random& r, Simplex s) {
    QuadraticCase q{Case{.simplex = s}, {}};
    for (double& x : q.linear.vertices) x = 2 * r.integer(-20, 20);
    const bool wild = r.coin();
    for (double& f : q.linear.values) f = wild ? any_finite(r) : testing_fields::nodal_value(r);
    for (int e = 0; e < mid_node_count(s); ++e) q.mids.push_back(wild ? any_finite(r) : testing_fields::nodal_value(r));
    return q;
}

TEST(LawV2Quadratic, NodesHaveTheirOwnValues) {
    for (const Simplex s : full) {
        for (std::uint64_t k = 0; k < 400; ++k) {
            base::Random r = base::Random::stream(34, base::hash64("nodes"), k);
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
TEST(LawV2Quadratic, BothCellsOfAFacetAgree) {
    for (const Simplex s : full) {
        const auto n = static_cast<std::size_t>(vertex_count(s)), d = n - 1;
        std::uint64_t compared = 0, easy = 0;
        for (std::uint64_t k = 0; k < 2000; ++k) {
            base::Random r = base::Random::stream(34, base::hash64("facets"), k);
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

TEST(LawV1Quadratic, TiesAndTheEndsOfTheRange) {
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
    EXPECT_EQ(ask({0, 0, 0}, {min_double, 0, 0}).value, 0);
    EXPECT_TRUE(std::signbit(ask({0, 0, 0}, {-min_double, 0, 0}).value));
    EXPECT_EQ(ask({0, 0, 0}, {min_double, 2 * min_double, 0}).value, min_double);
    EXPECT_EQ(ask({0, -max, -max}, {max, max, max}).value, infinity);  // 3/2 of the largest
    EXPECT_EQ(ask({0, max, max}, {max, max, max}).value, max);
    EXPECT_EQ(bits(ask({7, -0.0, -0.0}, {-0.0, -0.0, -0.0}).value), 0U);
    EXPECT_EQ(bits(ask({-0.0, -0.0, -0.0}, {-0.0, -0.0, -0.0}).value), 0U);
    EXPECT_EQ(value_of(q).tier, Tier::double_double);
    EXPECT_EQ(ask({1, 2, 3}, {4.1, 5.3, 6.7}).tier, Tier::double_double);
}

}  // namespace
}  // namespace barycert::core
