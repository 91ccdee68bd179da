#include <fcntl.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "core/base/text.hpp"
#include "tests/io/row_data.hpp"

namespace barycert::io::testing {
namespace {

RowData two_rows(const TableFormat& format) {
    return {.format = format,
            .points = format.dimension == 3 ? std::vector<double>{1, 2.5, -0.0, 1e300, 0.1, 5e-324}
                                            : std::vector<double>{1, 2.5, 1e300, 0.1},
            .values = format.fields.size() == 2 ? std::vector<double>{0.3, std::nan(""), -std::nan(""), 7}
                                                : std::vector<double>{},
            .distances = {0, 0.25},
            .cells = {12, -1},
            .features = {Feature::face, Feature::outside}};
}

std::string written(const RowData& data) {
    const TemporaryFolder folder;
    const Status status = write_rows(folder / "r.csv", data, 1);
    EXPECT_TRUE(status) << status.error().message();
    return get(folder / "r.csv");
}

TEST(CsvSink, TheText) {
    EXPECT_EQ(written(two_rows({.dimension = 3, .fields = {{"p"}, {"T"}}, .distances = true})),
              "x,y,z,cell,feature,p,T,distance\n"
              "1,2.5,-0,12,face,0.3,nan,0\n"
              "1e+300,0.1,5e-324,-1,outside,nan,7,0.25\n");
    EXPECT_EQ(written(two_rows({.dimension = 2})),
              "x,y,cell,feature\n"
              "1,2.5,12,face\n"
              "1e+300,0.1,-1,outside\n");
    EXPECT_EQ(written({.format = {.dimension = 3, .fields = {{"p"}}},
                       .points = {},
                       .values = {},
                       .distances = {},
                       .cells = {},
                       .features = {}}),
              "x,y,z,cell,feature,p\n");
}

TEST(CsvSink, NamesAreQuotedWhereTheyMustBe) {
    const RowData data = random_rows(
        0, {.dimension = 2, .fields = {{"a b"}, {"a,b"}, {"a\"b"}, {"a\nb"}, {"a\rb"}, {""}, {"\xC3\xA4"}}}, 1);
    EXPECT_EQ(written(data), "x,y,cell,feature,a b,\"a,b\",\"a\"\"b\",\"a\nb\",\"a\rb\",,\xC3\xA4\n");
}

TEST(CsvSink, ColumnsOfOneNameAreRefused) {
    const TemporaryFolder folder;
    for (const char* file : {"r.csv", "r.vtu", "r.npy"}) {
        const auto sink = open_table(folder / file, {.dimension = 2, .fields = {{"v", 2}, {"v.0"}}});
        ASSERT_FALSE(sink) << file;
        EXPECT_EQ(sink.error().what, "two columns of the rows would have the same name");
        EXPECT_EQ(sink.error().found, "\"v.0\" twice");
    }
}

/// Reads back what was written, by a parser of its own.
void expect_round_trip(const std::string& text, const RowData& data) {
    const auto same = [](double a, double b) {
        return std::isnan(a) ? std::isnan(b) : std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    };
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    for (std::size_t row = 0; row < data.cells.size(); ++row) {
        ASSERT_TRUE(std::getline(lines, line));
        std::istringstream fields(line);
        std::string field;
        const auto expect_number = [&](double expected) {
            std::getline(fields, field, ',');
            ASSERT_TRUE(same(expected, std::strtod(field.c_str(), nullptr))) << line;
            ASSERT_EQ(field, base::shortest(expected));
        };
        const auto d = static_cast<std::size_t>(data.format.dimension);
        const std::size_t c = data.format.fields.size();
        for (std::size_t i = 0; i < d; ++i) expect_number(data.points[row * d + i]);
        std::getline(fields, field, ',');
        ASSERT_EQ(field, std::to_string(data.cells[row]));
        std::getline(fields, field, ',');
        ASSERT_EQ(field, name(data.features[row]));
        for (std::size_t i = 0; i < c; ++i) expect_number(data.values[row * c + i]);
        if (data.format.distances) expect_number(data.distances[row]);
        ASSERT_TRUE(fields.eof());
    }
    EXPECT_FALSE(std::getline(lines, line));
}

TEST(CsvSink, EveryNumberReadsBackToTheSameBits) {
    // The longest row is 2 MB: then a piece is one row.
    std::vector<std::string> many;
    for (int i = 0; i < 80000; ++i) many.push_back("v" + std::to_string(i));
    struct Case {
        std::size_t count;
        TableFormat format;
    };
    for (const Case& c : {Case{30000, {.dimension = 3, .fields = {{"p"}, {"T"}}, .distances = true}},
                          Case{30000, {.dimension = 2, .fields = {}, .distances = false}},
                          Case{5, {.dimension = 3, .fields = fields_of(many)}}}) {
        const RowData data = random_rows(c.count, c.format, 5);
        std::string first;
        for (const std::size_t block : {std::size_t{1}, std::size_t{4097}, std::size_t{100000}}) {
            const TemporaryFolder folder;
            ASSERT_TRUE(write_rows(folder / "r.csv", data, block));
            const std::string text = get(folder / "r.csv");
            if (first.empty()) {
                first = text;
                expect_round_trip(text, data);
            }
            EXPECT_TRUE(text == first) << "the blocks must not show";
            if (c.format.fields.size() > 2) continue;
            const Result<std::vector<double>> points = read_file(folder / "r.csv", c.format.dimension, 1000);
            ASSERT_TRUE(points) << points.error().message();
            EXPECT_EQ(bits_of(*points), bits_of(data.points));
        }
    }
}

TEST(CsvSink, TheStandardOutput) {
    const TemporaryFolder folder;
    const RowData data = random_rows(1000, {.dimension = 3, .fields = {{"p"}}}, 9);
    put(folder / "out", "before\n");
    std::fflush(stdout);
    {
        const Redirected out(STDOUT_FILENO, ::open((folder / "out").c_str(), O_WRONLY | O_APPEND));
        const Status status = write_rows("-", data, 100);
        EXPECT_TRUE(status) << status.error().message();
        EXPECT_EQ(::write(STDOUT_FILENO, "after\n", 6), 6);  // it is still open
    }
    EXPECT_EQ(folder.file_count(), 1U);
    ASSERT_TRUE(write_rows(folder / "r.csv", data, 100));
    EXPECT_EQ(get(folder / "out"), "before\n" + get(folder / "r.csv") + "after\n");
}

}  // namespace
}  // namespace barycert::io::testing
