#include "barycert/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "barycert/base/random.hpp"
#include "barycert/io/png/colour_map.hpp"

namespace barycert {
namespace {

struct Shape {
    std::vector<double> points;
    std::vector<std::int32_t> triangles;

    SurfaceView view() const { return {.points = points, .triangles = triangles}; }
};

/// A tetrahedron of random size and place.
Shape any_shape(base::Random& random) {
    Shape s;
    const double scale = random.scaled(0.5, 1, -200, 200);
    const double x = random.uniform(-3, 3);
    for (int i = 0; i < 12; ++i) s.points.push_back(scale * (x + random.uniform(-1, 1)));
    s.triangles = {0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    return s;
}

/// Columns and rows that show something: first and last of each.
std::array<std::int32_t, 4> extent(const Image& image, Rgba background) {
    std::array<std::int32_t, 4> e{image.width, -1, image.height, -1};
    for (std::int32_t j = 0; j < image.height; ++j) {
        for (std::int32_t i = 0; i < image.width; ++i) {
            if (image.pixel(i, j) == background) continue;
            e = {std::min(e[0], i), std::max(e[1], i), std::min(e[2], j), std::max(e[3], j)};
        }
    }
    return e;
}

TEST(View, TheCameraFits) {
    base::Random random(1);
    for (int k = 0; k < 200; ++k) {
        const Shape s = any_shape(random);
        ViewOptions o;
        o.size = {random.integer(60, 200), random.integer(60, 200)};
        o.azimuth = random.uniform(-400, 400);
        o.elevation = k % 10 == 0 ? 90 : random.uniform(-90, 90);
        ViewCounts counts;
        const Image image = draw_surface(s.view(), o, &counts).value();
        ASSERT_EQ(counts.render.outside, 0U) << k;
        ASSERT_EQ(counts.render.clipped, 0U) << k;
        const std::array<std::int32_t, 4> e = extent(image, o.background);
        ASSERT_GT(e[1], 0);
        // Some margin on each side, but not on all sides a quarter of the window.
        EXPECT_TRUE(e[0] > 0 && e[1] < image.width - 1 && e[2] > 0 && e[3] < image.height - 1) << k;
        EXPECT_TRUE(e[1] - e[0] > image.width / 2 || e[3] - e[2] > image.height / 2) << k;
    }
}

TEST(View, ScaleAndPlaceDoNotMatter) {
    const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const ViewOptions o{.size = {80, 60}};
    const Image first = draw_surface({.points = points, .triangles = triangles}, o).value();
    for (const double scale : {0x1p-900, 0x1p900, 0x1p1023, -1.0}) {
        std::vector<double> scaled = points;
        for (double& x : scaled) x = std::abs(scale) * x;
        if (scale == -1) {
            for (double& x : scaled) x += 4096;
        }
        EXPECT_EQ(draw_surface({.points = scaled, .triangles = triangles}, o).value(), first) << scale;
    }
    // From the largest negative to the largest positive numbers.
    std::vector<double> widest = points;
    for (double& x : widest) x = x == 0 ? -std::numeric_limits<double>::max() : std::numeric_limits<double>::max();
    EXPECT_EQ(draw_surface({.points = widest, .triangles = triangles}, o).value(), first);
}

TEST(View, ColoursAreThoseOfTheMap) {
    // From above, so that nothing is shaded: a strip whose value is x.
    const std::vector<double> points{0, 0, 4, 0, 4, 1, 0, 1}, values{10, 30, 30, 10};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3};
    const SurfaceView strip{.dimension = 2, .points = points, .triangles = triangles, .point_values = values};
    ViewCounts counts;
    const Image image = draw_surface(strip, {.size = {400, 100}, .bar = false}, &counts).value();
    EXPECT_EQ(counts.low, 10);
    EXPECT_EQ(counts.high, 30);
    // The strip is 376 pixels wide (0.94 of the window): pixel 12 is its first.
    for (std::int32_t i = 0; i < 376; ++i) {
        const Rgba c = image.pixel(12 + i, 50);
        const auto step = [&](double part) { return io::colour(std::min(255, static_cast<int>(256 * part))); };
        const io::Colour low = step((i + 0.499) / 376), high = step((i + 0.501) / 376);
        const io::Colour seen{c[0], c[1], c[2]};
        ASSERT_TRUE(seen == low || seen == high) << i;
    }
    const Image cut = draw_surface(strip, {.size = {400, 100}, .range = {{15, 20}}, .bar = false}).value();
    const auto rgb = [&](std::int32_t i) {
        const Rgba c = cut.pixel(i, 50);
        return io::Colour{c[0], c[1], c[2]};
    };
    EXPECT_EQ(rgb(50), io::colour(0));
    EXPECT_EQ(rgb(250), io::colour(255));
    const Image one = draw_surface(strip, {.size = {400, 100}, .range = {{30, 30}}, .bar = false}).value();
    EXPECT_EQ(one.pixel(50, 50)[0], io::colour(0)[0]);
}

TEST(View, WhatHasNoValueIsGreyAndCounted) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> points{0, 0, 1, 0, 1, 1, 0, 1}, values{nan, 7}, both{nan, HUGE_VAL};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3};
    SurfaceView square{.dimension = 2, .points = points, .triangles = triangles, .triangle_values = values};
    ViewCounts counts;
    const Image image = draw_surface(square, {.size = {100, 100}, .bar = false}, &counts).value();
    EXPECT_EQ(counts.without_value, 1U);
    EXPECT_EQ(image.pixel(80, 20), (Rgba{190, 190, 190, 255}));
    const io::Colour middle = io::colour(128);
    EXPECT_EQ(image.pixel(20, 80), (Rgba{middle[0], middle[1], middle[2], 255}));
    square.triangle_values = both;
    const Image grey = draw_surface(square, {.size = {100, 100}}, &counts).value();
    EXPECT_TRUE(std::isnan(counts.low));
    EXPECT_EQ(counts.without_value, 2U);
    EXPECT_EQ(grey.pixel(20, 80), (Rgba{190, 190, 190, 255}));
}

TEST(View, BothSidesAreLitAlike) {
    base::Random random(5);
    for (int k = 0; k < 20; ++k) {
        Shape s = any_shape(random);
        const Image image = draw_surface(s.view(), {.size = {60, 60}}).value();
        for (std::size_t t = 0; t < 12; t += 3) std::swap(s.triangles[t], s.triangles[t + 1]);
        EXPECT_EQ(draw_surface(s.view(), {.size = {60, 60}}).value(), image);
    }
}

TEST(View, NothingAndPoints) {
    const ViewOptions o{.size = {50, 40}};
    EXPECT_EQ(draw_surface({}, o).value(), blank_image(50, 40, o.background).value());
    const std::vector<double> points{1, 2, 3};
    const std::vector<std::int32_t> triangles{0, 0, 0};
    ViewCounts counts;
    EXPECT_TRUE(draw_surface({.points = points, .triangles = triangles}, o, &counts));
    EXPECT_EQ(counts.render.degenerate, 1U);
}

TEST(View, BadInputIsAnError) {
    const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0}, values{1, 2, 3}, two{1, 2};
    const std::vector<double> bad{0, 0, std::numeric_limits<double>::infinity(), 1, 0, 0, 0, 1, 0};
    const std::vector<std::int32_t> triangle{0, 1, 2}, beyond{0, 1, 3}, negative{0, -1, 2}, pair{0, 1};
    const SurfaceView good{.points = points, .triangles = triangle, .point_values = values};
    ASSERT_TRUE(draw_surface(good));
    const auto refused = [&](auto change, ViewOptions o = {}) {
        SurfaceView s = good;
        change(s, o);
        EXPECT_FALSE(draw_surface(s, o));
    };
    refused([](SurfaceView& s, ViewOptions&) { s.dimension = 4; });
    refused([&](SurfaceView& s, ViewOptions&) { s.triangles = beyond; });
    refused([&](SurfaceView& s, ViewOptions&) { s.triangles = negative; });
    refused([&](SurfaceView& s, ViewOptions&) { s.triangles = pair; });
    refused([&](SurfaceView& s, ViewOptions&) { s.points = bad; });
    refused([&](SurfaceView& s, ViewOptions&) { s.points = two; });
    refused([&](SurfaceView& s, ViewOptions&) { s.point_values = two; });
    refused([&](SurfaceView& s, ViewOptions&) { s.triangle_values = std::span(values).subspan(0, 1); });
    refused([](SurfaceView&, ViewOptions& o) { o.azimuth = HUGE_VAL; });
    refused([](SurfaceView&, ViewOptions& o) { o.range = {2, 1}; });
    refused([](SurfaceView&, ViewOptions& o) { o.size = {0, 10}; });
    refused([](SurfaceView&, ViewOptions& o) { o.size = {20, 100}; });  // less than the bar
    refused([](SurfaceView&, ViewOptions& o) { o.size = {500, 20}; });  // lower than the bar
}

}  // namespace
}  // namespace barycert
