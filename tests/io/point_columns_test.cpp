// Which columns of a file are the coordinates, and which are carried through: CSV, NPY, .node.
#include "tests/io/carried_points.hpp"

namespace barycert::io::testing {
namespace {

const PointOptions none;

std::vector<double> points_of(const std::string& text, int dimension, const PointOptions& options) {
    Result<CarriedPoints> read = read_carried_bytes("p.csv", text, dimension, options);
    EXPECT_TRUE(read) << text << read.error().message();
    return read ? read->points : std::vector<double>();
}

void expect_refused(const std::string& name, const std::string& bytes, int dimension, const PointOptions& options,
                    const Expected& expected) {
    SCOPED_TRACE(bytes.substr(0, 100));
    expect_error(read_carried_bytes(name, bytes, dimension, options), "/" + name, expected);
}

TEST(PointColumns, WithoutNamesNothingIsGuessed) {
    const char* const what = "it is not clear which columns are the coordinates";
    expect_refused("p.csv", "1,2,3,4\n", 3, none,
                   {1, what, "3 columns, or names for them", "4 columns without names",
                    "options.columns 1,2,3, or options.columns 2,3,4, ..., or put a header line x,y,z,... first"});
    expect_refused("p.csv", "1,2,3\n", 2, none,
                   {1, what, "2 columns, or names for them", "3 columns without names", "options.columns 1,2, or"});
    expect_refused("p.csv", "1,2,3,4,5,6,7\n", 3, none, {1, what, nullptr, nullptr, "options.columns 5,6,7"});
    expect_refused("p.csv", "1,2,3,a\n", 3, none, {1, what, nullptr, nullptr, "options.columns 1,2,3"});
    expect_refused(
        "p.csv", "1,2,3,\n4,5,6,7\n", 3, none,
        {2, "a value after the last separator", "none, as in the first line", "\"7\"", "options.columns 1,2,3"});
    EXPECT_EQ(points_of("1,2,3,\n4,5,6,\n", 3, none), (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(points_of("1;2;3; ;\n4;5;6;;\"\"\n", 3, none), (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST(PointColumns, ByNumberAndByName) {
    EXPECT_EQ(points_of("1,2,3,4\n", 3, {.columns = {"2,3,4"}}), (std::vector<double>{2, 3, 4}));
    EXPECT_EQ(points_of("1,2,3,4\n", 3, {.columns = {"4", "1", "2"}}), (std::vector<double>{4, 1, 2}));
    EXPECT_EQ(points_of("1,2,3,x\n", 3, {.columns = {"1,2,3"}}), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(points_of("lon,lat,h\n1,2,3\n", 3, {.columns = {"lon,lat,h"}}), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(points_of("lon,lat,h\n1,2,3\n", 3, {.columns = {"3,2,1"}}), (std::vector<double>{3, 2, 1})) << "a header";
    EXPECT_EQ(points_of("2020 2021 x\n1 2 3\n", 2, {.columns = {"x,2020"}}), (std::vector<double>{3, 1}));
    EXPECT_EQ(points_of("\"a,b\",c\n1,2\n", 2, {.columns = {"a,b", "c"}}), (std::vector<double>{1, 2}));
    EXPECT_EQ(points_of("x,y,z\n1,2,3\n", 3, {.columns = {"z,y,x"}}), (std::vector<double>{3, 2, 1}));
    EXPECT_EQ(points_of("x,y,z\n1,2,3\n", 2, {.columns = {"x,y"}}), (std::vector<double>{1, 2}));
    const std::string header = "lon,lat,h\n1,2,3\n";
    expect_refused("p.csv", header, 3, none,
                   {1, "the header does not name the coordinates", nullptr, "\"lon\", \"lat\", \"h\"",
                    "options.columns lon,lat,h"});
    expect_refused(
        "p.csv", header, 3, {.columns = {"lon,lat"}},
        {1, "options.columns does not fit the mesh", "3 columns, for the mesh is 3-dimensional", "2", nullptr});
    expect_refused("p.csv", header, 3, {.columns = {"lon,lat,alt"}},
                   {1, "no such column", "\"alt\"", "\"lon\", \"lat\", \"h\"", "name columns that are there"});
    expect_refused("p.csv", header, 3, {.columns = {"1,2,4"}}, {1, "no such column", "\"4\"", nullptr, nullptr});
    expect_refused("p.csv", header, 3, {.columns = {"1,2,18446744073709551616"}},
                   {1, "no such column", nullptr, nullptr, nullptr});
    expect_refused("p.csv", header, 3, {.columns = {"0,1,2"}}, {1, "no such column", "\"0\"", nullptr, nullptr});
    expect_refused("p.csv", header, 3, {.columns = {"1,2,1"}},
                   {1, "a column is named twice in options.columns", nullptr, "\"1\"", nullptr});
    expect_refused("p.csv", "a,b,a\n1,2,3\n", 2, {.columns = {"a,b"}},
                   {1, "two columns have the same name", "one column \"a\"", "two", "rename"});
    expect_refused("p.csv", "1,2,a,4\n", 3, {.columns = {"2,3,4"}}, {1, "bad coordinate y", nullptr, "\"a\"", nullptr});
}

TEST(PointColumns, InThePlaneZIsZeroOrLeftOut) {
    Result<CarriedPoints> read =
        read_carried_bytes("p.csv", "x,y,z\n1,2,0\n3,4,-0.0\n", 2, {.columns = {}, .keep = {}});
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->points, (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(read->note_texts(), "left out: column z, which must be 0 throughout, for the mesh is 2D\n");
    const Expected off{3, "a point off the plane z = 0", "z = 0, for the mesh is 2D", "\"5e-324\"",
                       "options.columns x,y"};
    expect_refused("p.csv", "x,y,z\n1,2,0\n3,4,5e-324\n", 2, none, off);
    expect_refused("p.csv", "x y z n\n1 2 0 a\n3 4 5e-324 b\n", 2, {.columns = {}, .keep = {"n"}}, off);
    expect_refused("p.csv", "x,y,z\n1,2,a\n", 2, none, {2, "bad coordinate z", nullptr, nullptr, nullptr});
}

TEST(PointColumns, ColumnsAreCarriedThroughAsTheyStand) {
    const std::string text =
        "id,x,name,y,z,t\n007,1,\"a, \"\"b\"\" \",2,3,1.50\n-0,4,,5,6,\n9, 7 , c d ,8,9,1e400\n\n# c\n12,1,#,2,3,nan\n";
    for (const std::size_t block : {std::size_t{1}, std::size_t{2}, std::size_t{100}}) {
        Result<CarriedPoints> read = read_carried_bytes("p.csv", text, 3, {.columns = {}, .keep = {"all"}}, block);
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->points, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 1, 2, 3}));
        ASSERT_EQ(read->columns.size(), 3U);
        EXPECT_EQ(read->text(0), "id:t 007|-0|9|12");
        EXPECT_EQ(read->text(1), "name:t a, \"b\" ||c d|#");
        EXPECT_EQ(read->text(2), "t:t 1.50||1e400|nan");
        EXPECT_EQ(read->note_texts(), "");
    }
    Result<CarriedPoints> some = read_carried_bytes("p.csv", text, 3, {.columns = {}, .keep = {"t", "number=id"}});
    ASSERT_TRUE(some) << some.error().message();
    EXPECT_EQ(some->text(0), "t:t 1.50||1e400|nan");
    EXPECT_EQ(some->text(1), "number:t 007|-0|9|12");
    EXPECT_EQ(some->note_texts(), "left out: column name; options.keep name carries it through\n");
    Result<CarriedPoints> nothing = read_carried_bytes("p.csv", text, 3, none);
    EXPECT_EQ(nothing.value().note_texts(),
              "left out: columns id, name, t; options.keep id,name,t carries them through\n");
    Result<CarriedPoints> unnamed =
        read_carried_bytes("p.csv", "5;1;2;3\n", 3, {.columns = {"2,3,4"}, .keep = {"column1"}});
    EXPECT_EQ(unnamed.value().text(0), "column1:t 5");
    EXPECT_EQ(unnamed.value().note_texts(),
              "guessed: columns are separated by semicolons\n"
              "guessed: there is no header: the first line is a point\n");
}

TEST(PointColumns, ColumnsThatCannotBeKept) {
    const std::string text = "x,y,n,\"a,b\"\n1,2,3,4\n";
    const auto refused = [&](std::vector<std::string> keep, const Expected& expected) {
        expect_refused("p.csv", text, 2, {.columns = {}, .keep = std::move(keep)}, expected);
    };
    EXPECT_EQ(read_carried_bytes("p.csv", text, 2, {.columns = {}, .keep = {"a,b"}}).value().text(0), "a,b:t 4");
    EXPECT_EQ(read_carried_bytes("p.csv", text, 2, {.columns = {}, .keep = {"c=a,b"}}).value().text(0), "c:t 4");
    refused({"m"}, {1, "no such column", "\"m\"", "\"x\", \"y\", \"n\", \"a,b\"", "options.keep all"});
    refused({""}, {1, "no such column", "\"\"", nullptr, nullptr});
    refused({"x"}, {1, "a column to keep is a coordinate", nullptr, "\"x\"", nullptr});
    refused({"n,n"}, {1, "a column to keep is named twice", nullptr, "\"n\"", nullptr});
    refused({"all,n"}, {1, "no such column", "\"all\"", nullptr, nullptr});
    refused({"all", "n"}, {1, "a column to keep is named twice", nullptr, "\"n\"", nullptr});
    refused({"n", "n=a,b"}, {1, "two columns to keep have the same name", nullptr, "\"n\"", "NEW=NAME"});
}

TEST(PointColumns, TypesAreThoseOfAllValues) {
    const auto types = [](const std::string& values) {
        std::string text = "x,y,c\n";
        for (std::size_t begin = 0; begin <= values.size();) {
            const std::size_t end = std::min(values.find('|', begin), values.size());
            text += "1,2," + values.substr(begin, end - begin) + "\n";
            begin = end + 1;
        }
        Result<CarriedPoints> read =
            read_carried_bytes("p.csv", text, 2, {.columns = {}, .keep = {"c"}, .typed = true});
        EXPECT_TRUE(read) << read.error().message();
        return read ? read->text(0) : "";
    };
    EXPECT_EQ(types("1|-2|0|9223372036854775807|-9223372036854775808"),
              "c:i 1 -2 0 9223372036854775807 -9223372036854775808");
    EXPECT_EQ(types("1|2.5|-0"), "c:n 1 2.5 -0");
    EXPECT_EQ(types("1||3"), "c:n 1 nan 3");
    EXPECT_EQ(types("nan|-inf|1e3|.5|+1"), "c:n nan -inf 1000 0.5 1");
    EXPECT_EQ(types("9007199254740992|0.5"), "c:n 9007199254740992 0.5");
    EXPECT_EQ(types("9007199254740993|0.5"), "c:t 9007199254740993|0.5") << "no double represents it";
    EXPECT_EQ(types("9223372036854775808"), "c:n 9223372036854775808") << "a power of two";
    EXPECT_EQ(types("9223372036854775809"), "c:t 9223372036854775809");
    EXPECT_EQ(types("007|1"), "c:t 007|1");
    EXPECT_EQ(types("1|a"), "c:t 1|a");
    EXPECT_EQ(types("0x10"), "c:t 0x10");
    EXPECT_EQ(types("1e400"), "c:t 1e400");
    EXPECT_EQ(types("|"), "c:t |");
    EXPECT_EQ(types("\"1\"|\" 2\""), "c:t 1| 2") << "a blank in quotes is one";
    const auto widths = [](const std::string& value) {
        Result<CarriedPoints> read = read_carried_bytes("p.csv", "x,y,c\n1,2,a\n1,2," + value + "\n", 2,
                                                        {.columns = {}, .keep = {"c"}, .typed = true});
        return std::pair(read.value().formats[0].max_bytes, read.value().formats[0].max_characters);
    };
    EXPECT_EQ(widths("abc"), (std::pair<std::size_t, std::size_t>(3, 3)));
    EXPECT_EQ(widths("\xC3\xA4\xE2\x82\xAC"), (std::pair<std::size_t, std::size_t>(5, 2)));
    EXPECT_EQ(widths("\xFF"
                     "b"),
              (std::pair<std::size_t, std::size_t>(2, 0)))
        << "not UTF-8";
}

// Who prints a double with 17 digits or more means that double; other digits are lost, and that is told.
TEST(PointColumns, DecimalsThatNoDoubleHoldsAreTold) {
    const TemporaryFolder folder;
    const auto told = [&](const std::string& value) {
        put(folder / "p.csv", "x,y,c\n1,2,0.5\n1,2," + value + "\n");
        const auto source = open_points(folder / "p.csv", 2, {.columns = {}, .keep = {"c"}, .typed = true});
        EXPECT_TRUE(source) << source.error().message();
        std::string text;
        for (const Note& note : source ? (*source)->notes() : Notes{}) {
            if (note.kind == Note::Kind::converted) text += note.text;
        }
        return text;
    };
    const std::string rounded = "numbers of column c that no double holds to the nearest doubles";
    for (const char* held :
         {"0.1", "-1.50", "1e300", "0.10000000000000001", "0.1000000000000000055511151231257827",
          "4.9406564584124654e-324", "5e-324", "123456789012345", "9007199254740992.0", "nan", "0e5"})
        EXPECT_EQ(told(held), "") << held;
    for (const char* lost : {"0.1000000000000000001", "-0.1234567890123456789", "9007199254740993.0", "5.1e-324"})
        EXPECT_EQ(told(lost), rounded) << lost;
    EXPECT_EQ(told("0." + std::string(800, '1')), rounded);
    EXPECT_EQ(told("1e-400"), "numbers of column c that are too small for a double to 0");
}

TEST(PointColumns, ATypeThatShowsLateIsThatOfAll) {
    std::string text = "x,y,c\n";
    for (int i = 0; i < 100000; ++i) text += "1,2," + std::to_string(i) + "\n";
    text += "1,2,a\n";
    Result<CarriedPoints> read =
        read_carried_bytes("p.csv", text, 2, {.columns = {}, .keep = {"c"}, .typed = true}, 70000);
    ASSERT_TRUE(read) << read.error().message();
    const auto& texts = std::get<std::vector<std::string>>(read->columns[0].values);
    ASSERT_EQ(texts.size(), 100001U);
    for (std::size_t i = 0; i < 100000; ++i) ASSERT_EQ(texts[i], std::to_string(i));
    EXPECT_EQ(texts.back(), "a");
    // Found in the first pass, and told of it before any point is given.
    Result<CarriedPoints> bad =
        read_carried_bytes("p.csv", text + "1,b,2\n", 2, {.columns = {}, .keep = {"c"}, .typed = true}, 70000);
    expect_error(bad, "p.csv", {100003, "bad coordinate y", nullptr, "\"b\"", nullptr});
}

TEST(PointColumns, ValuesThatTheEndMayHaveCut) {
    const Expected cut{2, "the last row has no line end, so the file may be cut short", "a line end",
                       "the end of the file", "end the last line"};
    for (const bool typed : {false, true}) {
        const PointOptions keep{.columns = {}, .keep = {"n"}, .typed = typed};
        for (const char* last : {"1,2,stee", "1,2,4", "1,2,", "1,2,a b "}) {
            expect_refused("p.csv", "x,y,n\n" + std::string(last), 2, keep, cut);
            EXPECT_TRUE(read_carried_bytes("p.csv", "x,y,n\n" + std::string(last) + "\n", 2, keep));
            EXPECT_TRUE(read_carried_bytes("p.csv", "x,y,n\n" + std::string(last), 2, none)) << "nobody reads it";
        }
        EXPECT_TRUE(read_carried_bytes("p.csv", "x,y,n\n1,2,\"a\"", 2, keep));
        EXPECT_TRUE(read_carried_bytes("p.csv", "x y n\n1 2 a ", 2, keep)) << "the blank ends it";
        expect_refused("p.csv", "x y n\n1 2 a", 2, keep, cut);
        expect_refused("p.csv", "x,n,y\n1,a,2", 2, keep, cut);
    }
}

TEST(PointColumns, PipesCannotBeReadTwice) {
    expect_error(open_points("-", 3, {.columns = {}, .keep = {"all"}, .typed = true}), "standard input",
                 {0, "the types of columns cannot be found in a stream", nullptr, nullptr, "write CSV"});
}

TEST(PointColumns, OfNodeFiles) {
    const std::string text = "2 3 2 1\n1 1 2 0 7 0.5 3\n2 4 5 0 8 0.25 -4\n";
    Result<CarriedPoints> read = read_carried_bytes("p.node", text, 3, {.columns = {}, .keep = {"all"}});
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->points, (std::vector<double>{1, 2, 0, 4, 5, 0}));
    EXPECT_EQ(read->text(0), "attribute0:n 7 8");
    EXPECT_EQ(read->text(1), "attribute1:n 0.5 0.25");
    EXPECT_EQ(read->text(2), "marker:i 3 -4");
    Result<CarriedPoints> flat = read_carried_bytes("p.node", text, 2, {.columns = {}, .keep = {"m=marker"}});
    EXPECT_EQ(flat.value().points, (std::vector<double>{1, 2, 4, 5}));
    EXPECT_EQ(flat.value().text(0), "m:i 3 -4");
    EXPECT_EQ(flat.value().note_texts(),
              "left out: columns attribute0, attribute1; options.keep attribute0,attribute1 carries them through\n");
    EXPECT_EQ(read_carried_bytes("p.node", text, 2, {.columns = {"attribute0,y"}}).value().points,
              (std::vector<double>{7, 2, 8, 5}));
    expect_refused("p.node", text, 3, {.columns = {"x,y,marker"}},
                   {0, "a marker cannot be a coordinate", nullptr, nullptr, nullptr});
    expect_refused("p.node", "1 2 0 0\n1 0 0\n", 3, {.columns = {"1,2,3"}},
                   {0, "no such column", "\"3\"", "\"x\", \"y\"", nullptr});
}

TEST(PointColumns, OfMeshes) {
    const TemporaryFolder folder;
    put(folder / "m.node", "4 3 1 1\n0 0 0 0 1 5\n1 1 0 0 2 6\n2 0 1 0 3 7\n3 0 0 1 4 8\n");
    put(folder / "m.ele", "1 4\n0 0 1 2 3\n");
    for (const char* name : {"m", "m.ele"}) {
        Result<CarriedPoints> read = read_carried(folder / name, 3, {.columns = {}, .keep = {"all"}});
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
        EXPECT_EQ(read->text(0), "attribute0:n 1 2 3 4");
        EXPECT_EQ(read->text(1), "marker:i 5 6 7 8");
    }
    expect_error(read_carried(folder / "m", 2, {}), "/m",
                 {0, "a point off the plane z = 0: point 3, counted from 0", nullptr, "1", "options.columns x,y"});
    EXPECT_EQ(read_carried(folder / "m", 2, {.columns = {"y,z"}}).value().points,
              (std::vector<double>{0, 0, 0, 0, 1, 0, 0, 1}));
    expect_error(read_carried(folder / "m", 3, {.columns = {"x,y,marker"}}), "/m",
                 {0, "a column of texts or large integers cannot be a coordinate", nullptr, "\"marker\"", nullptr});
    expect_error(open_points(folder / "n", 3), "/n", {0, "unknown file suffix", nullptr, "no suffix", nullptr});
}

}  // namespace
}  // namespace barycert::io::testing
