// Output that fails: an Error, no half file, the old file as it was.
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "tests/io/row_data.hpp"

namespace barycert::io::testing {
namespace {

const TableFormat one_column{.dimension = 3, .fields = {{"p"}}};

/// No file may grow beyond `bytes` until the end of the scope.
class SmallFiles {
public:
    explicit SmallFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const struct rlimit small { bytes, before_.rlim_max };
        ::setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SmallFiles() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    SmallFiles(const SmallFiles&) = delete;
    SmallFiles& operator=(const SmallFiles&) = delete;

private:
    struct rlimit before_ {};
    void (*handler_)(int);
};

class Failures : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(, Failures, ::testing::Values("r.csv", "r.npy"));

TEST_P(Failures, NoMoreRoom) {
    const TemporaryFolder folder;
    put(folder / GetParam(), "old");
    const RowData data = random_rows(20000, one_column, 1);
    for (const rlim_t bytes : {rlim_t{0}, rlim_t{100}, rlim_t{300000}}) {
        bool told_early = false;
        {
            const SmallFiles small(bytes);
            const auto sink = open_table(folder / GetParam(), one_column);
            ASSERT_TRUE(sink);  // nothing has been handed to the system yet
            for (int i = 0; i < 10 && !told_early; ++i) {
                const Status written = (*sink)->write(data.rows());
                told_early = !written;
            }
            const Status status = (*sink)->commit();
            ASSERT_FALSE(status);
            EXPECT_EQ(status.error().file, folder / GetParam());
            EXPECT_EQ(status.error().what, "cannot write the file");
            EXPECT_EQ(status.error().found, "File too large");
            EXPECT_EQ(status.error().remedy, "free some space, or write to another disk");
        }
        EXPECT_TRUE(told_early);
        EXPECT_EQ(get(folder / GetParam()), "old");
        EXPECT_EQ(folder.file_count(), 1U);
    }
}

TEST_P(Failures, NoMoreRoomAtTheEnd) {
    const TemporaryFolder folder;
    put(folder / GetParam(), "old");
    {
        const SmallFiles small(10);
        EXPECT_FALSE(write_rows(folder / GetParam(), random_rows(3, one_column, 1), 3));  // one buffer, at the commit
    }
    EXPECT_EQ(get(folder / GetParam()), "old");
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST_P(Failures, NoFolder) {
    const TemporaryFolder folder;
    expect_error(
        open_table(folder / "none/" + GetParam(), one_column), GetParam(),
        {0, "cannot make a file beside the target", nullptr, "No such file or directory", "make the folder first"});
    std::filesystem::create_directory(folder / GetParam());
    expect_error(open_table(folder / GetParam(), one_column), GetParam(),
                 {0, "cannot write the file", nullptr, "Is a directory", "name a file"});
}

TEST_P(Failures, NoPermission) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    const TemporaryFolder folder;
    ASSERT_EQ(::chmod((folder / "").c_str(), 0500), 0);
    const auto sink = open_table(folder / GetParam(), one_column);
    ASSERT_EQ(::chmod((folder / "").c_str(), 0700), 0);
    expect_error(sink, GetParam(),
                 {0, "cannot make a file beside the target", nullptr, "Permission denied", "may write"});
}

TEST_P(Failures, NothingWithoutACommit) {
    const TemporaryFolder folder;
    put(folder / GetParam(), "old");
    {
        const auto sink = open_table(folder / GetParam(), one_column);
        ASSERT_TRUE(sink);
        ASSERT_TRUE((*sink)->write(random_rows(20000, one_column, 1).rows()));
        EXPECT_EQ(get(folder / GetParam()), "old");
    }
    EXPECT_EQ(get(folder / GetParam()), "old");
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST_P(Failures, RowsThatDoNotFit) {
    const RowData data = random_rows(4, {.dimension = 3, .fields = {{"p"}}, .distances = true}, 1);
    const std::vector<Feature> degenerate(4, Feature::degenerate);
    for (int i = 0; i < 8; ++i) {
        SCOPED_TRACE(i);
        TableView rows = data.rows();
        if (i == 1) rows.dimension = 2;
        if (i == 2) rows.points = rows.points.first(11);
        if (i == 3) rows.cells = rows.cells.first(3);
        if (i == 4) rows.features = rows.features.first(3);
        if (i == 5) rows.values = rows.values.first(3);
        if (i == 6) rows.distances = {};
        if (i == 7) rows.features = degenerate;
        const TemporaryFolder folder;
        const auto sink = open_table(folder / GetParam(), data.format);
        ASSERT_TRUE(sink);
        ASSERT_TRUE((*sink)->write(data.rows()));
        const Status status = (*sink)->write(rows);
        EXPECT_EQ(status.has_value(), i == 0);
        if (i != 0) {
            EXPECT_EQ(status.error().what,
                      i == 7 ? "a row in a degenerate cell" : "the parts of a block of rows have different sizes");
        }
        EXPECT_EQ((*sink)->write(data.rows()).has_value(), i == 0);
        EXPECT_EQ((*sink)->commit().has_value(), i == 0);  // never a file that lacks rows
        EXPECT_EQ(std::filesystem::exists(folder / GetParam()), i == 0);
    }
}

TEST(FailuresOfDevices, AFullDevice) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    const TemporaryFolder folder;
    std::filesystem::create_symlink("/dev/full", folder / "full.csv");
    const Status status = write_rows(folder / "full.csv", random_rows(20000, one_column, 1), 1000);
    expect_error(status, "full.csv",
                 {0, "cannot write the file", nullptr, "No space left on device", "free some space"});
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(FailuresOfDevices, AReaderThatHasGone) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ::close(ends[0]);
    const auto handler = std::signal(SIGPIPE, SIG_IGN);
    Status status = Done{};
    {
        const Redirected out(STDOUT_FILENO, ends[1]);
        status = write_rows("-", random_rows(20000, one_column, 1), 1000);
    }
    std::signal(SIGPIPE, handler);
    expect_error(status, "standard output", {0, "cannot write the file", nullptr, "Broken pipe", "stopped reading"});
}

}  // namespace
}  // namespace barycert::io::testing
