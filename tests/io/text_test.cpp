// Text in pictures, and what stands under them.
#include "barycert/io/png/panels.hpp"

#include <gtest/gtest.h>

#include <set>

namespace barycert::io {
namespace {

using Rows = std::vector<std::string>;

/// Dark dots as #.
std::string dots(const std::vector<std::uint8_t>& pixels) {
    std::string row;
    for (std::size_t x = 0; x < pixels.size(); x += 4) row += pixels[x] == text_colour[0] ? '#' : ' ';
    return row;
}

Rows drawn(std::string_view text, std::size_t scale) {
    Rows rows;
    for (std::size_t line = 0; line < scale * glyph_height; ++line) {
        std::vector<std::uint8_t> pixels(4 * scale * text_width(character_count(text)), 255);
        draw_text(text, scale, line, 0, pixels.data());
        rows.push_back(dots(pixels));
    }
    return rows;
}

TEST(Text, EveryPrintableCharacterHasAShapeOfItsOwn) {
    std::set<Rows> shapes;
    for (char c = ' '; c <= '~'; ++c) EXPECT_TRUE(shapes.insert(drawn(std::string(1, c), 1)).second) << c;
    EXPECT_TRUE(shapes.insert(drawn("\n", 1)).second) << "what is not printable is a box";
}

TEST(Text, IsRead) {
    EXPECT_EQ(drawn("T=1", 1), (Rows{"#####         #  ", "  #          ##  ", "  #   ##### # #  ", "  #           #  ",
                                     "  #   #####   #  ", "  #           #  ", "  #         #####"}));
    // Scaled up: each dot a square.
    const Rows one = drawn("aZ", 1), two = drawn("aZ", 2);
    for (std::size_t y = 0; y < two.size(); ++y) {
        for (std::size_t x = 0; x < two[y].size(); ++x) EXPECT_EQ(two[y][x], one[y / 2].at(x / 2));
    }
    EXPECT_EQ(drawn("\xc3\xb6", 1), drawn("\x01", 1)) << "a character of two bytes is one box";
    EXPECT_EQ(character_count("Gr\xc3\xb6\xc3\x9f"
                              "e"),
              5U);
    EXPECT_EQ(text_width(0), 0U);
}

TEST(Caption, RoundLengths) {
    for (const auto& [limit, length] : std::vector<std::pair<double, double>>{{1, 1},
                                                                              {0.99, 0.5},
                                                                              {1.99, 1},
                                                                              {2, 2},
                                                                              {4.9, 2},
                                                                              {5, 5},
                                                                              {9.99, 5},
                                                                              {10, 10},
                                                                              {0.3, 0.2},
                                                                              {1e-300, 1e-300},
                                                                              {1e308, 1e308},
                                                                              {5e-324, 5e-324},
                                                                              {1.7e308, 1e308},
                                                                              {123456, 1e5},
                                                                              {0.1, 0.1},
                                                                              {0.2, 0.2}})
        EXPECT_EQ(round_length(limit), length) << limit;
}

TEST(Caption, ATitleAndAScaleOfLengths) {
    const Caption both("T", 0.01, 100, 130, 1), none("", 0, 100, 130, 1);
    EXPECT_EQ(none.height(), 0U);
    EXPECT_EQ(Caption("T", 0, 100, 130, 1).height(), 15U);
    ASSERT_EQ(both.height(), 26U);
    Rows rows;
    for (std::size_t r = 0; r < both.height(); ++r) {
        std::vector<std::uint8_t> pixels(4 * 130, 7);
        both.row(r, pixels.data());
        rows.push_back(dots(pixels));
        for (std::size_t x = 3; x < pixels.size(); x += 4) EXPECT_EQ(pixels[x], 255);
    }
    EXPECT_EQ(rows[4].substr(0, 12), "    #####   ");
    EXPECT_EQ(rows[10].substr(0, 12), "      #     ");
    // A third of 100 pixels of 0.01 is 0.33: the scale is 0.2, 20 pixels.
    const std::string line = "    ####################    ";
    EXPECT_EQ(rows[18].substr(0, line.size() + 5), line + "#   #");
    EXPECT_EQ(rows[16].substr(0, 33), "    #                  #    #   #") << "ends of the scale";
    EXPECT_EQ(rows[14].find('#'), std::string::npos) << "white between the lines";
}

TEST(Caption, WhatHasNoPlaceIsCutOrLeftOut) {
    const Caption narrow("a long title", 1, 20, 20, 1);
    std::vector<std::uint8_t> pixels(4 * 20, 0);
    EXPECT_EQ(narrow.height(), 15U) << "no scale";
    for (std::size_t r = 0; r < narrow.height(); ++r) narrow.row(r, pixels.data());
    EXPECT_EQ(Caption("a", 1, 1, 1, 1).height(), 0U);
    for (const double length : {5e-324, 1e308, 1e-320}) {
        const Caption extreme("", length, 100, 400, 2);
        std::vector<std::uint8_t> row(4 * 400, 0);
        for (std::size_t r = 0; r < extreme.height(); ++r) extreme.row(r, row.data());
    }
}

}  // namespace
}  // namespace barycert::io
