#include "files/input_file.hpp"

#include <sys/stat.h>

#include "tests/temporary_folder.hpp"

namespace barycert::testing {
namespace {

using base::MappedFile;

TEST(MappedFile, HoldsTheBytesAndZerosAfterThem) {
    const TemporaryFolder folder;
    for (const std::size_t size : {0U, 1U, 4095U, 4096U, 4097U, 8192U}) {
        const std::string bytes(size, 'x');
        put(folder / "f", bytes);
        const Result<base::MappedFile> file = base::MappedFile::open(folder / "f");
        ASSERT_TRUE(file) << file.error().message();
        EXPECT_EQ(file->bytes(), bytes);
        const char* const end = file->bytes().data() + size;
        EXPECT_EQ(std::string(end, 4096), std::string(4096, '\0'));
    }
}

TEST(MappedFile, IsItsOwnWhenTheFileIsCut) {
    const TemporaryFolder folder;
    const std::string bytes(1 << 20, 'x');
    put(folder / "f", bytes);
    const Result<base::MappedFile> file = base::MappedFile::open(folder / "f", 2);
    ASSERT_TRUE(file) << file.error().message();
    std::filesystem::resize_file(folder / "f", 0);
    EXPECT_EQ(file->bytes(), bytes);
}

TEST(MappedFile, Moves) {
    const TemporaryFolder folder;
    put(folder / "f", "abc");
    Result<base::MappedFile> file = base::MappedFile::open(folder / "f");
    ASSERT_TRUE(file);
    base::MappedFile other = std::move(*file);
    EXPECT_EQ(other.bytes(), "abc");
    EXPECT_EQ(file->bytes(), "");
    *file = std::move(other);
    EXPECT_EQ(file->bytes(), "abc");
}

TEST(MappedFile, Errors) {
    const TemporaryFolder folder;
    const auto missing = base::MappedFile::open(folder / "none");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().found, "No such file or directory");
    EXPECT_EQ(missing.error().remedy, "check the path");
    EXPECT_EQ(missing.error().file, folder / "none");

    const auto directory = base::MappedFile::open(folder / "");
    ASSERT_FALSE(directory);
    EXPECT_EQ(directory.error().found, "a folder");

    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const auto pipe = base::MappedFile::open(folder / "pipe");
    ASSERT_FALSE(pipe);
    EXPECT_EQ(pipe.error().found, "a pipe or device");
}

}  // namespace
}  // namespace barycert::testing
