// Several samples a pixel: each is covered as a pixel of a finer raster, and the pixel is their mean in linear light.
#include <gtest/gtest.h>

#include <cmath>

#include "barycert/scene.hpp"
#include "core/base/random.hpp"
#include "draw/raster/resolve.hpp"

namespace barycert {
namespace {

/// Triangles of a colour each, some behind others, some beyond the window.
Scene any_scene(base::Random& random, int triangles) {
    Scene s;
    s.size = {random.integer(5, 40), random.integer(5, 90)};
    s.background = {250, 240, 230, 255};
    for (int t = 0; t < triangles; ++t) {
        const std::array<double, 3> colour{random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
        // Parallel to the window: which is in front does not depend on rounding.
        const double z = random.uniform(-1, 1);
        for (int c = 0; c < 3; ++c) {
            s.positions.insert(s.positions.end(), {random.uniform(-1.3, 1.3), random.uniform(-1.3, 1.3), z, 1});
            s.colours.insert(s.colours.end(), colour.begin(), colour.end());
            s.triangles.push_back(static_cast<std::int32_t>(s.triangles.size()));
        }
    }
    return s;
}

Image finer(Scene scene, int samples) {
    scene.samples = 1;
    scene.size = {scene.size.width * samples, scene.size.height * samples};
    return render(scene).value();
}

double light(std::uint8_t component) {
    const double x = component / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

TEST(Samples, ArePixelsOfAFinerRaster) {
    base::Random random(3);
    for (int k = 0; k < 120; ++k) {
        Scene s = any_scene(random, random.integer(1, 30));
        s.samples = random.integer(2, max_samples);
        const auto n = static_cast<std::int32_t>(s.samples);
        RenderCounts counts, fine_counts;
        const Image image = render(s, &counts).value(), fine = finer(s, s.samples);
        Scene single = s;
        single.samples = 1;
        single.size = {n * s.size.width, n * s.size.height};
        render(single, &fine_counts).value();
        EXPECT_EQ(counts, fine_counts);
        for (std::int32_t j = 0; j < image.height; ++j) {
            for (std::int32_t i = 0; i < image.width; ++i) {
                std::array<double, 3> sum{};
                bool same = true;
                for (std::int32_t a = 0; a < n * n; ++a) {
                    const Rgba c = fine.pixel(n * i + a % n, n * j + a / n);
                    same = same && c == fine.pixel(n * i, n * j);
                    for (std::size_t m = 0; m < 3; ++m) sum[m] += light(c[m]) / (n * n);
                }
                const Rgba seen = image.pixel(i, j);
                if (same) {
                    ASSERT_EQ(seen, fine.pixel(n * i, n * j));
                }
                for (std::size_t m = 0; m < 3; ++m) {
                    // The component whose light is nearest; light and mean are rounded to 65535ths, by half of one
                    // each.
                    const double own = std::abs(light(seen[m]) - sum[m]) - 3.0 / 65535;
                    if (seen[m] > 0) {
                        ASSERT_LE(own, std::abs(light(static_cast<std::uint8_t>(seen[m] - 1)) - sum[m]));
                    }
                    if (seen[m] < 255) {
                        ASSERT_LE(own, std::abs(light(static_cast<std::uint8_t>(seen[m] + 1)) - sum[m]));
                    }
                }
            }
        }
    }
}

/// A fan around a point partitions its surroundings: no sample is drawn twice, or not at all.
TEST(Samples, R1EachIsDrawnOnce) {
    base::Random random(4);
    for (int k = 0; k < 60; ++k) {
        Scene s;
        s.size = {24, 24};
        s.samples = random.integer(1, max_samples);
        s.positions = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0, 1};
        s.colours = {0.5, 0.5, 0.5};
        const std::int32_t spokes = random.integer(3, 40);
        for (std::int32_t i = 0; i < spokes; ++i) {
            const double turn = 2 * 3.14159265358979 * i / spokes;
            s.positions.insert(s.positions.end(), {4 * std::cos(turn), 4 * std::sin(turn), 0, 1});
            s.colours.insert(s.colours.end(), {0.5, 0.5, 0.5});
            s.triangles.insert(s.triangles.end(), {0, 1 + i, 1 + (i + 1) % spokes});
        }
        RenderCounts counts;
        const Image image = render(s, &counts).value();
        const auto all = static_cast<std::uint64_t>(24 * 24 * s.samples * s.samples);
        EXPECT_EQ(counts.covered, all);
        EXPECT_EQ(counts.hidden, 0U);
        EXPECT_EQ(counts.pixels, all);
        for (std::int32_t i = 0; i < 24 * 24; ++i) ASSERT_EQ(image.pixel(i % 24, i / 24), (Rgba{128, 128, 128, 255}));
    }
}

TEST(Samples, WeightsOfOpacity) {
    Image image = blank_image(1, 1, {}).value();
    raster::resolve(std::vector<Rgba>{{255, 0, 0, 255}, {0, 255, 0, 0}, {255, 0, 0, 255}, {0, 0, 255, 0}}, 2, 1, 0,
                    image);
    EXPECT_EQ(image.pixel(0, 0), (Rgba{255, 0, 0, 128}));
    raster::resolve(std::vector<Rgba>{{255, 255, 255, 255}, {0, 0, 0, 255}, {255, 255, 255, 255}, {0, 0, 0, 255}}, 2, 1,
                    0, image);
    EXPECT_EQ(image.pixel(0, 0), (Rgba{188, 188, 188, 255}));  // half of the light
}

TEST(Samples, OfAttributesOneAlone) {
    base::Random random(5);
    Scene s = any_scene(random, 2);
    s.samples = 2;
    PixelValues attributes;
    EXPECT_FALSE(render(s, nullptr, &attributes));
    s.samples = 9;
    EXPECT_FALSE(render(s));
    s.samples = 0;
    EXPECT_FALSE(render(s));
}

}  // namespace
}  // namespace barycert
