#include "barycert/scene.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "tests/draw/raster/judge.hpp"
#include "tests/draw/raster/ray_judge.hpp"

namespace barycert {
namespace {

std::uint64_t sum_of(const RenderCounts& n) {
    return n.drawn + n.outside + n.degenerate + n.between_pixels;
}

/// Triangle t of the scene as rows of clip positions and attributes. Requires: the matrix is the identity.
std::vector<double> rows_of(const Scene& s, std::size_t t) {
    std::vector<double> rows;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto v = static_cast<std::size_t>(s.triangles[3 * t + c]);
        rows.insert(rows.end(), s.positions.begin() + static_cast<std::ptrdiff_t>(4 * v),
                    s.positions.begin() + static_cast<std::ptrdiff_t>(4 * v + 4));
        for (std::size_t k = 0; k < 3 && !s.colours.empty(); ++k) rows.push_back(s.colours[3 * v + k]);
        for (std::size_t k = 0; k < 2 && !s.texture_coordinates.empty(); ++k)
            rows.push_back(s.texture_coordinates[2 * v + k]);
    }
    return rows;
}

/// Vertices whose window coordinates are exact, so that nothing is rounded but the results.
void add_exact_triangle(Scene& s, base::Random& random) {
    for (int v = 0; v < 3; ++v) {
        const double w = std::ldexp(1.0, random.integer(-3, 3));
        for (int k = 0; k < 2; ++k) s.positions.push_back(w * random.integer(-1024, 1024) / 1024);
        s.positions.push_back(w * random.integer(-60, 60) / 64);
        s.positions.push_back(w);
        s.triangles.push_back(static_cast<std::int32_t>(s.triangles.size()));
        for (int k = 0; k < 2; ++k) s.texture_coordinates.push_back(random.uniform(-1, 2));
    }
}

TEST(Render, PerspectiveEqualsRayCastingExactly) {
    base::Random random(1);
    std::size_t pixels = 0;
    for (int k = 0; k < 60; ++k) {
        Scene s;
        s.size = {32, 16};
        s.rounding = Rounding::correct;
        for (std::uint64_t t = 1 + random.below(3); t > 0; --t) add_exact_triangle(s, random);
        PixelValues drawn;
        RenderCounts counts;
        ASSERT_TRUE(render(s, &counts, &drawn));
        ASSERT_EQ(counts.clipped, 0U);
        for (std::int32_t j = 0; j < s.size.height; ++j) {
            for (std::int32_t i = 0; i < s.size.width; ++i) {
                const double* const uv = drawn.data.data() + 2 * static_cast<std::size_t>(j * s.size.width + i);
                std::optional<RayHit> nearest;
                bool tie = false;
                for (std::size_t t = 0; t < s.triangles.size() / 3; ++t) {
                    const std::vector<double> rows = rows_of(s, t);
                    Corners window;
                    for (std::size_t v = 0; v < 3; ++v) {
                        const std::array<double, 2> p = viewport(s.size, rows[6 * v], rows[6 * v + 1], rows[6 * v + 3]);
                        window[2 * v] = p[0];
                        window[2 * v + 1] = p[1];
                    }
                    if (!judge_covers(window, i, j)) continue;
                    const std::optional<RayHit> hit = cast_ray(rows, s.size, i, j);
                    ASSERT_TRUE(hit);
                    if (nearest && CGAL::to_double(nearest->depth - hit->depth) == 0) tie = true;
                    if (!nearest || hit->depth < nearest->depth) nearest = hit;
                }
                ASSERT_EQ(std::isnan(uv[0]), !nearest) << i << ' ' << j;
                if (!nearest || tie) continue;
                ++pixels;
                ASSERT_TRUE(is_nearest(uv[0], nearest->attributes[0])) << i << ' ' << j;
                ASSERT_TRUE(is_nearest(uv[1], nearest->attributes[1])) << i << ' ' << j;
            }
        }
    }
    EXPECT_GT(pixels, 3000U);
}

/// Triangles before and behind the eye, in and out of sight.
Scene any_scene(base::Random& random, int triangles) {
    Scene s;
    s.size = {24, 20};
    for (int v = 0; v < 3 * triangles; ++v) {
        for (int k = 0; k < 3; ++k) s.positions.push_back(random.uniform(-2, 2));
        s.positions.push_back(random.uniform(-0.5, 2));
        for (int k = 0; k < 3; ++k) s.colours.push_back(random.unit());
        s.triangles.push_back(v);
    }
    return s;
}

/// The largest factor by which window coordinates that are off may change an attribute: the greatest change of an
/// attribute with a step of half a pixel, by rays.
double slope(const std::vector<double>& rows, RasterSize size, std::int32_t i, std::int32_t j, std::size_t attribute) {
    const RasterSize fine{3 * size.width, 3 * size.height};  // the centre of a pixel is one of nine
    const auto at = [&](std::int32_t x, std::int32_t y) {
        const auto hit = cast_ray(rows, fine, 3 * i + 1 + x, 3 * j + 1 + y);
        return hit ? CGAL::to_double(hit->attributes[attribute]) : std::numeric_limits<double>::quiet_NaN();
    };
    double most = 0;
    for (const auto& [x, y] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const double change = std::abs(at(x, y) - at(0, 0));
        most = std::isnan(change) ? HUGE_VAL : std::max(most, 3 * change);  // at a rim: not judged
    }
    return most;
}

TEST(Render, ClippedTrianglesAreSeenAsRaysSeeThem) {
    base::Random random(2);
    std::size_t judged = 0, clipped = 0;
    for (int k = 0; k < 120; ++k) {
        Scene s = any_scene(random, 1);
        const std::vector<double> rows = rows_of(s, 0);
        for (const Rounding rounding : {Rounding::plain, Rounding::correct}) {
            s.rounding = rounding;
            PixelValues drawn;
            RenderCounts counts;
            ASSERT_TRUE(render(s, &counts, &drawn));
            clipped += counts.clipped;
            for (std::int32_t j = 0; j < s.size.height; ++j) {
                for (std::int32_t i = 0; i < s.size.width; ++i) {
                    const double* const rgb = drawn.data.data() + 3 * static_cast<std::size_t>(j * s.size.width + i);
                    const std::optional<RayHit> hit = cast_ray(rows, s.size, i, j);
                    const double steep = slope(rows, s.size, i, j, 0);
                    if (steep == HUGE_VAL) continue;  // within a third of a pixel of the rim
                    ASSERT_EQ(std::isnan(rgb[0]), !hit) << k << ' ' << i << ' ' << j;
                    if (!hit) continue;
                    // Window coordinates are off by some 2^-48 pixels (plain: three roundings of numbers below 24, and
                    // the new vertices' own); plain weights by 2^-37 at most, mostly by far less.
                    const double bound = rounding == Rounding::correct ? 1e-13 * (1 + steep) : 1e-10 * (1 + steep);
                    ASSERT_NEAR(rgb[0], CGAL::to_double(hit->attributes[0]), bound) << k << ' ' << i << ' ' << j;
                    ++judged;
                }
            }
        }
    }
    EXPECT_GT(judged, 5000U);
    EXPECT_GT(clipped, 100U);
}

TEST(Render, OrthographicIsAffine) {
    base::Random random(3);
    for (int k = 0; k < 40; ++k) {
        Scene s = any_scene(random, 3);
        for (std::size_t i = 3; i < s.positions.size(); i += 4) s.positions[i] = 1;
        s.to_clip = orthographic(-1.5, 1, -1, 1.25, -2, 2).value();
        for (const Rounding rounding : {Rounding::plain, Rounding::correct}) {
            s.rounding = rounding;
            PixelValues perspective, affine;
            s.interpolation = Interpolation::perspective;
            const Image one = render(s, nullptr, &perspective).value();
            s.interpolation = Interpolation::affine;
            const Image other = render(s, nullptr, &affine).value();
            for (std::size_t i = 0; i < affine.data.size(); ++i) {
                if (rounding == Rounding::correct) {
                    ASSERT_TRUE(perspective.data[i] == affine.data[i] || std::isnan(affine.data[i]));
                } else if (!std::isnan(affine.data[i])) {
                    // Both weigh with weights that are off by at most 2^-37 in a thin triangle.
                    ASSERT_NEAR(perspective.data[i], affine.data[i], 0x1p-34);
                }
            }
            for (std::size_t i = 0; i < one.data.size(); ++i)
                ASSERT_NEAR(one.data[i], other.data[i], rounding == Rounding::correct ? 0 : 1);
        }
    }
}

TEST(Render, AllMethodsGiveTheSamePicture) {
    base::Random random(4);
    for (int k = 0; k < 40; ++k) {
        Scene s = any_scene(random, 4);
        PixelValues first;
        RenderCounts first_counts;
        ASSERT_TRUE(render(s, &first_counts, &first));
        for (const FillMethod method : {FillMethod::scanline, FillMethod::bilinear}) {
            s.method = method;
            PixelValues values;
            RenderCounts counts;
            ASSERT_TRUE(render(s, &counts, &values));
            EXPECT_EQ(counts.covered, first_counts.covered);
            EXPECT_EQ(counts.pixels, first_counts.pixels);
            for (std::size_t i = 0; i < values.data.size(); ++i) {
                if (!std::isnan(first.data[i])) {
                    ASSERT_NEAR(values.data[i], first.data[i], 1e-7) << k;
                }
            }
        }
    }
}

TEST(Render, PlainValuesOfTheThinnestTriangles) {
    base::Random random(9);
    std::uint64_t covered = 0;
    for (int k = 0; k < 3000; ++k) {
        Scene s;
        s.size = {32, 32};
        // Along the diagonal of centres, a few units of 2^-40 pixels wide. Window coordinates are exact.
        for (int v = 0; v < 3; ++v) {
            const int at = random.integer(0, 31);
            for (int axis = 0; axis < 2; ++axis) {
                const double x = at + 0.5 + random.integer(-3, 3) * 0x1p-40;
                s.positions.push_back(x / 16 - 1);
            }
            s.positions.insert(s.positions.end(), {0, 1});
            for (int c = 0; c < 3; ++c) s.colours.push_back(random.unit());
            s.triangles.push_back(v);
        }
        s.rounding = Rounding::correct;
        PixelValues exact, plain;
        ASSERT_TRUE(render(s, nullptr, &exact));
        s.rounding = Rounding::plain;
        for (const Interpolation interpolation : {Interpolation::affine, Interpolation::perspective}) {
            s.interpolation = interpolation;
            RenderCounts counts;
            ASSERT_TRUE(render(s, &counts, &plain));
            covered += counts.covered;
            for (std::size_t i = 0; i < plain.data.size(); ++i) {
                if (!std::isnan(exact.data[i])) {
                    ASSERT_NEAR(plain.data[i], exact.data[i], 0x1p-36) << k;
                }
            }
        }
    }
    EXPECT_GT(covered, 3000U);
}

/// A square of cells * cells squares of two triangles, its inner nodes jittered, seen by the matrix.
Scene jittered_floor(base::Random& random, int cells, double half) {
    Scene s;
    s.size = {40, 30};
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            const bool inner = i > 0 && j > 0 && i < cells && j < cells;
            const double step = 2 * half / cells;
            const double x = -half + step * i + (inner ? step * random.uniform(-0.2, 0.2) : 0);
            const double z = -half + step * j + (inner ? step * random.uniform(-0.2, 0.2) : 0);
            s.positions.insert(s.positions.end(), {x, 0, z, 1});
            for (int c = 0; c < 3; ++c) s.colours.push_back(random.unit());
        }
    }
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            const std::int32_t a = j * (cells + 1) + i, b = a + 1, c = a + cells + 2, d = a + cells + 1;
            for (const std::int32_t v : {a, b, c, a, c, d}) s.triangles.push_back(v);
        }
    }
    return s;
}

TEST(Render, R1EachPixelOnceAcrossClippedEdges) {
    base::Random random(5);
    for (int k = 0; k < 60; ++k) {
        Scene s = jittered_floor(random, 8, 30);
        // The eye stands among the triangles, above the floor, and looks down at it: much lies behind.
        const Matrix4 view = look_at({random.uniform(-3, 3), 1, random.uniform(-3, 3)},
                                     {random.uniform(-3, 3), -1, random.uniform(-3, 3)}, {0, 1, 0.1})
                                 .value();
        s.to_clip = perspective(random.uniform(20, 50), 4.0 / 3, 0.01, 100).value() * view;
        s.rounding = k % 2 == 0 ? Rounding::plain : Rounding::correct;
        RenderCounts counts;
        ASSERT_TRUE(render(s, &counts));
        EXPECT_EQ(counts.hidden, 0U) << k;
        EXPECT_EQ(counts.covered, counts.pixels) << k;
        EXPECT_GT(counts.clipped, 0U);
        EXPECT_EQ(sum_of(counts), counts.triangles);
    }
}

TEST(Render, AFloorThatGoesThroughTheEyesPlaneFillsTheLowerHalf) {
    base::Random random(6);
    Scene s = jittered_floor(random, 6, 1000);
    const Matrix4 view = look_at({0.3, 1, 0.2}, {0.3, 1, -5}, {0, 1, 0}).value();
    s.to_clip = perspective(60, 4.0 / 3, 0.1, 900).value() * view;
    RenderCounts counts;
    const Image image = render(s, &counts).value();
    EXPECT_EQ(counts.hidden, 0U);
    // The floor ends at a depth of 900: less than a pixel below the horizon.
    EXPECT_EQ(counts.pixels, 40U * 15);
    for (std::int32_t i = 0; i < 40; ++i) {
        EXPECT_NE(image.pixel(i, 14), s.background);
        EXPECT_EQ(image.pixel(i, 15), s.background);
    }
}

TEST(Render, TheNearestIsSeenInAnyOrder) {
    Scene s;
    s.size = {8, 8};
    s.positions = {-1, -1, 0.5, 1, 3, -1, 0.5, 1, -1, 3, 0.5, 1, -1, -1, -0.5, 1, 3, -1, 0.9, 1, -1, 3, -0.5, 1};
    s.colours = {1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    s.triangles = {0, 1, 2, 3, 4, 5};
    const Image one = render(s).value();
    s.triangles = {3, 4, 5, 0, 1, 2};
    RenderCounts counts;
    EXPECT_EQ(render(s, &counts).value(), one);
    EXPECT_EQ(counts.pixels, 64U);
    EXPECT_EQ(counts.covered, 128U);
    // Depth of the second along x: -0.5 + 0.35 (x + 1): below 0.5 throughout the window up to x = 1.857.
    EXPECT_EQ(one.pixel(0, 0), (Rgba{0, 255, 0, 255}));
    s.positions[4 * 4 + 2] = 4.5;  // now it rises above the first in the middle of the window
    const Image crossed = render(s).value();
    EXPECT_EQ(crossed.pixel(0, 3), (Rgba{0, 255, 0, 255}));
    EXPECT_EQ(crossed.pixel(7, 0), (Rgba{255, 0, 0, 255}));
    // Equal depths: the first stays.
    s.positions = {-1, -1, 0, 1, 3, -1, 0, 1, -1, 3, 0, 1, -1, -1, 0, 1, 3, -1, 0, 1, -1, 3, 0, 1};
    EXPECT_EQ(render(s).value().pixel(3, 3), (Rgba{0, 255, 0, 255}));
}

TEST(Render, WithoutAreaAndBetweenPixels) {
    Scene s;
    s.size = {10, 10};
    s.positions = {-0.5, -0.5, 0, 1, 0.5,  0.5,  0, 1, 0.75, 0.75, 0, 1,  // on a line
                   0.01, 0.01, 0, 1, 0.03, 0.01, 0, 1, 0.01, 0.03, 0, 1,  // between centres
                   5,    5,    0, 1, 6,    5,    0, 1, 5,    6,    0, 1,  // out of sight
                   0,    0,    0, 0, 1,    0,    0, 1, 0,    1,    0, 1,  // w = 0
                   -1,   -1,   0, 1, 1,    -1,   0, 1, 0,    1,    0, 1};
    for (std::int32_t i = 0; i < 15; ++i) s.triangles.push_back(i);
    for (const Rounding rounding : {Rounding::plain, Rounding::correct}) {
        s.rounding = rounding;
        RenderCounts n;
        ASSERT_TRUE(render(s, &n));
        EXPECT_EQ(n.triangles, 5U);
        EXPECT_EQ(n.degenerate, 2U);
        EXPECT_EQ(n.between_pixels, 1U);
        EXPECT_EQ(n.outside, 1U);
        EXPECT_EQ(n.drawn, 1U);
        EXPECT_EQ(n.pixels, 50U);
    }
}

TEST(Render, ColoursAndTextures) {
    Scene s;
    s.size = {4, 4};
    s.positions = {-1, -1, 0, 1, 1, -1, 0, 1, 1, 1, 0, 1, -1, 1, 0, 1};
    s.triangles = {0, 1, 2, 0, 2, 3};
    EXPECT_EQ(render(s).value().pixel(1, 2), (Rgba{0, 0, 0, 255}));
    s.colours.assign(12, 0.5);
    EXPECT_EQ(render(s).value().pixel(1, 2), (Rgba{128, 128, 128, 255}));
    s.colours[0] = 1e300;
    s.colours[1] = -1e300;
    const Rgba far = render(s).value().pixel(0, 0);
    EXPECT_EQ(far[0], 255);
    EXPECT_EQ(far[1], 0);
    s.colours.assign(12, 0.5);
    s.texture_coordinates = {0, 0, 1, 0, 1, 1, 0, 1};
    s.texture = Texture{
        {2, 2, {200, 0, 0, 255, 0, 200, 0, 9, 0, 0, 200, 255, 100, 100, 100, 255}}, Wrap::clamp, Filter::nearest};
    const Image image = render(s).value();
    EXPECT_EQ(image.pixel(0, 0), (Rgba{100, 0, 0, 255}));
    EXPECT_EQ(image.pixel(3, 1), (Rgba{0, 100, 0, 9}));
    EXPECT_EQ(image.pixel(1, 3), (Rgba{0, 0, 100, 255}));
    s.colours.clear();
    EXPECT_EQ(render(s).value().pixel(3, 3), (Rgba{100, 100, 100, 255}));
}

TEST(Render, BadScenesAreErrors) {
    base::Random random(8);
    const Scene good = any_scene(random, 2);
    ASSERT_TRUE(render(good));
    const auto refused = [&](const char* what, auto change) {
        Scene s = good;
        change(s);
        const Result<Image> image = render(s);
        EXPECT_FALSE(image) << what;
        if (!image) {
            EXPECT_FALSE(image.error().expected.empty()) << what;
        }
    };
    refused("size 0", [](Scene& s) { s.size.width = 0; });
    refused("negative size", [](Scene& s) { s.size.height = -4; });
    refused("large size", [](Scene& s) { s.size = {32768, 32768}; });
    refused("huge size", [](Scene& s) { s.size = {2147483647, 2147483647}; });
    refused("NaN", [](Scene& s) { s.positions[5] = std::numeric_limits<double>::quiet_NaN(); });
    refused("NaN in a colour", [](Scene& s) { s.colours[5] = std::numeric_limits<double>::quiet_NaN(); });
    refused("infinity", [](Scene& s) { s.to_clip.m[3] = HUGE_VAL; });
    refused("overflow", [](Scene& s) { s.positions[0] = 1e308, s.to_clip.m[0] = 4; });
    refused("overflow, correctly rounded",
            [](Scene& s) { s.positions[0] = 1e308, s.to_clip.m[0] = 4, s.rounding = Rounding::correct; });
    refused("index", [](Scene& s) { s.triangles[4] = 6; });
    refused("negative index", [](Scene& s) { s.triangles[4] = -1; });
    refused("two vertices", [](Scene& s) { s.triangles.pop_back(); });
    refused("positions", [](Scene& s) { s.positions.pop_back(); });
    refused("colours", [](Scene& s) { s.colours.pop_back(); });
    refused("coordinates", [](Scene& s) { s.texture_coordinates = {1}; });
    refused("texture without coordinates", [](Scene& s) { s.texture = Texture{four_colours(), {}, {}}; });
    refused("texture without texels", [](Scene& s) { s.texture_coordinates.assign(12, 0), s.texture = Texture{}; });
    refused("correct scanline", [](Scene& s) { s.rounding = Rounding::correct, s.method = FillMethod::scanline; });
    refused("correct fault",
            [](Scene& s) { s.rounding = Rounding::correct, s.interpolation = Interpolation::projected_z; });
    Scene empty;
    empty.size = {2, 3};
    EXPECT_EQ(render(empty).value(), blank_image(2, 3, {255, 255, 255, 255}).value());
}

void expect_picture_or_error(base::Random& random) {
    Scene s;
    s.size = {random.integer(1, 20), random.integer(1, 20)};
    const int range = random.coin() ? 3 : 1020;
    const auto number = [&] { return random.scaled(-1, 1, -range, range); };
    for (int v = 0; v < 12; ++v) {
        for (int k = 0; k < 4; ++k) s.positions.push_back(number());
        for (int k = 0; k < 2; ++k) s.texture_coordinates.push_back(number());
        for (int k = 0; k < 3; ++k) s.colours.push_back(number());
        s.triangles.push_back(random.integer(0, 11));
    }
    if (random.coin()) {
        for (double& x : s.to_clip.m) x = number();
    }
    s.texture = Texture{four_colours(), random.coin() ? Wrap::repeat : Wrap::mirror,
                        random.coin() ? Filter::nearest : Filter::bilinear};
    s.interpolation = static_cast<Interpolation>(random.below(3));
    s.method = static_cast<FillMethod>(random.below(3));
    if (s.method == FillMethod::barycentric && s.interpolation != Interpolation::projected_z && random.coin())
        s.rounding = Rounding::correct;
    RenderCounts n;
    PixelValues values;
    const Result<Image> image = render(s, &n, &values);
    if (!image) return;
    RC_ASSERT(check_image(*image).has_value());
    RC_ASSERT(sum_of(n) == n.triangles);
    RC_ASSERT(n.covered == n.pixels + n.hidden || n.covered > n.pixels);
    std::uint64_t drawn = 0;
    for (std::int32_t j = 0; j < s.size.height; ++j) {
        for (std::int32_t i = 0; i < s.size.width; ++i) drawn += image->pixel(i, j) != s.background ? 1U : 0U;
    }
    RC_ASSERT(drawn <= n.pixels);
}

TEST(Render, AnyTriangleAnyCamera) {
    EXPECT_TRUE(rc::check("a picture or an error, and counts that fit", [](std::uint64_t seed) {
        base::Random random(seed);
        for (int k = 0; k < 20; ++k) expect_picture_or_error(random);
    }));
}

}  // namespace
}  // namespace barycert
