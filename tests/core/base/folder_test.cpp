// Names in a folder.

#include "core/base/nearest_name.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/scratch.hpp"

namespace barycert::base {
namespace {

TEST(NamesInFolder, AllSortedWhateverTheyAre) {
    const test::Scratch folder;
    for (const char* name : {"b", ".hidden", "a b", "B"}) folder.put(name, "");
    std::filesystem::create_directory(folder.path("inner"));
    std::error_code failed = std::make_error_code(std::errc::io_error);
    EXPECT_EQ(names_in_folder(folder.folder(), failed),
              (std::vector<std::string>{".hidden", "B", "a b", "b", "inner"}));
    EXPECT_FALSE(failed);
}

TEST(NamesInFolder, TellsWhyThereAreNone) {
    const test::Scratch folder;
    std::error_code failed;
    EXPECT_TRUE(names_in_folder(folder.path("absent"), failed).empty());
    EXPECT_EQ(failed, std::errc::no_such_file_or_directory);
    EXPECT_TRUE(names_in_folder(folder.put("file", ""), failed).empty());
    EXPECT_EQ(failed, std::errc::not_a_directory);
}

}  // namespace
}  // namespace barycert::base
