// Round numbers and what they are called.
#include "draw/axes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "barycert/figure.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "draw/colour_map.hpp"
#include "draw/files.hpp"

namespace barycert::draw {
namespace {

using Texts = std::vector<std::string>;

Texts texts(const Ticks& ticks) {
    Texts all;
    for (const Tick& t : ticks.ticks) all.push_back(t.text);
    return all;
}

TEST(Ticks, AreRoundAndFew) {
    EXPECT_EQ(texts(round_ticks(1.0000278387757613, 9.993791633427762, 5)), (Texts{"2", "4", "6", "8"}));
    EXPECT_EQ(texts(round_ticks(-1, 1, 5)), (Texts{"−1.0", "−0.5", "0.0", "0.5", "1.0"}));
    const Ticks small = round_ticks(0, 1.2e-3, 4);
    EXPECT_EQ(texts(small), (Texts{"0.0000", "0.0005", "0.0010"}));
    const Ticks tiny = round_ticks(0, 3e-7, 4);
    EXPECT_EQ(texts(tiny), (Texts{"0", "1", "2", "3"}));
    EXPECT_EQ(tiny.common, "×10⁻⁷");
    const Ticks narrow = round_ticks(1234500, 1234502, 4);
    EXPECT_EQ(texts(narrow), (Texts{"0", "1", "2"}));
    EXPECT_EQ(narrow.common, "+1234500");
}

TEST(Ticks, OfAnyRange) {
    base::Random random(6);
    for (int k = 0; k < 20000; ++k) {
        const double a = random.scaled(-1, 1, -500, 500), b = random.scaled(-1, 1, -500, 500);
        const double low = std::min(a, b), high = std::max(a, b);
        const int max = random.integer(2, 12);
        const Ticks ticks = round_ticks(low, high, max);
        ASSERT_LE(ticks.ticks.size(), static_cast<std::size_t>(max));
        ASSERT_FALSE(ticks.ticks.empty()) << low << " to " << high << ", " << max;
        for (const Tick& t : ticks.ticks) {
            ASSERT_TRUE(low <= t.at && t.at <= high);
            std::size_t digits = 0;
            for (const char c : t.text) digits += c >= '0' && c <= '9' ? 1U : 0U;
            ASSERT_LE(digits, 6U) << low << ' ' << high << ' ' << t.text;
        }
    }
    EXPECT_TRUE(round_ticks(1, 1, 5).ticks.empty());
    EXPECT_LE(round_numbers(-1.7e308, 1.7e308, 5).size(), 5U);
    EXPECT_LE(round_numbers(0, 5e-324, 5).size(), 5U);
}

TEST(Ticks, OfLogarithms) {
    const auto names = [](double low, double high) {
        Texts all;
        for (const Tick& t : log_ticks(low, high)) all.push_back(t.text);
        return all;
    };
    EXPECT_EQ(names(0, 1), (Texts{"1", "2", "5", "10"}));
    EXPECT_EQ(names(-6, -5), (Texts{"10⁻⁶", "2×10⁻⁶", "5×10⁻⁶", "10⁻⁵"}));
    EXPECT_EQ(names(0, 4), (Texts{"10⁰", "10¹", "10²", "10³", "10⁴"}));
    EXPECT_LE(names(-300, 300).size(), 12U);
}

TEST(Ticks, Numbers) {
    EXPECT_EQ(number_text(-0.00012345), "−0.0001234");
    EXPECT_EQ(number_text(1e-7), "10⁻⁷");
    EXPECT_EQ(number_text(-2.5e10), "−2.5×10¹⁰");
    EXPECT_EQ(superscript(-12), "⁻¹²");
}

TEST(ColourMaps, ByName) {
    for (const std::string_view name : colour_map_names()) {
        const ColourMap map = *colour_map(name);
        ColourMap turned = *colour_map(std::string(name) + "_r");
        std::ranges::reverse(turned);
        EXPECT_EQ(map, turned);
        for (std::size_t i = 1; i < map.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(map[i][k], map[i - 1][k], 13) << name << ' ' << i;
        }
    }
    EXPECT_FALSE(colour_map("jet"));
    EXPECT_FALSE(colour_map(""));
    EXPECT_FALSE(colour_map("_r"));
    // The ends, as matplotlib has them.
    EXPECT_EQ(colour_map("viridis")->front(), (Rgba{0x44, 0x01, 0x54, 255}));
    EXPECT_EQ(colour_map("viridis")->back(), (Rgba{0xfd, 0xe7, 0x25, 255}));
    EXPECT_EQ(colour_map("gray")->back(), (Rgba{255, 255, 255, 255}));
}

TEST(Fonts, WidthsAreThoseOfDejaVu) {
    // 2048 units an em: "A" 1401, "0" 1303, blank 651, the minus sign 1716, superscript one 821.
    EXPECT_NEAR(text_width("A0 ", 2048), 1401 + 1303 + 651, 1e-9);
    EXPECT_NEAR(text_width("−¹", 2048), 1716 + 821, 1e-9);
    EXPECT_EQ(text_width("", 12), 0);
    EXPECT_GT(text_width("\xff", 12), 0);
}

}  // namespace
}  // namespace barycert::draw
