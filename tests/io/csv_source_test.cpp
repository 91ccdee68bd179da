// CSV files that are accepted, and what they mean.
#include <cstdlib>

#include "core/base/random.hpp"
#include "tests/io/points_files.hpp"

namespace barycert::io::testing {
namespace {

void expect_points(const std::string& text, int dimension, const std::vector<double>& expected) {
    SCOPED_TRACE(text);
    for (const std::size_t block : {std::size_t{1}, std::size_t{2}, std::size_t{100}}) {
        const Result<std::vector<double>> points = read_bytes("p.csv", text, dimension, block);
        ASSERT_TRUE(points) << points.error().message();
        EXPECT_EQ(bits_of(*points), bits_of(expected));
    }
}

TEST(CsvSource, Separators) {
    const std::vector<double> points{1, 2.5, -3, 4e2, .5, 6.};
    expect_points("1,2.5,-3\n4e2,.5,6.\n", 3, points);
    expect_points("1;2.5;-3\n4e2;.5;6.\n", 3, points);
    expect_points("1\t2.5\t-3\n4e2\t.5\t6.\n", 3, points);
    expect_points("1 2.5 -3\n4e2 .5 6.\n", 3, points);
}

TEST(CsvSource, BlanksAroundFields) {
    expect_points(" 1 , 2.5\t,  -3 \n4e2,.5, +6.\t\n", 3, {1, 2.5, -3, 4e2, .5, 6});
    expect_points("   1    2   3   \n4  5  6\n", 3, {1, 2, 3, 4, 5, 6});
    expect_points("1 2 3\n4\t5\t\t6\n", 3, {1, 2, 3, 4, 5, 6});
    expect_points("1\t 2\t3 \n", 3, {1, 2, 3});
}

TEST(CsvSource, Headers) {
    expect_points("x,y,z\n1,2,3\n", 3, {1, 2, 3});
    expect_points("Z;name;X;Y\n1;a;2;3\n", 3, {2, 3, 1});
    expect_points("\"X\" \"Y\" \"Z\" \"a b\"\n1 2 3 \"4 5\"\n", 3, {1, 2, 3});
    expect_points("v,Points:0,Points:1,Points:2\n9,1,2,3\n", 3, {1, 2, 3});
    expect_points("\"v\",\"Points_0\",\"Points_1\",\"Points_2\"\n9,1,2,3\n", 3, {1, 2, 3});
    expect_points("id,x,y,Points:0,Points:1,Points:2\n9,7,7,1,2,3\n", 3, {1, 2, 3});  // no z: the others are whole
    expect_points("\"a;\tb\",x,y,z\n9,1,2,3\n", 3, {1, 2, 3});
    expect_points("\"a,\"\";b\" x y z\n9 1 2 3\n", 3, {1, 2, 3});
    expect_points("2020,x,y,z\n9,1,2,3\n", 3, {1, 2, 3});
    expect_points("x,y,z\n", 3, {});
    expect_points("x,y,z", 3, {});
}

TEST(CsvSource, TwoDimensionsTakeTwoColumns) {
    expect_points("z,y,x\n0,2,3\n-0.0,4,5\n", 2, {3, 2, 5, 4});
    expect_points("name,y,x\na,2,3\n", 2, {3, 2});
    expect_points("1 2\n3 4\n", 2, {1, 2, 3, 4});
}

TEST(CsvSource, ColumnsThatArePassedOverMayHoldAnything) {
    expect_points("x,y,z,name\n1,2,3,\"a, \"\"b\"\" # c\"\n4,5,6,\n7,8,9,5\" pipe\n", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9});
    expect_points("x,y,z,t\n1,2,3,nan\n4,5,6,inf\n", 3, {1, 2, 3, 4, 5, 6});
    expect_points("a,x,y,z\n\"\",1,2,3\n\"\"\"\",4,5,6\n", 3, {1, 2, 3, 4, 5, 6});
}

TEST(CsvSource, QuotedNumbers) {
    expect_points("\"1\",\" 2.5 \",\"-3\"\n\"4\" , 5,\"6\"\n", 3, {1, 2.5, -3, 4, 5, 6});
}

TEST(CsvSource, CommentsBlankLinesAndLineEnds) {
    expect_points("# c, d\n\n  # e\nx,y,z\n\n# f\n1,2,3\n \t \n4,5,6\n#\n", 3, {1, 2, 3, 4, 5, 6});
    expect_points("x,y,z\r\n1,2,3\r\n\r\n4,5,6\r\n", 3, {1, 2, 3, 4, 5, 6});
    expect_points("1,2,3\r\n4,5,6\r", 3, {1, 2, 3, 4, 5, 6});
    expect_points(
        "\xEF\xBB\xBF"
        "1,2,3\n",
        3, {1, 2, 3});
    expect_points(
        "\xEF\xBB\xBF"
        "x,y,z\r\n1,2,3\r\n",
        3, {1, 2, 3});
}

// The last number may end without a line end.
TEST(CsvSource, LastLinesWithoutLineEnd) {
    expect_points("1,2,3\n4,5,6 ", 3, {1, 2, 3, 4, 5, 6});
    expect_points("1 2 3\n4 5 6\t", 3, {1, 2, 3, 4, 5, 6});
    expect_points("1,2,3\n4,5,\"6\"", 3, {1, 2, 3, 4, 5, 6});
    expect_points("x,y,z,n\n1,2,3,a\n4,5,6,7", 3, {1, 2, 3, 4, 5, 6});
    expect_points("x,y,z,n\n1,2,3,a\n4,5,6,", 3, {1, 2, 3, 4, 5, 6});
    expect_points("1,2,3,\n4,5,6,", 3, {1, 2, 3, 4, 5, 6});
    expect_points("1,2,3\n# 4,5,6", 3, {1, 2, 3});
    expect_points("1,2,3\n  ", 3, {1, 2, 3});
}

TEST(CsvSource, TheSameNumbersAsStrtod) {
    base::Random random(7);
    std::string text = "x,y\n";
    std::vector<double> expected;
    const auto add = [&](const std::string& number) {
        text += number + (expected.size() % 2 == 0 ? "," : "\n");
        expected.push_back(std::strtod(number.c_str(), nullptr));
    };
    for (const char* number : {"5e-324", "2.4703282292062327e-324", "2.4703282292062328e-324", "-0", "0", "1e-999",
                               "2.2250738585072011e-308", "1.7976931348623157e308", "9007199254740993",
                               "0.1000000000000000055511151231257827021181583404541015625", "1e23", "-1e-400"}) {
        add(number);
    }
    for (int i = 0; i < 100000; ++i) {
        std::string number = random.coin() ? "-" : "";
        for (std::uint64_t digits = 1 + random.below(25); digits > 0; --digits) {
            number += static_cast<char>('0' + random.below(10));
        }
        number += ".";
        for (std::uint64_t digits = random.below(25); digits > 0; --digits) {
            number += static_cast<char>('0' + random.below(10));
        }
        number += "e" + std::to_string(static_cast<int>(random.below(620)) - 340);
        if (std::isfinite(std::strtod(number.c_str(), nullptr))) add(number);
    }
    if (expected.size() % 2 != 0) add("0");
    const Result<std::vector<double>> points = read_bytes("p.csv", text, 2, 1000);
    ASSERT_TRUE(points) << points.error().message();
    ASSERT_EQ(points->size(), expected.size());
    EXPECT_EQ(bits_of(*points), bits_of(expected));
}

TEST(CsvSource, LinesAcrossTheChunksOfTheReader) {
    std::string text = "x,y,z,a\n";
    std::vector<double> expected;
    for (int i = 0; i < 200000; ++i) {
        text += std::to_string(i) + "," + std::to_string(-i) + ",0.25," +
                std::string(static_cast<std::size_t>(i % 37), 'a') + "\n";
        expected.insert(expected.end(), {static_cast<double>(i), static_cast<double>(-i), 0.25});
    }
    expect_points(text, 3, expected);
}

TEST(CsvSource, ReadsToTheEndAndThenNothing) {
    const TemporaryFolder folder;
    put(folder / "p.CSV", "1,2\n3,4\n");
    const auto source = open_points(folder / "p.CSV", 2);
    ASSERT_TRUE(source) << source.error().message();
    EXPECT_FALSE((*source)->count());
    std::vector<double> out{7};
    EXPECT_EQ((*source)->read(0, out).value(), 0U);
    EXPECT_EQ((*source)->read(10, out).value(), 2U);
    EXPECT_EQ((*source)->read(10, out).value(), 0U);
    EXPECT_EQ(out, (std::vector<double>{7, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace barycert::io::testing
