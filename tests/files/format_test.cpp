// The table of formats: what is known by suffixes, and what is said of them.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "files/format.hpp"

namespace barycert::base {
namespace {

TEST(Formats, AreKnownByTheEndOfAName) {
    EXPECT_EQ(kind_of("a/b.VTU"), FormatKind::vtu);
    EXPECT_EQ(kind_of("part.1.node.gz"), FormatKind::node);
    EXPECT_EQ(kind_of("run.vtu.series"), FormatKind::series);
    EXPECT_EQ(kind_of("points.xyz"), FormatKind::csv);
    EXPECT_EQ(kind_of("a.inp"), FormatKind::none);
    EXPECT_EQ(format_of("part.1"), nullptr);
    EXPECT_EQ(format_of("part"), nullptr);
    EXPECT_EQ(format_of("folder.vtu/part"), nullptr);
    EXPECT_EQ(format_of(""), nullptr);
    EXPECT_STREQ(format_of("a.inp")->meshio, "abaqus");
    EXPECT_EQ(format_with("vtu"), nullptr);
    EXPECT_EQ(format_with(".vt"), nullptr);
    EXPECT_EQ(format_with(""), nullptr);
}

TEST(Formats, OfASuffixTheFirstOneCounts) {
    EXPECT_EQ(kind_of("a.dat"), FormatKind::csv) << "Tecplot's, too";
    EXPECT_STREQ(format_of_mesh("a.dat")->meshio, "tecplot");
    EXPECT_EQ(format_of_mesh("a.txt")->kind, FormatKind::csv);
    EXPECT_EQ(format_of_mesh("a.vtu")->kind, FormatKind::vtu);
    EXPECT_EQ(format_of_mesh("part.1"), nullptr);
    std::map<std::string, int> times;
    for (const Format& format : formats()) {
        ASSERT_TRUE(format.suffixes.starts_with(' ') && format.suffixes.ends_with(' ')) << format.suffixes;
        std::istringstream words{std::string(format.suffixes)};
        for (std::string word; words >> word;) {
            EXPECT_TRUE(word.size() > 1 && word.front() == '.') << word;
            EXPECT_NE(format_with(word), nullptr) << word;
            ++times[word];
        }
    }
    std::erase_if(times, [](const auto& one) { return one.second == 1; });
    EXPECT_EQ(times, (std::map<std::string, int>{{".dat", 2}}));
}

TEST(Formats, AreToldByTheirFirstBytes) {
    EXPECT_EQ(format_that_begins("\x93NUMPY\x01")->kind, FormatKind::npy);
    EXPECT_EQ(format_that_begins("BZh91AY")->what, "a file packed by bzip2");
    EXPECT_EQ(format_that_begins("x,y,z\n"), nullptr);
    EXPECT_EQ(format_that_begins(""), nullptr);
}

TEST(Formats, WhatIsNoMeshSaysSo) {
    for (const Format& format : formats()) {
        const bool is_mesh = format.read.has(Use::mesh) || format.meshio != nullptr;
        const bool is_output = format.read.has(Use::mesh) || (!format.family.empty() && format.what.empty());
        EXPECT_TRUE(is_mesh || is_output || !format.remedy.empty()) << format.suffixes;
        EXPECT_EQ(!format.is_mesh, format.what.find(", not a mesh") != std::string_view::npos) << format.suffixes;
    }
}

TEST(Formats, ListsForPeople) {
    EXPECT_EQ(suffixes_written(Use::rows), ".csv, .npy or .vtu");
    EXPECT_EQ(suffixes_written(Use::weights), ".npz");
    EXPECT_EQ(suffix_list_written(Use::picture), ".png .svg .pdf");
    EXPECT_EQ(suffix_list_read(Use::plc), ".poly .smesh .off .stl .ply .obj");
    EXPECT_EQ(suffix_list_read(Use::steps), ".pvd .series");
    EXPECT_EQ(families_read(Use::mesh),
              "TetGen and Triangle (.node .ele), Gmsh (.msh), Medit (.mesh .meshb), VTK (.vtu .vtk .vtp .vti .vtr .vts "
              ".pvtu .pvtp .vtm .vtpd .vtpc .pvd .series)");
}

TEST(Formats, AreThoseOfThePage) {
    std::stringstream page;
    page << std::ifstream(std::string(BARYCERT_DATA_DIR) + "/../doc/formats.md").rdbuf();
    EXPECT_NE(page.str().find("\n" + formats_table()), std::string::npos) << "doc/formats.md should have\n"
                                                                          << formats_table();
}

}  // namespace
}  // namespace barycert::base
