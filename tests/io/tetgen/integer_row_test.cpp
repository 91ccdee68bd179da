// The fast row against the general scanner: it may say "don't know", and never anything else than the scanner says.
#include "io/tetgen/scanner.hpp"

#include <string>

#include <gtest/gtest.h>

#include "core/base/random.hpp"

namespace barycert::detail {
namespace {

/// Scans a row of five integers by the general scanner: returns the place after it, or nullptr.
const char* scan_generally(const char* at, const char* end, std::array<std::int64_t, 5>& values) {
    io::Scanner scanner{at, end};
    scanner.skip_blanks();
    for (std::size_t i = 0; i < 5; ++i) {
        if (i != 0 && !scanner.separator()) return nullptr;
        if (!scanner.integer(values[i])) return nullptr;
    }
    return scanner.end_row() ? scanner.at : nullptr;
}

/// 1: the fast row read it, 0: it did not know.
int agree(const std::string& row) {
    const std::string text = row + std::string(128, '\0');
    std::array<std::uint32_t, 5> fast{};
    std::array<std::int64_t, 5> general{};
    const char* const after = io::scan_plain_row(text.data(), fast);
    if (after == nullptr) return 0;
    EXPECT_EQ(after, scan_generally(text.data(), text.data() + row.size(), general)) << row;
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(fast[i], general[i]) << row;
    return 1;
}

TEST(IntegerRow, PlainRows) {
#ifdef __SSE2__
    EXPECT_EQ(agree("0 1 2 3 4\n"), 1);
    EXPECT_EQ(agree("   12345678  1 23 456 7890   \n5 6"), 1);
    const std::string four = "99999999 99999999 99999999 99999999 ";
    const std::string fifth = "99999999";
    EXPECT_EQ(agree(four + std::string(63 - four.size() - 8, ' ') + fifth + "\n"), 1);  // LF is byte 63
    EXPECT_EQ(agree(four + std::string(64 - four.size() - 8, ' ') + fifth + "\n"), 0);
#endif
}

TEST(IntegerRow, RowsItLeavesAlone) {
    for (const char* row :
         {"", "\n", "1 2 3 4\n", "1 2 3 4 5 6\n", "1 2 3 4 05\n", "1 2 3 4 00\n", "1 2 3 4 5", "1 2 3 4 -5\n",
          "1 2 3 4 +5\n", "1,2,3,4,5\n", "1 2 3 4 5\r\n", "1 2 3 4 5#\n", "1 2 3 4 123456789\n", "1 2 3 4 5.0\n",
          "1 2 3 4 a\n", "1 2 3 4 :\n", "1 2 3 4 /\n", "1 2 3\n4 5\n", "1\t2 3 4 5\n"}) {
        EXPECT_EQ(agree(row), 0) << row;
    }
}

TEST(IntegerRow, NeverDiffersFromTheScanner) {
    constexpr std::string_view alphabet = "0000123456789999      \n\t,+-.#;:/a\r";
    int read = 0;
    for (std::uint64_t seed = 0; seed < 200000; ++seed) {
        base::Random random = base::Random::stream(2, seed, 0);
        std::string row;
        for (int i = 0; i < 5; ++i) {
            row.append(random.below(3) + (i == 0 ? 0 : 1), ' ');
            row += std::to_string(random.below(std::uint64_t{1} << random.below(30)));
        }
        row += '\n';
        for (std::uint64_t i = random.below(3); i > 0; --i) {
            row[random.below(row.size())] = alphabet[random.below(alphabet.size())];
        }
        read += agree(row);
    }
#ifdef __SSE2__
    EXPECT_GT(read, 70000);
#endif
}

TEST(Scanner, IntegersOfEveryLength) {
    std::string digits;
    for (int length = 1; length <= 19; ++length) {
        digits += static_cast<char>('0' + length % 10);
        for (const char* after : {" ", "\n", ",", "\t9", "x", "/", ":", "\xff"}) {
            const std::string text = digits + after + std::string(16, '\0');
            std::int64_t value = 0;
            const char* const end = io::scan_integer(text.data(), value);
            ASSERT_EQ(end, text.data() + length);
            EXPECT_EQ(value, std::stoll(digits));
        }
    }
}

TEST(Scanner, LimitsOf64Bits) {
    const auto read = [](std::string text) {
        text.append(16, '\0');
        std::int64_t value = 1;
        return io::scan_integer(text.data(), value) == nullptr ? 1 : value;
    };
    EXPECT_EQ(read("9223372036854775807"), INT64_MAX);
    EXPECT_EQ(read("9223372036854775808"), 1);
    EXPECT_EQ(read("-9223372036854775808"), INT64_MIN);
    EXPECT_EQ(read("-9223372036854775809"), 1);
    EXPECT_EQ(read("99999999999999999999999"), 1);
    EXPECT_EQ(read("-0"), 0);
}

}  // namespace
}  // namespace barycert::detail
