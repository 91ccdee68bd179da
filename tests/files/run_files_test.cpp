#include <filesystem>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "files/input_file.hpp"
#include "files/output_file.hpp"
#include "tests/scratch.hpp"

namespace barycert::base {
namespace {

class RunFilesTest : public ::testing::Test {
protected:
    Status write(const std::string& to) const {
        OutputFile file(to);
        file.write("new");
        return file.commit();
    }
    test::Scratch scratch;
    std::string path = scratch.put("a", "old");
};

TEST_F(RunFilesTest, AnOutputReplacesNoFileThatTheRunHasOpened) {
    std::filesystem::create_symlink(path, scratch.path("soft"));
    std::filesystem::create_hard_link(path, scratch.path("hard"));
    const RunFiles run;
    ASSERT_TRUE(write(path)) << "nothing was read";
    ASSERT_TRUE(read_file(path));
    for (const std::string name : {"a", "soft"}) {
        const Status refused = write(scratch.path(name));
        ASSERT_FALSE(refused) << name;
        EXPECT_EQ(refused.error().what, "the output would overwrite a file that is read");
        EXPECT_EQ(refused.error().file, scratch.path(name));
        EXPECT_EQ(refused.error().found, path);
    }
    EXPECT_TRUE(write(scratch.path("hard"))) << "the first write made another file of the input";
    EXPECT_EQ(read_file(path).value(), "new");
    EXPECT_TRUE(write(scratch.path("b")));
}

TEST_F(RunFilesTest, WhatIsOpenedAfterTheOutputCountsToo) {
    const RunFiles run;
    OutputFile file(path);
    file.write("new");
    ASSERT_TRUE(file.status());
    ASSERT_TRUE(InputFile::open(path));
    EXPECT_FALSE(file.commit());
    EXPECT_EQ(read_file(path).value(), "old");
    EXPECT_EQ(scratch.names(), (std::vector<std::string>{"a"}));
}

TEST_F(RunFilesTest, ARunHandsOnWhatItReadAndEnds) {
    {
        const RunFiles outer;
        {
            const RunFiles inner;
            ASSERT_TRUE(read_file(path));
            EXPECT_FALSE(write(path));
        }
        EXPECT_FALSE(write(path)) << "a report of the job";
        // Another job, in another thread, knows nothing of it.
        std::thread([&] { EXPECT_TRUE(write(path)); }).join();
    }
    ASSERT_TRUE(read_file(path));
    EXPECT_TRUE(write(path)) << "no run: two calls of a library";
}

}  // namespace
}  // namespace barycert::base
