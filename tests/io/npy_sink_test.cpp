#include <cstring>

#include "tests/io/row_data.hpp"

namespace barycert::io::testing {
namespace {

struct Parts {
    int version;
    std::string text;  // of the header, without what pads it
    std::string data;
};

/// The format by its document: magic, version, length, text that ends with a line end and keeps data aligned to 64.
Parts parts_of(const std::string& bytes) {
    EXPECT_TRUE(bytes.starts_with("\x93NUMPY"));
    const int version = bytes.at(6);
    EXPECT_EQ(bytes.at(7), 0);
    const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes.at(i))); };
    std::size_t begin = 10, size = byte(8) + 256 * byte(9);
    if (version > 1) {
        begin = 12;
        size += 65536 * byte(10) + 16777216 * byte(11);
    }
    EXPECT_EQ((begin + size) % 64, 0U);
    std::string text = bytes.substr(begin, size);
    EXPECT_TRUE(text.ends_with('\n'));
    text.resize(text.find_last_not_of(" \n") + 1);
    return {version, text, bytes.substr(begin + size)};
}

template <class T>
T number_at(const std::string& data, std::size_t& at) {
    T value{};
    std::memcpy(&value, data.data() + at, sizeof value);
    at += sizeof value;
    return value;
}

void expect_rows(const std::string& data, const RowData& rows) {
    const auto d = static_cast<std::size_t>(rows.format.dimension);
    const std::size_t c = rows.format.fields.size();
    const std::size_t row_size = 8 * (d + 2 + c + (rows.format.distances ? 1 : 0));
    ASSERT_EQ(data.size(), row_size * rows.cells.size());
    std::size_t at = 0;
    for (std::size_t row = 0; row < rows.cells.size(); ++row) {
        for (std::size_t i = 0; i < d; ++i) {
            ASSERT_EQ(number_at<std::uint64_t>(data, at), std::bit_cast<std::uint64_t>(rows.points[row * d + i]));
        }
        ASSERT_EQ(number_at<std::int64_t>(data, at), rows.cells[row]);
        std::string feature(name(rows.features[row]));
        feature.resize(8, '\0');
        ASSERT_EQ(data.substr(at, 8), feature);
        at += 8;
        for (std::size_t i = 0; i < c; ++i) {
            ASSERT_EQ(number_at<std::uint64_t>(data, at), std::bit_cast<std::uint64_t>(rows.values[row * c + i]));
        }
        if (rows.format.distances) {
            ASSERT_EQ(number_at<std::uint64_t>(data, at), std::bit_cast<std::uint64_t>(rows.distances[row]));
        }
    }
}

TEST(NpySink, HeaderAndRows) {
    const RowData data = random_rows(20000, {.dimension = 3, .fields = {{"p"}, {"T"}}, .distances = true}, 3);
    for (const std::size_t block : {std::size_t{1}, std::size_t{999}, std::size_t{100000}}) {
        const TemporaryFolder folder;
        const Status status = write_rows(folder / "r.npy", data, block);
        ASSERT_TRUE(status) << status.error().message();
        const Parts parts = parts_of(get(folder / "r.npy"));
        EXPECT_EQ(parts.version, 1);
        EXPECT_EQ(
            parts.text,
            "{'descr': [('x', '<f8'), ('y', '<f8'), ('z', '<f8'), ('cell', '<i8'), ('feature', '|S8'), ('p', '<f8'), "
            "('T', '<f8'), ('distance', '<f8')], 'fortran_order': False, 'shape': (20000,), }");
        expect_rows(parts.data, data);
    }
}

TEST(NpySink, ManyRowsAtOnce) {
    const TemporaryFolder folder;
    const RowData data = random_rows(200000, {.fields = {{"a"}, {"b"}}, .distances = true}, 8);
    ASSERT_TRUE(write_rows(folder / "many.npy", data, 200000));
    ASSERT_TRUE(write_rows(folder / "few.npy", data, 999));
    const std::string bytes = get(folder / "many.npy");
    EXPECT_TRUE(bytes == get(folder / "few.npy"));
    expect_rows(parts_of(bytes).data, data);
}

TEST(NpySink, TwoDimensionsAndNoRows) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_rows(folder / "r.npy", random_rows(0, {.dimension = 2}, 3), 1));
    const Parts parts = parts_of(get(folder / "r.npy"));
    EXPECT_EQ(parts.text,
              "{'descr': [('x', '<f8'), ('y', '<f8'), ('cell', '<i8'), ('feature', '|S8')], 'fortran_order': False, "
              "'shape': (0,), }");
    EXPECT_EQ(parts.data, "");
}

TEST(NpySink, Versions) {
    const TemporaryFolder folder;
    std::vector<std::string> many;
    for (int i = 0; i < 5000; ++i) many.push_back("column" + std::to_string(i));
    const RowData wide = random_rows(3, {.dimension = 2, .fields = fields_of(many)}, 3);
    ASSERT_TRUE(write_rows(folder / "wide.npy", wide, 2));
    const Parts two = parts_of(get(folder / "wide.npy"));
    EXPECT_EQ(two.version, 2);
    EXPECT_TRUE(two.text.ends_with("'shape': (3,), }"));
    expect_rows(two.data, wide);
    ASSERT_TRUE(write_rows(folder / "utf8.npy", random_rows(3, {.dimension = 2, .fields = {{"\xC3\xA4"}}}, 3), 2));
    const Parts three = parts_of(get(folder / "utf8.npy"));
    EXPECT_EQ(three.version, 3);
    EXPECT_NE(three.text.find("('\xC3\xA4', '<f8')"), std::string::npos);
}

TEST(NpySink, Names) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_rows(folder / "r.npy",
                           random_rows(3, {.dimension = 2, .fields = {{"it's"}, {"a\\b"}, {"a\nb"}, {"distance"}}}, 3),
                           2));
    EXPECT_NE(parts_of(get(folder / "r.npy"))
                  .text.find("('it\\'s', '<f8'), ('a\\\\b', '<f8'), ('a\\x0ab', '<f8'), ('distance', '<f8')"),
              std::string::npos);

    const auto refused = [&](std::vector<std::string> names, bool distances, const char* expected, const char* found) {
        const TableFormat format{.dimension = 2, .fields = fields_of(names), .distances = distances};
        expect_error(open_table(folder / "n.npy", format), "/n.npy",
                     {0, "a column name is not allowed in an NPY file", expected, found, "write CSV"});
    };
    const char* const differs = "a name that differs from the others and from x, y, z, cell, feature, distance";
    refused({"y"}, false, differs, "\"y\"");
    refused({"cell"}, false, differs, "\"cell\"");
    refused({"distance"}, true, differs, "\"distance\"");
    refused({""}, false, "a name", "\"\"");
    for (const char* name : {"\xFF", "a\xC3", "\xC3(", "\xC0\xAF", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80",
                             "\xF0\x80\x80\x80", "\x80"}) {
        refused({name}, false, "a name in UTF-8", nullptr);
    }
    for (const char* name :
         {"\xC2\x80", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"}) {
        EXPECT_TRUE(open_table(folder / "n.npy", {.dimension = 2, .fields = {{name}}}));
    }
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST(NpySink, DevicesAreRefused) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("/dev/null", folder / "null.npy");
    expect_error(open_table(folder / "null.npy", {}), "/null.npy",
                 {0, "cannot write NPY to a pipe or device", nullptr, nullptr, "CSV"});
}

}  // namespace
}  // namespace barycert::io::testing
