// Quadratic fields in batches: the values of single calls on every target, tiers, counts, errors.
#include "barycert/environment.hpp"
#include "tests/core/environments.hpp"
#include "tests/core/quadratic_cases.hpp"

namespace barycert {
namespace {

using testing_cases::all_kinds;
using testing_cases::Kind;
using testing_cases::random_case;
using testing_environments::Columns;
using testing_fields::expect_as_oracle;
using testing_fields::full;
using testing_fields::QuadraticCase;
using testing_fields::stretched_case;
using testing_fields::value_of;
using testing_fields::with_mids;
using testing_rational::bits;
using testing_rational::infinity;

/// A mesh of the cells of cases, each with nodes of its own, mid-edge nodes behind all corners.
struct QuadraticMesh {
    Columns columns;
    std::size_t n, m, count, stride;
    std::vector<std::int32_t> mid_nodes;
    std::vector<double> values;

    QuadraticMesh(Simplex s, const std::vector<QuadraticCase>& cases, int components, base::Random& r)
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

    Status ask(std::vector<double>& out, TierCounts* tiers, Rounding rounding = Rounding::correct) const {
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

TEST(QuadraticBatch, IsSingleCallsOnEveryTarget) {
    for (const Simplex s : full) {
        for (const std::size_t count : std::array<std::size_t, 10>{0, 1, 2, 7, 8, 9, 127, 128, 129, 300}) {
            for (const int components : {1, 2, 3}) {
                base::Random r =
                    base::Random::stream(35, base::hash64("batch"), 10 * count + static_cast<std::size_t>(components));
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
                TierCounts expected;
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
                    TierCounts tiers;
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

// Within and beyond the ranges of the double-double tier, where products and their remainders under- and overflow:
// right on every target, and by the same tiers.
TEST(QuadraticBatch, EndsOfTheRanges) {
    for (const Simplex s : full) {
        base::Random r = base::Random::stream(35, base::hash64("ranges"), 0);
        std::vector<QuadraticCase> cases;
        for (int j = 0; j < 4000; ++j) {
            QuadraticCase q = stretched_case(r, s, 3);
            const int ends[] = {-800, 0, 700, 890, 990};
            const int shift = ends[r.below(5)] + r.integer(-30, 20), far = r.coin() ? 0 : r.integer(0, 120);
            for (double& f : q.linear.values) f = std::ldexp(f, shift);
            for (double& f : q.mids) f = std::ldexp(f, shift);
            for (double& x : q.linear.point) x = std::ldexp(x, far);
            cases.push_back(q);
        }
        const QuadraticMesh mesh(s, cases, 1, r);
        TierCounts first;
        for (const std::string& target : simd_targets()) {
            ASSERT_TRUE(use_simd_target(target));
            std::vector<double> out;
            TierCounts tiers;
            ASSERT_TRUE(mesh.ask(out, &tiers));
            if (first.cases() == 0) first = tiers;
            EXPECT_EQ(tiers, first) << target;
            for (std::size_t j = 0; j < cases.size() && !HasFailure(); ++j)
                expect_as_oracle(cases[j], {.value = out[j], .degenerate = std::isnan(out[j])});
        }
        use_simd_target("");
        EXPECT_GT(first.double_double, 500U) << name(s);
        EXPECT_GT(first.exact, 1000U) << name(s);
    }
}

TEST(QuadraticTiers, OrdinaryCellsNeedDoubleDoubleAlone) {
    for (const Simplex s : full) {
        base::Random r = base::Random::stream(35, base::hash64("ordinary"), 0);
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
        TierCounts tiers, none;
        ASSERT_TRUE(mesh.ask(out, &tiers));
        EXPECT_LE(tiers.exact, 20U) << name(s);
        EXPECT_EQ(tiers.cases(), cases.size());
        // Plain rounding is near, and counts nothing.
        ASSERT_TRUE(mesh.ask(plain, &none, Rounding::plain));
        EXPECT_EQ(none, TierCounts{});
        std::size_t near = 0, same = 0;
        for (std::size_t j = 0; j < out.size(); ++j) {
            near += std::fabs(plain[j] - out[j]) <= 1e-10 * (1 + std::fabs(out[j])) ? 1 : 0;
            same += plain[j] == out[j] ? 1 : 0;
        }
        EXPECT_GT(near, 19000U);
        EXPECT_LT(same, 15000U);  // it is not the correct one under another name
    }
}

TEST(QuadraticTiers, OutOfRangeNeedsIntegers) {
    base::Random r = base::Random::stream(35, base::hash64("range"), 0);
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

TEST(QuadraticBatch, DegenerateAndNotFiniteAreCounted) {
    for (const Simplex s : full) {
        base::Random r = base::Random::stream(35, base::hash64("counted"), 0);
        std::vector<QuadraticCase> cases;
        for (int j = 0; j < 20; ++j) cases.push_back(stretched_case(r, s, 0));
        for (int k = 0; k < space_dimension(s); ++k) cases[3].linear.vertex(0, k) = cases[3].linear.vertex(1, k);
        QuadraticMesh mesh(s, cases, 2, r);
        mesh.values[2 * mesh.node(5, 2)] = infinity;               // component 0, a corner
        mesh.values[2 * mesh.node(7, mesh.n) + 1] = std::nan("");  // component 1, amid an edge
        mesh.values[2 * mesh.node(3, 1)] = -infinity;              // of the degenerate one
        std::vector<double> out;
        TierCounts tiers;
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

TEST(QuadraticBatch, ErrorsAreTold) {
    const std::array<double, 6> v{0, 0, 1, 0, 0, 1};
    const std::array<double, 2> p{0.25, 0.25};
    const std::array<double, 6> f{0, 1, 2, 3, 4, 5};
    const std::array<std::int32_t, 3> corners{0, 1, 2}, mids{3, 4, 5};
    const std::array<std::int32_t, 1> cells{0};
    std::array<double, 1> out{};
    TierCounts tiers;
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
        EXPECT_EQ(what(mids, 1, out), "unsupported simplex for quadratic interpolation");
        EXPECT_FALSE(interpolate_quadratic(s, v.data(), p.data(), f.data()));
    }
    const std::array<double, 2> far{0.25, infinity};
    q = {Simplex::triangle, v, corners, cells, far};
    EXPECT_EQ(what(mids, 1, out), "case 0: coordinate 1 of the point");
    EXPECT_EQ(interpolate_quadratic(Simplex::triangle, v.data(), far.data(), f.data()).error().what,
              "coordinate 1 of the point");
    EXPECT_EQ(tiers.cases(), 1U);
}

}  // namespace
}  // namespace barycert
