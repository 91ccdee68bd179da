// Few boxes in place of many.

#include "mesh/pieces/piece.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/base/random.hpp"

namespace barycert::testing {
namespace {

using pieces::Box;

Box random_box(base::Random& random, double unit) {
    Box box = pieces::empty_box;
    for (int corner = 0; corner < 2; ++corner) {
        std::array<double, 3> x{};
        // On a lattice, so that many sides coincide.
        for (double& c : x) c = unit * static_cast<double>(random.below(9));
        box.add({x, x});
    }
    return box;
}

TEST(Cover, HoldsAllBoxesInAtMostSoMany) {
    base::Random random(3);
    for (const std::size_t most : {std::size_t{1}, std::size_t{3}, std::size_t{64}}) {
        // Also as large as doubles are.
        for (const double unit : {1.0, std::numeric_limits<double>::max() / 8}) {
            Box around = pieces::empty_box;
            std::vector<Box> boxes;
            for (int i = 0; i < 1000; ++i) {
                boxes.push_back(random_box(random, unit));
                around.add(boxes.back());
            }
            const std::vector<Box> few = pieces::cover(
                around, boxes.size(), [&](std::size_t i) { return boxes[i]; }, most);
            EXPECT_LE(few.size(), most);
            for (const Box& box : boxes) {
                EXPECT_TRUE(std::any_of(few.begin(), few.end(), [&](const Box& one) {
                    Box both = one;
                    both.add(box);
                    return both.low == one.low && both.high == one.high;
                }));
            }
        }
    }
}

TEST(Cover, OfNothingIsNothing) {
    EXPECT_TRUE(pieces::cover(
                    pieces::empty_box, 0, [](std::size_t) { return pieces::empty_box; }, 4)
                    .empty());
    EXPECT_TRUE(pieces::empty(pieces::empty_box));
    const Box point{{1, 1, 1}, {1, 1, 1}};
    EXPECT_FALSE(pieces::empty(point));
    EXPECT_FALSE(pieces::empty_box.meets(point));
    EXPECT_FALSE(point.meets(pieces::empty_box));
}

}  // namespace
}  // namespace barycert::testing
