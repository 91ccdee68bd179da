// Interpolation along auxiliary lines is barycentric interpolation: never refuted, and undefined only where said.
#include "barycert/oracle.hpp"

#include <algorithm>

#include "tests/audit/exact/checks.hpp"

namespace barycert::exact {
namespace {

using namespace testing_cases;
using second_path::Q;

bool any_two_equal(std::vector<Q> x) {
    std::sort(x.begin(), x.end());
    return std::adjacent_find(x.begin(), x.end()) != x.end();
}

/// The triangle has no apex from which the line level with the point meets two sides in two points.
bool bilinear_must_be_undefined(const Case& c) {
    if (!second_path::weights(c)) return true;
    for (int i = 0; i < 3; ++i) {
        const double apex = c.vertex(i, 1);
        if (apex != c.vertex((i + 1) % 3, 1) && apex != c.vertex((i + 2) % 3, 1) && apex != c.point[1]) return false;
    }
    return true;
}

/// Two vertices or a vertex and the point level in z, or two edges that meet the point's level with equal y.
bool has_coincidence(const Case& c) {
    std::vector<Q> z{Q(c.point[2])};
    for (int i = 0; i < 4; ++i) z.emplace_back(c.vertex(i, 2));
    if (any_two_equal(z)) return true;
    std::vector<Q> y;
    for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) {
            const Q t = (z[0] - Q(c.vertex(i, 2))) / (Q(c.vertex(j, 2)) - Q(c.vertex(i, 2)));
            y.emplace_back(Q(c.vertex(i, 1)) + t * (Q(c.vertex(j, 1)) - Q(c.vertex(i, 1))));
        }
    }
    y.emplace_back(c.point[1]);
    return any_two_equal(y);
}

// Catches an apex that is tried too few: undefined is then said where another apex serves.
TEST(Bilinear, HoldsWhereverItIsDefined) {
    for (const Kind kind : all_kinds) {
        int holds = 0;
        for (int k = 0; k < (kind == Kind::bit_patterns ? 60 : 800); ++k) {
            base::Random r = base::Random::stream(1, base::hash64("bilinear") + base::hash64(name(kind)),
                                                  static_cast<std::uint64_t>(k));
            const Case c = random_case(r, Simplex::triangle, kind);
            const IdentityVerdict found = bilinear_is_barycentric(c);
            ASSERT_EQ(found, bilinear_must_be_undefined(c) ? IdentityVerdict::undefined : IdentityVerdict::holds)
                << describe(c);
            holds += found == IdentityVerdict::holds ? 1 : 0;
        }
        EXPECT_GT(holds, 50) << name(kind);
    }
}

TEST(Bilinear, SpecialPositions) {
    const auto identity = [](std::array<double, 12> v, std::array<double, 3> p) {
        return bilinear_is_barycentric({Simplex::triangle, v, p, {}});
    };
    EXPECT_EQ(identity({0, 0, 3, 1, 1, 4}, {1, 1}), IdentityVerdict::holds);
    EXPECT_EQ(identity({0, 0, 3, 1, 1, 4}, {9, 0}), IdentityVerdict::holds);  // level with one vertex only
    EXPECT_EQ(identity({0, 0, 3, 0, 0, 3}, {1, 1}), IdentityVerdict::holds);  // one side level: the other apex serves
    EXPECT_EQ(identity({0, 0, 3, 0, 0, 3}, {1, 3}), IdentityVerdict::undefined);  // and the point level with that apex
    EXPECT_EQ(identity({0, 0, 3, 0, 0, 3}, {1, 0}), IdentityVerdict::holds);      // on the level side
    EXPECT_EQ(identity({0, 0, 1, 1, 2, 2}, {1, 0}), IdentityVerdict::undefined);  // degenerate
    EXPECT_EQ(identity({5, 5, 5, 5, 5, 5}, {5, 5}), IdentityVerdict::undefined);
}

TEST(Trilinear, NeverFailsAndHoldsInGeneralPosition) {
    for (const Kind kind : all_kinds) {
        int holds = 0;
        for (int k = 0; k < (kind == Kind::bit_patterns ? 30 : 250); ++k) {
            base::Random r = base::Random::stream(1, base::hash64("trilinear") + base::hash64(name(kind)),
                                                  static_cast<std::uint64_t>(k));
            const Case c = random_case(r, Simplex::tetrahedron, kind);
            const IdentityVerdict found = trilinear_is_barycentric(c);
            ASSERT_NE(found, IdentityVerdict::fails) << describe(c);
            if (!second_path::weights(c)) {
                ASSERT_EQ(found, IdentityVerdict::undefined) << describe(c);
            } else if (!has_coincidence(c)) {
                ASSERT_EQ(found, IdentityVerdict::holds) << describe(c);
            }
            holds += found == IdentityVerdict::holds ? 1 : 0;
        }
        EXPECT_GT(holds, 10) << name(kind);
    }
}

TEST(Trilinear, SpecialPositions) {
    const auto identity = [](std::array<double, 12> v, std::array<double, 3> p) {
        return trilinear_is_barycentric({Simplex::tetrahedron, v, p, {}});
    };
    const std::array<double, 12> corner{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    EXPECT_EQ(identity(corner, {0.25, 0.25, 0.25}), IdentityVerdict::holds);   // a level face: only one apex serves
    EXPECT_EQ(identity(corner, {0.25, 0.25, 1}), IdentityVerdict::undefined);  // level with that apex
    EXPECT_EQ(identity(corner, {7, -9, 11}), IdentityVerdict::holds);          // far outside
    // Two pairs of level vertices: no apex has three edges that cross levels.
    EXPECT_EQ(identity({0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1}, {0.5, 0.5, 0.5}), IdentityVerdict::undefined);
    EXPECT_EQ(identity({0, 0, 0, 1, 0, 1, 0, 1, 2, 1, 1, 3}, {0.5, 0.5, 0.5}), IdentityVerdict::undefined);  // coplanar
}

}  // namespace
}  // namespace barycert::exact
