// NPY files of columns: structured arrays, integers, texts; and damaged ones.
#include "core/base/random.hpp"
#include "tests/io/carried_points.hpp"

namespace barycert::io::testing {
namespace {

/// Little-endian, as this machine is.
template <class... T>
std::string packed(T... values) {
    std::string out;
    (out.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
    return out;
}

std::string structured(const std::string& fields, const std::string& shape) {
    return "{'descr': " + fields + ", 'fortran_order': False, 'shape': " + shape + ", }";
}

const PointOptions as_it_is, all{.columns = {}, .keep = {"all"}};

void expect_refused(const std::string& bytes, int dimension, const PointOptions& options, const Expected& expected) {
    expect_error(read_carried_bytes("p.npy", bytes, dimension, options), "/p.npy", expected);
}

TEST(NpyTables, FieldsByTheirNames) {
    const std::string bytes = npy_bytes(
        structured("[('id', '<i4'), ('Z', '<f4'), ('x', '<f8'), ('y', '|i1'), ('n', '|S3'), (('t', 'w'), '<U2')]",
                   "(2,)"),
        packed(std::int32_t{-7}, 0.5F, 1.25, std::int8_t{-3}) + "ab" + std::string(1, '\0') +
            packed(U'\u20AC', char32_t{0}) + packed(std::int32_t{8}, -0.0F, 5e-324, std::int8_t{3}) + "abc" +
            packed(U'a', U'\U0001F600'));
    for (const std::size_t block : {std::size_t{1}, std::size_t{2}, std::size_t{9}}) {
        Result<CarriedPoints> read = read_carried_bytes("p.npy", bytes, 3, all, block);
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(bits_of(read->points), bits_of({1.25, -3, 0.5, 5e-324, 3, -0.0}));
        EXPECT_EQ(read->text(0), "id:i -7 8");
        EXPECT_EQ(read->text(1), "n:t ab|abc");
        EXPECT_EQ(read->text(2), "w:t \xE2\x82\xAC|a\xF0\x9F\x98\x80");
        EXPECT_EQ(read->formats[1], (ColumnFormat{"n", Column::Type::text, 3, 0}));
        EXPECT_EQ(read->formats[2], (ColumnFormat{"w", Column::Type::text, 8, 2}));
    }
    EXPECT_EQ(read_carried_bytes("p.npy", bytes, 3, as_it_is).value().note_texts(),
              "left out: columns id, n, w; options.keep id,n,w carries them through\n"
              "converted: coordinates of type <f4 to double, exactly\n");
    EXPECT_EQ(read_carried_bytes("p.npy", bytes, 2, {.columns = {"id,Z"}}).value().points,
              (std::vector<double>{-7, 0.5, 8, -0.0}));
    EXPECT_EQ(read_carried_bytes("p.npy", bytes, 2, {.columns = {"3,1"}}).value().points,
              (std::vector<double>{1.25, -7, 5e-324, 8}));
    expect_refused(bytes, 2, as_it_is,
                   {0, "a point off the plane z = 0: row 0, counted from 0", nullptr, "0.5", "options.columns x,y"});
    expect_refused(bytes, 3, {.columns = {"x,y,n"}},
                   {0, "cannot read points of that type", nullptr, "\"|S3\"", nullptr});
    expect_refused(bytes, 3, {.columns = {"x,y,h"}},
                   {0, "no such column", "\"h\"", "\"id\", \"Z\", \"x\", \"y\", \"n\", \"w\"", nullptr});
}

TEST(NpyTables, FieldsOfSeveralValuesAndHoles) {
    const std::string bytes = npy_bytes(
        structured("[('p', '<f8', (2,)), ('', '|V2'), ('s', [('a', '<i2'), ('b', '>f4', (3,))]), ('k', '>u2', (1, 2))]",
                   "(1,)"),
        packed(1.0, 2.0) + "xx" + std::string(14, 'y') + std::string("\x01\x02\x03\x04", 4));
    Result<CarriedPoints> read = read_carried_bytes("p.npy", bytes, 2, {.columns = {"p.0,p.1"}, .keep = {"k.0,k.1"}});
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->points, (std::vector<double>{1, 2}));
    EXPECT_EQ(read->text(0), "k.0:i 258");
    EXPECT_EQ(read->text(1), "k.1:i 772");
    expect_refused(bytes, 2, {.columns = {"p.0,p.1"}, .keep = {"s"}},
                   {0, "column \"s\" cannot be carried through", "integers, floating-point numbers or texts", nullptr,
                    "leave it out"});
    const std::string empty =
        npy_bytes(structured("[('x', '<f8'), ('y', '<f8'), ('none', '<f8', (0,))]", "(1,)"), packed(1.0, 2.0));
    expect_refused(empty, 2, all, {0, "column \"none\" cannot be carried through", nullptr, nullptr, nullptr});
    expect_refused(bytes, 2, as_it_is,
                   {0, "the header does not name the coordinates", nullptr, nullptr, "options.columns p.0,p.1"});
}

TEST(NpyTables, IntegersAreExactOrRefused) {
    const auto plain = [](const char* type, const std::string& data) {
        return npy_bytes(npy_dictionary(type, "(1, 2)"), data);
    };
    const auto points = [&](const char* type, const std::string& data) {
        Result<CarriedPoints> read = read_carried_bytes("p.npy", plain(type, data), 2, as_it_is);
        EXPECT_TRUE(read) << type << read.error().message();
        return read ? read->points : std::vector<double>();
    };
    EXPECT_EQ(points("|i1", packed(std::int8_t{-128}, std::int8_t{127})), (std::vector<double>{-128, 127}));
    EXPECT_EQ(points("|u1", packed(std::uint8_t{0}, std::uint8_t{255})), (std::vector<double>{0, 255}));
    EXPECT_EQ(points(">i2", std::string("\x80\x00\x01\x02", 4)), (std::vector<double>{-32768, 258}));
    EXPECT_EQ(points("<u4", packed(0xFFFFFFFFU, 0U)), (std::vector<double>{4294967295, 0}));
    EXPECT_EQ(points("<i8", packed(INT64_MIN, std::int64_t{1} << 53)), (std::vector<double>{-0x1p63, 0x1p53}));
    EXPECT_EQ(points("<u8", packed(std::uint64_t{1} << 63, (std::uint64_t{1} << 54) + 4)),
              (std::vector<double>{0x1p63, 0x1p54 + 4}));
    EXPECT_EQ(points("<f2", std::string("\x00\x3C\x01\x80", 4)), (std::vector<double>{1, -0x1p-24}));
    const Expected refused{0, "row 0 of column \"column2\"", "an integer that a double holds exactly", nullptr,
                           "a.astype('f8')"};
    expect_refused(plain("<i8", packed(std::int64_t{0}, (std::int64_t{1} << 53) + 1)), 2, as_it_is, refused);
    expect_refused(plain("<u8", packed(std::uint64_t{0}, UINT64_MAX)), 2, as_it_is, refused);
    expect_refused(plain("<i8", packed(std::int64_t{0}, INT64_MAX)), 2, as_it_is, refused);
    expect_refused(plain("<f2", std::string("\x00\x7C\x00\x00", 4)), 2, as_it_is,
                   {0, "a point that is not finite", nullptr, "inf at [0, 0]", nullptr});
    const std::string fields = structured("[('x', '<f8'), ('y', '<f8'), ('n', '<u8')]", "(1,)");
    EXPECT_EQ(read_carried_bytes("p.npy", npy_bytes(fields, packed(1.0, 2.0, INT64_MAX)), 2, all).value().text(0),
              "n:i 9223372036854775807");
    expect_refused(npy_bytes(fields, packed(1.0, 2.0, std::uint64_t{1} << 63)), 2, all,
                   {0, "row 0 of column \"n\"", "an integer below 2^63", nullptr, "options.keep"});
    const std::string text = structured("[('x', '<f8'), ('y', '<f8'), ('n', '<U1')]", "(1,)");
    expect_refused(npy_bytes(text, packed(1.0, 2.0, char32_t{0xD800})), 2, all,
                   {0, "row 0 of column \"n\"", "characters of Unicode", nullptr, nullptr});
}

TEST(NpyTables, ColumnsOfAnArrayByNumber) {
    const std::string rows = packed(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0), shape = "(2, 4)";
    const PointOptions options{.columns = {"2,3,4"}, .keep = {"id=column1"}};
    for (const bool fortran : {false, true}) {
        const std::string data = fortran ? packed(1.0, 5.0, 2.0, 6.0, 3.0, 7.0, 4.0, 8.0) : rows;
        Result<CarriedPoints> read =
            read_carried_bytes("p.npy", npy_bytes(npy_dictionary("<f8", shape, fortran), data), 3, options, 1);
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->points, (std::vector<double>{2, 3, 4, 6, 7, 8}));
        EXPECT_EQ(read->text(0), "id:n 1 5");
    }
    expect_refused(
        npy_bytes(npy_dictionary("<f8", shape), rows), 3, as_it_is,
        {0, "an array of another shape", "(n, 3), for the mesh is 3-dimensional", "(2, 4)", "options.columns 1,2,3"});
}

TEST(NpyTables, TypesThatAreNoTable) {
    for (const char* fields :
         {"[('x', '<f8'), ('y', '|O')]", "[('x', '<f8'), ('y', '<f8', (-1,))]", "[('x', '<f8'), 'y']",
          "[('x', '<f8'), ('y', '<f8', (4294967296, 4294967296, 4294967296))]", "[('x',), ('y',)]",
          "[('x', '<f8') ('y', '<f8')]", "[]", "[('x', '<f8'), ('y', '<q8')]",
          "[('x', '<f8'), ('y', '<S99999999999999999999')]"}) {
        SCOPED_TRACE(fields);
        expect_refused(npy_bytes(structured(fields, "(1,)"), packed(1.0, 2.0)), 2, as_it_is,
                       {0, "cannot read a structured array of that type", nullptr, nullptr, nullptr});
    }
    std::string deep = "[('x', '<f8'), ('y', ";
    for (int i = 0; i < 1000; ++i) deep += "[('a', ";
    deep += "'<f8'";
    for (int i = 0; i < 1000; ++i) deep += ")]";
    expect_refused(npy_bytes(structured(deep + ")]", "(1,)"), packed(1.0, 2.0), 2), 2, as_it_is,
                   {0, "cannot read a structured array of that type", nullptr, nullptr, nullptr});
    const std::string good = "[('x', '<f8'), ('y', '<f8')]";
    expect_refused(npy_bytes(structured(good, "(1, 1)"), packed(1.0, 2.0)), 2, as_it_is,
                   {0, "an array of another shape", "(n,)", "(1, 1)", nullptr});
    expect_refused(npy_bytes(structured(good, "(2,)"), packed(1.0, 2.0)), 2, as_it_is,
                   {0, "the file ends too early", "2 rows of 16 bytes, as its header tells", "16 bytes", nullptr});
    EXPECT_TRUE(
        read_carried_bytes("p.npy", npy_bytes(structured(good, "(0,)"), ""), 2, as_it_is).value().points.empty());
}

TEST(NpyTables, NamesWithEscapesAndOtherLetters) {
    const std::string fields = R"([('x', '<f8'), ("y", '<f8'), ('it\'s', '<f8'), ('a\nb\\\x41\u20ac', '<f8')])";
    Result<CarriedPoints> read =
        read_carried_bytes("p.npy", npy_bytes(structured(fields, "(1,)"), packed(1.0, 2.0, 3.0, 4.0)), 2, all);
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->formats[0].name, "it's");
    EXPECT_EQ(read->formats[1].name, "a\nb\\A\xE2\x82\xAC");
    const auto name_of = [&](int version, const std::string& name) {
        const std::string text = structured("[('x', '<f8'), ('y', '<f8'), ('" + name + "', '<f8')]", "(1,)");
        return read_carried_bytes("p.npy", npy_bytes(text, packed(1.0, 2.0, 3.0), version), 2, all)
            .value()
            .formats[0]
            .name;
    };
    EXPECT_EQ(name_of(1, "\xE4"), "\xC3\xA4") << "Latin-1";
    EXPECT_EQ(name_of(2, "\xE4"), "\xC3\xA4");
    EXPECT_EQ(name_of(3, "\xC3\xA4"), "\xC3\xA4") << "UTF-8";
}

/// Cut and flipped at every byte: an error, or points and columns of as many values.
TEST(NpyTables, DamageAtEveryByte) {
    const std::string bytes = npy_bytes(
        structured("[('x', '<f8'), ('n', '<U2'), ('y', '>i2', (1,)), ('', '|V1'), ('y', '<f4'), ('s', '|S3')]", "(2,)"),
        packed(1.0, U'a', U'b') + "\x01\x02v" + packed(0.5F) + "abc" + packed(2.0, U'c', U'd') + "\x03\x04w" +
            packed(0.25F) + "de" + std::string(1, '\0'));
    const TemporaryFolder folder;
    const std::string path = folder / "p.npy";
    int accepted = 0, refused = 0;
    const auto look = [&](const std::string& damaged) {
        put(path, damaged);
        Result<CarriedPoints> read = read_carried(path, 2, all, 1);
        Result<CarriedPoints> more = read_carried(path, 2, all, 100);
        ASSERT_EQ(read.has_value(), more.has_value());
        ++(read ? accepted : refused);
        if (!read) {
            ASSERT_EQ(read.error().message(), more.error().message());
            ASSERT_FALSE(read.error().what.empty());
            return;
        }
        ASSERT_EQ(bits_of(read->points), bits_of(more->points));
        for (std::size_t k = 0; k < read->columns.size(); ++k) {
            ASSERT_EQ(read->text(k), more->text(k));
            ASSERT_EQ(2 * read->columns[k].size(), read->points.size());
        }
    };
    look(bytes);
    ASSERT_EQ(accepted, 1);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        look(bytes.substr(0, size));
        ASSERT_EQ(accepted, 1) << "a file that tells its size was accepted when cut at " << size;
    }
    for (std::size_t place = 0; place < bytes.size(); ++place) {
        SCOPED_TRACE(place);
        for (int bit = 0; bit < 8; ++bit) {
            std::string damaged = bytes;
            damaged[place] = static_cast<char>(damaged[place] ^ 1 << bit);
            look(damaged);
        }
    }
    base::Random random(3);
    constexpr std::string_view alphabet = "0123456789 ()[]{}',<>|fiuSUVOxyn:-\"\\";
    for (int i = 0; i < 4000; ++i) {
        std::string damaged = bytes;
        for (std::uint64_t n = 1 + random.below(4); n > 0; --n)
            damaged[random.below(damaged.size())] = alphabet[random.below(alphabet.size())];
        look(damaged);
    }
    EXPECT_GT(accepted, 300);
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace barycert::io::testing
