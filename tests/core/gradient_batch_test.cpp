// Gradients in batches: those of single calls on every target, tiers, counts, errors.
#include "barycert/environment.hpp"
#include "tests/core/environments.hpp"
#include "tests/core/gradient_cases.hpp"

namespace barycert {
namespace {

using testing_cases::all_kinds;
using testing_cases::Kind;
using testing_cases::random_case;
using testing_environments::Columns;
using testing_fields::expect_as_oracle;
using testing_fields::expect_gradient_law;
using testing_fields::full;
using testing_fields::gradient_in;
using testing_fields::stretched_cell;
using testing_rational::bits;
using testing_rational::infinity;

/// A mesh of the cells of cases, each with nodes of its own, and `components` values a node: those of the case, then
/// others.
struct CellMesh {
    std::vector<Case> cases;
    Columns columns;
    std::vector<double> values;
    int components;

    CellMesh(Simplex s, std::vector<Case> all, int count, base::Random& r)
        : cases(std::move(all)), columns(s, cases), components(count) {
        for (const Case& c : cases) {
            for (int i = 0; i < vertex_count(s); ++i) {
                values.push_back(c.values[static_cast<std::size_t>(i)]);
                for (int m = 1; m < count; ++m) values.push_back(testing_fields::nodal_value(r));
            }
        }
    }
    Status ask(std::vector<double>& out, TierCounts* tiers) const {
        const MeshQueries q = columns.mesh();
        out.assign(cases.size() * static_cast<std::size_t>(components * space_dimension(q.simplex)), -1);
        return gradients(q.simplex, q.nodes, q.corners, {values, components}, out, tiers);
    }
    /// Case j with the values of component m.
    Case at(std::size_t j, int m) const {
        Case c = cases[j];
        const auto n = static_cast<std::size_t>(vertex_count(c.simplex)), count = static_cast<std::size_t>(components);
        for (std::size_t i = 0; i < n; ++i) c.values[i] = values[count * (n * j + i) + static_cast<std::size_t>(m)];
        return c;
    }
};

// Every count around the width of vectors and blocks; every target; the tiers are those of single calls.
TEST(GradientBatch, IsSingleCallsOnEveryTarget) {
    for (const Simplex s : full) {
        const auto d = static_cast<std::size_t>(space_dimension(s));
        for (const std::size_t count : std::array<std::size_t, 10>{0, 1, 2, 7, 8, 9, 127, 128, 129, 300}) {
            for (const int components : {1, 2, 3}) {
                base::Random r =
                    base::Random::stream(23, base::hash64("batch"), 10 * count + static_cast<std::size_t>(components));
                std::vector<Case> cases;
                for (std::size_t j = 0; j < count; ++j) {
                    const Kind kind = all_kinds[r.below(all_kinds.size())];
                    const bool easy = r.integer(0, 3) != 0;
                    cases.push_back(easy ? stretched_cell(r, s) : random_case(r, s, kind));
                }
                const CellMesh mesh(s, cases, components, r);
                TierCounts single;
                std::vector<std::uint64_t> expected;
                for (std::size_t j = 0; j < count; ++j) {
                    Tier highest = Tier::double_double;
                    bool degenerate = false;
                    for (int m = 0; m < components; ++m) {
                        const Gradient g = gradient_in(mesh.at(j, m));
                        highest = std::max(highest, g.tier);
                        degenerate = g.degenerate;
                        for (std::size_t k = 0; k < d; ++k) expected.push_back(g.degenerate ? 0 : bits(g.gradient[k]));
                    }
                    single.add(highest);
                    single.degenerate += degenerate ? 1 : 0;
                }
                for (const std::string& target : simd_targets()) {
                    ASSERT_TRUE(use_simd_target(target));
                    std::vector<double> out;
                    TierCounts tiers;
                    ASSERT_TRUE(mesh.ask(out, &tiers));
                    EXPECT_EQ(tiers, single) << target;
                    ASSERT_EQ(out.size(), expected.size());
                    for (std::size_t i = 0; i < out.size(); ++i)
                        EXPECT_EQ(std::isnan(out[i]) ? 0 : bits(out[i]), expected[i]) << target << ' ' << i;
                }
                use_simd_target("");
            }
        }
    }
}

// Within and beyond the ranges of the double-double tier, where products and their remainders under- and overflow:
// right on every target, and by the same tiers.
TEST(GradientBatch, EndsOfTheRanges) {
    for (const Simplex s : full) {
        const int d = space_dimension(s);
        base::Random r = base::Random::stream(23, base::hash64("ranges"), 0);
        std::vector<Case> cases;
        for (int j = 0; j < 6000; ++j) {
            Case c = stretched_cell(r, s, 3);
            const int long_axis = r.integer(0, d - 1), far = r.coin() ? r.integer(-260, 260) : r.integer(-1000, 960);
            const int others[] = {0, -far / (d - 1), -r.integer(100, 190)}, other = others[r.below(3)];
            for (int k = 0; k < d; ++k) {
                for (int i = 0; i <= d; ++i) c.vertex(i, k) = std::ldexp(c.vertex(i, k), k == long_axis ? far : other);
            }
            const int ends[] = {-500, 0, 900, far - 1060, far + 890, far + 1000};
            const int shift = ends[r.below(6)] + r.integer(-40, 20);
            for (double& f : c.values) f = std::ldexp(f, std::min(shift, 1018));
            bool finite = true;
            for (const double x : c.vertices) finite = finite && std::isfinite(x);
            if (finite) cases.push_back(c);
        }
        const CellMesh mesh(s, cases, 1, r);
        TierCounts first;
        for (const std::string& target : simd_targets()) {
            ASSERT_TRUE(use_simd_target(target));
            std::vector<double> out;
            TierCounts tiers;
            ASSERT_TRUE(mesh.ask(out, &tiers));
            if (first.cases() == 0) first = tiers;
            EXPECT_EQ(tiers, first) << target;
            for (std::size_t j = 0; j < cases.size() && !HasFailure(); ++j) {
                Gradient g;
                for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k)
                    g.gradient[k] = out[static_cast<std::size_t>(d) * j + k];
                g.degenerate = std::isnan(g.gradient[0]);
                expect_as_oracle(cases[j], g);
            }
        }
        use_simd_target("");
        EXPECT_GT(first.double_double, 300U) << name(s);
        EXPECT_GT(first.exact, 1000U) << name(s);
    }
}

TEST(GradientTiers, OrdinaryCellsNeedDoubleDoubleAlone) {
    for (const Simplex s : full) {
        base::Random r = base::Random::stream(23, base::hash64("ordinary"), 0);
        std::vector<Case> cases;
        for (int j = 0; j < 20000; ++j) {
            Case c = random_case(r, s, Kind::ordinary);
            for (std::size_t i = 0; i < 12; ++i) c.vertices[i] = r.uniform(-1, 1);
            for (double& f : c.values) f = r.uniform(-1, 1);
            cases.push_back(c);
        }
        const CellMesh mesh(s, cases, 1, r);
        std::vector<double> out;
        TierCounts tiers;
        ASSERT_TRUE(mesh.ask(out, &tiers));
        EXPECT_LE(tiers.exact, 5U) << name(s);
        EXPECT_EQ(tiers.cases(), cases.size());
    }
}

TEST(GradientTiers, ExactZerosAndWideExponentsNeedIntegers) {
    Case c{.simplex = Simplex::tetrahedron, .values = {1, 2, 1, 1}};
    c.vertices = {0, 0, 0, 1, 0.1, 0.3, 0, 1, 0, 0, 0, 1};
    EXPECT_EQ(gradient_in(c).tier, Tier::exact);  // (1, 0, 0)
    c.values = {1, 2.3, 3.6, 7.7};
    EXPECT_EQ(gradient_in(c).tier, Tier::double_double);
    for (const double scale : {0x1p-520, 0x1p910}) {  // values out of range
        Case scaled = c;
        for (double& f : scaled.values) f *= scale;
        EXPECT_EQ(gradient_in(scaled).tier, Tier::exact);
        expect_gradient_law(scaled);
    }
    for (const double scale : {0x1p-210, 0x1p200}) {  // cells out of range
        Case scaled = c;
        for (double& x : scaled.vertices) x *= scale;
        EXPECT_EQ(gradient_in(scaled).tier, Tier::exact);
        expect_gradient_law(scaled);
    }
}

TEST(GradientBatch, DegenerateAndNotFiniteAreCounted) {
    for (const Simplex s : full) {
        const auto d = static_cast<std::size_t>(space_dimension(s));
        base::Random r = base::Random::stream(23, base::hash64("counted"), 0);
        std::vector<Case> cases;
        for (int j = 0; j < 20; ++j) cases.push_back(stretched_cell(r, s, 0));
        CellMesh mesh(s, cases, 2, r);
        // Cell 3 is degenerate: two corners are one.
        std::vector<std::int32_t> corners(mesh.columns.mesh().corners.begin(), mesh.columns.mesh().corners.end());
        corners[(d + 1) * 3] = corners[(d + 1) * 3 + 1];
        const std::size_t node_5 = static_cast<std::size_t>(corners[(d + 1) * 5 + 2]);
        const std::size_t node_7 = static_cast<std::size_t>(corners[(d + 1) * 7]);
        mesh.values[2 * node_5] = infinity;                                           // component 0 of cell 5
        mesh.values[2 * node_7 + 1] = std::nan("");                                   // component 1 of cell 7
        mesh.values[2 * static_cast<std::size_t>(corners[(d + 1) * 3])] = -infinity;  // of the degenerate one
        std::vector<double> out(cases.size() * d * 2);
        TierCounts tiers;
        const MeshQueries q = mesh.columns.mesh();
        ASSERT_TRUE(gradients(s, q.nodes, corners, {mesh.values, 2}, out, &tiers));
        EXPECT_EQ(tiers.degenerate, 1U);
        EXPECT_EQ(tiers.not_finite, 3U);
        EXPECT_EQ(tiers.exact, 3U);
        EXPECT_EQ(tiers.double_double, 17U);
        for (std::size_t j = 0; j < cases.size(); ++j) {
            for (std::size_t m = 0; m < 2; ++m) {
                const bool bad = j == 3 || (j == 5 && m == 0) || (j == 7 && m == 1);
                for (std::size_t k = 0; k < d; ++k)
                    EXPECT_EQ(std::isnan(out[(2 * j + m) * d + k]), bad) << j << ' ' << m;
                if (j == 5 && m == 1) expect_as_oracle(mesh.at(j, 1), gradient_in(mesh.at(j, 1)));
            }
        }
        // The usable component of a cell with a NaN is right to the bit.
        const auto other = oracle_gradient(mesh.at(5, 1));
        for (std::size_t k = 0; k < d; ++k) EXPECT_EQ(bits(out[(2 * 5 + 1) * d + k]), bits(other.gradient[k]));
        // A single call says the same.
        const Gradient g = gradient_in(mesh.at(5, 0));
        EXPECT_TRUE(std::isnan(g.gradient[0]));
        EXPECT_FALSE(g.degenerate);
    }
}

TEST(GradientBatch, ErrorsAreTold) {
    const std::array<double, 6> v{0, 0, 1, 0, 0, 1};
    const std::array<double, 3> f{0, 1, 2};
    const std::array<std::int32_t, 3> corners{0, 1, 2};
    std::array<double, 2> out{};
    TierCounts tiers;
    const auto ask = [&](Simplex s, std::span<const std::int32_t> cells, int components, std::span<double> to) {
        return gradients(s, v, cells, {f, components}, to, &tiers);
    };
    EXPECT_TRUE(ask(Simplex::triangle, corners, 1, out));
    EXPECT_EQ(tiers.cases(), 1U);
    for (const Simplex s : {Simplex::segment, Simplex::triangle3d}) {
        ASSERT_FALSE(ask(s, corners, 1, out));
        EXPECT_EQ(ask(s, corners, 1, out).error().expected, "triangle or tetrahedron");
        EXPECT_FALSE(gradient(s, v.data(), f.data()));
    }
    EXPECT_EQ(ask(Simplex::triangle, corners, 0, out).error().what, "number of components");
    EXPECT_EQ(ask(Simplex::triangle, {corners.data(), 2}, 1, out).error().what, "size of the corners");
    EXPECT_EQ(ask(Simplex::triangle, corners, 1, {out.data(), 1}).error().what, "size of the output");
    auto spoilt = v;
    spoilt[3] = infinity;
    const auto status = gradients(Simplex::triangle, spoilt, corners, {f, 1}, out, &tiers);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().what, "cell 0: coordinate 1 of vertex 1");
    EXPECT_EQ(gradient(Simplex::triangle, spoilt.data(), f.data()).error().what, "coordinate 1 of vertex 1");
    EXPECT_EQ(tiers.cases(), 1U);  // failures add nothing
}

}  // namespace
}  // namespace barycert
