#include <limits>

#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/io/tetgen/random_mesh.hpp"

namespace barycert::testing {
namespace {

Mesh tetrahedron() {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1};
    mesh.cells = {0, 1, 2, 3};
    return mesh;
}

TEST(Writer, TheText) {
    Mesh mesh = tetrahedron();
    mesh.index_base = 1;
    mesh.point_fields = {{"t", 1, {1.5, 2, -0.0, 4}}, {"v", 2, {1, 2, 3, 4, 5, 6, 7, 8}}};
    mesh.point_markers = {-1, 0, 1, 2};
    mesh.cell_fields = {{"k", 1, {1e300}}};
    mesh.faces = {0, 1, 2};
    mesh.face_markers = {7};
    mesh.neighbours = {-1, -1, -1, -1};
    const TemporaryFolder folder;
    ASSERT_TRUE(write_tetgen(mesh, folder / "m", {.comment = "by hand"}));
    EXPECT_EQ(get(folder / "m.node"),
              "4 3 3 1\n1 0 0 0 1.5 1 2 -1\n2 1 0 0 2 3 4 0\n3 0 1 0 -0 5 6 1\n4 0 0 0.1 4 7 8 2\n# by hand\n");
    EXPECT_EQ(get(folder / "m.ele"), "1 4 1\n1 1 2 3 4 1e+300\n# by hand\n");
    EXPECT_EQ(get(folder / "m.face"), "1 1\n1 1 2 3 7\n# by hand\n");
    EXPECT_EQ(get(folder / "m.neigh"), "1 4\n1 -1 -1 -1 -1\n# by hand\n");
    EXPECT_EQ(folder.file_count(), 4U);
}

TEST(Writer, AnInconsistentMeshIsAnErrorAndLeavesNothing) {
    const TemporaryFolder folder;
    const auto refused = [&](auto change, const char* what) {
        Mesh mesh = tetrahedron();
        change(mesh);
        const Status status = write_tetgen(mesh, folder / "m");
        ASSERT_FALSE(status) << what;
        EXPECT_EQ(status.error().what, std::string("cannot write the mesh: ") + what);
    };
    refused([](Mesh& m) { m.dimension = 1; }, "its dimension is neither 2 nor 3");
    refused([](Mesh& m) { m.dimension = 0; }, "its dimension is neither 2 nor 3");
    refused([](Mesh& m) { m.index_base = 2; }, "its index base is neither 0 nor 1");
    refused([](Mesh& m) { m.points.pop_back(); }, "the number of coordinates is not a multiple of the dimension");
    refused([](Mesh& m) { m.points[1] = std::numeric_limits<double>::quiet_NaN(); }, "a coordinate is not finite");
    refused([](Mesh& m) { m.cells.pop_back(); },
            "the number of vertex indices is not a multiple of the vertices of a cell");
    refused([](Mesh& m) { m.cells[3] = 4; }, "a vertex of a cell is not a node");
    refused([](Mesh& m) { m.cells[3] = -1; }, "a vertex of a cell is not a node");
    refused([](Mesh& m) { m.mid_nodes = {0, 1, 2}; }, "the mid-edge nodes do not match the cells");
    refused([](Mesh& m) { m.mid_nodes = {0, 1, 2, 3, 0, 4}; }, "a mid-edge node of a cell is not a node");
    refused([](Mesh& m) { m.mid_nodes = {0, 1, 2, 3, 0, 1}; },
            "the order of the mid-edge nodes is not set, or is of another dimension");
    refused([](Mesh& m) { m.neighbours = {-1}; }, "the neighbours do not match the cells");
    refused([](Mesh& m) { m.neighbours = {-1, -1, -1, 1}; }, "a neighbour is not a cell");
    refused([](Mesh& m) { m.neighbours = {-1, -1, -1, -2}; }, "a neighbour is not a cell");
    refused([](Mesh& m) { m.faces = {0, 1}; }, "the number of face indices is not a multiple of 3");
    refused([](Mesh& m) { m.faces = {0, 1, 9}; }, "a vertex of a face is not a node");
    refused([](Mesh& m) { m.face_mid_nodes = {0}; }, "the mid-edge nodes do not match the faces");
    refused([](Mesh& m) { m.face_markers = {0}; }, "the markers do not match the faces");
    refused([](Mesh& m) { m.point_markers = {0}; }, "the markers do not match the nodes");
    refused([](Mesh& m) { m.point_fields = {{"f", 1, {1}}}; }, "a field does not have one value per node or cell");
    refused([](Mesh& m) { m.cell_fields = {{"f", 0, {}}}; }, "a field has no components");
    refused(
        [](Mesh& m) {
            m.cell_fields = {{"f", 1, {HUGE_VAL}}};
        },
        "a value of a field is not finite, which the format cannot hold");
    EXPECT_EQ(folder.file_count(), 0U);
}

TEST(Writer, AFileOfAnOlderMeshIsNotLeftBesideTheNewOne) {
    const TemporaryFolder folder;
    put(folder / "m.face", "old");
    const Status status = write_tetgen(tetrahedron(), folder / "m");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().file, folder / "m.face");
    EXPECT_EQ(folder.file_count(), 1U);
    EXPECT_EQ(get(folder / "m.face"), "old");
}

TEST(Writer, AFailureChangesNoFile) {
    const TemporaryFolder folder;
    put(folder / "m.node", "old");
    std::filesystem::create_directory(folder / "m.ele");  // cannot be written
    const Status status = write_tetgen(tetrahedron(), folder / "m");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().file, folder / "m.ele");
    EXPECT_EQ(get(folder / "m.node"), "old");
    EXPECT_EQ(folder.file_count(), 2U);
    EXPECT_FALSE(write_tetgen(tetrahedron(), folder / "none/m"));
}

}  // namespace
}  // namespace barycert::testing
