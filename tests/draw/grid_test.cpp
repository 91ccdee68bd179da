// Pictures of grids, read back by libpng: every pixel is the colour of its value.
#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <vector>

#include "barycert/figure.hpp"
#include "core/base/random.hpp"
#include "draw/colour_map.hpp"
#include "tests/temporary_folder.hpp"

namespace barycert::draw {
namespace {

using barycert::testing::TemporaryFolder;

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

struct Read {
    std::size_t width = 0, height = 0;
    std::vector<std::uint8_t> bytes;
    std::string error;

    std::array<int, 4> at(std::size_t x, std::size_t y) const {  // y from the top
        std::array<int, 4> pixel{};
        for (std::size_t i = 0; i < 4; ++i) pixel[i] = bytes.at(4 * (y * width + x) + i);
        return pixel;
    }
};

Read picture(const std::string& path) {
    Read result;
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) != 0) {
        EXPECT_EQ(image.format, PNG_FORMAT_RGBA);
        image.format = PNG_FORMAT_RGBA;
        result.bytes.resize(PNG_IMAGE_SIZE(image));
        if (png_image_finish_read(&image, nullptr, result.bytes.data(), 0, nullptr) != 0) {
            result.width = image.width;
            result.height = image.height;
        }
    }
    EXPECT_EQ(image.warning_or_error, 0U) << image.message;
    png_image_free(&image);
    return result;
}

std::array<int, 4> colour_of(int i) {
    static const ColourMap map = *colour_map("viridis");
    const Rgba& c = map[static_cast<std::size_t>(i)];
    return {c[0], c[1], c[2], c[3]};
}

constexpr std::array<int, 4> transparent{0, 0, 0, 0};

using Range = std::optional<std::pair<double, double>>;

/// The grid alone.
Figure bare(const FigureGrid& grid, const Range& range = {}) {
    Figure f{.dimension = 2, .grid = grid};
    f.options.range = range;
    f.options.axes = Axes::none;
    f.options.bar = false;
    return f;
}

Status write(const std::string& path, const FigureGrid& grid, const Range& range = {}, FigureCounts* counts = nullptr) {
    FigureCounts all;
    const Status written = write_figure(path, bare(grid, range), &all);
    if (written && counts != nullptr) *counts = all;
    return written;
}

/// Written and read.
Read drawn(const FigureGrid& grid, FigureCounts* counts = nullptr, const Range& range = {}) {
    const TemporaryFolder folder;
    const Status written = write(folder / "grid.png", grid, range, counts);
    EXPECT_TRUE(written) << written.error().message();
    return picture(folder / "grid.png");
}

TEST(GridPicture, EveryPixelIsTheColourOfItsValue) {
    // 3 by 2, the first line at the bottom.
    const std::vector<double> values{0, 1, 2, 255, 254.5, 256};
    FigureCounts counts;
    const Read p = drawn({.width = 3, .height = 2, .values = values}, &counts);
    ASSERT_EQ(p.width, 3U);
    ASSERT_EQ(p.height, 2U);
    EXPECT_EQ(p.at(0, 1), colour_of(0));
    EXPECT_EQ(p.at(1, 1), colour_of(1));
    EXPECT_EQ(p.at(2, 1), colour_of(2));
    EXPECT_EQ(p.at(0, 0), colour_of(255));
    EXPECT_EQ(p.at(1, 0), colour_of(254));
    EXPECT_EQ(p.at(2, 0), colour_of(255));
    EXPECT_EQ(counts.grid.drawn, 6U);
    EXPECT_EQ(counts.low, 0);
    EXPECT_EQ(counts.high, 256);
    EXPECT_EQ(counts.below + counts.above + counts.grid.not_finite + counts.grid.outside, 0U);
}

TEST(GridPicture, ARangeThatIsGiven) {
    const std::vector<double> values{-1, 0, std::nextafter(1.0, 0), 1, 1.5, nan};
    FigureCounts counts;
    const Read p = drawn({.width = 6, .height = 1, .values = values}, &counts, {{0.0, 1.0}});
    const std::vector<std::array<int, 4>> expected{colour_of(0),   colour_of(0),   colour_of(255),
                                                   colour_of(255), colour_of(255), transparent};
    for (std::size_t x = 0; x < 6; ++x) EXPECT_EQ(p.at(x, 0), expected[x]) << x;
    EXPECT_EQ(counts.grid.drawn, 5U);
    EXPECT_EQ(counts.below, 1U);
    EXPECT_EQ(counts.above, 1U);
    EXPECT_EQ(counts.grid.not_finite, 1U);
}

TEST(GridPicture, OutsideAndNotFiniteAreTransparent) {
    const std::vector<double> values{1e300, 3, inf, -inf, nan, 4, 5};
    const std::vector<std::uint8_t> valid{0, 1, 1, 1, 1, 1, 1};
    FigureCounts counts;
    const Read p = drawn({.width = 7, .height = 1, .values = values, .valid = valid}, &counts);
    const std::vector<std::array<int, 4>> expected{transparent, colour_of(0),   transparent,   transparent,
                                                   transparent, colour_of(128), colour_of(255)};
    for (std::size_t x = 0; x < 7; ++x) EXPECT_EQ(p.at(x, 0), expected[x]) << x;
    EXPECT_EQ(counts.grid.drawn, 3U);
    EXPECT_EQ(counts.grid.not_finite, 3U);
    EXPECT_EQ(counts.grid.outside, 1U);
    EXPECT_EQ(counts.low, 3);
    EXPECT_EQ(counts.high, 5);
}

TEST(GridPicture, OneValueHasTheColourInTheMiddle) {
    for (const double x : {0.0, -0.0, 1.0, -7e300, 5e-324}) {
        const std::vector<double> values{x, x};
        const Read p = drawn({.width = 1, .height = 2, .values = values});
        EXPECT_EQ(p.at(0, 0), colour_of(128));
        EXPECT_EQ(p.at(0, 1), colour_of(128));
    }
    const std::vector<double> values{1, 2, 3};
    const Read p = drawn({.width = 3, .height = 1, .values = values}, nullptr, {{2.0, 2.0}});
    EXPECT_EQ(p.at(0, 0), colour_of(0));
    EXPECT_EQ(p.at(1, 0), colour_of(128));
    EXPECT_EQ(p.at(2, 0), colour_of(255));
}

TEST(GridPicture, AnyMagnitude) {
    constexpr double max = std::numeric_limits<double>::max();
    const std::vector<double> large{-max, 0, max, -max / 2};
    Read p = drawn({.width = 4, .height = 1, .values = large});
    EXPECT_EQ(p.at(0, 0), colour_of(0));
    EXPECT_EQ(p.at(1, 0), colour_of(128));
    EXPECT_EQ(p.at(2, 0), colour_of(255));
    EXPECT_EQ(p.at(3, 0), colour_of(64));
    const std::vector<double> small{0, 5e-324, 1e-323};
    p = drawn({.width = 3, .height = 1, .values = small});
    EXPECT_EQ(p.at(0, 0), colour_of(0));
    EXPECT_EQ(p.at(1, 0), colour_of(128));
    EXPECT_EQ(p.at(2, 0), colour_of(255));
}

TEST(GridPicture, AllNan) {
    const TemporaryFolder folder;
    const std::vector<double> values(35, nan);
    FigureCounts counts;
    ASSERT_TRUE(write(folder / "nan.png", {.width = 7, .height = 5, .values = values}, {}, &counts));
    const Read p = picture(folder / "nan.png");
    EXPECT_EQ(p.width, 7U);
    EXPECT_EQ(p.height, 5U);
    EXPECT_TRUE(std::all_of(p.bytes.begin(), p.bytes.end(), [](std::uint8_t b) { return b == 0; }));
    EXPECT_EQ(counts.grid.drawn, 0U);
    EXPECT_TRUE(std::isnan(counts.low) && std::isnan(counts.high));
}

TEST(GridPicture, Sizes) {
    for (const auto& [width, height] : std::vector<std::pair<std::size_t, std::size_t>>{
             {1, 1}, {1, 1000}, {1000, 1}, {2, 3}, {640, 480}, {4096, 4096}, {1000000, 1}, {1, 1000000}}) {
        SCOPED_TRACE(std::to_string(width) + " by " + std::to_string(height));
        std::vector<double> values(width * height);
        base::Random random(width + height);
        for (double& x : values) x = static_cast<double>(random.below(257));
        values[0] = 0;  // so that the range is known, where there are two values
        values.back() = 256;
        const Read p = drawn({.width = width, .height = height, .values = values});
        ASSERT_EQ(p.width, width);
        ASSERT_EQ(p.height, height);
        if (values.size() == 1) continue;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::array<int, 4> c = colour_of(std::min(255, static_cast<int>(values[i])));
            const std::uint8_t* const pixel = &p.bytes[4 * ((height - 1 - i / width) * width + i % width)];
            wrong += pixel[0] != c[0] || pixel[1] != c[1] || pixel[2] != c[2] || pixel[3] != 255;
        }
        EXPECT_EQ(wrong, 0U);
    }
}

TEST(GridPicture, TheShapeOfThePlane) {
    const std::vector<double> values{0, 1, 2, 3, 4, 256};
    Read p = drawn({.width = 3, .height = 2, .values = values, .spacing = {2, 1}});
    ASSERT_EQ(p.width, 6U);
    ASSERT_EQ(p.height, 2U);
    for (std::size_t x = 0; x < 6; ++x) {
        EXPECT_EQ(p.at(x, 1), colour_of(static_cast<int>(x / 2)));
        EXPECT_EQ(p.at(x, 0), x < 4 ? colour_of(static_cast<int>(3 + x / 2)) : colour_of(255));
    }
    p = drawn({.width = 3, .height = 2, .values = values, .spacing = {1.0 / 3, 1}});
    ASSERT_EQ(p.width, 3U);
    ASSERT_EQ(p.height, 6U);
    for (std::size_t y = 0; y < 6; ++y) EXPECT_EQ(p.at(0, y), colour_of(y < 3 ? 3 : 0));
    // 3 values on 4 columns: middles at 3/8, 9/8, 15/8 and 21/8 of a value's width.
    p = drawn({.width = 3, .height = 2, .values = values, .spacing = {1.4, 1}});
    ASSERT_EQ(p.width, 4U);
    const std::array<int, 4> shown{0, 1, 1, 2};
    for (std::size_t x = 0; x < 4; ++x) EXPECT_EQ(p.at(x, 1), colour_of(shown[x]));
}

TEST(GridPicture, Errors) {
    const TemporaryFolder folder;
    const std::vector<double> values(6);
    const std::vector<std::uint8_t> valid(5);
    testing::put(folder / "s.png", "old");
    const auto refused = [&](const FigureGrid& grid, const Range& range = {}) {
        FigureCounts counts;
        counts.grid.drawn = 77;
        const Status status = write(folder / "s.png", grid, range, &counts);
        if (status) return std::string("written");
        EXPECT_EQ(status.error().file, folder / "s.png");
        EXPECT_EQ(counts.grid.drawn, 77U);
        return status.error().what;
    };
    const std::string size = "a grid of that size cannot be a picture";
    EXPECT_EQ(refused({}), size);
    EXPECT_EQ(refused({.width = 0, .height = 6}), size);
    EXPECT_EQ(refused({.width = 1000001, .height = 1, .values = values}), size);
    EXPECT_EQ(refused({.width = 1, .height = std::size_t{1} << 63, .values = values}), size);
    const std::string fit = "the arrays of the grid do not fit together";
    EXPECT_EQ(refused({.width = 3, .height = 3, .values = values}), fit);
    EXPECT_EQ(refused({.width = 3, .height = 2, .values = values, .valid = valid}), fit);
    for (const double spacing : {0.0, -1.0, nan, inf})
        EXPECT_EQ(refused({.width = 3, .height = 2, .values = values, .spacing = {spacing, 1}}), "the place of a grid");
    for (const double spacing : {1e7, 1e-7, 5e-324, 1.7e308}) {
        EXPECT_EQ(refused({.width = 3, .height = 2, .values = values, .spacing = {spacing, 1}}),
                  "a grid of that aspect cannot be a picture");
    }
    for (const auto& [low, high] :
         std::vector<std::pair<double, double>>{{1, 0}, {nan, 1}, {0, nan}, {0, inf}, {-inf, 0}}) {
        EXPECT_EQ(refused({.width = 3, .height = 2, .values = values}, {{low, high}}), "the range of colours");
    }
    // Beside a bar, or on axes, it is a picture of cairo's, and no larger.
    const std::vector<double> line(1000000);
    Figure wide = bare({.width = 1000000, .height = 1, .values = line});
    wide.options.bar = true;
    EXPECT_FALSE(write_figure(folder / "s.png", wide));
    EXPECT_EQ(testing::get(folder / "s.png"), "old");
    EXPECT_EQ(folder.file_count(), 1U);
    EXPECT_EQ(write(folder / "none/s.png", {.width = 3, .height = 2, .values = values}).error().remedy,
              "make the folder first, or name another one");
}

TEST(GridPicture, TheSameBesideABarAndOnAxes) {
    const TemporaryFolder folder;
    std::vector<double> values(40 * 30);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i % 97);
    const FigureGrid grid{.width = 40, .height = 30, .values = values};
    const Read plain = drawn(grid);
    Figure f = bare(grid);
    f.options.bar = true;
    f.options.axes = Axes::automatic;
    f.options.title = "title";
    ASSERT_TRUE(write_figure(folder / "all.png", f));
    const Read whole = picture(folder / "all.png");
    // Axes take 68 pixels to the left, 16 above, the title 34.
    for (std::size_t y = 0; y + 1 < 30; ++y)
        for (std::size_t x = 1; x + 1 < 40; ++x)
            EXPECT_EQ(whole.at(68 + x, 50 + y + 1), plain.at(x, y + 1)) << x << ' ' << y;
}

TEST(GridPicture, AFullDiskLeavesTheTarget) {
    const TemporaryFolder folder;
    testing::put(folder / "s.png", "old");
    std::vector<double> values(1000000);
    base::Random random(1);
    for (double& x : values) x = random.uniform(0, 1);
    std::vector<Status> failures;
    std::size_t asked = 0;
    struct rlimit before {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    for (const rlim_t limit : {0U, 1000U, 500000U}) {
        const struct rlimit small { limit, before.rlim_max };
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
        failures.push_back(write(folder / "s.png", {.width = 1000, .height = 1000, .values = values}));
        ++asked;
    }
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);
    for (const Status& status : failures) {
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().remedy, "free some space, or write to another disk");
    }
    EXPECT_EQ(failures.size(), asked);
    EXPECT_EQ(testing::get(folder / "s.png"), "old");
    EXPECT_EQ(folder.file_count(), 1U);
}

}  // namespace
}  // namespace barycert::draw
