#include "core/base/text.hpp"

#include <gmpxx.h>

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/base/random.hpp"
#include "tests/audit/exact/second_path.hpp"
#include "tests/limits.hpp"

namespace barycert {
namespace {

std::uint64_t bits(double x) {
    return std::bit_cast<std::uint64_t>(x);
}

void expect_round_trip(double x) {
    for (const std::string& text : {base::shortest(x), base::hexadecimal(x)}) {
        const auto back = base::parse_double(text);
        ASSERT_TRUE(back) << text;
        if (std::isnan(x)) {
            EXPECT_TRUE(std::isnan(*back)) << text;
        } else {
            EXPECT_EQ(bits(*back), bits(x)) << text;
        }
    }
}

RC_GTEST_PROP(Text, EveryDoubleReadsBack, (std::uint64_t word)) {
    const auto x = std::bit_cast<double>(word);
    for (const std::string& text : {base::shortest(x), base::hexadecimal(x)}) {
        const auto back = base::parse_double(text);
        RC_ASSERT(back.has_value());
        RC_ASSERT((std::isnan(x) ? std::isnan(*back) : bits(*back) == word));
    }
}

TEST(Text, DoublesOfEveryExponentReadBack) {
    base::Random r(1);
    for (std::uint64_t exponent = 0; exponent < 2048; ++exponent) {
        for (const std::uint64_t mantissa : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}, r.bits()}) {
            const std::uint64_t word = exponent << 52 | (mantissa & 0xfffffffffffffULL);
            expect_round_trip(std::bit_cast<double>(word));
            expect_round_trip(-std::bit_cast<double>(word));
        }
    }
}

TEST(Text, Forms) {
    EXPECT_EQ(base::shortest(0.1), "0.1");
    EXPECT_EQ(base::shortest(0.1 + 0.2), "0.30000000000000004");
    EXPECT_EQ(base::shortest(1), "1");
    EXPECT_EQ(base::shortest(-0.0), "-0");
    EXPECT_EQ(base::shortest(1e300), "1e+300");
    EXPECT_EQ(base::shortest(0x1p-1074), "5e-324");
    EXPECT_EQ(base::shortest(HUGE_VAL), "inf");
    EXPECT_EQ(base::shortest(-HUGE_VAL), "-inf");
    EXPECT_EQ(base::shortest(std::numeric_limits<double>::quiet_NaN()), "nan");
    EXPECT_EQ(base::hexadecimal(3), "0x1.8p+1");
    EXPECT_EQ(base::hexadecimal(-3), "-0x1.8p+1");
    EXPECT_EQ(base::hexadecimal(0), "0x0p+0");
    EXPECT_EQ(base::hexadecimal(-0.0), "-0x0p+0");
    EXPECT_EQ(base::hexadecimal(-HUGE_VAL), "-inf");
}

TEST(ParseDouble, Accepts) {
    const std::pair<const char*, double> table[] = {
        {"1", 1},
        {"+1", 1},
        {"-1", -1},
        {"1.", 1},
        {".5", 0.5},
        {"-.5", -0.5},
        {"1e3", 1000},
        {"1E+3", 1000},
        {"007", 7},  // decimal, never octal
        {"0x1.8p+1", 3},
        {"-0X1P-1", -0.5},
        {"0x10", 16},
        {"0x.8", 0.5},
        {"1.7976931348623157e308", testing::max_double},
        {"2.2250738585072011e-308", 0x0.fffffffffffffp-1022},
        {"9007199254740993", 9007199254740992},  // a tie, to even
        {"9007199254740993.0000000000000000000000000000000000000000000000001", 9007199254740994},
        {"inf", HUGE_VAL},
        {"-infinity", -HUGE_VAL},
        {"INF", HUGE_VAL},
    };
    for (const auto& [text, value] : table) {
        const auto x = base::parse_double(text);
        ASSERT_TRUE(x) << text;
        EXPECT_EQ(bits(*x), bits(value)) << text;
    }
    EXPECT_EQ(bits(*base::parse_double("-0")), bits(-0.0));
    EXPECT_EQ(bits(*base::parse_double("-0x0p0")), bits(-0.0));
    for (const char* text : {"nan", "NaN", "-nan", "+nan"}) {
        ASSERT_TRUE(base::parse_double(text)) << text;
        EXPECT_TRUE(std::isnan(*base::parse_double(text))) << text;
    }
}

// All of the text must be the number: what other readers take for 1 and leave the rest is nothing here.
TEST(ParseDouble, Refuses) {
    for (const char* text :
         {"",      " ",     "1 ",    " 1",    "1\n",     "+",         "-",     "+-1",      "-+1",     "--1",
          "++1",   ".",     "-.",    "e5",    "1e",      "1e+",       "1.0D3", "1d3",      "1,5",     "1_000",
          "1.2.3", "0x",    "-0x",   "0x.",   "0xg",     "0x1p",      "0x1p+", "0x1.8p1x", "0x-1",    "0x+1",
          "0x 1",  "0x0x1", "0xinf", "0xnan", "0x-inf",  "1f",        "1.5L",  "0b1",      "1/3",     "in",
          "infi",  "na",    "nano",  "one",   "infinit", "inf inity", "0x1e+", "1e5e5",    "0xnan(1)"}) {
        EXPECT_EQ(base::parse_double(text), std::nullopt) << '"' << text << '"';
    }
    EXPECT_EQ(base::parse_double(std::string_view("1\0", 2)), std::nullopt);
}

// A number that is finite as written never becomes infinity; underflow is rounding.
TEST(ParseDouble, OutOfRange) {
    for (const char* text : {"1e309", "-1e309", "1.7976931348623159e308", "1e99999999999999999999", "0x1p1024",
                             "0x1p99999999999", "0x1p-1100", "0x1p-99999999999"}) {
        EXPECT_EQ(base::parse_double(text), std::nullopt) << text;
    }
    EXPECT_EQ(base::parse_double("0e99999"), 0);
    EXPECT_EQ(base::parse_double("4.9e-324"), 0x1p-1074);
    EXPECT_EQ(base::parse_double("2e-324"), 0);
    EXPECT_EQ(bits(*base::parse_double("-1e-400")), bits(-0.0));
}

// More digits than a double has are rounded to nearest, ties to even, in both bases.
TEST(ParseDouble, RoundsCorrectly) {
    const auto hex_digits = [](base::Random& r, int count) {
        std::string text;
        for (int k = 0; k < count; ++k) text += "0123456789abcdef"[r.below(16)];
        return text;
    };
    for (int k = 0; k < 4000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("parse"), static_cast<std::uint64_t>(k));
        std::string digits = hex_digits(r, r.integer(1, 20));
        if (r.coin()) digits += r.coin() ? "8" : "80000000000001";  // ties, and next to them
        const int point = r.integer(0, static_cast<int>(digits.size()));
        const int exponent = r.coin() ? r.integer(-1100, -1020) : r.integer(-60, 60);
        const mpz_class mantissa(digits, 16);
        if (mantissa == 0) continue;
        const auto fraction_digits = static_cast<int>(digits.size()) - point;
        const double expected =
            second_path::nearest(second_path::Q(mantissa) * second_path::power_of_two(exponent - 4 * fraction_digits));
        std::string text = "0x" + digits;
        text.insert(2 + static_cast<std::size_t>(point), ".");
        text += "p" + std::to_string(exponent);
        const auto x = base::parse_double(text);
        if (expected == 0) {
            EXPECT_EQ(x, std::nullopt) << text;
        } else {
            ASSERT_TRUE(x) << text;
            EXPECT_EQ(bits(*x), bits(expected)) << text << ' ' << base::hexadecimal(expected);
        }
    }
    for (int k = 0; k < 2000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("decimal"), static_cast<std::uint64_t>(k));
        // The exact decimal digits of a midpoint between two doubles.
        const auto word = static_cast<double>(r.bits() >> 12 | std::uint64_t{1} << 52);
        const mpz_class twice = (mpz_class(word) * 2 + 1) << static_cast<mp_bitcnt_t>(r.integer(0, 900));
        for (const int beside : {-1, 0, 1}) {
            const mpz_class n = twice + beside;
            EXPECT_EQ(base::parse_double(n.get_str()), second_path::nearest(second_path::Q(n)));
        }
    }
}

TEST(Glob, Table) {
    struct Row {
        const char* pattern;
        const char* text;
        bool matches;
    };
    for (const Row& row : {Row{"", "", true},
                           {"", "a", false},
                           {"*", "", true},
                           {"*", "abc", true},
                           {"**", "abc", true},
                           {"?", "", false},
                           {"?", "a", true},
                           {"?", "ab", false},
                           {"a", "a", true},
                           {"a", "b", false},
                           {"a*", "a", true},
                           {"a*", "abc", true},
                           {"a*", "ba", false},
                           {"*c", "abc", true},
                           {"*c", "abcd", false},
                           {"a*c", "abc", true},
                           {"a*c", "ac", true},
                           {"a*c", "abcd", false},
                           {"*b*", "abc", true},
                           {"*ab*ab", "aababab", true},
                           {"*aab", "aaaab", true},
                           {"a?c*", "abcd", true},
                           {"*?", "", false},
                           {"*?", "a", true},
                           {"?*?", "a", false},
                           {"?*?", "ab", true},
                           {"tetrahedron.*", "tetrahedron.signed-volume", true},
                           {"triangle.*", "triangle3d.cross", false},
                           {"[a]", "a", false},
                           {"[a]", "[a]", true},
                           {"a.c", "abc", false},
                           {"A", "a", false},
                           {"a*b*c*d", "a1b2b3c4c5d", true},
                           {"a*b*c*d", "a1b2b3c4c5", false}}) {
        EXPECT_EQ(base::glob_match(row.pattern, row.text), row.matches) << row.pattern << " on " << row.text;
    }
}

// Against the definition, on short words of two letters. Catches a lost point of return.
TEST(Glob, EqualsItsRecursiveDefinition) {
    struct Slow {
        static bool match(std::string_view p, std::string_view t) {
            if (p.empty()) return t.empty();
            if (p[0] == '*') return match(p.substr(1), t) || (!t.empty() && match(p, t.substr(1)));
            return !t.empty() && (p[0] == '?' || p[0] == t[0]) && match(p.substr(1), t.substr(1));
        }
    };
    for (int k = 0; k < 20000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("glob"), static_cast<std::uint64_t>(k));
        std::string pattern, text;
        for (int n = r.integer(0, 7); n > 0; --n) pattern += "ab*?*"[r.below(5)];
        for (int n = r.integer(0, 8); n > 0; --n) text += "ab"[r.below(2)];
        ASSERT_EQ(base::glob_match(pattern, text), Slow::match(pattern, text)) << pattern << " on " << text;
    }
}

TEST(Text, WhatIsPrintableStaysAsItIs) {
    for (const std::string_view text :
         {"", "part.1.node", "a b\\n", "Länge", "点", "\xf0\x9f\x98\x80", "~ !", "\xc2\xa0"})
        EXPECT_EQ(base::printable(text), text);
}

TEST(Text, WhatActsOnATerminalIsEscaped) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"a\nb\tc\rd", "a\\nb\\tc\\rd"},
        {std::string("\0", 1), "\\x00"},
        {"\033[2J\a\x7f", "\\x1b[2J\\x07\\x7f"},
        {"\xc2\x9b"
         "31m",
         "\\xc2\\x9b31m"},                        // CSI in one character
        {"x\xe2\x80\xaey", "x\\xe2\\x80\\xaey"},  // right to left from here on
        {"\xe2\x81\xa6\xef\xbb\xbf", "\\xe2\\x81\\xa6\\xef\\xbb\\xbf"},
        {"\xff"
         "a\xc3",
         "\\xffa\\xc3"},             // no UTF-8; cut
        {"\xc0\x9b", "\\xc0\\x9b"},  // overlong
        {"\xe0\x82\x9b", "\\xe0\\x82\\x9b"},
        {"\xed\xa0\x80", "\\xed\\xa0\\x80"},           // a surrogate
        {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},  // past the last
        {"\xc3\x28", "\\xc3("}};
    for (const auto& [text, shown] : cases) {
        EXPECT_EQ(base::printable(text), shown);
        EXPECT_EQ(base::printable(shown), shown);
    }
}

}  // namespace
}  // namespace barycert
