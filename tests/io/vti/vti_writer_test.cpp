#include "io/vti/vti.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <limits>
#include <string>
#include <thread>

#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/io/vti/vti_files.hpp"

namespace barycert::testing {
namespace {

namespace fs = std::filesystem;

const std::vector<io::ArrayFormat> four{{"vtkValidPointMask", 1, io::NumberType::int8},
                                        {"cell", 1, io::NumberType::int32},
                                        {"u <v>", 3, io::NumberType::float64},
                                        {"T", 1, io::NumberType::float64}};

std::vector<Bytes> data_of(base::Random& random, const std::vector<io::ArrayFormat>& arrays, std::size_t points) {
    std::vector<Bytes> data;
    for (const io::ArrayFormat& array : arrays) {
        const std::size_t size = array.type == io::NumberType::int8 || array.type == io::NumberType::uint8      ? 1
                                 : array.type == io::NumberType::int32 || array.type == io::NumberType::float32 ? 4
                                                                                                                : 8;
        data.push_back(any_bytes(random, points * size * static_cast<std::size_t>(array.components)));
    }
    return data;
}

TEST(VtiWriter, TheFileHoldsWhatWasWrittenWhateverTheBlocks) {
    base::Random random(1);
    const io::VtiGrid grid{{7, 11, 5}, {0.1, -1e300, 5e-324}, {0.1, 2, 1e-10}};
    const std::vector<Bytes> data = data_of(random, four, 7 * 11 * 5);
    const TemporaryFolder folder;
    ASSERT_TRUE(write_in_blocks(folder / "a.vti", grid, four, data, 1, false));
    const std::string text = get(folder / "a.vti");
    std::string expected =
        "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
        "  <ImageData WholeExtent=\"0 6 0 10 0 4\" Origin=\"0.1 -1e+300 5e-324\" Spacing=\"0.1 2 1e-10\">\n"
        "    <Piece Extent=\"0 6 0 10 0 4\">\n      <PointData>\n"
        "        <DataArray type=\"Int8\" Name=\"vtkValidPointMask\" format=\"appended\" offset=\"0\"/>\n"
        "        <DataArray type=\"Int32\" Name=\"cell\" format=\"appended\" offset=\"393\"/>\n"
        "        <DataArray type=\"Float64\" Name=\"u &#60;v&#62;\" NumberOfComponents=\"3\" format=\"appended\" "
        "offset=\"1941\"/>\n"
        "        <DataArray type=\"Float64\" Name=\"T\" format=\"appended\" offset=\"11189\"/>\n"
        "      </PointData>\n      <CellData>\n      </CellData>\n    </Piece>\n  </ImageData>\n"
        "  <AppendedData encoding=\"raw\">\n    _";
    for (const Bytes& bytes : data) {
        const std::uint64_t size = bytes.size();
        expected.append(reinterpret_cast<const char*>(&size), 8);
        expected.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    expected += "\n  </AppendedData>\n</VTKFile>\n";
    EXPECT_TRUE(text == expected);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        ASSERT_TRUE(write_in_blocks(folder / "b.vti", grid, four, data, seed, true));
        EXPECT_TRUE(get(folder / "b.vti") == text) << seed;
    }
    EXPECT_EQ(folder.file_count(), 2U);
}

TEST(VtiWriter, NothingAppearsBeforeTheCommit) {
    const TemporaryFolder folder;
    put(folder / "a.vti", "old");
    {
        auto writer =
            io::VtiWriter::open(folder / "a.vti", {{2, 2, 1}, {}, {1, 1, 0}}, {{"T", 1, io::NumberType::float64}});
        ASSERT_TRUE(writer);
        const std::vector<double> values{1, 2, 3};
        ASSERT_TRUE((*writer)->write(0, std::as_bytes(std::span(values))));
        const Status early = (*writer)->commit();
        ASSERT_FALSE(early);
        EXPECT_EQ(early.error().what, "the bytes of array \"T\"");
        EXPECT_EQ(early.error().expected, "32");
        EXPECT_EQ(early.error().found, "24");
        EXPECT_EQ(get(folder / "a.vti"), "old");
    }
    EXPECT_EQ(folder.file_count(), 1U);
    EXPECT_EQ(get(folder / "a.vti"), "old");
}

TEST(VtiWriter, NoArrays) {
    const TemporaryFolder folder;
    auto writer = io::VtiWriter::open(folder / "a.vti", {}, {});
    ASSERT_TRUE(writer);
    ASSERT_TRUE((*writer)->commit());
    EXPECT_NE(get(folder / "a.vti").find("WholeExtent=\"0 0 0 0 0 0\""), std::string::npos);
}

TEST(VtiWriter, WhatIsRefused) {
    const TemporaryFolder folder;
    const auto refused = [&](const io::VtiGrid& grid, const std::vector<io::ArrayFormat>& arrays,
                             const std::string& what, const std::string& found) {
        const auto writer = io::VtiWriter::open(folder / "a.vti", grid, arrays);
        ASSERT_FALSE(writer) << what;
        EXPECT_EQ(writer.error().what, what);
        EXPECT_EQ(writer.error().found, found);
        EXPECT_EQ(writer.error().file, folder / "a.vti");
        EXPECT_EQ(folder.file_count(), 0U);
    };
    const io::VtiGrid good{{2, 2, 2}, {0, 0, 0}, {1, 1, 1}};
    refused(good, {{"", 1, io::NumberType::int8}}, "the name of an array", "none");
    refused(good, {{"a\x01", 1, io::NumberType::int8}}, "the name of an array", "\"a\x01\"");
    refused(good, {{"a", 0, io::NumberType::int8}}, "the components of array \"a\"", "0");
    refused(good, {{"a", 1, io::NumberType::int8}, {"b", 1, io::NumberType::int8}, {"a", 1, io::NumberType::int8}},
            "the names of arrays", "\"a\" twice");
    refused({{2147483647, 2147483647, 2}, {}, {1, 1, 1}}, {{"a", 1, io::NumberType::float64}}, "the size of the arrays",
            "more");
    refused({{2147483647, 2147483647, 1}, {}, {1, 1, 1}}, {{"a", 2147483647, io::NumberType::float64}},
            "the size of the arrays", "more");
    EXPECT_FALSE(io::VtiWriter::open(folder / "none/a.vti", good, {}));
    auto writer = io::VtiWriter::open(folder / "a.vti", good, {{"a", 1, io::NumberType::int8}});
    ASSERT_TRUE(writer);
    const Bytes bytes(9);
    const Status more = (*writer)->write(0, bytes);
    ASSERT_FALSE(more);
    EXPECT_EQ(more.error().expected, "8 in all");
    EXPECT_TRUE((*writer)->write(0, std::span(bytes).first(8)));
    EXPECT_FALSE((*writer)->write(0, std::span(bytes).first(1)));
    EXPECT_TRUE((*writer)->commit());
}

/// On a pipe arrays come one after the other.
TEST(VtiWriter, Pipes) {
    const TemporaryFolder folder;
    base::Random random(2);
    const io::VtiGrid grid{{20, 20, 1}, {0, 0, 0}, {1, 1, 0}};
    const std::vector<Bytes> data = data_of(random, four, 400);
    ASSERT_TRUE(write_in_blocks(folder / "a.vti", grid, four, data, 1, true));
    const std::string pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const bool take_turns : {false, true}) {
        std::string received;
        std::thread reader([&] { received = get(pipe); });
        const Status status = write_in_blocks(pipe, grid, four, data, 1, take_turns);
        reader.join();
        EXPECT_EQ(status.has_value(), !take_turns);
        if (!take_turns) {
            EXPECT_TRUE(received == get(folder / "a.vti"));
        } else {
            EXPECT_NE(status.error().remedy.find("pipe"), std::string::npos);
        }
    }
}

/// More than 2^32 bytes, of which the file system keeps those that are not zero.
TEST(VtiWriter, SizesBeyond32Bits) {
    const TemporaryFolder folder;
    const std::vector<io::ArrayFormat> arrays{{"a", 1, io::NumberType::int8}, {"b", 1, io::NumberType::float64}};
    auto writer = io::VtiWriter::open(folder / "a.vti", {{65536, 65537, 1}, {}, {1, 1, 1}}, arrays);
    ASSERT_TRUE(writer);
    const std::string head_of_b = "offset=\"4295032840\"";  // 65536 * 65537 + 8
    const Bytes block(1 << 20);
    ASSERT_TRUE((*writer)->write(1, block));  // its place lies beyond 4 GiB
    EXPECT_FALSE((*writer)->commit());
    std::string found;
    // It has no name yet, or one in the folder.
    for (const std::string& where : {std::string("/proc/self/fd"), folder / ""}) {
        for (const auto& entry : fs::directory_iterator(where)) {
            std::error_code ignored;
            if (!entry.is_regular_file(ignored) || entry.file_size(ignored) <= 4295032840U + block.size()) continue;
            std::ifstream in(entry.path(), std::ios::binary);
            found.resize(1000);
            in.read(found.data(), 1000);
            std::uint64_t size = 0;
            in.seekg(static_cast<std::streamoff>(found.find(">\n    _") + 7 + 4295032840U));
            in.read(reinterpret_cast<char*>(&size), 8);
            EXPECT_EQ(size, std::uint64_t{8} * 65536 * 65537);
        }
    }
    EXPECT_NE(found.find(head_of_b), std::string::npos);
}

}  // namespace
}  // namespace barycert::testing
