// Pictures of slices, read back by libpng: every pixel is the colour of its value.
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
#include <numbers>
#include <vector>

#include "barycert/base/random.hpp"
#include "barycert/io.hpp"
#include "barycert/io/png/colour_map.hpp"
#include "barycert/io/png/panels.hpp"
#include "barycert/io/png/png_file.hpp"
#include "io/tetgen/mesh_files.hpp"

namespace barycert::io {
namespace {

using barycert::testing::TemporaryFolder;

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

struct Picture {
    std::size_t width = 0, height = 0;
    std::vector<std::uint8_t> bytes;
    std::string error;

    std::array<int, 4> at(std::size_t x, std::size_t y) const {  // y from the top
        std::array<int, 4> pixel{};
        for (std::size_t i = 0; i < 4; ++i) pixel[i] = bytes.at(4 * (y * width + x) + i);
        return pixel;
    }
};

Picture picture(const std::string& path) {
    Picture result;
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
    const io::Colour c = io::colour(i);
    return {c[0], c[1], c[2], 255};
}

constexpr std::array<int, 4> transparent{0, 0, 0, 0};

/// The slice with no bar, written and read.
Picture drawn(Slice slice, SliceCounts* counts = nullptr) {
    const TemporaryFolder folder;
    slice.bar = false;
    const Status written = write_png(folder / "slice.png", slice, counts);
    EXPECT_TRUE(written) << written.error().message();
    return picture(folder / "slice.png");
}

// Oklab from sRGB, by its author's definition; the other way in `curve` below.
std::array<double, 3> oklab(const std::array<double, 3>& c) {
    std::array<double, 3> v{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double s = c[i] / 255.0;
        v[i] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    }
    const double l = std::cbrt(0.4122214708 * v[0] + 0.5363325363 * v[1] + 0.0514459929 * v[2]);
    const double m = std::cbrt(0.2119034982 * v[0] + 0.6806995451 * v[1] + 0.1073969566 * v[2]);
    const double s = std::cbrt(0.0883024619 * v[0] + 0.2817188376 * v[1] + 0.6299787005 * v[2]);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

std::array<double, 3> oklab(const io::Colour& c) {
    return oklab(std::array<double, 3>{1.0 * c[0], 1.0 * c[1], 1.0 * c[2]});
}

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

TEST(ColourMap, IsTheCurveThatItSays) {
    const auto curve = [](double t) {
        const double hue = (305 + (108 - 305) * t) * std::numbers::pi / 180;
        const double chroma = 0.12 * (1 - t) * (1 - 2 * t) + 0.10 * 4 * t * (1 - t) + 0.17 * t * (2 * t - 1);
        return std::array<double, 3>{0.27 + (0.93 - 0.27) * t, chroma * std::cos(hue), chroma * std::sin(hue)};
    };
    constexpr int pieces = 100000;
    std::vector<double> length{0};
    for (int i = 0; i < pieces; ++i) {
        length.push_back(length.back() + distance(curve(1.0 * i / pieces), curve((i + 1.0) / pieces)));
    }
    for (int k = 0; k < io::colour_count; ++k) {
        const auto next = std::lower_bound(length.begin(), length.end(), length.back() * k / (io::colour_count - 1));
        const auto [light, a, b] = curve(1.0 * static_cast<double>(next - length.begin()) / pieces);
        const double l = std::pow(light + 0.3963377774 * a + 0.2158037573 * b, 3);
        const double m = std::pow(light - 0.1055613458 * a - 0.0638541728 * b, 3);
        const double s = std::pow(light - 0.0894841775 * a - 1.2914855480 * b, 3);
        const std::array<double, 3> linear{4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                                           -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                                           -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
        const io::Colour c = io::colour(k);
        for (std::size_t i = 0; i < 3; ++i) {
            ASSERT_GT(linear[i], 0);  // a colour that sRGB has
            ASSERT_LT(linear[i], 1);
            const double v = linear[i] <= 0.0031308 ? 12.92 * linear[i] : 1.055 * std::pow(linear[i], 1 / 2.4) - 0.055;
            // Half a step of rounding, and what a piece of the curve may be off: 1e-5 of it is 1/100 of a step.
            EXPECT_NEAR(c[i], 255 * v, 0.5 + 0.01) << k;
        }
    }
}

/// How far the rounding to 8 bits, half a step in each component, may have moved a colour.
double rounding_of(const io::Colour& c) {
    std::array<double, 3> exact{};
    double max = 0;
    for (int corner = 0; corner < 8; ++corner) {
        for (std::size_t i = 0; i < 3; ++i) exact[i] = c[i] + ((corner >> i & 1) != 0 ? 0.5 : -0.5);
        max = std::max(max, distance(oklab(exact), oklab(c)));
    }
    return max;
}

/// What the map is for. The distance of colours 16 steps apart is the same everywhere, but for their rounding and for
/// the chord being shorter than the curve: its hue turns by 12.4 degrees, which makes at most 0.2 % (angle^2 / 24).
TEST(ColourMap, EqualStepsAndEverLighter) {
    double min = 1, max = 0;
    for (int i = 0; i + 16 < io::colour_count; ++i) {
        const double apart = distance(oklab(io::colour(i)), oklab(io::colour(i + 16)));
        const double rounding = rounding_of(io::colour(i)) + rounding_of(io::colour(i + 16));
        EXPECT_LT(rounding, 0.2 * apart);
        min = std::min(min, 1.002 * (apart + rounding));
        max = std::max(max, apart - rounding);
    }
    EXPECT_LE(max, min);
    for (int i = 1; i < io::colour_count; ++i) EXPECT_GT(oklab(io::colour(i))[0], oklab(io::colour(i - 1))[0]) << i;
}

TEST(Png, EveryPixelIsTheColourOfItsValue) {
    // 3 by 2, the first line at the bottom.
    const std::vector<double> values{0, 1, 2, 255, 254.5, 256};
    SliceCounts counts;
    const Picture p = drawn({.width = 3, .height = 2, .values = values}, &counts);
    ASSERT_EQ(p.width, 3U);
    ASSERT_EQ(p.height, 2U);
    EXPECT_EQ(p.at(0, 1), colour_of(0));
    EXPECT_EQ(p.at(1, 1), colour_of(1));
    EXPECT_EQ(p.at(2, 1), colour_of(2));
    EXPECT_EQ(p.at(0, 0), colour_of(255));
    EXPECT_EQ(p.at(1, 0), colour_of(254));
    EXPECT_EQ(p.at(2, 0), colour_of(255));
    EXPECT_EQ(counts.drawn, 6U);
    EXPECT_EQ(counts.low, 0);
    EXPECT_EQ(counts.high, 256);
    EXPECT_EQ(counts.below + counts.above + counts.not_finite + counts.outside, 0U);
}

TEST(Png, ARangeThatIsGiven) {
    const std::vector<double> values{-1, 0, std::nextafter(1.0, 0), 1, 1.5, nan};
    SliceCounts counts;
    const Picture p = drawn({.width = 6, .height = 1, .values = values, .range = {{0.0, 1.0}}}, &counts);
    const std::vector<std::array<int, 4>> expected{colour_of(0),   colour_of(0),   colour_of(255),
                                                   colour_of(255), colour_of(255), transparent};
    for (std::size_t x = 0; x < 6; ++x) EXPECT_EQ(p.at(x, 0), expected[x]) << x;
    EXPECT_EQ(counts.drawn, 5U);
    EXPECT_EQ(counts.below, 1U);
    EXPECT_EQ(counts.above, 1U);
    EXPECT_EQ(counts.not_finite, 1U);
}

TEST(Png, OutsideAndNotFiniteAreTransparent) {
    const std::vector<double> values{1e300, 3, inf, -inf, nan, 4, 5};
    const std::vector<std::uint8_t> valid{0, 1, 1, 1, 1, 1, 1};
    SliceCounts counts;
    const Picture p = drawn({.width = 7, .height = 1, .values = values, .valid = valid}, &counts);
    const std::vector<std::array<int, 4>> expected{transparent, colour_of(0),   transparent,   transparent,
                                                   transparent, colour_of(128), colour_of(255)};
    for (std::size_t x = 0; x < 7; ++x) EXPECT_EQ(p.at(x, 0), expected[x]) << x;
    EXPECT_EQ(counts.drawn, 3U);
    EXPECT_EQ(counts.not_finite, 3U);
    EXPECT_EQ(counts.outside, 1U);
    EXPECT_EQ(counts.low, 3);
    EXPECT_EQ(counts.high, 5);
}

TEST(Png, OneValueHasTheColourInTheMiddle) {
    for (const double x : {0.0, -0.0, 1.0, -7e300, 5e-324}) {
        const std::vector<double> values{x, x};
        const Picture p = drawn({.width = 1, .height = 2, .values = values});
        EXPECT_EQ(p.at(0, 0), colour_of(128));
        EXPECT_EQ(p.at(0, 1), colour_of(128));
    }
    const std::vector<double> values{1, 2, 3};
    const Picture p = drawn({.width = 3, .height = 1, .values = values, .range = {{2.0, 2.0}}});
    EXPECT_EQ(p.at(0, 0), colour_of(0));
    EXPECT_EQ(p.at(1, 0), colour_of(128));
    EXPECT_EQ(p.at(2, 0), colour_of(255));
}

TEST(Png, AnyMagnitude) {
    constexpr double max = std::numeric_limits<double>::max();
    const std::vector<double> large{-max, 0, max, -max / 2};
    Picture p = drawn({.width = 4, .height = 1, .values = large});
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

TEST(Png, AllNan) {
    const TemporaryFolder folder;
    const std::vector<double> values(35, nan);
    SliceCounts counts;
    ASSERT_TRUE(write_png(folder / "nan.png", {.width = 7, .height = 5, .values = values}, &counts));
    const Picture p = picture(folder / "nan.png");
    EXPECT_EQ(p.width, 7U);  // no range, no bar
    EXPECT_EQ(p.height, 5U);
    EXPECT_TRUE(std::all_of(p.bytes.begin(), p.bytes.end(), [](std::uint8_t b) { return b == 0; }));
    EXPECT_EQ(counts.drawn, 0U);
    EXPECT_TRUE(std::isnan(counts.low) && std::isnan(counts.high));
}

TEST(Png, Sizes) {
    for (const auto& [width, height] : std::vector<std::pair<std::size_t, std::size_t>>{
             {1, 1}, {1, 1000}, {1000, 1}, {2, 3}, {640, 480}, {4096, 4096}, {1000000, 1}, {1, 1000000}}) {
        SCOPED_TRACE(std::to_string(width) + " by " + std::to_string(height));
        std::vector<double> values(width * height);
        base::Random random(width + height);
        for (double& x : values) x = static_cast<double>(random.below(257));
        values[0] = 0;  // so that the range is known, where there are two values
        values.back() = 256;
        const Picture p = drawn({.width = width, .height = height, .values = values});
        ASSERT_EQ(p.width, width);
        ASSERT_EQ(p.height, height);
        if (values.size() == 1) continue;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const io::Colour c = io::colour(std::min(255, static_cast<int>(values[i])));
            const std::uint8_t* const pixel = &p.bytes[4 * ((height - 1 - i / width) * width + i % width)];
            wrong += pixel[0] != c[0] || pixel[1] != c[1] || pixel[2] != c[2] || pixel[3] != 255;
        }
        EXPECT_EQ(wrong, 0U);
    }
}

TEST(Png, TheShapeOfThePlane) {
    const std::vector<double> values{0, 1, 2, 3, 4, 256};
    Picture p = drawn({.width = 3, .height = 2, .values = values, .aspect = 2});
    ASSERT_EQ(p.width, 6U);
    ASSERT_EQ(p.height, 2U);
    for (std::size_t x = 0; x < 6; ++x) {
        EXPECT_EQ(p.at(x, 1), colour_of(static_cast<int>(x / 2)));
        EXPECT_EQ(p.at(x, 0), x < 4 ? colour_of(static_cast<int>(3 + x / 2)) : colour_of(255));
    }
    p = drawn({.width = 3, .height = 2, .values = values, .aspect = 1.0 / 3});
    ASSERT_EQ(p.width, 3U);
    ASSERT_EQ(p.height, 6U);
    for (std::size_t y = 0; y < 6; ++y) EXPECT_EQ(p.at(0, y), colour_of(y < 3 ? 3 : 0));
    // 3 values on 4 columns: middles at 3/8, 9/8, 15/8 and 21/8 of a value's width.
    p = drawn({.width = 3, .height = 2, .values = values, .aspect = 1.4});
    ASSERT_EQ(p.width, 4U);
    const std::array<int, 4> shown{0, 1, 1, 2};
    for (std::size_t x = 0; x < 4; ++x) EXPECT_EQ(p.at(x, 1), colour_of(shown[x]));
}

TEST(Png, TheBarStandsBesideTheSlice) {
    const TemporaryFolder folder;
    std::vector<double> values(40 * 30);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i % 97);
    values[5] = nan;
    for (const std::size_t height : {1U, 24U, 25U, 30U}) {
        const Slice slice{.width = 40, .height = height, .values = std::span(values).first(40 * height)};
        ASSERT_TRUE(write_png(folder / "bar.png", slice));
        const Picture plain = drawn(slice), p = picture(folder / "bar.png");
        ASSERT_EQ(p.height, std::max<std::size_t>(height, io::min_bar_height));
        for (std::size_t y = 0; y < p.height; ++y) {
            for (std::size_t x = 0; x < 40; ++x) EXPECT_EQ(p.at(x, y), y < height ? plain.at(x, y) : transparent);
            for (std::size_t x = 40; x < p.width; ++x) EXPECT_EQ(p.at(x, y)[3], 255);
        }
        // The bar's ends, four pixels in, are the first and the last colour; around it all is white.
        const std::array<int, 4> white{255, 255, 255, 255};
        EXPECT_EQ(p.at(44, 3), white);
        EXPECT_EQ(p.at(44, 4), colour_of(255));
        EXPECT_EQ(p.at(44, p.height - 5), colour_of(0));
        EXPECT_EQ(p.at(44, p.height - 4), white);
        EXPECT_EQ(p.at(43, p.height / 2), white);
        EXPECT_EQ(p.at(54, p.height / 2), white);
    }
}

/// What stands in the panel of a bar, dark dots as #.
std::vector<std::string> panel(double low, double high, std::size_t height) {
    const io::ColourBar bar(low, high, height);
    std::vector<std::string> rows;
    std::vector<std::uint8_t> pixels(4 * bar.width());
    for (std::size_t r = 0; r < height; ++r) {
        bar.row(r, pixels.data());
        rows.emplace_back();
        for (std::size_t x = 0; x < bar.width(); ++x)
            rows.back() += pixels[4 * x] == 34 && pixels[4 * x + 1] == 34 && pixels[4 * x + 2] == 34 ? '#' : ' ';
    }
    return rows;
}

TEST(Png, NumbersAtTheBar) {
    const std::vector<std::string> rows = panel(-1.5, 10, 25);
    const std::vector<std::string> high{
        "  #    ###              ", " ##   #   #             ", "# #   #   #             ", "  #   #   #             ",
        "  #   #   #             ", "  #   #   #             ", "#####  ###              "};
    const std::vector<std::string> low{
        "        #         ##### ", "       ##         #     ", "      # #         ####  ", " ###    #             # ",
        "        #             # ", "        #    ##   #   # ", "      #####  ##    ###  "};
    for (std::size_t r = 0; r < 7; ++r) {
        EXPECT_EQ(rows[4 + r].substr(18, 24), high[r]);
        EXPECT_EQ(rows[14 + r].substr(18, 24), low[r]);
    }
    for (const std::size_t r : {0U, 3U, 11U, 13U, 21U, 24U}) EXPECT_EQ(rows[r].find('#'), std::string::npos) << r;
    // Every character that a number may hold has dots, and no two the same.
    const std::vector<std::string> all = panel(-1.234567890123e-300, 1e+300, 25);
    EXPECT_EQ(all[4 + 3].size(), 12 + 10 + 6 * std::string("-1.234567890123e-300").size());
    // Twice as high: the same text, twice as large.
    const std::vector<std::string> twice = panel(-1.5, 10, 500);
    for (std::size_t r = 0; r < 14; ++r) {
        for (std::size_t x = 0; x < 48; ++x) EXPECT_EQ(twice[8 + r].at(36 + x), high[r / 2][x / 2]);
    }
    // One number stands once.
    const std::vector<std::string> one = panel(3, 3, 25);
    EXPECT_NE(one[4].find('#'), std::string::npos);
    for (std::size_t r = 11; r < 25; ++r) EXPECT_EQ(one[r].find('#'), std::string::npos);
}

TEST(Png, RoundNumbersBetweenTheEndsOfTheBar) {
    // The rows of marks beside the bar, and the numbers there: -1.5 to 10 over 192 pixels.
    const auto marks = [](double low, double high, std::size_t height) {
        std::vector<std::size_t> rows;
        const std::vector<std::string> all = panel(low, high, height);
        for (std::size_t r = 0; r < height; ++r) {
            if (all[r].substr(14, 3) == "## ") rows.push_back(r);
        }
        return rows;
    };
    // 0 and 5: steps of 5 are the least that are 40 pixels apart; 10 is an end.
    const auto row_of = [](double value) {
        return 4 + static_cast<std::size_t>(std::lround(191 * (10 - value) / 11.5));
    };
    EXPECT_EQ(marks(-1.5, 10, 200), (std::vector<std::size_t>{row_of(5), row_of(0)}));
    EXPECT_EQ(marks(-1.5, 10, 25), std::vector<std::size_t>{});
    EXPECT_EQ(marks(3, 3, 200), std::vector<std::size_t>{});
    for (const auto& [low, high] : std::vector<std::pair<double, double>>{
             {-1.7e308, 1.7e308}, {0, 5e-324}, {1e15, 1e15 + 1}, {1, std::nextafter(1, 2)}, {-1e-300, 1e300}}) {
        const std::vector<std::string> all = panel(low, high, 240);
        for (const std::string& row : all) EXPECT_EQ(row.size(), all[0].size());
    }
}

TEST(Png, Errors) {
    const TemporaryFolder folder;
    const std::vector<double> values(6);
    const std::vector<std::uint8_t> valid(5);
    testing::put(folder / "s.png", "old");
    const auto refused = [&](const Slice& slice) {
        SliceCounts counts;
        counts.drawn = 77;
        const Status status = write_png(folder / "s.png", slice, &counts);
        if (status) return std::string("written");
        EXPECT_EQ(status.error().file, folder / "s.png");
        EXPECT_FALSE(status.error().remedy.empty());
        EXPECT_EQ(counts.drawn, 77U);
        return status.error().what;
    };
    const std::string size = "a slice of that size cannot be a picture";
    EXPECT_EQ(refused({}), size);
    EXPECT_EQ(refused({.width = 0, .height = 6}), size);
    EXPECT_EQ(refused({.width = 1000001, .height = 1, .values = values}), size);
    EXPECT_EQ(refused({.width = 1, .height = std::size_t{1} << 63, .values = values}), size);
    const std::string fit = "the arrays of the slice do not fit together";
    EXPECT_EQ(refused({.width = 3, .height = 3, .values = values}), fit);
    EXPECT_EQ(refused({.width = 3, .height = 2, .values = values, .valid = valid}), fit);
    for (const double aspect : {0.0, -1.0, nan, inf}) {
        EXPECT_EQ(refused({.width = 3, .height = 2, .values = values, .aspect = aspect}),
                  "the aspect of a slice is not valid");
    }
    for (const double aspect : {1e7, 1e-7, 5e-324, 1.7e308}) {
        EXPECT_EQ(refused({.width = 3, .height = 2, .values = values, .aspect = aspect}),
                  "a slice of that aspect cannot be a picture");
    }
    for (const auto& [low, high] :
         std::vector<std::pair<double, double>>{{1, 0}, {nan, 1}, {0, nan}, {0, inf}, {-inf, 0}}) {
        EXPECT_EQ(refused({.width = 3, .height = 2, .values = values, .range = {{low, high}}}),
                  "the range of colours is not valid");
    }
    const std::vector<double> line(1000000);
    EXPECT_EQ(refused({.width = 1000000, .height = 1, .values = line}), "there is no room for the colour bar");
    EXPECT_EQ(testing::get(folder / "s.png"), "old");
    EXPECT_EQ(folder.file_count(), 1U);
    EXPECT_EQ(write_png(folder / "none/s.png", {.width = 3, .height = 2, .values = values}).error().remedy,
              "make the folder first, or name another one");
}

TEST(Png, AFullDiskLeavesTheTarget) {
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
        failures.push_back(write_png(folder / "s.png", {.width = 1000, .height = 1000, .values = values}));
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

TEST(IndexedPng, EveryPixelIsItsColour) {
    const std::vector<Colour> colours{{1, 2, 3}, {255, 255, 255}, {0, 114, 178}, {32, 32, 32}};
    for (const std::size_t width : {1U, 3U, 16U}) {
        std::vector<std::uint8_t> pixels;
        for (std::size_t i = 0; i < 5 * width; ++i) pixels.push_back(static_cast<std::uint8_t>(i * i % 4));
        const std::string bytes = indexed_png(width, pixels, colours).value();
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        ASSERT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0) << image.message;
        EXPECT_EQ(image.width, width);
        EXPECT_EQ(image.height, 5U);
        image.format = PNG_FORMAT_RGB;
        std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(image));
        ASSERT_NE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr), 0) << image.message;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(read[3 * i + k], colours[pixels[i]][k]);
        }
    }
}

}  // namespace
}  // namespace barycert::io
