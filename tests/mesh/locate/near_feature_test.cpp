// The nearest feature of a cell is found whatever is tried first.
#include "mesh/locate/near_feature.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"

namespace barycert::testing {
namespace {

TEST(NearFeature, DoesNotDependOnTheGuess) {
    base::Random random(1);
    std::array<std::size_t, 4> found{};
    for (int i = 0; i < 4000; ++i) {
        locate::NearCell cell{.count = i % 2 == 0 ? 3 : 4};
        for (int n = 0; n < cell.count; ++n) {
            const auto at = static_cast<std::size_t>(n);
            cell.nodes[at] = 10 * n;
            for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(cell.count); ++k)
                cell.at[at][k] = random.integer(-4, 4);
        }
        locate::Point3 p{};
        for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(cell.count); ++k) p[k] = random.integer(-6, 6);
        locate::NearFeature first;
        if (!locate::nearest_feature(cell, p, 1, first)) continue;
        ++found[static_cast<std::size_t>(first.nodes[0] < 0 ? 0 : first.count)];
        for (unsigned guess = 2; guess + 1 < 1U << cell.count; ++guess) {
            locate::NearFeature other;
            ASSERT_TRUE(locate::nearest_feature(cell, p, guess, other));
            EXPECT_EQ(other.count, first.count) << guess;
            EXPECT_EQ(other.nodes, first.nodes) << guess;
        }
    }
    for (const std::size_t count : found) EXPECT_GT(count, 50U);
}

}  // namespace
}  // namespace barycert::testing
