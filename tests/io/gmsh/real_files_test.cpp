// Files from real programs, in a folder beside the checkout that may be absent.
#include <filesystem>

#include "tests/io/gmsh/msh_files.hpp"

namespace barycert::testing {
namespace {

const std::string shared = BARYCERT_SHARED_DATA_DIR "/gmsh/";

Mesh read(const std::string& name) {
    Result<Mesh> mesh = read_gmsh(shared + name);
    EXPECT_TRUE(mesh) << mesh.error().message();
    return mesh ? std::move(*mesh) : Mesh{};
}

TEST(GmshRealFiles, Armadillo) {
    if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no " << shared;
    const Mesh mesh = read("ipc_Armadillo13K.msh");
    EXPECT_EQ(mesh.point_count(), 13230U);
    EXPECT_EQ(mesh.cell_count(), 54985U);
    EXPECT_EQ(mesh.cells.front(), 8795);
    EXPECT_TRUE(mesh.cell_fields.empty());
    ASSERT_EQ(mesh.notes.size(), 1U);
    EXPECT_EQ(mesh.notes[0].text, "section $Surface");
}

TEST(GmshRealFiles, CubesInBothVersions) {
    if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no " << shared;
    const Mesh old = read("polyfem_cubes_v22.msh"), current = read("polyfem_cubes_v41.msh");
    for (const Mesh& mesh : {old, current}) {
        EXPECT_EQ(mesh.point_count(), 7714U);
        EXPECT_EQ(mesh.cell_count(), 32981U);
        ASSERT_EQ(mesh.cell_fields.size(), 2U);
        EXPECT_EQ(mesh.cell_fields[0].name, "gmsh:physical");
        EXPECT_EQ(mesh.cell_fields[1].name, "gmsh:geometrical");
        EXPECT_EQ(mesh.cell_fields[0].data, mesh.cell_fields[1].data);
        EXPECT_EQ(mesh.cell_fields[0].data.front(), 1);
        EXPECT_EQ(mesh.cell_fields[0].data.back(), 3);
    }
}

}  // namespace
}  // namespace barycert::testing
