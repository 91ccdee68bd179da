// Batches give what single calls give, bit for bit: arrays and meshes, any count, any number of components, doubles and
// floats; and numbers that are none are named.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "barycert/predicates.hpp"
#include "barycert/weights.hpp"
#include "tests/audit/exact/cases.hpp"
#include "tests/core/environments.hpp"
#include "tests/core/rational.hpp"

namespace barycert {
namespace {

using testing_cases::all_kinds;
using testing_cases::describe;
using testing_cases::Kind;
using testing_cases::random_case;
using testing_environments::Columns;
using testing_rational::bits;
using testing_rational::infinity;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<Case> mixed_cases(Simplex s, std::size_t count) {
    std::vector<Case> cases;
    for (std::size_t j = 0; j < count; ++j) {
        base::Random r = base::Random::stream(6, base::hash64("batches"), j);
        cases.push_back(random_case(r, s, all_kinds[j % all_kinds.size()]));
    }
    return cases;
}

void expect_same(double got, double expected, std::size_t j) {
    if (std::isnan(expected)) {
        ASSERT_TRUE(std::isnan(got)) << j;
    } else {
        ASSERT_EQ(bits(got), bits(expected)) << j;
    }
}

// About the width of vectors and of blocks. Catches a tail left out, done twice or with the wrong place to write to.
TEST(LawD1, BatchesGiveTheBitsOfSingleCalls) {
    for (const Simplex s : all_simplices) {
        const auto n = static_cast<std::size_t>(vertex_count(s));
        for (const std::size_t count : {0U, 1U, 2U, 7U, 8U, 9U, 255U, 256U, 257U, 1000U}) {
            const std::vector<Case> cases = mixed_cases(s, count);
            const Columns columns(s, cases);
            std::vector<WeightSigns> signs(count), mesh_signs(count);
            std::vector<double> w(n * count, 0.25), mesh_w(n * count, 0.25), v(count), mesh_v(count);
            TierCounts sign_tiers, w_tiers, v_tiers, one_signs, one_w, one_v;
            ASSERT_TRUE(weight_signs(columns.arrays(), signs, &sign_tiers));
            ASSERT_TRUE(barycentric_weights(columns.arrays(), w, &w_tiers));
            ASSERT_TRUE(interpolate(columns.arrays(), columns.values(), v, &v_tiers));
            for (std::size_t j = 0; j < count; ++j) {
                const Case& c = cases[j];
                ASSERT_EQ(signs[j], weight_signs(s, c.vertices.data(), c.point.data(), &one_signs)) << describe(c);
                const Weights single = barycentric_weights(s, c.vertices.data(), c.point.data()).value();
                for (std::size_t i = 0; i < n; ++i) expect_same(w[n * j + i], single.weights[i], j);
                one_w.add(single.tier);
                one_w.degenerate += single.degenerate ? 1 : 0;
                const Value value = interpolate(s, c.vertices.data(), c.point.data(), c.values.data()).value();
                expect_same(v[j], value.value, j);
                one_v.add(value.tier);
                one_v.degenerate += value.degenerate ? 1 : 0;
            }
            EXPECT_EQ(sign_tiers, one_signs);
            EXPECT_EQ(w_tiers, one_w);
            EXPECT_EQ(v_tiers, one_v);
            EXPECT_EQ(sign_tiers.cases(), count);
            EXPECT_EQ(w_tiers.cases(), count);
            EXPECT_EQ(v_tiers.cases(), count);

            TierCounts mesh_sign_tiers{.filter = 1000}, mesh_w_tiers,
                mesh_v_tiers;  // counts are added to what is there
            ASSERT_TRUE(weight_signs(columns.mesh(), mesh_signs, &mesh_sign_tiers));
            ASSERT_TRUE(barycentric_weights(columns.mesh(), mesh_w, &mesh_w_tiers));
            ASSERT_TRUE(interpolate(columns.mesh(), columns.nodal_values(), mesh_v, &mesh_v_tiers));
            EXPECT_EQ(mesh_signs, signs);
            for (std::size_t i = 0; i < w.size(); ++i) expect_same(mesh_w[i], w[i], i);
            for (std::size_t i = 0; i < v.size(); ++i) expect_same(mesh_v[i], v[i], i);
            mesh_sign_tiers.filter -= 1000;
            EXPECT_EQ(mesh_sign_tiers, sign_tiers);
            EXPECT_EQ(mesh_w_tiers, w_tiers);
            EXPECT_EQ(mesh_v_tiers, v_tiers);
        }
    }
}

/// Values of `components` numbers, the same at vertex i of every case in both layouts.
template <class T>
struct Components {
    std::vector<T> at[4];
    std::vector<T> nodes;
    int components;

    Components(Simplex s, std::size_t count, int components_) : components(components_) {
        base::Random r(7);
        for (std::size_t j = 0; j < count; ++j) {
            for (int i = 0; i < vertex_count(s); ++i) {
                for (int c = 0; c < components; ++c) {
                    const auto x = static_cast<T>(r.scaled(-1, 1, -20, 20));
                    at[i].push_back(x);
                    nodes.push_back(x);
                }
            }
        }
    }
    ValueArrays<T> arrays() const { return {{at[0].data(), at[1].data(), at[2].data(), at[3].data()}, components}; }
    NodalValues<T> mesh() const { return {nodes, components}; }
};

/// Each component by itself, as a double, in a single call.
template <class T>
void expect_components(Simplex s, int components) {
    constexpr std::size_t count = 300;
    const std::vector<Case> cases = mixed_cases(s, count);
    const Columns columns(s, cases);
    const Components<T> f(s, count, components);
    const auto stride = static_cast<std::size_t>(components);
    std::vector<double> v(stride * count), mesh(stride * count);
    ASSERT_TRUE(interpolate(columns.arrays(), f.arrays(), v));
    ASSERT_TRUE(interpolate(columns.mesh(), f.mesh(), mesh));
    for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t c = 0; c < stride; ++c) {
            double one[4] = {};
            for (int i = 0; i < vertex_count(s); ++i) one[i] = static_cast<double>(f.at[i][stride * j + c]);
            const double expected = interpolate(s, cases[j].vertices.data(), cases[j].point.data(), one).value().value;
            expect_same(v[stride * j + c], expected, j);
            expect_same(mesh[stride * j + c], expected, j);
        }
    }
}

TEST(LawV1, EveryComponentIsTheValueOfItsOwnField) {
    for (const Simplex s : all_simplices) {
        for (const int components : {1, 2, 3, 7}) {
            expect_components<double>(s, components);
            expect_components<float>(s, components);
        }
    }
}

TEST(LawV1, NodalValuesThatAreNoNumbersSpoilTheirComponentAlone) {
    for (const Simplex s : all_simplices) {
        constexpr std::size_t count = 20;
        std::vector<Case> cases(count, Case{.simplex = s});
        base::Random r(1);
        for (Case& c : cases) {
            for (double& x : c.vertices) x = r.uniform(-1, 1);
            for (double& x : c.point) x = r.uniform(-1, 1);
        }
        const Columns columns(s, cases);
        for (const double bad : {nan, infinity, -infinity}) {
            Components<double> f(s, count, 3);
            std::vector<double> before(3 * count), after(3 * count);
            ASSERT_TRUE(interpolate(columns.arrays(), f.arrays(), before));
            const auto last = static_cast<std::size_t>(vertex_count(s) - 1);
            f.at[last][3 * 5 + 1] = f.at[0][3 * 11 + 2] = bad;
            TierCounts tiers;
            ASSERT_TRUE(interpolate(columns.arrays(), f.arrays(), after, &tiers));
            for (std::size_t i = 0; i < after.size(); ++i)
                expect_same(after[i], i == 3 * 5 + 1 || i == 3 * 11 + 2 ? nan : before[i], i);
            EXPECT_EQ(tiers.not_finite, 2U);
            EXPECT_EQ(tiers.cases(), count);
            const double values[4] = {1, bad, 1, 1};
            EXPECT_TRUE(
                std::isnan(interpolate(s, cases[0].vertices.data(), cases[0].point.data(), values).value().value));
        }
    }
}

// TierCounts counts "cases with a nodal value that is NaN or infinite", whatever else is wrong with them.
TEST(LawV1, NodalValuesThatAreNoNumbersAreCountedInDegenerateCellsToo) {
    const std::vector<Case> cases(3, Case{.simplex = Simplex::triangle, .values = {1, nan, 2}});
    const Columns columns(Simplex::triangle, cases);
    std::vector<double> v(3);
    TierCounts tiers;
    ASSERT_TRUE(interpolate(columns.arrays(), columns.values(), v, &tiers));
    EXPECT_EQ(tiers, (TierCounts{.exact = 3, .degenerate = 3, .not_finite = 3}));
}

/// `bad` in place `place` of case `number`: coordinates of the vertices, then of the point.
void expect_named(Simplex s, std::size_t number, int place, double bad) {
    constexpr std::size_t count = 300;
    std::vector<Case> cases = mixed_cases(s, count);
    const int d = space_dimension(s), n = vertex_count(s);
    Case& c = cases[number];
    (place < n * d ? c.vertex(place / d, place % d) : c.point[static_cast<std::size_t>(place - n * d)]) = bad;
    const std::string coordinate = "coordinate " + std::to_string(place % d) +
                                   (place < n * d ? " of vertex " + std::to_string(place / d) : " of the point");
    const Columns columns(s, cases);
    std::vector<WeightSigns> signs(count);
    std::vector<double> w(count * 4), v(count);
    const std::span<double> weights(w.data(), count * static_cast<std::size_t>(n));
    for (const Status& status :
         {weight_signs(columns.arrays(), signs), weight_signs(columns.mesh(), signs),
          barycentric_weights(columns.arrays(), weights), barycentric_weights(columns.mesh(), weights),
          interpolate(columns.arrays(), columns.values(), v), interpolate(columns.mesh(), columns.nodal_values(), v)}) {
        ASSERT_FALSE(status) << coordinate;
        EXPECT_EQ(status.error().what, "case " + std::to_string(number) + ": " + coordinate);
        EXPECT_EQ(status.error().expected, "a finite number");
    }
    const auto signs_alone = checked_weight_signs(s, c.vertices.data(), c.point.data());
    const auto weights_alone = barycentric_weights(s, c.vertices.data(), c.point.data());
    const auto value_alone = interpolate(s, c.vertices.data(), c.point.data(), c.values.data());
    ASSERT_FALSE(signs_alone || weights_alone || value_alone);
    EXPECT_EQ(signs_alone.error().what, coordinate);
    EXPECT_EQ(weights_alone.error().what, coordinate);
    EXPECT_EQ(value_alone.error().what, coordinate);
}

// Every place, in the first lane, a middle one, the last of a block and in the tail. On lanes a minimum or maximum may
// drop a NaN: catches a bound that forgets it.
TEST(LawE, NoSignWeightOrValueOfWhatIsNoNumber) {
    for (const Simplex s : all_simplices) {
        const int places = space_dimension(s) * (vertex_count(s) + 1);
        for (int place = 0; place < places; ++place) {
            for (const double bad : {nan, -nan, infinity, -infinity}) {
                for (const std::size_t number : {0U, 5U, 255U, 299U}) expect_named(s, number, place, bad);
            }
        }
    }
}

TEST(LawE, OrientationsOfWhatIsNoNumber) {
    for (std::size_t place = 0; place < 12; ++place) {
        for (const double bad : {nan, infinity, -infinity}) {
            std::array<double, 12> v{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
            v[place] = bad;
            const auto three = checked_orient3d(v.data(), v.data() + 3, v.data() + 6, v.data() + 9);
            ASSERT_FALSE(three);
            EXPECT_EQ(three.error().what,
                      "coordinate " + std::to_string(place % 3) + " of point " + std::to_string(place / 3));
            if (place >= 6) continue;
            std::array<double, 6> t{0, 0, 1, 0, 0, 1};
            t[place] = bad;
            const auto two = checked_orient2d(t.data(), t.data() + 2, t.data() + 4);
            ASSERT_FALSE(two);
            EXPECT_EQ(two.error().what,
                      "coordinate " + std::to_string(place % 2) + " of point " + std::to_string(place / 2));
        }
    }
}

/// A tetrahedron of size 1 in the corner, or its lower-dimensional part, the point within.
Case corner(Simplex s) {
    Case c{
        .simplex = s, .vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, .point = {.1, .2, .3}, .values = {1, 2, 3, 5}};
    if (s == Simplex::triangle) c.vertices = {0, 0, 1, 0, 0, 1};
    return c;
}

// Volumes of this cell: each coordinate below 1, so that each of at most 3 numerators' terms and d are off by at most
// 8 u; four products with values up to 5, three sums, one division: below 60 u relative to values of at least 1.
TEST(Plain, IsNearOnGoodCells) {
    for (const Simplex s : all_simplices) {
        const std::vector<Case> cases(33, corner(s));
        const Columns columns(s, cases);
        std::vector<double> plain(33), right(33);
        TierCounts tiers;
        ASSERT_TRUE(interpolate(columns.arrays(), columns.values(), plain, &tiers, Rounding::plain));
        ASSERT_TRUE(interpolate(columns.arrays(), columns.values(), right));
        EXPECT_EQ(tiers.cases(), 0U);
        for (std::size_t j = 0; j < 33; ++j) EXPECT_NEAR(plain[j], right[j], 60 * 0x1p-53 * right[j]) << name(s);
        ASSERT_TRUE(interpolate(columns.mesh(), columns.nodal_values(), plain, nullptr, Rounding::plain));
        for (std::size_t j = 0; j < 33; ++j) EXPECT_NEAR(plain[j], right[j], 60 * 0x1p-53 * right[j]) << name(s);
    }
}

// Degenerate cells, and finite coordinates whose differences overflow, give NaN or infinity: many of them in a block.
// Catches a list of undecided cases written past its end, as nothing here reads it.
TEST(Plain, GivesNoNumberWhereThereIsNone) {
    for (const Simplex s : all_simplices) {
        for (const double size : {0.0, 1.7e308}) {
            std::vector<Case> cases(600, corner(s));
            for (Case& c : cases) {
                for (double& x : c.vertices) x = x == 0 ? -size : size;
                c.point = {size, -size, size};
            }
            const Columns columns(s, cases);
            std::vector<double> v(600, 1);
            ASSERT_TRUE(interpolate(columns.arrays(), columns.values(), v, nullptr, Rounding::plain));
            for (const double x : v) {
                ASSERT_FALSE(std::isfinite(x)) << name(s) << ' ' << size;
                // One NaN, whatever the processor and the compiler would make of infinity less infinity.
                if (std::isnan(x)) {
                    ASSERT_EQ(std::bit_cast<std::uint64_t>(x), 0x7ff8000000000000U) << name(s) << ' ' << size;
                }
            }
        }
    }
}

// Nothing is written where the sizes do not fit: catches a check left out of one of the six batches.
TEST(Batches, SizesThatDoNotFitAreAnError) {
    const std::vector<Case> cases = mixed_cases(Simplex::triangle, 4);
    const Columns columns(Simplex::triangle, cases);
    const CaseArrays arrays = columns.arrays();
    const std::vector<double> nodes{0, 0, 1, 0, 0, 1}, points{0.25, 0.25, 0.5, 0.25}, odd_points{0.25, 0.25, 0.5};
    const std::vector<std::int32_t> corners{0, 1, 2}, cells{0, 0};
    const MeshQueries queries{Simplex::triangle, nodes, corners, cells, points};
    const MeshQueries odd{Simplex::triangle, nodes, corners, cells, odd_points};
    for (const std::size_t wrong : {0U, 3U, 5U}) {
        std::vector<WeightSigns> signs(wrong);
        std::vector<double> w(3 * wrong), v(wrong);
        const Status statuses[] = {weight_signs(arrays, signs),
                                   weight_signs(queries, signs),
                                   barycentric_weights(arrays, w),
                                   barycentric_weights(queries, w),
                                   interpolate(arrays, columns.values(), v),
                                   interpolate(queries, NodalValues<double>{nodes}, v)};
        for (const Status& status : statuses) {
            ASSERT_FALSE(status);
            EXPECT_EQ(status.error().what, "size of the output");
        }
    }
    std::vector<WeightSigns> signs(2);
    ASSERT_FALSE(weight_signs(odd, signs));
    EXPECT_EQ(weight_signs(odd, signs).error().message(),
              "size of the points: expected 2 coordinates for each of 2 queries, found 3");
    std::vector<double> v(2);
    const Status none = interpolate(queries, NodalValues<double>{nodes, 0}, v);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message(), "number of components: expected at least 1, found 0");
}

}  // namespace
}  // namespace barycert
