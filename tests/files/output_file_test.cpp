#include "files/output_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace barycert {
namespace {

namespace fs = std::filesystem;

bool only_names = false;   ///< as on a file system that knows no nameless files
bool close_fails = false;  ///< as on one that tells at the end that there was no room

}  // namespace
}  // namespace barycert

/// In place of the C library's, in this program.
extern "C" int open(const char* path, int flags, ...) {
    if (barycert::only_names && (flags & O_TMPFILE) == O_TMPFILE) {
        errno = EOPNOTSUPP;
        return -1;
    }
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

extern "C" int close(int descriptor) {
    const auto result = static_cast<int>(::syscall(SYS_close, descriptor));
    if (!barycert::close_fails) return result;
    errno = EIO;
    return -1;
}

namespace barycert {
namespace {

class OutputFileTest : public ::testing::TestWithParam<bool> {
protected:
    void SetUp() override {
        only_names = GetParam();
        if (!only_names) {
            const int probe = ::open(fs::temp_directory_path().c_str(), O_TMPFILE | O_WRONLY, 0600);
            if (probe < 0) GTEST_SKIP() << "no nameless files here";
            ::close(probe);
        }
        folder_ = fs::temp_directory_path() / ("barycert-output-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override {
        only_names = false;
        if (!folder_.empty()) fs::remove_all(folder_);
    }
    /// The number of names of a file that is being written.
    std::size_t begun() const { return only_names ? 1 : 0; }

    std::string path(const char* name) const { return (folder_ / name).string(); }
    std::size_t file_count() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
    }
    static void put(const std::string& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }
    static std::string get(const std::string& file) {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    fs::path folder_;
};

TEST_P(OutputFileTest, AppearsOnCommitAndNotBefore) {
    put(path("f"), "old");
    base::OutputFile file(path("f"));
    file.write("new ");
    file.write("text");
    EXPECT_EQ(get(path("f")), "old");
    EXPECT_EQ(file_count(), 1U + begun());
    ASSERT_TRUE(file.close());
    EXPECT_EQ(get(path("f")), "old");
    ASSERT_TRUE(file.commit());
    EXPECT_EQ(get(path("f")), "new text");
    EXPECT_EQ(file_count(), 1U);
    EXPECT_TRUE(file.commit());
}

TEST_P(OutputFileTest, LeavesNothingWithoutACommit) {
    put(path("f"), "old");
    {
        base::OutputFile file(path("f"));
        file.write(std::string(1 << 20, 'x'));
        EXPECT_EQ(file_count(), 1U + begun());
    }
    EXPECT_EQ(get(path("f")), "old");
    EXPECT_EQ(file_count(), 1U);
}

TEST_P(OutputFileTest, LargeAndEmpty) {
    std::string text;
    for (int i = 0; i < 200000; ++i) text += std::to_string(i) + '\n';
    base::OutputFile large(path("large"));
    for (std::size_t at = 0; at < text.size(); at += 777) large.write(std::string_view(text).substr(at, 777));
    ASSERT_TRUE(large.commit());
    EXPECT_EQ(get(path("large")), text);
    base::OutputFile empty(path("empty"));
    ASSERT_TRUE(empty.commit());
    EXPECT_EQ(get(path("empty")), "");
}

TEST_P(OutputFileTest, ALinkIsFollowedAndPermissionsStay) {
    put(path("real"), "old");
    ASSERT_EQ(::chmod(path("real").c_str(), 0640), 0);
    fs::create_symlink(path("real"), path("link"));
    base::OutputFile file(path("link"));
    file.write("new");
    ASSERT_TRUE(file.commit());
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_EQ(get(path("real")), "new");
    struct stat status {};
    ASSERT_EQ(::stat(path("real").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST_P(OutputFileTest, ALinkToNothingMakesWhatItNames) {
    fs::create_symlink("between", path("link"));  // relative, by way of another one
    fs::create_symlink(path("new"), path("between"));
    base::OutputFile file(path("link"));
    file.write("new");
    ASSERT_TRUE(file.commit());
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_TRUE(fs::is_symlink(path("between")));
    EXPECT_EQ(get(path("new")), "new");
    fs::create_symlink("loop", path("loop"));
    base::OutputFile loop(path("loop"));
    const Status refused = loop.commit();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().file, path("loop"));
    EXPECT_TRUE(fs::is_symlink(path("loop")));
}

TEST_P(OutputFileTest, BytesAreReplaced) {
    put(path("f"), "old");
    base::OutputFile file(path("f"));
    ASSERT_TRUE(file.can_replace());
    file.write("count: ....\n");
    file.replace(7, "12  ");  // nothing of it has reached the disk yet
    const std::string rows(300000, 'x');
    file.write(rows);
    file.replace(9, "34");
    file.write("end");
    file.replace(0, "C");
    EXPECT_EQ(get(path("f")), "old");
    ASSERT_TRUE(file.commit());
    EXPECT_EQ(get(path("f")), "Count: 1234\n" + rows + "end");
    EXPECT_EQ(file_count(), 1U);
    EXPECT_FALSE(base::OutputFile("/dev/null").can_replace());
    EXPECT_FALSE(base::OutputFile::standard_output().can_replace());
    EXPECT_FALSE(base::OutputFile(path("none/f")).can_replace());
}

TEST_P(OutputFileTest, TheStandardOutputIsWrittenWhereItStandsAndStaysOpen) {
    put(path("f"), "before ");
    std::fflush(stdout);
    const int real = ::dup(STDOUT_FILENO);
    const int file = ::open(path("f").c_str(), O_WRONLY | O_APPEND);
    ::dup2(file, STDOUT_FILENO);
    base::OutputFile output = base::OutputFile::standard_output();
    output.write("text ");
    const Status committed = output.commit();
    const ssize_t after = ::write(STDOUT_FILENO, "after", 5);
    ::dup2(real, STDOUT_FILENO);
    ::close(file);
    ::close(real);
    EXPECT_TRUE(committed);
    EXPECT_EQ(after, 5);
    EXPECT_EQ(get(path("f")), "before text after");
    EXPECT_EQ(file_count(), 1U);
}

TEST_P(OutputFileTest, TheStandardOutputMayBeClosed) {
    std::fflush(stdout);
    const int real = ::dup(STDOUT_FILENO);
    ::close(STDOUT_FILENO);
    base::OutputFile output = base::OutputFile::standard_output();
    ::dup2(real, STDOUT_FILENO);
    ::close(real);
    output.write("text");
    const Status committed = output.commit();
    ASSERT_FALSE(committed);
    EXPECT_EQ(committed.error().file, "standard output");
    EXPECT_EQ(committed.error().found, "Bad file descriptor");
}

TEST_P(OutputFileTest, ADeviceIsWrittenAndStaysADevice) {
    base::OutputFile file("/dev/null");
    file.write("text");
    ASSERT_TRUE(file.commit());
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_P(OutputFileTest, Errors) {
    base::OutputFile no_folder(path("none/f"));
    no_folder.write("text");
    const Status missing = no_folder.commit();
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().file, path("none/f"));
    EXPECT_EQ(missing.error().what, "cannot make a file beside the target");
    EXPECT_EQ(missing.error().found, "No such file or directory");
    EXPECT_EQ(missing.error().remedy, "make the folder first, or name another one");

    fs::create_directory(path("d"));
    const Status folder = base::OutputFile(path("d")).commit();
    ASSERT_FALSE(folder);
    EXPECT_EQ(folder.error().found, "Is a directory");
    EXPECT_EQ(file_count(), 1U);

    base::OutputFile turned(path("t"));
    fs::create_directory(path("t"));  // in the meantime
    const Status rename = turned.commit();
    ASSERT_FALSE(rename);
    EXPECT_EQ(rename.error().what, "cannot put the finished file in its place");
}

TEST_P(OutputFileTest, AFileThatCannotBeClosedIsTold) {
    put(path("f"), "old");
    {
        base::OutputFile file(path("f"));
        file.write("new");
        close_fails = true;
        const Status status = file.commit();
        close_fails = false;
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().what, "cannot write the file");
        EXPECT_EQ(status.error().found, "Input/output error");
    }
    EXPECT_EQ(get(path("f")), "old");
    EXPECT_EQ(file_count(), 1U);
}

TEST_P(OutputFileTest, AFullDeviceIsTold) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    base::OutputFile file("/dev/full");
    EXPECT_TRUE(file.status());
    file.write(std::string(1 << 20, 'x'));
    EXPECT_FALSE(file.status());
    const Status status = file.commit();
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().what, "cannot write the file");
    EXPECT_EQ(status.error().found, "No space left on device");
    EXPECT_EQ(status.error().remedy, "free some space, or write to another disk");
}

TEST_P(OutputFileTest, AFileThatMayNotGrowLeavesTheTarget) {
    put(path("f"), "old");
    struct rlimit before {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const struct rlimit small { 100000, before.rlim_max };
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    {
        base::OutputFile file(path("f"));
        file.write(std::string(1 << 20, 'x'));
        const Status status = file.commit();
        EXPECT_FALSE(status);
    }
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(get(path("f")), "old");
    EXPECT_EQ(file_count(), 1U);
}

INSTANTIATE_TEST_SUITE_P(ways, OutputFileTest, ::testing::Values(false, true),
                         [](const auto& names) { return names.param ? "with_names" : "nameless"; });

}  // namespace
}  // namespace barycert
