#include "files/named_file.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace barycert {
namespace {

namespace fs = std::filesystem;

class NamedFiles : public ::testing::Test {
protected:
    NamedFiles() {
        std::string name = (fs::temp_directory_path() / "barycert-names-XXXXXX").string();
        folder_ = ::mkdtemp(name.data());
        std::ofstream(path("f")) << "text";
        fs::create_hard_link(path("f"), path("hard"));
        fs::create_symlink("f", path("soft"));
        fs::create_directory_symlink(folder_, path("way"));
    }
    ~NamedFiles() override { fs::remove_all(folder_); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

private:
    fs::path folder_;
};

TEST_F(NamedFiles, OneFileByAllItsNames) {
    const std::string f = path("f");
    for (const std::string other : {"f", "hard", "soft", "./f", "way/f", "way/way/hard"})
        EXPECT_TRUE(base::same_file(f, path(other))) << other;
    EXPECT_TRUE(base::same_file(path("new"), path("way/./new")));
    EXPECT_FALSE(base::same_file(f, path("new")));
    EXPECT_FALSE(base::same_file("", ""));
    EXPECT_FALSE(base::same_file(f, "-"));
    EXPECT_TRUE(base::same_file("-", "-"));
}

TEST_F(NamedFiles, OutputsAreNoInputsAndDistinct) {
    const std::vector<base::NamedFile> inputs{{"the mesh", path("f")}, {"--points", "-"}};
    EXPECT_TRUE(base::check_distinct(inputs, {{"--json", path("new")}, {"--output", "-"}}));
    const Status over = base::check_distinct(inputs, {{"--json", path("hard")}});
    ASSERT_FALSE(over);
    EXPECT_EQ(over.error().what, "--json would overwrite the mesh");
    EXPECT_EQ(over.error().file, path("hard"));
    const Status twice = base::check_distinct(inputs, {{"--json", path("new")}, {"--plot", path("way/new")}});
    ASSERT_FALSE(twice);
    EXPECT_EQ(twice.error().what, "--json and --plot name the same output");
    EXPECT_FALSE(base::check_distinct({}, {{"--json", "-"}, {"--plot", "-"}}));
    // An output that is no regular file is not overwritten.
    EXPECT_TRUE(base::check_distinct({{"--points", "/dev/null"}}, {{"--output", "/dev/null"}}));
}

}  // namespace
}  // namespace barycert
