// Figures: what the camera sees, colours, layout, files.
#include "barycert/figure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "core/base/random.hpp"
#include "draw/colour_map.hpp"
#include "draw/files.hpp"
#include "draw/histogram.hpp"
#include "draw/view.hpp"
#include "tests/temporary_folder.hpp"

namespace barycert {
namespace {

using testing::TemporaryFolder;

struct Shape {
    std::vector<double> points;
    std::vector<std::int32_t> triangles;

    FigureSurface surface() const { return {.points = points, .triangles = triangles}; }
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

/// The window alone, a sample a pixel.
Figure bare(const FigureSurface& surface, RasterSize size, int dimension = 3) {
    Figure f{.dimension = dimension, .surfaces = {surface}};
    f.options.size = size;
    f.options.samples = 1;
    f.options.axes = Axes::none;
    f.options.bar = false;
    return f;
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

TEST(Figure, TheCameraFits) {
    base::Random random(1);
    for (int k = 0; k < 200; ++k) {
        const Shape s = any_shape(random);
        Figure f = bare(s.surface(), {random.integer(60, 200), random.integer(60, 200)});
        f.options.camera.azimuth = random.uniform(-400, 400);
        f.options.camera.elevation = k % 10 == 0 ? 90 : random.uniform(-90, 90);
        f.options.camera.parallel = k % 2 == 1;
        FigureCounts counts;
        const Image image = draw_figure(f, &counts).value();
        ASSERT_EQ(counts.render.outside, 0U) << k;
        ASSERT_EQ(counts.render.clipped, 0U) << k;
        const std::array<std::int32_t, 4> e = extent(image, f.options.background);
        ASSERT_GT(e[1], 0);
        // Some margin on each side, but not on all sides a quarter of the window.
        EXPECT_TRUE(e[0] > 0 && e[1] < image.width - 1 && e[2] > 0 && e[3] < image.height - 1) << k;
        EXPECT_TRUE(e[1] - e[0] > image.width / 2 || e[3] - e[2] > image.height / 2) << k;
    }
}

TEST(Figure, ScaleAndPlaceDoNotMatter) {
    const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const auto drawn = [&](const std::vector<double>& at) {
        Figure f = bare({.points = at, .triangles = triangles}, {80, 60});
        f.options.samples = 4;
        return draw_figure(f).value();
    };
    const Image first = drawn(points);
    for (const double scale : {0x1p-900, 0x1p900, 0x1p1023, -1.0}) {
        std::vector<double> scaled = points;
        for (double& x : scaled) x = std::abs(scale) * x;
        if (scale == -1) {
            for (double& x : scaled) x += 4096;
        }
        EXPECT_EQ(drawn(scaled), first) << scale;
    }
    // From the largest negative to the largest positive numbers.
    std::vector<double> widest = points;
    for (double& x : widest) x = x == 0 ? -std::numeric_limits<double>::max() : std::numeric_limits<double>::max();
    EXPECT_EQ(drawn(widest), first);
}

TEST(Figure, ViewsByName) {
    // A box of sides 1, 2, 3: what is seen of it from each side.
    std::vector<double> points;
    for (unsigned i = 0; i < 8; ++i)
        for (unsigned k = 0; k < 3; ++k) points.push_back((i >> k & 1U) != 0 ? k + 1.0 : 0.0);
    const std::vector<std::int32_t> triangles{0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                              2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5};
    for (const auto& [name, wide, tall] :
         {std::tuple("+x", 2.0, 3.0), {"-x", 2, 3}, {"+y", 1, 3}, {"-y", 1, 3}, {"+z", 1, 2}, {"-z", 1, 2}}) {
        Figure f = bare({.points = points, .triangles = triangles}, {300, 300});
        std::tie(f.options.camera.azimuth, f.options.camera.elevation) = angles_of(name).value();
        f.options.camera.parallel = true;
        const auto e = extent(draw_figure(f).value(), f.options.background);
        EXPECT_NEAR((e[1] - e[0] + 1.0) / (e[3] - e[2] + 1.0), wide / tall, 0.02) << name;
        f.options.camera.zoom = 0.5;
        const auto half = extent(draw_figure(f).value(), f.options.background);
        EXPECT_NEAR(half[3] - half[2], (e[3] - e[2]) / 2, 2) << name;
    }
    EXPECT_FALSE(angles_of("x"));
    EXPECT_TRUE(angles_of("iso"));
}

TEST(Figure, ColoursAreThoseOfTheMap) {
    // From above, so that nothing is shaded: a strip whose value is x.
    const std::vector<double> points{0, 0, 4, 0, 4, 1, 0, 1}, values{10, 30, 30, 10};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3};
    Figure f = bare({.points = points, .triangles = triangles, .point_values = values}, {400, 100}, 2);
    FigureCounts counts;
    const Image image = draw_figure(f, &counts).value();
    EXPECT_EQ(counts.low, 10);
    EXPECT_EQ(counts.high, 30);
    const draw::ColourMap map = *draw::colour_map("viridis");
    // The strip is 376 pixels wide (0.94 of the window): pixel 12 is its first.
    for (std::int32_t i = 0; i < 376; ++i) {
        const Rgba seen = image.pixel(12 + i, 50);
        const auto step = [&](double part) {
            return map[std::min<std::size_t>(255, static_cast<std::size_t>(256 * part))];
        };
        ASSERT_TRUE(seen == step((i + 0.499) / 376) || seen == step((i + 0.501) / 376)) << i;
    }
    f.options.range = {15, 20};
    const Image cut = draw_figure(f, &counts).value();
    EXPECT_EQ(cut.pixel(50, 50), map.front());
    EXPECT_EQ(cut.pixel(250, 50), map.back());
    EXPECT_EQ(counts.below, 3U);
    EXPECT_EQ(counts.above, 3U);
    f.options.range = {30, 30};
    EXPECT_EQ(draw_figure(f).value().pixel(50, 50), map.front());
    f.options.range = {};
    f.options.colour_map = "coolwarm_r";
    EXPECT_EQ(draw_figure(f).value().pixel(12, 50), draw::colour_map("coolwarm")->back());
}

TEST(Figure, LogarithmsAndLabels) {
    const std::vector<double> points{0, 0, 4, 0, 4, 1, 0, 1}, values{1, 1e4, 1e4, 1};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3};
    Figure f = bare({.points = points, .triangles = triangles, .point_values = values}, {400, 100}, 2);
    f.options.log = true;
    const Image image = draw_figure(f).value();
    const draw::ColourMap map = *draw::colour_map("viridis");
    const std::int32_t at = 212;  // the value there is about 5300
    const double value = 1 + 9999 * (at - 12 + 0.5) / 376;
    EXPECT_EQ(image.pixel(at, 50), map[static_cast<std::size_t>(64 * std::log10(value))]);
    const std::vector<double> numbers{7, 3};
    f = bare({.points = points, .triangles = triangles, .triangle_values = numbers}, {400, 100}, 2);
    f.options.labels = true;
    const Image labels = draw_figure(f).value();
    EXPECT_EQ(labels.pixel(300, 20), draw::curve_colour(1));
    EXPECT_EQ(labels.pixel(100, 80), draw::curve_colour(0));
    f.options.labels = false;
    f.options.log = true;
    f.options.range = {0, 1};
    EXPECT_FALSE(draw_figure(f));
}

TEST(Figure, WhatHasNoValueIsGreyAndCounted) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> points{0, 0, 1, 0, 1, 1, 0, 1}, values{nan, 7}, both{nan, HUGE_VAL};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3};
    Figure f = bare({.points = points, .triangles = triangles, .triangle_values = values}, {100, 100}, 2);
    FigureCounts counts;
    const Rgba grey = draw::ColourScale().no_value;
    const Image image = draw_figure(f, &counts).value();
    EXPECT_EQ(counts.without_value, 1U);
    EXPECT_EQ(image.pixel(80, 20), grey);
    EXPECT_EQ(image.pixel(20, 80), (*draw::colour_map("viridis"))[128]);
    f.surfaces[0].triangle_values = both;
    EXPECT_EQ(draw_figure(f, &counts).value().pixel(20, 80), grey);
    EXPECT_TRUE(std::isnan(counts.low));
    EXPECT_EQ(counts.without_value, 2U);
}

TEST(Figure, BothSidesAreLitAlike) {
    base::Random random(5);
    for (int k = 0; k < 20; ++k) {
        Shape s = any_shape(random);
        const Image image = draw_figure(bare(s.surface(), {60, 60})).value();
        for (std::size_t t = 0; t < 12; t += 3) std::swap(s.triangles[t], s.triangles[t + 1]);
        EXPECT_EQ(draw_figure(bare(s.surface(), {60, 60})).value(), image);
    }
}

TEST(Figure, NothingAndPoints) {
    const Figure none = bare({}, {50, 40});
    EXPECT_EQ(draw_figure(none).value(), blank_image(50, 40, none.options.background).value());
    const std::vector<double> points{1, 2, 3};
    const std::vector<std::int32_t> triangles{0, 0, 0};
    FigureCounts counts;
    EXPECT_TRUE(draw_figure(bare({.points = points, .triangles = triangles}, {50, 40}), &counts));
    EXPECT_EQ(counts.render.degenerate, 1U);
}

/// A square in the plane x = 0 of space, seen from +x, and a line in it from corner to corner.
TEST(Figure, LinesAreHiddenBySurfacesBeforeThem) {
    const std::vector<double> square{0, -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1}, ends{0, -1, -1, 0, 1, 1},
        behind{-1, -0.9, 0, -1, 0.9, 0};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3}, segment{0, 1};
    Figure f = bare({.points = square, .triangles = triangles}, {101, 101});
    std::tie(f.options.camera.azimuth, f.options.camera.elevation) = *angles_of("+x");
    f.options.camera.parallel = true;
    f.lines = {{.points = ends, .segments = segment, .width = 3, .colour = {255, 0, 0, 255}},
               {.points = behind, .segments = segment, .width = 3, .colour = {0, 255, 0, 255}}};
    for (const int samples : {1, 4}) {
        f.options.samples = samples;
        const Image image = draw_figure(f).value();
        EXPECT_EQ(image.pixel(50, 50), (Rgba{255, 0, 0, 255}));
        std::size_t red = 0, green = 0;
        for (std::int32_t k = 0; k < 101 * 101; ++k) {
            const Rgba c = image.pixel(k % 101, k / 101);
            red += c == Rgba{255, 0, 0, 255} ? 1U : 0U;
            green += c[1] > c[0] && c[1] > c[2] ? 1U : 0U;
        }
        EXPECT_GT(red, 95U);
        EXPECT_EQ(green, 0U);
    }
}

TEST(Figure, ArrowsPointAlongTheirVectors) {
    const std::vector<double> points{0, 0, 10, 0}, vectors{1, 0, 0, 2};
    Figure f = bare({}, {200, 100}, 2);
    f.surfaces.clear();
    f.arrows = {{.points = points, .vectors = vectors, .longest = 2, .colour = {0, 0, 0, 255}}};
    FigureCounts counts;
    const Image image = draw_figure(f, &counts).value();
    EXPECT_GT(counts.render.drawn, 2U);
    const auto e = extent(image, f.options.background);
    EXPECT_LT(e[0], 20);
    EXPECT_GT(e[1], 180);
    // The same on a surface, and a disc.
    const std::vector<double> square{0, -1, 10, -1, 10, 2, 0, 2}, middle{5, 0.5};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3};
    f.surfaces = {{.points = square, .triangles = triangles}};
    f.points = {{.points = middle, .size = 10, .colour = {0, 0, 0, 255}}};
    const Image over = draw_figure(f).value();
    const auto black = [](const Image& of) {
        std::size_t count = 0;
        for (std::int32_t k = 0; k < of.width * of.height; ++k)
            count += of.pixel(k % of.width, k / of.width) == Rgba{0, 0, 0, 255} ? 1U : 0U;
        return count;
    };
    EXPECT_NEAR(static_cast<double>(black(over)), static_cast<double>(black(image)) + 76, 20);
}

std::size_t count_of(const std::string& text, std::string_view what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

TEST(Figure, DiscsAreAsLargeWhereverTheyAre) {
    // Three along the line of sight of a camera with perspective.
    const std::vector<double> points{0, -1, 0, -20, 0, 0, 10, 1, 0.5};
    for (const double resolution : {1.0, 2.0}) {
        Figure f = bare({}, {301, 201});
        f.surfaces.clear();
        f.options.camera = {.azimuth = 0, .elevation = 0, .zoom = 0.8};
        f.options.resolution = resolution;
        f.points = {{.points = points, .size = 20, .colour = {0, 0, 200, 255}}};
        const Image image = draw_figure(f).value();
        std::size_t drawn = 0;
        for (std::int32_t k = 0; k < image.width * image.height; ++k)
            drawn += image.pixel(k % image.width, k / image.width) == f.options.background ? 0U : 1U;
        // A disc of 20 pixels across has 314 of them, one of 16 sides 306.
        EXPECT_NEAR(static_cast<double>(drawn), 3 * 306 * resolution * resolution, 12 * resolution);
    }
}

TEST(Figure, DiscsHaveColoursOfValuesAndAreHidden) {
    const std::vector<double> points{0, 0, 1, 0, 2, 0, 3, 0}, values{5, 7, std::nan(""), 9};
    Figure f = bare({}, {200, 100}, 2);
    f.surfaces.clear();
    f.points = {{.points = points, .values = values, .size = 12}};
    FigureCounts counts;
    const Image image = draw_figure(f, &counts).value();
    EXPECT_EQ(counts.low, 5);
    EXPECT_EQ(counts.high, 9);
    const draw::View view(f, f.options.size, 0.94);
    const draw::ColourScale scale{.map = *draw::colour_map("viridis"), .low = 5, .high = 9};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const draw::Pixel p = view.at({points[2 * i], points[2 * i + 1], 0});
        EXPECT_EQ(image.pixel(static_cast<std::int32_t>(p.x), 100 - 1 - static_cast<std::int32_t>(p.y)),
                  i == 2 ? scale.no_value : scale(values[i]));
    }
    f.options.bar = true;
    f.options.size = {300, 200};
    EXPECT_EQ(counts.without_value, 1U);
    const std::vector<double> all{5, 7, 8, 9};
    const Image told = draw_figure(f).value();
    f.points[0].values = all;
    const Image full = draw_figure(f).value();
    std::size_t apart = 0;  // right of the discs: the bar tells of what has no value
    for (std::int32_t k = 0; k < 60 * 200; ++k)
        apart += told.pixel(299 - k % 60, k / 60) == full.pixel(299 - k % 60, k / 60) ? 0U : 1U;
    EXPECT_GT(apart, 20U);

    // Behind a square, on it, before it.
    const std::vector<double> square{0, -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1}, three{-1, -0.6, 0, 0, 0, 0, 1, 0.6, 0};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3};
    Figure g = bare({.points = square, .triangles = triangles}, {101, 101});
    std::tie(g.options.camera.azimuth, g.options.camera.elevation) = *angles_of("+x");
    g.options.camera.parallel = true;
    g.points = {{.points = three, .size = 9, .colour = {200, 0, 0, 255}}};
    const Image seen = draw_figure(g).value();
    const auto red = [&](std::int32_t first) {
        std::size_t count = 0;
        for (std::int32_t k = 0; k < 33 * 101; ++k) count += seen.pixel(first + k % 33, k / 33)[1] == 0 ? 1U : 0U;
        return count;
    };
    EXPECT_EQ(red(0), 0U);
    EXPECT_NEAR(static_cast<double>(red(34)), 62, 6);
    EXPECT_NEAR(static_cast<double>(red(68)), 62, 6);
}

TEST(Figure, FlatOnesArePolygonsInFilesOfVectors) {
    const TemporaryFolder folder;
    const std::vector<double> points{0, 0, 1, 0, 1, 1, 0, 1}, values{1, 2, 3, 4}, two{1, 2};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3}, segments{0, 1, 1, 2};
    Figure f{.dimension = 2, .surfaces = {{.points = points, .triangles = triangles, .triangle_values = two}}};
    f.lines = {{.points = points, .segments = segments, .width = 2.5, .colour = {1, 2, 3, 255}}};
    const auto svg = [&](const Figure& figure) {
        write_figure(folder / "f.svg", figure).value();
        return testing::get(folder / "f.svg");
    };
    const std::string flat = svg(f);
    EXPECT_EQ(count_of(flat, "<image"), 0U);
    EXPECT_EQ(count_of(flat, "stroke-width=\"0.4\""), 2U);
    EXPECT_EQ(count_of(flat, "stroke=\"#010203\" stroke-width=\"2.5\""), 1U);
    EXPECT_EQ(count_of(flat, "fill=\"#440154\" stroke=\"#440154\""), 1U) << "the first colour of viridis";
    FigureCounts counts;
    write_figure(folder / "f.pdf", f, &counts).value();
    EXPECT_EQ(counts.render.drawn, 2U);
    EXPECT_EQ(testing::get(folder / "f.pdf").find("/Subtype /Image"), std::string::npos);
    // By the corners of a triangle, with points or arrows, beyond the window, too many, in space: an image.
    Figure g = f;
    g.surfaces = {{.points = points, .triangles = triangles, .point_values = values}};
    EXPECT_EQ(count_of(svg(g), "stroke-width=\"0.4\""), 0U);
    g = f;
    g.points = {{.points = points, .values = values}};
    EXPECT_EQ(count_of(svg(g), "stroke-width=\"0.4\""), 0U);
    g = f;
    g.arrows = {{.points = points, .vectors = points, .longest = 1}};
    EXPECT_EQ(count_of(svg(g), "stroke-width=\"0.4\""), 0U);
    g = f;
    g.options.camera.zoom = 2;
    EXPECT_EQ(count_of(svg(g), "stroke-width=\"0.4\""), 0U);
    std::vector<std::int32_t> many;
    for (int i = 0; i < 10000; ++i) many.insert(many.end(), {0, 1, 1, 0, 1, 1});
    g = f;
    g.surfaces = {{.points = points, .triangles = many}};
    EXPECT_EQ(count_of(svg(g), "stroke-width=\"0.4\""), 0U);
    g.surfaces[0].triangles = std::span(many).first(many.size() - 3);
    EXPECT_EQ(count_of(svg(g), "stroke-width=\"0.4\""), 19999U);
}

TEST(Figure, BoxesHaveNoEdgesBeforeTheMesh) {
    std::vector<double> corners;
    for (int i = 0; i < 24; ++i) corners.push_back((i / 3 >> i % 3 & 1) != 0 ? 1 : -1);
    Figure f = bare({}, {300, 300});
    f.surfaces.clear();
    f.points = {{.points = corners, .size = 0}};
    f.options.axes = Axes::box;
    // Seen along an axis one side looks at the viewer, so that all edges are drawn.
    for (const auto& [azimuth, elevation] :
         {std::pair(30.0, 25.0), {120, 40}, {-50, 20}, {200, -30}, {0, 0}, {90, 0}, {0, 90}}) {
        f.options.camera.azimuth = azimuth;
        f.options.camera.elevation = elevation;
        const bool along = std::fmod(azimuth, 90) == 0;
        const Image image = draw_figure(f).value();
        const draw::View view(f, f.options.size, 0.76);
        const auto drawn = [&](double sign) {
            const Vector3 towards = draw::ViewAxes(f.options.camera).towards;
            Vector3 corner;
            for (std::size_t k = 0; k < 3; ++k) corner[k] = (towards[k] < 0 ? -1 : 1) * sign;
            const draw::Pixel p = view.at(corner);
            std::size_t count = 0;
            for (std::int32_t k = 0; k < 9; ++k) {
                const auto x = static_cast<std::int32_t>(p.x) + k % 3 - 1,
                           y = 299 - static_cast<std::int32_t>(p.y) + k / 3 - 1;
                count += image.pixel(x, y) == f.options.background ? 0U : 1U;
            }
            return count;
        };
        EXPECT_EQ(drawn(1) > 2, along) << azimuth << ' ' << elevation;
        EXPECT_TRUE(along || drawn(1) == 0) << azimuth << ' ' << elevation;
        EXPECT_GT(drawn(-1), 2U) << azimuth << ' ' << elevation;
    }
}

TEST(Histograms, AreBarsOfCounts) {
    const draw::Histogram h{.title = "what",
                            .x = {.low = 2, .high = 5, .title = "size"},
                            .counts = {1, 0, 400},
                            .counted = "row",
                            .range = [](std::size_t i) { return "bin " + std::to_string(i); },
                            .bad = [](std::size_t i) { return i == 2; }};
    const draw::Picture one = draw::histogram(h);
    std::vector<const draw::PictureItem*> bars;
    for (const draw::PictureItem& item : one.items)
        if (item.kind == draw::PictureItem::Kind::bar) bars.push_back(&item);
    ASSERT_EQ(bars.size(), 2U);
    EXPECT_EQ(bars[0]->text, "bin 0: 1 row");
    EXPECT_EQ(bars[1]->text, "bin 2: 400 rows");
    EXPECT_EQ(bars[1]->style, "bar bad");
    EXPECT_GE(bars[0]->height, 5) << "by logarithm";
    EXPECT_NEAR(bars[1]->height, 174, 1e-9);
    EXPECT_NEAR(bars[1]->width, 440 / 3.0 - 1, 1e-9);
    const auto text = [&](const char* path, std::size_t count) {
        return draw::rows_text(path, std::vector<draw::Picture>(count, one), "some");
    };
    EXPECT_TRUE(text("a.pdf", 3).value().starts_with("%PDF-"));
    EXPECT_TRUE(text("a.png", 3).value().starts_with("\x89PNG"));
    EXPECT_EQ(count_of(text("-", 3).value(), "bin 2: 400 rows"), 3U);
    const auto width = [](double w) { return "width=\"" + std::to_string(static_cast<int>(w)) + "\""; };
    EXPECT_NE(text("-", 3).value().find(width(2 * one.width + 12)), std::string::npos);
    EXPECT_NE(text("-", 1).value().find(width(one.width + 12)), std::string::npos);
    EXPECT_FALSE(text("-", 0));
}

TEST(Figure, FilesAreWrittenBySuffix) {
    const TemporaryFolder folder;
    const std::vector<double> points{0, 0, 1, 0, 1, 1, 0, 1}, values{1, 2, 3, 4};
    const std::vector<std::int32_t> triangles{0, 1, 2, 0, 2, 3};
    Figure f{.dimension = 2, .surfaces = {{.points = points, .triangles = triangles, .point_values = values}}};
    f.options.title = "a <title> & more";
    f.options.bar_title = "T";
    f.options.unit = "K";
    for (const auto& [name, start] : {std::pair("f.png", "\x89PNG"), {"f.svg", "<svg "}, {"f.pdf", "%PDF-"}}) {
        ASSERT_TRUE(is_figure_name(name));
        ASSERT_TRUE(write_figure(folder / name, f));
        EXPECT_TRUE(testing::get(folder / name).starts_with(start)) << name;
        const std::string first = testing::get(folder / name);
        ASSERT_TRUE(write_figure(folder / name, f));
        EXPECT_EQ(testing::get(folder / name), first) << name << " is the same again";
    }
    const std::string svg = testing::get(folder / "f.svg");
    for (const char* text :
         {">a &lt;title&gt; &amp; more</text>", ">T (K)</text>", ">1.0</text>", "data:image/png;base64,"})
        EXPECT_NE(svg.find(text), std::string::npos) << text;
    EXPECT_EQ(read_png(folder / "f.png").value().width, 800);
    f.options.resolution = 2;
    ASSERT_TRUE(write_figure(folder / "f.png", f));
    EXPECT_EQ(read_png(folder / "f.png").value().width, 1600);
    EXPECT_FALSE(write_figure(folder / "f.gif", f));
    EXPECT_FALSE(write_figure(folder / "none/f.png", f));
}

TEST(Figure, BadInputIsAnError) {
    const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0}, values{1, 2, 3}, two{1, 2};
    const std::vector<double> bad{0, 0, std::numeric_limits<double>::infinity(), 1, 0, 0, 0, 1, 0};
    const std::vector<std::int32_t> triangle{0, 1, 2}, beyond{0, 1, 3}, negative{0, -1, 2}, pair{0, 1};
    Figure good;
    good.surfaces = {{.points = points, .triangles = triangle, .point_values = values}};
    ASSERT_TRUE(draw_figure(good));
    const auto refused = [&](auto change) {
        Figure f = good;
        change(f, f.surfaces[0], f.options);
        EXPECT_FALSE(draw_figure(f));
    };
    using S = FigureSurface;
    using O = FigureOptions;
    refused([](Figure& f, S&, O&) { f.dimension = 4; });
    refused([&](Figure&, S& s, O&) { s.triangles = beyond; });
    refused([&](Figure&, S& s, O&) { s.triangles = negative; });
    refused([&](Figure&, S& s, O&) { s.triangles = pair; });
    refused([&](Figure&, S& s, O&) { s.points = bad; });
    refused([&](Figure&, S& s, O&) { s.points = two; });
    refused([&](Figure&, S& s, O&) { s.point_values = two; });
    refused([&](Figure&, S& s, O&) { s.triangle_values = std::span(values).subspan(0, 1); });
    refused([](Figure&, S&, O& o) { o.camera.azimuth = HUGE_VAL; });
    refused([](Figure&, S&, O& o) { o.camera.zoom = 0; });
    refused([](Figure&, S&, O& o) { o.samples = 9; });
    refused([](Figure&, S&, O& o) { o.resolution = 0; });
    refused([](Figure&, S&, O& o) { o.colour_map = "jet9"; });
    refused([](Figure&, S&, O& o) { o.range = {2, 1}; });
    refused([](Figure&, S&, O& o) { o.size = {0, 10}; });
    refused([](Figure&, S&, O& o) { o.size = {20, 100}; });  // less than the bar
    refused([](Figure&, S&, O& o) { o.size = {500, 10}; });
    refused([&](Figure& f, S&, O&) { f.lines = {{.points = points, .segments = beyond}}; });
    refused([&](Figure& f, S&, O&) { f.arrows = {{.points = points, .vectors = two}}; });
    refused([&](Figure& f, S&, O&) { f.points = {{.points = two}}; });
    refused([&](Figure& f, S&, O&) { f.points = {{.points = points, .values = two}}; });
    refused([&](Figure& f, S&, O&) { f.points = {{.points = bad}}; });
    refused([&](Figure& f, S&, O&) { f.points = {{.points = points, .size = -1}}; });
    refused([&](Figure& f, S&, O&) { f.grid = {.width = 1, .height = 1}; });
}

}  // namespace
}  // namespace barycert
