// CSV files that are refused, and in which words.
#include <filesystem>

#include "io/csv/line_reader.hpp"
#include "tests/io/points_files.hpp"

namespace barycert::io::testing {
namespace {

void expect_csv_refused(const std::string& text, int dimension, const Expected& expected) {
    SCOPED_TRACE(text.substr(0, 200));
    for (const std::size_t block : {std::size_t{1}, std::size_t{100}}) {
        expect_error(read_bytes("p.csv", text, dimension, block), "/p.csv", expected);
    }
}

TEST(CsvErrors, Coordinates) {
    const auto bad = [](std::size_t line, const char* what, const char* expected, const char* found,
                        const char* remedy) {
        return Expected{line, what, expected, found, remedy};
    };
    const char* const finite = "a finite number";
    const char* const x = "bad coordinate x";
    const char* const y = "bad coordinate y";
    const char* const z = "bad coordinate z";
    expect_csv_refused("x,y,z\n1,2,3\n1,nan,3\n", 3, bad(3, y, finite, "\"nan\"", "remove the point"));
    expect_csv_refused("x,y,z\n1,2,-inf\n", 3, bad(2, z, finite, "\"-inf\"", "remove the point"));
    expect_csv_refused("x,y,z\n1,2,+Infinity\n", 3, bad(2, z, finite, "\"+Infinity\"", "remove the point"));
    expect_csv_refused("1,2,-NaN\n", 3, bad(1, z, finite, "\"-NaN\"", nullptr));
    expect_csv_refused("nan,nan,nan\n", 3, bad(1, x, finite, "\"nan\"", nullptr));
    expect_csv_refused("1,2,3\n\n# c\n1,,3\n", 3, bad(4, y, "a number", "nothing", "fill it in"));
    expect_csv_refused("1,2,3\n1,\"\",3\n", 3, bad(2, y, "a number", "nothing", "fill it in"));
    expect_csv_refused("1\t2\t3\n\t2\t3\n", 3, bad(2, x, "a number", "nothing", "fill it in"));
    expect_csv_refused("1\t2\t3\n\t\t\n", 3, bad(2, x, "a number", "nothing", "fill it in"));
    expect_csv_refused("1,2,3\n,,\n", 3, bad(2, x, "a number", "nothing", "fill it in"));
    expect_csv_refused("1,2,3\n1,2,abc\n", 3, bad(2, z, "a number", "\"abc\"", "separate the fields by commas"));
    expect_csv_refused("1,2,abc\n", 3, bad(1, z, "a number", "\"abc\"", nullptr));  // a number in it: no header
    expect_csv_refused("1,2,3\n1 2 3\n", 3, bad(2, x, "a number", "\"1 2 3\"", "separate the fields by commas"));
    expect_csv_refused("1 2 3\n1,2,3\n", 3, bad(2, x, "a number", "\"1,2,3\"", nullptr));
    expect_csv_refused("1;2;3\n1,5;2;3\n", 3, bad(2, x, "a number", "\"1,5\"", "decimal point"));
    expect_csv_refused("1,5;2,5;3,5\n", 3, bad(1, x, "a number", "\"1,5\"", "decimal point"));
    expect_csv_refused("1,2,3\n1d5,2,3\n", 3, bad(2, x, "a number", "\"1d5\"", "with e"));
    expect_csv_refused("1,2,3\n1,2,1e400\n", 3, bad(2, z, "a number that a double can hold", "\"1e400\"", "1.8e308"));
    expect_csv_refused("1,2,3\n1,2,0x10\n", 3, bad(2, z, "a number", "\"0x10\"", nullptr));
    expect_csv_refused("1,2,3\n1,2,+-3\n", 3, bad(2, z, nullptr, "\"+-3\"", nullptr));
    expect_csv_refused("1,2,3\n1,2,3 # c\n", 3, bad(2, z, "a number", "\"3 # c\"", "put #"));
    expect_csv_refused("1,2,3\n1,2,3\r4,5,6\r", 3, bad(2, z, "a number", "\"3\\r4\"", "not with CR alone"));
    expect_csv_refused(std::string("1,2,3\n1,2,3\0\n", 13), 3, bad(2, z, "a number", "\"3\\x00\"", "binary"));
    expect_csv_refused("z,x,y\n1,2,3\n1,b,3\n", 3, bad(3, x, "a number", "\"b\"", nullptr));  // by name, not by place
}

TEST(CsvErrors, AFileThatCannotBeReadHasNotEnded) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("/proc/self/mem", folder / "p.csv");
    expect_error(read_file(folder / "p.csv", 3), "/p.csv",
                 {0, "cannot read the file", nullptr, "Input/output error", nullptr});
}

// Files of the system say that they have no bytes; others grow while they are read.
TEST(CsvErrors, AFileThatIsLongerThanItSays) {
    const std::string path = "/proc/self/limits", whole = get(path);
    LineReader reader(path);
    std::string lines;
    for (std::string_view line; reader.next(line);) lines += std::string(line) + '\n';
    EXPECT_GT(whole.size(), 100U);
    EXPECT_EQ(lines, whole);
}

TEST(CsvErrors, NumbersOfFields) {
    expect_csv_refused(
        "1,2,3\n1,2\n", 3,
        {2, "too few fields in a line", "3, separated by commas, as in the first line", "2", "same columns"});
    expect_csv_refused("1,2,3\n1,2,3,\n", 3,
                       {2, "too many fields in a line", "3, separated by commas, as in the first line", "4", nullptr});
    expect_csv_refused(
        "x y z n\n1 2 3 a b\n", 3,
        {2, "too many fields in a line", "4, separated by blanks, as in the first line", "5", "double quotes"});
    expect_csv_refused("x\ty\tz\tn\n\n1\t2\t3\n", 3,
                       {3, "too few fields in a line", "4, separated by tabs, as in the first line", "3", nullptr});
    expect_csv_refused(
        "1;2\n1;2;3;4\n", 2,
        {2, "too many fields in a line", "2, separated by semicolons, as in the first line", "4", nullptr});
    expect_csv_refused("# c\n1,2\n", 3,
                       {2, "too few columns for a point", "3, for the mesh is 3-dimensional", "2 columns without names",
                        "one point a line"});
    expect_csv_refused(
        "5\n", 2,
        {1, "too few columns for a point", "2, for the mesh is 2-dimensional", "1 columns without names", nullptr});
}

TEST(CsvErrors, Headers) {
    const char* const unnamed = "the header does not name the coordinates";
    expect_csv_refused(
        "x,y\n1,2\n", 3,
        {1, unnamed, "columns x, y, z (or Points:0, Points:1, Points:2)", "\"x\", \"y\"", "use these column names"});
    expect_csv_refused(
        "\n#\nlon,lat,h\n1,2,3\n", 3,
        {3, unnamed, nullptr, "\"lon\", \"lat\", \"h\"", "options.columns lon,lat,h, or use these names"});
    expect_csv_refused("a,b,c,d,e,f,g,h,i\n", 2,
                       {1, unnamed, "columns x, y (or Points:0, Points:1)",
                        "\"a\", \"b\", \"c\", \"d\", \"e\", \"f\", \"g\", \"h\", ...", nullptr});
    expect_csv_refused("x,y,X,z\n1,2,3,4\n", 3,
                       {1, "two columns have the same name", "one column x", "\"x\" and \"X\"", "rename"});
    expect_csv_refused("x y z\n1,2,3\n", 3, {2, "bad coordinate x", "a number", "\"1,2,3\"", nullptr});
}

TEST(CsvErrors, Quotes) {
    const char* const what = "a quoted field is not closed";
    expect_csv_refused("x,y,z,n\n1,2,3,\"a\n4,5,6,b\"\n", 3, {2, what, nullptr, "\"1,2,3,\"a\"", "close the quote"});
    expect_csv_refused("x,y,z,n\n4,5,6,\"b\"c\n", 3, {2, what, nullptr, nullptr, nullptr});
    expect_csv_refused("1,2,3\n4,5,6,\"b\n", 3, {2, what, nullptr, nullptr, nullptr});  // beyond the fields
    expect_csv_refused("x y z n\n4 5 6 \"b\"c\n", 3, {2, what, nullptr, nullptr, nullptr});
    expect_csv_refused("x,y,z,n\n4,5,6,\"\"\"\n", 3, {2, what, nullptr, nullptr, nullptr});
}

TEST(CsvErrors, NothingToRead) {
    expect_csv_refused("", 3,
                       {0, "the file is empty", "a header line or a point", "nothing", "a file with a header only"});
    expect_csv_refused("\n# x,y,z\n", 3,
                       {0, "the file is empty", "a header line or a point", "blank lines and comments", nullptr});
    expect_csv_refused("\xEF\xBB\xBF", 3, {0, "the file is empty", nullptr, "nothing", nullptr});
}

TEST(CsvErrors, NoText) {
    using namespace std::string_literals;
    const Expected cr{1, "lines end with CR alone", "LF or CR LF", "CR alone", "save the file with LF or CR LF"};
    expect_csv_refused("x,y,z\r1,2,3\r4,5,6\r", 3, cr);
    expect_csv_refused("1,2,3\r4,5,6\r", 3, cr);
    expect_csv_refused(
        "\xFF\xFE"
        "1\0,\0"s,
        3, {1, "the text is not in UTF-8", "UTF-8 or ASCII", "a byte-order mark of UTF-16", "save the file as UTF-8"});
    expect_csv_refused(
        "\xFE\xFF\0"
        "1"s,
        3, {1, "the text is not in UTF-8", nullptr, nullptr, nullptr});
    const std::string long_line(std::size_t{1} << 20, ' ');
    expect_csv_refused("1,2,3\n" + long_line + "\n", 3,
                       {2, "a line is too long", "at most 1048576 bytes", "more", "text file"});
    const Result<std::vector<double>> longest = read_bytes("p.csv", "1,2,3\n" + long_line.substr(1) + "\n4,5,6\n", 3);
    ASSERT_TRUE(longest) << longest.error().message();
    EXPECT_EQ(longest->size(), 6U);
}

// "0.2" may be the beginning of "0.25".
TEST(CsvErrors, NumbersThatTheEndOfTheFileMayHaveCut) {
    const Expected cut{2, "the last row has no line end, so the file may be cut short", "a line end",
                       "the end of the file", "end the last line"};
    for (const char* text :
         {"1,2,3\n4,5,0.2", "1 2 3\n4 5 6", "x,y,z\n4,5,6.", "1;2;3\n4;5; 6", "z,y,x\n1,2,3", "name,x,y,z\na,1,2,3"}) {
        SCOPED_TRACE(text);
        expect_csv_refused(text, 3, cut);
    }
    Expected first = cut;
    first.line = 1;
    expect_csv_refused("1,2,3", 3, first);
    expect_csv_refused("1,2", 2, first);
    // Other errors come first: there is more to mend than the end.
    expect_csv_refused("1,2,3\n4,5", 3, {2, "too few fields in a line", nullptr, "2", nullptr});
    expect_csv_refused("1,2,3\n4,5,1e", 3, {2, "bad coordinate z", nullptr, "\"1e\"", nullptr});
}

TEST(CsvErrors, AnErrorStays) {
    const TemporaryFolder folder;
    put(folder / "p.csv", "1,2\n3,4\nx,5\n6,7\n");
    const auto source = open_points(folder / "p.csv", 2);
    ASSERT_TRUE(source);
    std::vector<double> out;
    for (int i = 0; i < 3; ++i) {
        const Result<std::size_t> read = (*source)->read(10, out);
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().line, 3U);
    }
    EXPECT_EQ(out, (std::vector<double>{1, 2, 3, 4}));
}

TEST(CsvErrors, FilesThatCannotBeOpened) {
    const TemporaryFolder folder;
    expect_error(read_file(folder / "none.csv", 3), "/none.csv",
                 {0, "cannot read the file", nullptr, "No such file or directory", "check the path"});
    std::filesystem::create_directory(folder / "d.csv");
    expect_error(read_file(folder / "d.csv", 3), "/d.csv",
                 {0, "cannot read the file", nullptr, "Is a directory", "name a file"});
}

}  // namespace
}  // namespace barycert::io::testing
