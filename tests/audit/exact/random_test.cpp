// The oracle against the second path on many thousand cases of every kind.
#include <map>

#include "tests/audit/exact/checks.hpp"

namespace barycert::exact {
namespace {

using namespace testing_cases;

class RandomCases : public ::testing::TestWithParam<Kind> {};

TEST_P(RandomCases, EqualTheSecondPath) {
    const Kind kind = GetParam();
    // Numbers of two thousand bits are slow in rationals.
    const bool slow = kind == Kind::bit_patterns;
    const int count = slow ? 600 : 2000;
    for (const Simplex simplex : all_simplices) {
        std::map<Region, int> regions;
        for (int k = 0; k < count; ++k) {
            base::Random r = base::Random::stream(1, base::hash64(name(kind)) + static_cast<std::uint64_t>(simplex),
                                                  static_cast<std::uint64_t>(k));
            ++regions[check(random_case(r, simplex, kind)).region];
            ASSERT_FALSE(HasFailure()) << name(kind) << ", case " << k;
        }
        // The generator must reach what it is there for.
        EXPECT_GT(regions[Region::degenerate], 0);
        EXPECT_GT(regions[Region::boundary], 0);
        EXPECT_GT(regions[Region::outside], 0);
        EXPECT_GT(regions[Region::interior], 0) << name(simplex) << ' ' << name(kind);
    }
}

INSTANTIATE_TEST_SUITE_P(, RandomCases, ::testing::ValuesIn(all_kinds), [](const auto& kind) {
    std::string text{name(kind.param)};
    for (char& c : text) {
        if (c == ' ') c = '_';
    }
    return text;
});

// Simplices with vertices in {0, 1}^3, every point of a lattice of quarters around it:
// catches a wrong region, feature or support bit wherever random cases might miss a combination.
TEST(Lattice, AllPointsAboutUnitSimplices) {
    std::map<Feature, int> features;
    for (const Simplex simplex : all_simplices) {
        base::Random r = base::Random::stream(1, base::hash64("lattice"), static_cast<std::uint64_t>(simplex));
        for (int k = 0; k < 5; ++k) {
            Case c;
            c.simplex = simplex;
            for (double& x : c.vertices) x = r.integer(0, 1);
            for (double& f : c.values) f = r.integer(-3, 3);
            const int depth = space_dimension(simplex) == 3 ? 5 : 0;
            for (int x = -1; x <= 5; ++x) {
                for (int y = -1; y <= 5; ++y) {
                    for (int z = -(depth != 0); z <= depth; ++z) {
                        c.point = {x / 4.0, y / 4.0, z / 4.0};
                        ++features[check(c).feature];
                    }
                }
            }
            ASSERT_FALSE(HasFailure());
        }
    }
    EXPECT_EQ(features.size(), 6U);
}

}  // namespace
}  // namespace barycert::exact
