#include "barycert/raster.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "tests/draw/raster/rational.hpp"

namespace barycert {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

/// Texel i has red i, row j green j.
Image numbered(std::int32_t width, std::int32_t height) {
    Image image = blank_image(width, height, {0, 0, 0, 255}).value();
    for (std::int32_t j = 0; j < height; ++j) {
        for (std::int32_t i = 0; i < width; ++i)
            image.set_pixel(i, j, {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), 7, 255});
    }
    return image;
}

Rational floor_of(const Rational& x) {
    CGAL::Gmpz quotient, rest;
    mpz_fdiv_qr(quotient.mpz(), rest.mpz(), x.numerator().mpz(), x.denominator().mpz());
    return Rational(quotient);
}

/// The texel by the rules of the header, in rationals. Requires: u is finite.
int judged_texel(double u, int size, Wrap wrap) {
    Rational place(u);
    if (wrap == Wrap::clamp) {
        if (place < Rational(0)) return 0;
        if (place >= Rational(1)) return size - 1;
    }
    if (wrap == Wrap::repeat) place = place - floor_of(place);
    if (wrap == Wrap::mirror) place = place - Rational(2) * floor_of(place / Rational(2));
    const int i = static_cast<int>(CGAL::to_double(floor_of(place * Rational(size))));
    return i < size ? i : 2 * size - 1 - i;
}

constexpr Wrap all_wraps[] = {Wrap::clamp, Wrap::repeat, Wrap::mirror};
constexpr Filter all_filters[] = {Filter::nearest, Filter::bilinear};

TEST(Texel, TheRimIsTheLastTexel) {
    for (const int size : {1, 2, 3, 5, 7, 64, 100, 255}) {
        for (const Filter filter : all_filters) {
            const Texture t{numbered(size, size), Wrap::clamp, filter};
            const auto last = static_cast<std::uint8_t>(size - 1);
            EXPECT_EQ(texel(t, 1, 1), (Rgba{last, last, 7, 255}));
            EXPECT_EQ(texel(t, std::nextafter(1, 0), std::nextafter(1, 2)), (Rgba{last, last, 7, 255}));
            EXPECT_EQ(texel(t, 0, 0), (Rgba{0, 0, 7, 255}));
            EXPECT_EQ(texel(t, -0.0, -1e-320), (Rgba{0, 0, 7, 255}));
        }
        const Texture mirrored{numbered(size, size), Wrap::mirror, Filter::nearest};
        EXPECT_EQ(texel(mirrored, 1, 0)[0], size - 1);
        EXPECT_EQ(texel(mirrored, 2, 0)[0], 0);
        const Texture repeated{numbered(size, size), Wrap::repeat, Filter::nearest};
        EXPECT_EQ(texel(repeated, 1, 0)[0], 0);
        EXPECT_EQ(texel(repeated, std::nextafter(1, 0), 0)[0], size - 1);
        EXPECT_EQ(texel(repeated, -1e-320, 0)[0], size - 1);
    }
}

TEST(Texel, AnyNumberIsSafe) {
    for (const Wrap wrap : all_wraps) {
        for (const Filter filter : all_filters) {
            const Texture t{numbered(3, 5), wrap, filter};
            for (const double u : {1e308, -1e308, 1e17, -1e17, 5e-324, -5e-324, inf, -inf, nan, 0.5, -3.7}) {
                for (const double v : {1e308, -1e-308, inf, -inf, nan, 2.0}) {
                    const Rgba c = texel(t, u, v);
                    EXPECT_LE(c[0], 2);
                    EXPECT_LE(c[1], 4);
                    EXPECT_EQ(c[2], 7);
                    EXPECT_EQ(c[3], 255);
                }
            }
            EXPECT_EQ(texel(t, nan, nan), texel(t, 0, 0));
        }
    }
    const Texture t{numbered(3, 5), Wrap::clamp, Filter::nearest};
    EXPECT_EQ(texel(t, inf, -inf), (Rgba{2, 0, 7, 255}));
}

/// Borders between texels as they are in doubles, and their neighbours; everything else.
double place_near_border(base::Random& random, int size) {
    const auto texels = static_cast<double>(random.integer(-3 * size, 3 * size));
    double u = texels / size;
    const std::int64_t steps = random.integer(-2, 2);
    for (std::int64_t k = 0; k < std::abs(steps); ++k) u = std::nextafter(u, steps < 0 ? -inf : inf);
    const std::int64_t kind = random.integer(0, 9);
    if (kind == 0) return random.uniform(-5, 5);
    if (kind == 1) return u * 0x1p40;
    if (kind == 2) return u * 0x1p-60;
    return u;
}

TEST(Texel, NearestIsExact) {
    base::Random random(4);
    for (int k = 0; k < 30000; ++k) {
        const auto size = static_cast<int>(random.integer(1, 200));
        const double u = place_near_border(random, size);
        for (const Wrap wrap : all_wraps) {
            const Texture t{numbered(size, 1), wrap, Filter::nearest};
            ASSERT_EQ(texel(t, u, 0.5)[0], judged_texel(u, size, wrap))
                << u << ' ' << size << ' ' << static_cast<int>(wrap);
        }
    }
}

TEST(Texel, BilinearIsTheTexelAtItsCentreAndTheMiddleBetween) {
    const Texture t{numbered(4, 4), Wrap::clamp, Filter::bilinear};
    for (int i = 0; i < 4; ++i) EXPECT_EQ(texel(t, (i + 0.5) / 4, 0.125)[0], i);
    const Texture two{{2, 1, {0, 10, 100, 255, 200, 30, 100, 255}}, Wrap::clamp, Filter::bilinear};
    EXPECT_EQ(texel(two, 0.5, 0.5), (Rgba{100, 20, 100, 255}));
    EXPECT_EQ(texel(two, 0.375, 0.5), (Rgba{50, 15, 100, 255}));
    EXPECT_EQ(texel(two, 0.1, 0.5), (Rgba{0, 10, 100, 255}));
    Texture repeated = two;
    repeated.wrap = Wrap::repeat;
    EXPECT_EQ(texel(repeated, 0, 0.5), (Rgba{100, 20, 100, 255}));  // halfway between the last and the first
    EXPECT_EQ(texel(repeated, 7, 0.5), texel(repeated, -3, 0.5));
}

RC_GTEST_PROP(Texel, BilinearLiesBetweenTheTexels, (std::uint64_t seed)) {
    base::Random random(seed);
    Texture t{blank_image(3, 2, {}).value(), Wrap::repeat, Filter::bilinear};
    std::uint8_t low = 255, high = 0;
    for (std::uint8_t& x : t.image.data) {
        x = static_cast<std::uint8_t>(random.below(256));
        low = std::min(low, x);
        high = std::max(high, x);
    }
    for (const Wrap wrap : all_wraps) {
        t.wrap = wrap;
        const double u = random.uniform(-9, 9);
        const double v = random.uniform(-9, 9);
        for (const std::uint8_t x : texel(t, u, v)) RC_ASSERT(low <= x && x <= high);
    }
}

TEST(Images, SizesAreChecked) {
    EXPECT_FALSE(blank_image(0, 5, {}));
    EXPECT_FALSE(blank_image(5, -1, {}));
    EXPECT_FALSE(blank_image(8193, 8192, {}));
    EXPECT_FALSE(blank_image(2147483647, 2147483647, {}));
    EXPECT_TRUE(blank_image(1, 1, {}));
    EXPECT_FALSE(check_image({2, 2, {1, 2, 3}}));
    EXPECT_FALSE(checkerboard(0, 1));
    EXPECT_FALSE(checkerboard(2147483647, 2147483647));
    EXPECT_FALSE(checkerboard(8193, 1));
}

TEST(Images, BuiltIn) {
    const Image four = four_colours();
    ASSERT_TRUE(check_image(four));
    EXPECT_GT(four.pixel(0, 0)[0], 200);  // red at the lower left
    EXPECT_GT(four.pixel(1, 0)[1], 150);  // green at the lower right
    EXPECT_GT(four.pixel(0, 1)[2], 200);  // blue at the upper left
    const Image board = checkerboard(3, 2).value();
    ASSERT_TRUE(check_image(board));
    EXPECT_EQ(board.width, 6);
    EXPECT_EQ(board.pixel(0, 0), board.pixel(1, 1));
    EXPECT_NE(board.pixel(1, 0), board.pixel(2, 0));
    EXPECT_EQ(board.pixel(0, 0), board.pixel(2, 2));
    EXPECT_LT(board.pixel(0, 0)[0], board.pixel(2, 0)[0]);
}

}  // namespace
}  // namespace barycert
