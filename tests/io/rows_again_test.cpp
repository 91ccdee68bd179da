// Rows that come out go in again as points, with all their columns.
#include "tests/io/carried_points.hpp"
#include "tests/io/row_data.hpp"

namespace barycert::io::testing {
namespace {

std::vector<Column> random_columns(std::size_t count, base::Random& random) {
    std::vector<std::int64_t> integers;
    std::vector<double> numbers;
    std::vector<std::string> words, bytes;
    const std::vector<std::string> some{"",   "a",   "steel", "a,b", "\"", " blank ", "\xC3\xA4\xF0\x9F\x98\x80",
                                        "12", "x;y", "#"};
    for (std::size_t i = 0; i < count; ++i) {
        integers.push_back(static_cast<std::int64_t>(random.bits()));
        numbers.push_back(random.below(9) == 0 ? std::nan("") : any_finite(random));
        words.push_back(some[random.below(some.size())]);
        bytes.push_back(random.below(5) == 0 ? "\xFF\x01" : "b");
    }
    words.at(0) = "steel";  // no column of integers
    numbers.at(0) = 0.5;
    return {
        {"i", std::move(integers)}, {"n,m", std::move(numbers)}, {"word", std::move(words)}, {"S", std::move(bytes)}};
}

/// Writes rows with these columns, `block` at a time.
Status write_carried(const std::string& path, RowData data, std::vector<Column>& columns, std::size_t block) {
    for (const Column& column : columns) data.format.carried.push_back(mesh::format_of(column));
    auto sink = open_table(path, data.format);
    if (!sink) return sink.error();
    for (std::size_t row = 0; row < data.cells.size(); row += block) {
        const std::size_t count = std::min(block, data.cells.size() - row);
        std::vector<Column> part;
        for (Column& column : columns) {
            Column copy = column;
            part.push_back(empty_column({column.name, column.type()}));
            mesh::move_values(copy, row, count, part.back());
        }
        TableView rows = data.rows(row, count);
        rows.carried = part;
        if (Status written = (*sink)->write(rows); !written) return written;
    }
    return (*sink)->commit();
}

TEST(RowsAgain, EveryColumnHasTheSameValues) {
    base::Random random(17);
    for (const std::string name : {"r.csv", "r.npy"}) {
        for (const int dimension : {2, 3}) {
            const RowData data =
                random_rows(5000, {.dimension = dimension, .fields = {{"p"}, {"T x"}}, .distances = true}, 40);
            std::vector<Column> columns = random_columns(5000, random);
            const TemporaryFolder folder;
            const Status written = write_carried(folder / name, data, columns, 700);
            ASSERT_TRUE(written) << written.error().message();
            ASSERT_TRUE(write_carried(folder / ("one-" + name), data, columns, 5000));
            EXPECT_TRUE(get(folder / name) == get(folder / ("one-" + name))) << "the blocks must not show";
            const PointOptions options{.columns = {}, .keep = {"all"}, .typed = true};
            const Result<CarriedPoints> read = read_carried(folder / name, dimension, options, 999);
            ASSERT_TRUE(read) << read.error().message();
            EXPECT_EQ(bits_of(read->points), bits_of(data.points));
            ASSERT_EQ(read->columns.size(), 9U);
            const auto& cells = std::get<std::vector<std::int64_t>>(read->columns[0].values);
            const auto& features = std::get<std::vector<std::string>>(read->columns[1].values);
            for (std::size_t i = 0; i < 5000; ++i) {
                ASSERT_EQ(cells[i], data.cells[i]);
                ASSERT_EQ(features[i], barycert::name(data.features[i]));
            }
            for (std::size_t k = 0; k < columns.size(); ++k) {
                EXPECT_EQ(read->columns[5 + k].name, columns[k].name);
                ASSERT_EQ(read->columns[5 + k].type(), columns[k].type()) << columns[k].name;
                CarriedPoints written_ones;
                written_ones.columns = {columns[k]};
                EXPECT_EQ(read->text(5 + k), written_ones.text(0));
            }
            // And out again: the same bytes, but for the names of columns that rows have themselves.
            std::vector<Column> again(read->columns.begin() + 5, read->columns.end());
            RowData same = data;
            same.points = read->points;
            for (std::size_t k = 0; k < again.size(); ++k)
                EXPECT_EQ(mesh::format_of(again[k]), mesh::format_of(columns[k]));
            ASSERT_TRUE(write_carried(folder / ("again-" + name), same, again, 1234));
            EXPECT_TRUE(get(folder / name) == get(folder / ("again-" + name)));
        }
    }
}

TEST(RowsAgain, TheTextOfCarriedColumns) {
    RowData data = random_rows(3, {.dimension = 2}, 1);
    data.points = {1, 2, 3, 4, 5, 6};
    data.cells = {0, -1, 2};
    data.features = {Feature::edge, Feature::outside, Feature::face};
    std::vector<Column> columns{{"a,b", std::vector<std::string>{"", "x, \"y\"", " c"}},
                                {"i", std::vector<std::int64_t>{INT64_MIN, 0, 7}},
                                {"n;", std::vector<double>{0.1, std::nan(""), -0.0}}};
    const TemporaryFolder folder;
    ASSERT_TRUE(write_carried(folder / "r.csv", data, columns, 2));
    EXPECT_EQ(get(folder / "r.csv"),
              "x,y,cell,feature,\"a,b\",i,\"n;\"\n1,2,0,edge,,-9223372036854775808,0.1\n"
              "3,4,-1,outside,\"x, \"\"y\"\"\",0,nan\n5,6,2,face,\" c\",7,-0\n");
}

TEST(RowsAgain, LongTexts) {
    RowData data = random_rows(40, {.dimension = 2}, 1);
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < 40; ++i) texts.emplace_back(i * 3000, i % 2 == 0 ? '"' : 'a');
    std::vector<Column> columns{{"t", texts}};
    const TemporaryFolder folder;
    for (const std::string name : {"r.csv", "r.npy"}) {
        ASSERT_TRUE(write_carried(folder / name, data, columns, 7));
        const auto read = read_carried(folder / name, 2, {.columns = {}, .keep = {"t"}});
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(std::get<std::vector<std::string>>(read->columns[0].values), texts);
    }
}

TEST(RowsAgain, ColumnsThatDoNotFitAreRefused) {
    const TemporaryFolder folder;
    const RowData data = random_rows(2, {.dimension = 2}, 1);
    for (const char* name : {"r.csv", "r.npy"}) {
        TableFormat format{.dimension = 2};
        format.carried = {{"t", Column::Type::text, 3, 3}, {"i", Column::Type::integer}};
        const auto attempt = [&](std::vector<Column> columns) {
            auto sink = open_table(folder / name, format);
            EXPECT_TRUE(sink) << sink.error().message();
            TableView rows = data.rows();
            rows.carried = columns;
            return (*sink)->write(rows);
        };
        const Column good{"t", std::vector<std::string>{"a", "b"}}, ids{"i", std::vector<std::int64_t>{1, 2}};
        EXPECT_TRUE(attempt({good, ids}));
        EXPECT_FALSE(attempt({}));
        EXPECT_FALSE(attempt({good}));
        EXPECT_FALSE(attempt({ids, good}));
        EXPECT_FALSE(attempt({good, {"i", std::vector<std::int64_t>{1}}}));
        EXPECT_FALSE(attempt({good, {"i", std::vector<double>{1, 2}}}));
        if (std::string(name) == "r.csv") continue;
        for (const std::string& text : {std::string("abcd"), std::string("a\0", 2), std::string("\xFF")})
            EXPECT_FALSE(attempt({{"t", std::vector<std::string>{"a", text}}, ids})) << text;
        EXPECT_TRUE(
            attempt({{"t", std::vector<std::string>{"\xC3\xA4\xC3\xA4\xC3\xA4", std::string("a\0b", 3)}}, ids}));
    }
    TableFormat twice{.dimension = 2};
    twice.carried = {{"cell", Column::Type::integer}};
    EXPECT_FALSE(open_table(folder / "n.npy", twice));
    EXPECT_EQ(folder.file_count(), 0U);
}

}  // namespace
}  // namespace barycert::io::testing
