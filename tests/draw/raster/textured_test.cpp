// Textured triangles on lanes, on every SIMD target, against exact coverage and exact texture coordinates.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/perspective.hpp"
#include "barycert/raster.hpp"
#include "core/base/random.hpp"

namespace barycert {
namespace {

/// A texture whose texels are all different: red and green the column, blue and opacity the line (above 0x80).
Texture numbered(std::int32_t width, std::int32_t height, Wrap wrap) {
    Texture t{blank_image(width, height, {}).value(), wrap, Filter::nearest};
    for (std::int32_t j = 0; j < height; ++j) {
        for (std::int32_t i = 0; i < width; ++i)
            t.image.set_pixel(i, j,
                              {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8),
                               static_cast<std::uint8_t>(j), static_cast<std::uint8_t>(0x80 | j >> 8)});
    }
    return t;
}

/// The distance, in texels, that `x` (any texture coordinate times the size) would have to move to be in texel i.
double distance_to_texel(double x, std::int32_t i, std::int32_t size, Wrap wrap) {
    if (wrap == Wrap::clamp) {
        x = std::clamp(x, 0.0, static_cast<double>(size));
        return std::max({0.0, i - x, x - (i + 1)});
    }
    const double period = wrap == Wrap::repeat ? size : 2.0 * size;
    double least = std::numeric_limits<double>::infinity();
    for (const double low : {static_cast<double>(i), wrap == Wrap::repeat ? i : 2.0 * size - (i + 1)}) {
        const double k = std::floor((x - low) / period);
        for (const double at : {low + k * period, low + (k + 1) * period})
            least = std::min(least, std::max({0.0, at - x, x - (at + 1)}));
    }
    return least;
}

std::array<TexturedVertex, 3> any_triangle(base::Random& random, double side, double spread) {
    std::array<TexturedVertex, 3> t;
    for (TexturedVertex& v : t) {
        v.x = random.uniform(-0.2 * side, 1.2 * side);
        v.y = random.uniform(-0.2 * side, 1.2 * side);
        if (random.below(4) == 0) v.x = std::floor(v.x) + 0.5, v.y = std::floor(v.y) + 0.5;
        v.w = random.uniform(1, 16);
        v.u = random.below(4) == 0 ? static_cast<double>(random.below(2)) : random.uniform(0.5 - spread, 0.5 + spread);
        v.v = random.uniform(0.5 - spread, 0.5 + spread);
    }
    return t;
}

/// Draws one triangle and holds each pixel against exact coverage and exact coordinates.
void expect_right(const std::array<TexturedVertex, 3>& t, std::int32_t side, const Texture& texture, bool perspective,
                  double& largest) {
    Image image = blank_image(side, side, {0, 0, 0, 0}).value();
    auto drawn = draw_textured(image, texture, t, perspective);
    ASSERT_TRUE(drawn);
    const std::array<double, 6> corners{t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y};
    std::vector<PixelSpan> spans;
    ASSERT_TRUE(cover_triangle({side, side}, corners, spans));
    std::size_t covered = 0, set = 0;
    for (std::size_t p = 0; p < image.data.size(); p += 4) set += image.data[p + 3] != 0 ? 1 : 0;
    std::array<double, 9> vertices{};
    std::array<double, 6> values{};
    for (std::size_t k = 0; k < 3; ++k) {
        vertices[3 * k] = t[k].x, vertices[3 * k + 1] = t[k].y, vertices[3 * k + 2] = perspective ? t[k].w : 1;
        values[2 * k] = t[k].u, values[2 * k + 1] = t[k].v;
    }
    for (const PixelSpan& s : spans) {
        covered += static_cast<std::size_t>(s.end - s.begin);
        for (std::int32_t i = s.begin; i < s.end; ++i) {
            const Rgba pixel = image.pixel(i, s.row);
            ASSERT_NE(pixel[3], 0) << "a covered pixel is not drawn";
            const std::array<double, 2> centre{i + 0.5, s.row + 0.5};
            std::array<double, 2> exact{};
            ASSERT_TRUE(perspective_values(vertices.data(), centre, values, 2, exact));
            const std::int32_t column = pixel[0] | pixel[1] << 8, line = pixel[2] | (pixel[3] & 0x7f) << 8;
            largest = std::max(
                {largest, distance_to_texel(exact[0] * texture.image.width, column, texture.image.width, texture.wrap),
                 distance_to_texel(exact[1] * texture.image.height, line, texture.image.height, texture.wrap)});
        }
    }
    ASSERT_EQ(covered, set);
    ASSERT_EQ(covered, drawn.value());
}

class Textured : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override { use_simd_target(GetParam()); }
    void TearDown() override { use_simd_target(""); }
};

TEST_P(Textured, CoverageIsExactAndTexelsAreWithinTheBound) {
    base::Random random(21);
    for (const Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirror}) {
        for (const auto& [width, height] : {std::pair{256, 256}, {1024, 16}, {100, 77}, {1, 1}}) {
            const Texture texture = numbered(width, height, wrap);
            for (const bool perspective : {false, true}) {
                double largest = 0;
                for (int k = 0; k < 25; ++k)
                    expect_right(any_triangle(random, k % 5 == 0 ? 300 : 40, k % 2 == 0 ? 0.5 : 1.5),
                                 k % 5 == 0 ? 300 : 40, texture, perspective, largest);
                EXPECT_LE(largest, 0x1p-8)
                    << width << " wide, wrap " << static_cast<int>(wrap) << " perspective " << perspective;
            }
        }
    }
}

TEST_P(Textured, FarOffTheTextureTheRimIsDrawn) {
    // Coordinates beyond what fixed point holds.
    const Texture texture = numbered(64, 64, Wrap::clamp);
    Image image = blank_image(32, 32, {}).value();
    for (const double far : {3e2, 1e6, 1e300}) {
        const std::array<TexturedVertex, 3> t{
            {{-40, -40, 1, far, -far}, {90, -40, 1, far, -far}, {-40, 90, 1, far, -far}}};
        ASSERT_TRUE(draw_textured(image, texture, t, false));
        EXPECT_EQ(image.pixel(3, 4), texture.image.pixel(63, 0));
    }
}

TEST_P(Textured, AnyFiniteNumbersAreSafe) {
    base::Random random(22);
    Image image = blank_image(37, 29, {}).value();
    for (const Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirror}) {
        const Texture texture = numbered(13, 9, wrap);
        for (int k = 0; k < 3000; ++k) {
            std::array<TexturedVertex, 3> t;
            const auto number = [&] {
                const int exponent = static_cast<int>(random.below(2098)) - 1074;
                return random.below(2) == 0 ? random.uniform(-20, 60) : std::ldexp(random.uniform(-1, 1), exponent);
            };
            for (TexturedVertex& v : t) {
                v.x = number(), v.y = number(), v.u = number(), v.v = number();
                v.w = std::fabs(number()) + std::numeric_limits<double>::denorm_min();
            }
            auto drawn = draw_textured(image, texture, t, k % 2 == 0);
            ASSERT_TRUE(drawn);
            std::vector<PixelSpan> spans;
            std::size_t covered = 0;
            ASSERT_TRUE(cover_triangle({37, 29}, std::array{t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y}, spans));
            for (const PixelSpan& s : spans) covered += static_cast<std::size_t>(s.end - s.begin);
            ASSERT_EQ(covered, drawn.value());
        }
    }
}

TEST_P(Textured, ManyAtOnceOnAnyThreadsAreAsDrawnOneByOne) {
    // So wide that a band has 16 rows: triangles meet one, several or all bands, and lie over each other.
    constexpr std::int32_t width = 4096, height = 290;
    base::Random random(23);
    std::vector<TexturedVertex> all;
    for (int k = 0; k < 400; ++k) {
        const double size = k % 3 == 0 ? 400 : 12, x = random.uniform(0, width), y = random.uniform(0, height);
        for (TexturedVertex v : any_triangle(random, size, k % 2 == 0 ? 0.5 : 1.5)) {
            v.x += x - size / 2, v.y += y - size / 2;
            all.push_back(v);
        }
    }
    for (const Wrap wrap : {Wrap::clamp, Wrap::mirror}) {
        const Texture texture = numbered(64, 50, wrap);
        for (const bool perspective : {false, true}) {
            Image one_by_one = blank_image(width, height, {}).value();
            std::size_t drawn = 0;
            std::vector<PixelSpan> spans;
            for (std::size_t k = 0; k < all.size(); k += 3) {
                const TexturedVertex* const t = all.data() + k;
                drawn += draw_textured(one_by_one, texture, std::span(t, 3), perspective, 1).value();
                ASSERT_TRUE(
                    cover_triangle({width, height}, std::array{t[0].x, t[0].y, t[1].x, t[1].y, t[2].x, t[2].y}, spans));
            }
            std::size_t covered = 0;
            for (const PixelSpan& s : spans) covered += static_cast<std::size_t>(s.end - s.begin);
            EXPECT_EQ(drawn, covered);
            for (const int threads : {0, 1, 2, 5}) {
                Image together = blank_image(width, height, {}).value();
                EXPECT_EQ(draw_textured(together, texture, all, perspective, threads).value(), covered);
                EXPECT_EQ(together, one_by_one) << threads << " threads";
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Targets, Textured, testing::ValuesIn(simd_targets()), [](const auto& target) {
    std::string name = target.param;
    std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
    return name;
});

TEST(TexturedErrors, BadInputIsRefusedAndNothingIsDrawn) {
    const Texture texture = numbered(4, 4, Wrap::clamp);
    Image image = blank_image(8, 8, {}).value();
    const Image before = image;
    const std::vector<TexturedVertex> good{{0, 0, 1, 0, 0}, {8, 0, 1, 1, 0}, {0, 8, 1, 0, 1}};
    for (double TexturedVertex::*member :
         {&TexturedVertex::x, &TexturedVertex::y, &TexturedVertex::w, &TexturedVertex::u, &TexturedVertex::v}) {
        for (const double bad : {std::nan(""), HUGE_VAL}) {
            std::vector<TexturedVertex> t = good;
            t[1].*member = bad;
            EXPECT_FALSE(draw_textured(image, texture, t));
        }
    }
    std::vector<TexturedVertex> behind = good;
    behind[2].w = 0;
    EXPECT_FALSE(draw_textured(image, texture, behind));
    EXPECT_FALSE(draw_textured(image, texture, std::span(good).first(2)));
    Texture smooth = texture;
    smooth.filter = Filter::bilinear;
    EXPECT_FALSE(draw_textured(image, smooth, good));
    Image broken = image;
    broken.data.pop_back();
    EXPECT_FALSE(draw_textured(broken, texture, good));
    EXPECT_EQ(image, before);
    EXPECT_TRUE(draw_textured(image, texture, behind, false));
}

}  // namespace
}  // namespace barycert
