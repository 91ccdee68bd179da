#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

#include "barycert/raster.hpp"
#include "core/base/random.hpp"
#include "tests/draw/raster/judge.hpp"

namespace barycert {
namespace {

std::vector<int> counts_of(RasterSize size, const std::vector<Corners>& triangles) {
    std::vector<int> counts(static_cast<std::size_t>(size.width * size.height));
    for (const Corners& t : triangles) {
        std::vector<PixelSpan> spans;
        EXPECT_TRUE(cover_triangle(size, t, spans));
        for (const PixelSpan& s : spans) {
            EXPECT_TRUE(0 <= s.begin && s.begin < s.end && s.end <= size.width && 0 <= s.row && s.row < size.height);
            for (std::int32_t i = s.begin; i < s.end; ++i) ++counts[static_cast<std::size_t>(s.row * size.width + i)];
        }
    }
    return counts;
}

void expect_as_judged(RasterSize size, const Corners& triangle) {
    const std::vector<int> counts = counts_of(size, {triangle});
    for (std::int32_t j = 0; j < size.height; ++j) {
        for (std::int32_t i = 0; i < size.width; ++i)
            ASSERT_EQ(counts[static_cast<std::size_t>(j * size.width + i)], judge_covers(triangle, i, j) ? 1 : 0)
                << "pixel " << i << ' ' << j;
    }
}

double some_ulps(double x, base::Random& random) {
    const auto n = static_cast<int>(random.below(7)) - 3;
    for (int k = 0; k < std::abs(n); ++k) x = std::nextafter(x, n > 0 ? HUGE_VAL : -HUGE_VAL);
    return x;
}

/// Numbers as they hurt: centres, pixel borders, halves of them, some ulps off, anything.
double coordinate(base::Random& random, int side) {
    const double at = static_cast<double>(random.below(static_cast<std::uint64_t>(4 * side + 9))) / 4 - 1;
    switch (random.below(4)) {
        case 0:
            return at;
        case 1:
            return some_ulps(at, random);
        case 2:
            return std::floor(at) + 0.5;
        default:
            return random.uniform(-1, side + 1);
    }
}

TEST(Cover, R1AsTheJudgeSays) {
    base::Random random(1);
    for (int k = 0; k < 3000; ++k) {
        Corners t;
        for (double& x : t) x = coordinate(random, 7);
        expect_as_judged({7, 6}, t);
    }
}

TEST(Cover, R1AnyFiniteCoordinates) {
    base::Random random(2);
    for (int k = 0; k < 2000; ++k) {
        Corners t;
        for (double& x : t) {
            const int exponent = static_cast<int>(random.below(2099)) - 1075;
            x = random.below(3) == 0 ? coordinate(random, 5) : std::ldexp(random.uniform(-1, 1), exponent);
        }
        expect_as_judged({5, 5}, t);
    }
    const double huge = 1.7e308;
    expect_as_judged({4, 4}, {-huge, -huge, huge, huge, -huge, huge});
    expect_as_judged({4, 4}, {-huge, -huge, huge, -huge, 2, huge});
}

/// A square with jittered nodes in a grid: every diagonal at random.
std::vector<Corners> jittered_square(int cells, double size, bool ulps, base::Random& random) {
    std::vector<std::array<double, 2>> nodes;
    const int n = cells + 1;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            std::array<double, 2> at{size * i / cells, size * j / cells};
            for (std::size_t k = 0; k < 2; ++k) {
                const int index = k == 0 ? i : j;
                if (index == 0 || index == cells) continue;
                at[k] = ulps ? some_ulps(at[k], random) : at[k] + random.uniform(-0.3, 0.3) * size / cells;
            }
            nodes.push_back(at);
        }
    }
    std::vector<Corners> triangles;
    const auto add = [&](int a, int b, int c) {
        if (random.below(2) == 0) std::swap(b, c);
        const auto &p = nodes[static_cast<std::size_t>(a)], &q = nodes[static_cast<std::size_t>(b)],
                   &r = nodes[static_cast<std::size_t>(c)];
        triangles.push_back({p[0], p[1], q[0], q[1], r[0], r[1]});
    };
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            const int a = j * n + i, b = a + 1, c = a + n, d = c + 1;
            if (random.below(2) == 0)
                add(a, b, d), add(a, d, c);
            else
                add(a, b, c), add(b, d, c);
        }
    }
    return triangles;
}

TEST(Cover, R1EachPixelOnceInJitteredSquares) {
    base::Random random(3);
    for (int round = 0; round < 60; ++round) {
        const int cells = 1 + static_cast<int>(random.below(12)), side = 1 + static_cast<int>(random.below(40));
        const bool ulps = round % 2 == 0;
        // On the raster's border when ulps: sides and nodes on centres and on pixel borders.
        const double size = ulps ? side + 0.5 * static_cast<double>(random.below(2)) : side;
        const RasterSize raster{side, side};
        const std::vector<int> counts = counts_of(raster, jittered_square(cells, size, ulps, random));
        for (const int count : counts) ASSERT_EQ(count, 1) << "round " << round;
    }
}

TEST(Cover, R1EachPixelOnceInFansOfSlivers) {
    base::Random random(4);
    for (int round = 0; round < 40; ++round) {
        const double side = 24;
        // A fan about an inner point, a pixel's centre in half of the rounds, to many points of the square's border,
        // often next to each other.
        const bool centre = round % 2 == 0;
        const double cx = centre ? 11.5 : random.uniform(1, 23), cy = centre ? 12.5 : random.uniform(1, 23);
        std::vector<double> along{0, side, 2 * side, 3 * side};
        for (int k = 0; k < 200; ++k) {
            const double s =
                random.below(2) == 0 ? static_cast<double>(random.below(192)) / 2 : random.uniform(0, 4 * side);
            along.push_back(s);
            along.push_back(std::min(std::nextafter(s, HUGE_VAL), std::nextafter(4 * side, 0)));
        }
        std::sort(along.begin(), along.end());
        const auto at = [&](double s) -> std::array<double, 2> {
            if (s < side) return {s, 0};
            if (s < 2 * side) return {side, s - side};
            if (s < 3 * side) return {3 * side - s, side};
            return {0, 4 * side - s};
        };
        std::vector<Corners> fan;
        for (std::size_t k = 0; k < along.size(); ++k) {
            const auto a = at(along[k]), b = at(along[(k + 1) % along.size()]);
            fan.push_back({cx, cy, a[0], a[1], b[0], b[1]});
        }
        const std::vector<int> counts = counts_of({24, 24}, fan);
        for (const int count : counts) ASSERT_EQ(count, 1) << "round " << round;
    }
}

TEST(Cover, R1TopAndLeftSides) {
    // A square of two triangles with its sides on centres: left and top belong to it, right and bottom do not.
    const std::vector<int> counts = counts_of({4, 4}, {{0.5, 0.5, 2.5, 0.5, 2.5, 2.5}, {0.5, 0.5, 2.5, 2.5, 0.5, 2.5}});
    const std::vector<int> expected{0, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0};
    EXPECT_EQ(counts, expected);
}

TEST(Cover, R2NothingForZeroArea) {
    base::Random random(5);
    for (int k = 0; k < 500; ++k) {
        // Exactly on a line: a, b and a + 2 (b - a) with small integers; or two equal vertices.
        const auto number = [&] { return static_cast<double>(random.below(64)) / 4; };
        const double ax = number(), ay = number(), bx = number(), by = number();
        std::vector<PixelSpan> spans;
        EXPECT_TRUE(cover_triangle({20, 20}, Corners{ax, ay, bx, by, 2 * bx - ax, 2 * by - ay}, spans));
        EXPECT_TRUE(cover_triangle({20, 20}, Corners{ax, ay, bx, by, ax, ay}, spans));
        EXPECT_TRUE(spans.empty());
    }
}

TEST(Cover, SubPixelTriangles) {
    std::vector<PixelSpan> spans;
    EXPECT_TRUE(cover_triangle({9, 9}, Corners{3.6, 3.6, 3.9, 3.6, 3.6, 3.9}, spans));
    EXPECT_TRUE(spans.empty());
    EXPECT_TRUE(cover_triangle({9, 9}, Corners{3.4, 3.4, 3.7, 3.4, 3.4, 3.7}, spans));
    EXPECT_EQ(spans, (std::vector<PixelSpan>{{3, 3, 4}}));
}

TEST(Cover, BadInputIsRefused) {
    std::vector<PixelSpan> spans;
    const Corners good{0, 0, 3, 0, 0, 3};
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        for (std::size_t k = 0; k < 6; ++k) {
            Corners t = good;
            t[k] = bad;
            const Status s = cover_triangle({4, 4}, t, spans);
            ASSERT_FALSE(s);
            EXPECT_EQ(s.error().what, "coordinate " + std::to_string(k % 2) + " of vertex " + std::to_string(k / 2));
        }
    }
    EXPECT_FALSE(cover_triangle({4, 4}, std::vector<double>{0, 0, 1, 1}, spans));
    for (const RasterSize size : {RasterSize{0, 4}, {4, 0}, {-1, 4}, {4, max_raster_side + 1}})
        EXPECT_FALSE(cover_triangle(size, good, spans));
    EXPECT_TRUE(spans.empty());
}

}  // namespace
}  // namespace barycert
