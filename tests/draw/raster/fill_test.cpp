#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "barycert/raster.hpp"
#include "core/base/random.hpp"
#include "tests/draw/raster/judge.hpp"

namespace barycert {
namespace {

constexpr std::array methods{FillMethod::barycentric, FillMethod::scanline, FillMethod::bilinear};

PixelValues filled(RasterSize size, const Corners& t, const std::array<double, 3>& f, const FillOptions& options) {
    PixelValues image = empty_pixels(size, 1).value();
    EXPECT_TRUE(fill_triangle(t, f, image, options));
    return image;
}

struct Drawn {
    Corners triangle;
    std::array<double, 3> values;
};

Drawn any_triangle(base::Random& random, double side) {
    Drawn d;
    for (double& x : d.triangle) x = random.uniform(-0.2 * side, 1.2 * side);
    if (random.below(3) == 0) {  // flat: the third vertex near the line of the others
        const double t = random.uniform(0, 1), off = std::ldexp(side, -static_cast<int>(random.below(30)));
        for (std::size_t k = 0; k < 2; ++k)
            d.triangle[4 + k] = d.triangle[k] + t * (d.triangle[2 + k] - d.triangle[k]) + off * random.uniform(-1, 1);
    }
    for (double& f : d.values) f = random.uniform(-1, 1);
    return d;
}

TEST(Fill, CorrectValuesAreTheExactOnesRoundedOnce) {
    base::Random random(11);
    for (int k = 0; k < 60; ++k) {
        const Drawn d = any_triangle(random, 16);
        const PixelValues image = filled({16, 16}, d.triangle, d.values, {.rounding = Rounding::correct});
        for (std::int32_t j = 0; j < 16; ++j) {
            for (std::int32_t i = 0; i < 16; ++i) {
                const double found = image.data[static_cast<std::size_t>(16 * j + i)];
                if (!judge_covers(d.triangle, i, j)) {
                    EXPECT_TRUE(std::isnan(found));
                    continue;
                }
                EXPECT_EQ(std::bit_cast<std::uint64_t>(found),
                          std::bit_cast<std::uint64_t>(judge_value(d.triangle, d.values, i, j)));
            }
        }
    }
}

TEST(Fill, PlainErrorsAreWithinTheirBounds) {
    base::Random random(12);
    for (const FillMethod method : methods) {
        double nearest = 0;
        std::size_t pixels = 0;
        for (int k = 0; k < 300; ++k) {
            const int side = k % 3 == 0 ? 60 : 12;
            const Drawn d = any_triangle(random, side);
            const PixelValues image = filled({side, side}, d.triangle, d.values, {.method = method});
            const double bound = fill_error(d.triangle, d.values, method);
            for (std::int32_t j = 0; j < side; ++j) {
                for (std::int32_t i = 0; i < side; i += 3) {
                    const double found = image.data[static_cast<std::size_t>(side * j + i)];
                    if (std::isnan(found)) continue;
                    const double error = judge_error(d.triangle, d.values, i, j, found);
                    ASSERT_LE(error, bound) << "method " << static_cast<int>(method) << " round " << k;
                    nearest = std::max(nearest, error / bound);
                    ++pixels;
                }
            }
        }
        EXPECT_GT(pixels, 5000U);
        // The bound is of the right size: some error comes within a factor of 200.
        EXPECT_GT(nearest, 0.005) << "method " << static_cast<int>(method);
    }
}

TEST(Fill, AllMethodsCoverTheSamePixels) {
    base::Random random(13);
    for (int k = 0; k < 200; ++k) {
        const Drawn d = any_triangle(random, 20);
        const PixelValues first = filled({20, 20}, d.triangle, d.values, {});
        for (const FillMethod method : methods) {
            const PixelValues image = filled({20, 20}, d.triangle, d.values, {.method = method});
            for (std::size_t p = 0; p < image.data.size(); ++p)
                ASSERT_EQ(std::isnan(image.data[p]), std::isnan(first.data[p]));
        }
    }
}

TEST(Fill, ComponentsAreFilledAlike) {
    base::Random random(14);
    for (const FillMethod method : methods) {
        for (const Rounding rounding : {Rounding::plain, Rounding::correct}) {
            if (rounding == Rounding::correct && method != FillMethod::barycentric) continue;
            const Drawn d = any_triangle(random, 20), e = any_triangle(random, 20);
            PixelValues both = empty_pixels({20, 20}, 2).value();
            const std::array<double, 6> values{d.values[0], e.values[0], d.values[1],
                                               e.values[1], d.values[2], e.values[2]};
            Result<std::size_t> count = fill_triangle(d.triangle, values, both, {method, rounding});
            const PixelValues one = filled({20, 20}, d.triangle, d.values, {method, rounding});
            const PixelValues two = filled({20, 20}, d.triangle, e.values, {method, rounding});
            std::size_t set = 0;
            for (std::size_t p = 0; p < 400; ++p) {
                if (std::isnan(one.data[p])) continue;
                ++set;
                EXPECT_EQ(both.data[2 * p], one.data[p]);
                EXPECT_EQ(both.data[2 * p + 1], two.data[p]);
            }
            EXPECT_EQ(count.value(), set);
        }
    }
}

TEST(Fill, BadInputIsRefusedAndNothingIsChanged) {
    PixelValues image = empty_pixels({4, 4}, 1).value();
    const Corners t{0, 0, 4, 0, 0, 4};
    EXPECT_FALSE(fill_triangle(t, std::array<double, 2>{1, 2}, image));
    EXPECT_FALSE(fill_triangle(Corners{0, 0, 4, 0, 0, NAN}, std::array<double, 3>{1, 2, 3}, image));
    EXPECT_FALSE(fill_triangle(t, std::array<double, 3>{1, 2, 3}, image, {FillMethod::scanline, Rounding::correct}));
    for (const double x : image.data) EXPECT_TRUE(std::isnan(x));
    image.data.pop_back();
    EXPECT_FALSE(fill_triangle(t, std::array<double, 3>{1, 2, 3}, image));
    EXPECT_FALSE(empty_pixels({0, 4}, 1));
    EXPECT_FALSE(empty_pixels({4, 4}, 0));
    EXPECT_FALSE(empty_pixels({max_raster_side, max_raster_side}, 2));
}

}  // namespace
}  // namespace barycert
