// Small pieces of terminal text.

#include "app/report/common/terminal_text.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "app/report/common/document.hpp"

namespace barycert::report {
namespace {

TEST(BriefCount, DigitsWhileTheyFit) {
    EXPECT_EQ(brief_count(0), "-");
    EXPECT_EQ(brief_count(1), "1");
    EXPECT_EQ(brief_count(9999), "9999");
    EXPECT_EQ(brief_count(12345), "12.3k");
    EXPECT_EQ(brief_count(1234567), "1.23M");
    for (std::uint64_t n = 1; n < 1000000000000000; n = n * 7 / 5 + 1) EXPECT_LE(brief_count(n).size(), 5U) << n;
    for (const std::uint64_t edge : {9999ULL, 99949ULL, 99950ULL, 999499ULL, 999500ULL, 9994999ULL, 9995000ULL})
        EXPECT_LE(brief_count(edge).size(), 5U) << edge;
}

TEST(Brief, ThreeDigits) {
    EXPECT_EQ(brief(0), "0");
    EXPECT_EQ(brief(-1), "-");
    EXPECT_EQ(brief(std::numeric_limits<double>::quiet_NaN()), "-");
    EXPECT_EQ(brief(0.5), "0.5");
    EXPECT_EQ(brief(2.4951e-16), "2.5e-16");
    EXPECT_EQ(brief(999.4), "999");
    EXPECT_EQ(brief(999.6), "1000");
    EXPECT_EQ(brief(99999), "99999");
    EXPECT_EQ(brief(99999.7), "1e+05");
    EXPECT_EQ(brief(std::numeric_limits<double>::infinity()), "inf");
    for (double x = 4e-324; x < 1e308; x *= 1.7) EXPECT_LE(brief(x).size(), 9U) << x;
}

TEST(Percent, ZeroAndHundredOnlyWhenTheyAre) {
    EXPECT_EQ(percent(0, 10), "0");
    EXPECT_EQ(percent(10, 10), "100");
    EXPECT_EQ(percent(0, 0), "0");
    EXPECT_EQ(percent(1, 2), "50.0");
    EXPECT_EQ(percent(1, 1000000000000), "<0.001");
    EXPECT_EQ(percent(999999999999, 1000000000000), ">99.9");
    EXPECT_EQ(percent(9997, 10000), ">99.9");
    EXPECT_EQ(percent(9994, 10000), "99.9");
    constexpr std::uint64_t whole = 200003;
    for (std::uint64_t part = 1; part < whole; ++part) {
        const std::string text = percent(part, whole);
        double shown = 0;
        if (std::sscanf(text.c_str(), "%lf", &shown) == 1) {
            ASSERT_GT(shown, 0) << part;
            ASSERT_LT(shown, 100) << part;
            // Half a unit of the last digit shown.
            const double p = 100.0 * static_cast<double>(part) / whole;
            ASSERT_LE(std::fabs(shown - p), p < 0.1 ? 0.00051 : p < 10 ? 0.0051 : 0.051) << part;
        } else {
            ASSERT_TRUE(text == "<0.001" || text == ">99.9") << part << ' ' << text;
        }
        ASSERT_LE(text.size(), 6U);
    }
}

TEST(Colours, OnlyWhenOn) {
    Document d;
    for (const Tone tone : {Tone::plain, Tone::good, Tone::bad, Tone::strong, Tone::soft}) d.say("x", tone);
    EXPECT_EQ(terminal_text(d, false), "x\nx\nx\nx\nx\n");
    EXPECT_EQ(terminal_text(d, true), "x\n\033[32mx\033[0m\n\033[31mx\033[0m\n\033[1mx\033[0m\n\033[2mx\033[0m\n");
}

}  // namespace
}  // namespace barycert::report
