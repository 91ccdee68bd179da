// Files that are read: regular ones, pipes with and without writers, and what is neither.
#include "files/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

namespace barycert {
namespace {

namespace fs = std::filesystem;

class InputFileTest : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("barycert-input-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string path(const char* name) const { return (folder_ / name).string(); }
    std::string put(const char* name, const std::string& text) const {
        std::ofstream(path(name), std::ios::binary) << text;
        return path(name);
    }
    std::string pipe(const char* name) const {
        EXPECT_EQ(::mkfifo(path(name).c_str(), 0600), 0);
        return path(name);
    }

    fs::path folder_;
};

TEST_F(InputFileTest, WholeFiles) {
    for (const std::size_t size : {0U, 1U, 65535U, 65536U, 65537U, 3000000U}) {
        std::string text;
        for (std::size_t i = 0; i < size; ++i) text += static_cast<char>(i * 31 % 251);
        const Result<std::string> read = base::read_file(put("f", text));
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_TRUE(*read == text) << size;
        EXPECT_EQ(base::InputFile::open(path("f")).value().size(), size);
    }
    // It tells the size 0.
    const Result<std::string> status = base::read_file("/proc/self/status");
    ASSERT_TRUE(status) << status.error().message();
    EXPECT_NE(status->find("VmPeak"), std::string::npos);
}

TEST_F(InputFileTest, WhatIsNoFile) {
    for (const auto& [name, found] :
         {std::pair{path("none"), "No such file or directory"}, std::pair{folder_.string(), "a folder"},
          std::pair{put("f", "") + "/g", "Not a directory"}}) {
        for (const Error& error : {base::read_file(name).error(), base::InputFile::open(name).error()}) {
            EXPECT_EQ(error.what, "cannot read the file");
            EXPECT_EQ(error.file, name);
            EXPECT_EQ(error.found, found);
            EXPECT_FALSE(error.remedy.empty());
        }
    }
    EXPECT_EQ(base::read_file("/dev/zero").error().found, "a device");
    EXPECT_EQ(base::InputFile::open("/dev/zero").error().found, "a pipe or device");
    EXPECT_EQ(base::InputFile::open(pipe("p"), "do this").error().remedy, "do this");
}

TEST_F(InputFileTest, APointerOfGitLfsIsNotTheFile) {
    const std::string begin = "version https://git-lfs.github.com/spec/";
    const std::string name = put("a.vtu", begin + "v1\noid sha256:4d7a\nsize 12345\n");
    for (const Error& error : {base::read_file(name).error(), base::InputFile::open(name).error(),
                               base::InputFile::head(name, 10).error(), base::MappedFile::open(name).error()}) {
        EXPECT_TRUE(error.what.starts_with("this is a pointer of Git LFS")) << error.message();
        EXPECT_EQ(error.file, name);
        EXPECT_NE(error.remedy.find("`git lfs pull`"), std::string::npos);
    }
    EXPECT_TRUE(base::read_file(put("b.vtu", begin.substr(0, begin.size() - 1))));
}

TEST_F(InputFileTest, AFileThatCannotBeReadHasNotEnded) {
    const std::string memory = "/proc/self/mem";  // opens, and nothing can be read where it begins
    const Result<base::InputFile> file = base::InputFile::open(memory);
    if (!file) GTEST_SKIP() << file.error().message();
    std::array<char, 16> bytes{};
    for (const Error& error : {base::read_file(memory).error(), file->read_at(0, bytes, memory).error()}) {
        EXPECT_EQ(error.what, "cannot read the file");
        EXPECT_EQ(error.file, memory);
        EXPECT_EQ(error.found, "Input/output error");
    }
}

TEST_F(InputFileTest, APipeWithoutAWriterHasEnded) {
    const Result<std::string> read = base::read_file(pipe("p"));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().found, "nothing: a pipe that nobody writes to");
}

TEST_F(InputFileTest, APipeIsReadToItsEnd) {
    const std::string name = pipe("p"), text(300000, 'x');
    const int descriptor = ::open(name.c_str(), O_RDWR);  // opens at once, and has the pipe open for writing
    ASSERT_GE(descriptor, 0);
    std::thread writer([&] {
        for (std::size_t at = 0; at < text.size();) {
            ::usleep(10000);  // the reader is there first
            const ssize_t got = ::write(descriptor, text.data() + at, std::min<std::size_t>(50000, text.size() - at));
            if (got > 0) at += static_cast<std::size_t>(got);
        }
        ::close(descriptor);
    });
    const Result<std::string> read = base::read_file(name);
    writer.join();
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_TRUE(*read == text) << read->size();
}

TEST_F(InputFileTest, AnEndlessPipeIsGivenUp) {
    ASSERT_NE(::signal(SIGPIPE, SIG_IGN), SIG_ERR);
    const std::string name = pipe("p");
    const int reader = ::open(name.c_str(), O_RDONLY | O_NONBLOCK), writer = ::open(name.c_str(), O_WRONLY);
    const std::string text(1000, 'x');
    ASSERT_EQ(::write(writer, text.data(), text.size()), 1000);
    ::close(writer);
    EXPECT_EQ(base::read_file(name, 999).error().expected, "at most 999 bytes from a pipe");
    ::close(reader);
    // As many are not too many; a regular file may be of any size.
    const int again = ::open(name.c_str(), O_RDONLY | O_NONBLOCK), more = ::open(name.c_str(), O_WRONLY);
    ASSERT_EQ(::write(more, text.data(), text.size()), 1000);
    ::close(more);
    EXPECT_EQ(base::read_file(name, 1000).value().size(), 1000U);
    ::close(again);
    EXPECT_EQ(base::read_file(put("f", text), 999).value().size(), 1000U);
}

TEST_F(InputFileTest, TellsWhatWasChangedSinceItWasOpened) {
    put("f", "abc");
    base::InputFile moved = base::InputFile::open(path("f")).value();
    const base::InputFile file = std::move(moved);
    EXPECT_TRUE(file.unchanged(path("f")));
    fs::rename(path("f"), path("g"));  // one that is replaced is read as it was
    put("f", "other");
    EXPECT_TRUE(file.unchanged(path("f")));
    std::ofstream(path("g"), std::ios::app) << "d";
    const Status longer = file.unchanged(path("g"));
    ASSERT_FALSE(longer);
    EXPECT_EQ(longer.error().what, "the file was changed while it was read");
    EXPECT_EQ(longer.error().expected, "3 bytes, as when it was opened");
    EXPECT_EQ(longer.error().found, "4");
    fs::resize_file(path("g"), 3);  // of the same size, and written to
    fs::last_write_time(path("g"), fs::last_write_time(path("g")) + std::chrono::seconds(1));
    const Status written = file.unchanged(path("g"));
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().found, "");
}

TEST_F(InputFileTest, TheFirstBlockDecides) {
    const std::string blanks(base::first_block + 1, '\n'), words = "[" + std::string(base::first_block, ' ') + "]";
    for (const base::Text text : {base::Text::words, base::Text::head, base::Text::all, base::Text::json}) {
        EXPECT_EQ(base::read_file(put("f", blanks), base::longest_pipe, text).error().found,
                  "65536 bytes of blanks and line ends");
        const Result<std::string> read = base::read_file(put("f", words), base::longest_pipe, text);
        EXPECT_EQ(read.has_value(), text != base::Text::head) << static_cast<int>(text);
    }
    EXPECT_EQ(base::read_file(put("f", "a" + words), base::longest_pipe, base::Text::json).error().found, "no JSON");
    // The format is asked about larger files only, and before they are read.
    std::size_t asked = 0;
    const base::Header refuse = [&](std::string_view block, std::uint64_t size) -> Status {
        EXPECT_EQ(block.size(), base::first_block);
        asked = size;
        return Error{.code = "file.syntax", .what = "no header"};
    };
    EXPECT_EQ(base::read_file(path("f"), base::longest_pipe, base::Text::all, refuse).error().what, "no header");
    EXPECT_EQ(asked, words.size() + 1);
    EXPECT_FALSE(base::MappedFile::open(path("f"), 1, base::Text::all, refuse));
    put("f", words.substr(0, base::first_block));
    EXPECT_TRUE(base::read_file(path("f"), base::longest_pipe, base::Text::all, refuse));
    EXPECT_TRUE(base::MappedFile::open(path("f"), 1, base::Text::all, refuse));
}

// Neither moving nor failing loses a descriptor.
TEST_F(InputFileTest, DescriptorsAreClosed) {
    put("f", "abc");
    const auto open_now = [] { return std::distance(fs::directory_iterator("/proc/self/fd"), {}); };
    const auto before = open_now();
    for (int i = 0; i < 10; ++i) {
        base::InputFile file = base::InputFile::open(path("f")).value();
        base::InputFile other = std::move(file);
        file = std::move(other);
        EXPECT_TRUE(base::read_file(path("f")));
        EXPECT_FALSE(base::read_file(folder_.string()));
        EXPECT_FALSE(base::InputFile::open(folder_.string()));
    }
    EXPECT_EQ(open_now(), before);
}

}  // namespace
}  // namespace barycert
