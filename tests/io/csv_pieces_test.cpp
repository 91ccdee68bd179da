// CSV files of many pieces: parsed on all threads, with points, lines and errors as if it were one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "tests/io/points_files.hpp"

namespace barycert::io::testing {
namespace {

struct Text {
    std::string bytes;
    std::vector<double> points;
    std::vector<std::size_t> line_of;  ///< of each point, from 1
};

/// About `size` bytes of lines in all the ways there are, separated by `separator`.
Text text_of(std::size_t size, char separator, base::Random& random) {
    Text text;
    std::size_t line = 0;
    const auto end = [&] {
        text.bytes += random.below(3) == 0 ? "\r\n" : "\n";
        ++line;
    };
    while (text.bytes.size() < size) {
        switch (random.below(12)) {
            case 0:
                if (separator != '\t') text.bytes += random.below(2) == 0 ? "  " : "";
                end();
                continue;
            case 1:
                text.bytes += "# comment, \"1,2,3";
                text.bytes.append(random.below(2000), '#');
                end();
                continue;
            default:
                break;
        }
        const bool quoted = random.below(6) == 0, padded = separator != '\t' && random.below(6) == 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double x = random.uniform(-1, 1) * (random.below(9) == 0 ? 1e-300 : 1);
            if (axis != 0) text.bytes += separator;
            if (padded) text.bytes += " ";
            text.bytes += (quoted ? "\"" : "") + base::shortest(x) + (quoted ? "\"" : "");
            text.points.push_back(x);
        }
        text.line_of.push_back(line + 1);
        end();
    }
    return text;
}

TEST(CsvPieces, LawPointsAreThoseOfTheLines) {
    base::Random random(31);
    for (const char separator : {',', ';', '\t', ' '}) {
        for (const std::size_t size : {std::size_t{1} << 12, std::size_t{1} << 18, std::size_t{3} << 20}) {
            const Text text = text_of(size, separator, random);
            const TemporaryFolder folder;
            put(folder / "p.csv", text.bytes);
            put(folder / "headed.csv", std::string("x") + separator + "y" + separator + "z\n" + text.bytes);
            for (const char* const name : {"p.csv", "headed.csv"}) {
                for (const std::size_t block : {std::size_t{777}, std::size_t{1} << 17}) {
                    const auto points = read_file(folder / name, 3, block);
                    ASSERT_TRUE(points) << points.error().message();
                    ASSERT_EQ(*points, text.points) << '"' << separator << '"' << size;
                }
            }
        }
    }
}

TEST(CsvPieces, LawABlockIsFullUntilTheEnd) {
    base::Random random(32);
    const Text text = text_of(std::size_t{2} << 20, ',', random);
    const TemporaryFolder folder;
    put(folder / "p.csv", text.bytes);
    const auto source = open_points(folder / "p.csv", 3);
    ASSERT_TRUE(source);
    std::vector<double> points;
    for (const std::size_t count = text.line_of.size(); points.size() < 3 * count;) {
        const std::size_t max = 1 + random.below(20000), left = count - points.size() / 3;
        const auto taken = (*source)->read(max, points);
        ASSERT_TRUE(taken);
        ASSERT_EQ(*taken, std::min(max, left));
    }
    EXPECT_EQ((*source)->read(5, points).value(), 0U);
    EXPECT_EQ(points, text.points);
}

TEST(CsvPieces, TheFirstBadLineIsToldWhateverComesAfter) {
    base::Random random(33);
    const std::size_t size = std::size_t{5} << 19;
    for (int round = 0; round < 12; ++round) {
        Text text = text_of(size, ',', random);
        // The bad line, one much later, and before it as many good points as there are.
        const std::size_t bad = random.below(text.line_of.size());
        std::size_t at = 0;
        for (std::size_t line = 1; line < text.line_of[bad]; ++line) at = text.bytes.find('\n', at) + 1;
        std::string bytes = text.bytes.substr(0, at) + "1,2,oops\n" + text.bytes.substr(at) + "later\n";
        const TemporaryFolder folder;
        put(folder / "p.csv", bytes);
        for (const std::size_t block : {std::size_t{1000}, std::size_t{1} << 20}) {
            const auto source = open_points(folder / "p.csv", 3);
            if (!source) {
                EXPECT_EQ(bad, 0U);
                continue;
            }
            std::vector<double> points;
            std::optional<Error> error;
            for (int calls = 0; calls < 100000; ++calls) {
                const auto taken = (*source)->read(block, points);
                if (!taken) {
                    error = taken.error();
                    break;
                }
                ASSERT_NE(*taken, 0U);
            }
            ASSERT_TRUE(error);
            EXPECT_EQ(error->line, text.line_of[bad]);
            EXPECT_EQ(error->what, "bad coordinate z");
            EXPECT_EQ(error->code.name(), "file.number");
            EXPECT_LE(points.size(), 3 * bad);
            EXPECT_GE(points.size() + 3 * block, 3 * bad);
            EXPECT_TRUE(std::equal(points.begin(), points.end(), text.points.begin()));
            EXPECT_EQ((*source)->read(block, points).error().line, error->line) << "nothing but that";
        }
    }
}

TEST(CsvPieces, TheEndOfALargeFile) {
    base::Random random(34);
    const Text text = text_of(std::size_t{3} << 19, ',', random);
    const std::size_t lines = static_cast<std::size_t>(std::count(text.bytes.begin(), text.bytes.end(), '\n'));
    const auto cut = read_bytes("p.csv", text.bytes + "1,2,0.2", 3, 1000);
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().line, lines + 1);
    EXPECT_EQ(cut.error().what, "the last row has no line end, so the file may be cut short");
    const auto named = read_bytes("p.csv", "x,y,z,n\n" + std::string(1 << 17, '\n') + "1,2,3,name", 3, 1000);
    ASSERT_TRUE(named) << "it ends within no coordinate";
    EXPECT_EQ(*named, (std::vector<double>{1, 2, 3}));
    const auto comment = read_bytes("p.csv", text.bytes + "# the end", 3, 1000);
    ASSERT_TRUE(comment);
    EXPECT_EQ(*comment, text.points);
    const auto longest =
        read_bytes("p.csv", text.bytes + std::string(std::size_t{1} << 20, ' ') + "x\n1,2,3\n", 3, 1000);
    ASSERT_FALSE(longest);
    EXPECT_EQ(longest.error().what, "a line is too long");
    EXPECT_EQ(longest.error().line, lines + 1);
}

}  // namespace
}  // namespace barycert::io::testing
