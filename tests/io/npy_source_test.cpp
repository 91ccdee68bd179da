#include <sys/stat.h>

#include <limits>

#include "tests/io/points_files.hpp"

namespace barycert::io::testing {
namespace {

template <class T>
std::string as_bytes(const std::vector<T>& numbers, bool big_endian = false) {
    std::string bytes;
    for (const T number : numbers) {
        std::string one(reinterpret_cast<const char*>(&number), sizeof number);  // little-endian, as this machine is
        bytes += big_endian ? std::string(one.rbegin(), one.rend()) : one;
    }
    return bytes;
}

const std::vector<double> points{1, 2.5, -3, -0.0, 5e-324, std::numeric_limits<double>::max(), 0.1, 1e-310, 7};
const std::vector<double> by_columns{1, -0.0, 0.1, 2.5, 5e-324, 1e-310, -3, std::numeric_limits<double>::max(), 7};

void expect_points(const std::string& bytes, const std::vector<double>& expected) {
    for (const std::size_t block : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{50}}) {
        const Result<std::vector<double>> read = read_bytes("p.npy", bytes, 3, block);
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(bits_of(*read), bits_of(expected));
    }
}

TEST(NpySource, TypesOrdersAndVersions) {
    for (const int version : {1, 2, 3}) {
        expect_points(npy_bytes(npy_dictionary("<f8", "(3, 3)"), as_bytes(points), version), points);
        expect_points(npy_bytes(npy_dictionary(">f8", "(3, 3)"), as_bytes(points, true), version), points);
    }
    expect_points(npy_bytes(npy_dictionary("<f8", "(3, 3)", true), as_bytes(by_columns)), points);
    expect_points(npy_bytes(npy_dictionary(">f8", "(3, 3)", true), as_bytes(by_columns, true)), points);
    const std::vector<float> floats{1, 2.5F, -3, -0.0F, 1e-45F, 3.4028235e38F};
    const std::vector<double> widened(floats.begin(), floats.end());
    expect_points(npy_bytes(npy_dictionary("<f4", "(2, 3)"), as_bytes(floats)), widened);
    expect_points(npy_bytes(npy_dictionary(">f4", "(2, 3)"), as_bytes(floats, true)), widened);
    expect_points(npy_bytes(npy_dictionary("<f8", "(0, 3)"), ""), {});
}

TEST(NpySource, FormsOfTheHeader) {
    const std::string data = as_bytes(points);
    for (const char* text : {"{'shape': (3, 3), 'fortran_order': False, 'descr': '<f8'}",
                             "{\"descr\":\"<f8\",\"fortran_order\":False,\"shape\":(3,3)}",
                             "{ 'descr' : '<f8' ,'fortran_order':False,'shape': (3L, 3L,) , }"}) {
        SCOPED_TRACE(text);
        expect_points(npy_bytes(text, data), points);
    }
}

TEST(NpySource, BlocksLargerThanTheBuffer) {
    std::vector<double> many(300000);
    for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<double>(i) * 0.1;
    const std::string bytes = npy_bytes(npy_dictionary("<f8", "(100000, 3)"), as_bytes(many));
    EXPECT_EQ(bits_of(read_bytes("p.npy", bytes, 3, 70001).value()), bits_of(many));
    std::vector<double> columns(many.size());
    for (std::size_t i = 0; i < many.size(); ++i) columns[i % 3 * 100000 + i / 3] = many[i];
    const std::string fortran = npy_bytes(npy_dictionary("<f8", "(100000, 3)", true), as_bytes(columns));
    EXPECT_EQ(bits_of(read_bytes("p.npy", fortran, 3, 70001).value()), bits_of(many));
}

TEST(NpySource, TellsTheCount) {
    const TemporaryFolder folder;
    put(folder / "p.npy", npy_bytes(npy_dictionary("<f8", "(3, 3)"), as_bytes(points)));
    EXPECT_EQ(open_points(folder / "p.npy", 3).value()->count(), 3U);
}

void expect_npy_refused(const std::string& bytes, int dimension, const Expected& expected) {
    expect_error(read_bytes("p.npy", bytes, dimension), "/p.npy", expected);
}

TEST(NpySource, TypesThatAreRefused) {
    for (const char* type : {"|O", "=f8", "f8", "<f8x", "<i", "|O8"}) {
        SCOPED_TRACE(type);
        expect_npy_refused(npy_bytes(npy_dictionary(type, "(3, 3)"), as_bytes(points)), 3,
                           {0, "cannot read an array of that type", nullptr, ('"' + std::string(type) + '"').c_str(),
                            "a.astype('f8')"});
    }
    for (const char* type : {"<c8", "<M8[ns]", "|S8", "<U2", "|V8"}) {
        SCOPED_TRACE(type);
        expect_npy_refused(
            npy_bytes(npy_dictionary(type, "(3, 3)"), as_bytes(points)), 3,
            {0, "cannot read points of that type", "integers or floating-point numbers of at most 64 bits",
             ('"' + std::string(type) + '"').c_str(), "a.astype('f8')"});
    }
}

TEST(NpySource, ShapesThatAreRefused) {
    const auto shaped = [](const char* shape) { return npy_bytes(npy_dictionary("<f8", shape), as_bytes(points)); };
    const char* const what = "an array of another shape";
    expect_npy_refused(shaped("(9,)"), 3,
                       {0, what, "(n, 3), for the mesh is 3-dimensional", "(9,)", "a.reshape(-1, 3)"});
    expect_npy_refused(shaped("()"), 3, {0, what, nullptr, "()", nullptr});
    expect_npy_refused(shaped("(3, 3)"), 2,
                       {0, what, "(n, 2), for the mesh is 2-dimensional", "(3, 3)", "options.columns 1,2"});
    expect_npy_refused(shaped("(3, 2)"), 3, {0, what, nullptr, "(3, 2)", "a.T"});
    expect_npy_refused(shaped("(4, 2)"), 3, {0, what, nullptr, "(4, 2)", "a row of 3 coordinates"});
    expect_npy_refused(shaped("(3, 3, 1)"), 3, {0, what, nullptr, "(3, 3, 1)", nullptr});
    expect_npy_refused(
        shaped("(4, 3)"), 3,
        {0, "the file ends too early", "4 rows of 24 bytes, as its header tells", "72 bytes", "cut short"});
    expect_npy_refused(shaped("(2, 3)"), 3,
                       {0, "bytes after the array", "48, as the header tells", "72", "one array a file"});
    expect_npy_refused(shaped("(18446744073709551615, 3)"), 3,
                       {0, "the file ends too early", nullptr, "72 bytes", nullptr});
    expect_npy_refused(shaped("(768614336404564653, 3)"), 3,
                       {0, "the file ends too early", nullptr, "72 bytes", nullptr});  // 24 n wraps round
}

TEST(NpySource, HeadersThatAreRefused) {
    const char* const what = "cannot read the header of the NPY file";
    expect_npy_refused("", 3, {0, what, nullptr, "nothing", "numpy.save"});
    expect_npy_refused("1,2,3\n4,5,6\n", 3, {0, what, "a file that begins with \\x93NUMPY", "\"1,2,3\\n\"", nullptr});
    expect_npy_refused(std::string("PK\x03\x04 and more"), 3,
                       {0, what, "one array", nullptr, "the one array of points"});
    std::string bytes = npy_bytes(npy_dictionary("<f8", "(3, 3)"), as_bytes(points));
    bytes[6] = 4;
    expect_npy_refused(bytes, 3, {0, what, "version 1, 2 or 3", "version 4.0", nullptr});
    bytes[6] = 0;
    expect_npy_refused(bytes, 3, {0, what, "version 1, 2 or 3", "version 0.0", nullptr});
    bytes[6] = 2;  // so the first letters of the text become a length
    expect_npy_refused(bytes, 3, {0, what, "a header of at most 1048576 bytes", nullptr, nullptr});
    for (const char* text : {"{}", "[]", "{'descr': '<f8', 'fortran_order': False}",
                             "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3)",
                             "{'descr': '<f8', 'fortran_order': False, 'shape': (3, -3)}",
                             "{'descr': '<f8', 'fortran_order': 0, 'shape': (3, 3)}",
                             "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3)} x",
                             "{'descr': '<f8', 'descr': '<f8', 'fortran_order': False, 'shape': (3, 3)}",
                             "{'descr': '<f8', 'fortran_order': False, 'shape': (3 3)}",
                             "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 99999999999999999999)}",
                             "{'descr': '<f8', 'fortran_order': False, 'shape': (,)}",
                             "{'descr: <f8', 'fortran_order': False, 'shape': (3, 3)}",
                             "{'descr': [('x', '<f8'), 'fortran_order': False}"}) {
        SCOPED_TRACE(text);
        expect_npy_refused(npy_bytes(text, as_bytes(points)), 3,
                           {0, what, "a dictionary of descr, fortran_order and shape", nullptr, nullptr});
    }
}

TEST(NpySource, PointsThatAreNotFinite) {
    std::vector<double> bad = points;
    bad[5] = std::numeric_limits<double>::quiet_NaN();
    const Expected nan{0, "a point that is not finite", "finite coordinates", "nan at [1, 2]", "isfinite"};
    expect_npy_refused(npy_bytes(npy_dictionary("<f8", "(3, 3)"), as_bytes(bad)), 3, nan);
    bad[5] = 0;
    bad[7] = -std::numeric_limits<double>::infinity();
    expect_npy_refused(npy_bytes(npy_dictionary("<f8", "(3, 3)"), as_bytes(bad)), 3,
                       {0, "a point that is not finite", nullptr, "-inf at [2, 1]", nullptr});
}

TEST(NpySource, FilesThatCannotBeOpened) {
    const TemporaryFolder folder;
    expect_error(read_file(folder / "none.npy", 3), "/none.npy",
                 {0, "cannot read the file", nullptr, "No such file or directory", "check the path"});
    std::filesystem::create_directory(folder / "d.npy");
    expect_error(read_file(folder / "d.npy", 3), "/d.npy",
                 {0, "cannot read the file", "a regular file", "a folder", nullptr});
    ASSERT_EQ(::mkfifo((folder / "f.npy").c_str(), 0600), 0);
    expect_error(read_file(folder / "f.npy", 3), "/f.npy",
                 {0, "cannot read the file", "a regular file", "a pipe or device", nullptr});
}

TEST(NpySource, AFileThatShrinksIsTold) {
    const TemporaryFolder folder;
    put(folder / "p.npy", npy_bytes(npy_dictionary("<f8", "(3, 3)"), as_bytes(points)));
    const auto source = open_points(folder / "p.npy", 3);
    ASSERT_TRUE(source);
    std::filesystem::resize_file(folder / "p.npy", std::filesystem::file_size(folder / "p.npy") - 1);
    std::vector<double> out;
    EXPECT_EQ((*source)->read(2, out).value(), 2U);
    expect_error((*source)->read(2, out), "/p.npy",
                 {0, "the file ends too early", nullptr, "the end of the file", nullptr});
    expect_error((*source)->read(2, out), "/p.npy", {0, "the file ends too early", nullptr, nullptr, nullptr});
    EXPECT_EQ(out.size(), 6U);
}

}  // namespace
}  // namespace barycert::io::testing
