#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/io/points_files.hpp"

namespace barycert::io::testing {
namespace {

TEST(NodeSource, Accepted) {
    const std::vector<double> points{1, 2, 3, 4, 5, 6.5};
    for (const char* text :
         {"2 3 0 0\n0 1 2 3\n1 4 5 6.5\n", "2 3 0 0\n1 1 2 3\n2 4 5 6.5\n", "2\n1, 1, 2, 3\n2, 4, 5, 6.5\n",
          "# c\r\n2 3 2 1\r\n\r\n0 1 2 3 7 8 9\r\n# c\r\n1 4 5 6.5 7 8 -9 # c\r\n#"}) {
        SCOPED_TRACE(text);
        for (const std::size_t block : {std::size_t{1}, std::size_t{2}, std::size_t{5}}) {
            const Result<std::vector<double>> read = read_bytes("p.node", text, 3, block);
            ASSERT_TRUE(read) << read.error().message();
            EXPECT_EQ(*read, points);
        }
    }
    EXPECT_EQ(read_bytes("p.node", "1 2 0 0\n1 0.5 -0\n", 2).value(), (std::vector<double>{0.5, -0.0}));
    EXPECT_TRUE(read_bytes("p.node", "0 3 0 0\n", 3).value().empty());
}

TEST(NodeSource, TellsTheCount) {
    const TemporaryFolder folder;
    put(folder / "p.node", "2 3\n1 0 0 0\n2 1 1 1\n");
    EXPECT_EQ(open_points(folder / "p.node", 3).value()->count(), 2U);
}

TEST(NodeSource, Refused) {
    const auto refused = [](const std::string& text, int dimension, const Expected& expected) {
        SCOPED_TRACE(text);
        expect_error(read_bytes("p.node", text, dimension, 1), "/p.node", expected);
        expect_error(read_bytes("p.node", text, dimension, 100), "/p.node", expected);
    };
    refused("", 3, {1, "the file is empty", nullptr, nullptr, nullptr});
    refused("1 4 0 0\n1 0 0 0 0\n", 2,
            {1, "bad dimension in the header", "2, for the mesh is 2-dimensional", "4", "dimension of the mesh"});
    refused("2 3 0 0\n1 0 0 0\n2 0 0 0.5\n", 2,
            {0, "a point off the plane z = 0: node 1, counted from 0", "z = 0, for the mesh is 2D", "0.5",
             "options.columns x,y"});
    refused("1 2 0 0\n1 0 0\n", 3,
            {1, "bad dimension in the header", "3, for the mesh is 3-dimensional", "2", nullptr});
    refused("1 3 0 2\n1 0 0 0 1 1\n", 3, {1, "bad number of markers in the header", "0 or 1", "2", nullptr});
    refused("2 3 0 0\n1 0 0 0\n2 0 nan 0\n", 3, {3, "bad coordinate", "a finite number", "\"nan\"", nullptr});
    refused("2 3 0 0\n1 0 0 0\n2 0 0x1 0\n", 3, {3, "bad coordinate", "a number", "\"0x1\"", nullptr});
    refused("2 3 0 0\n1 0 0 0\n3 0 0 0\n", 3, {3, "a row out of sequence", "row 2", "\"3\"", nullptr});
    refused("2 3 0 0\n2 0 0 0\n3 0 0 0\n", 3, {2, "a bad first row number", "0 or 1", "\"2\"", nullptr});
    refused("2 3 0 0\n1 0 0 0\n", 3, {3, "the file ends too early", "2 rows as the header tells", "1", nullptr});
    refused("1 3 0 0\n1 0 0 0\n2 0 0 0\n", 3, {3, "more rows than the header tells", "1 row", "a row \"2\"", nullptr});
    refused("0 3 0 0\n0 0 0 0\n", 3, {2, "more rows than the header tells", "0 rows", "a row \"0\"", nullptr});
    refused("1 3 0 0\n1 0 0\n", 3, {2, "too few columns in a row", nullptr, "3", nullptr});
    refused("1 3 0 0\n1 0 0 0 0\n", 3, {2, "too many columns in a row", nullptr, nullptr, "mend the header"});
    refused("1 3 0 0\n1 0 0 0", 3,
            {2, "the last row has no line end, so the file may be cut short", nullptr, nullptr, nullptr});
    refused("2000000000 3 0 0\n1 0 0 0\n", 3, {3, "the file ends too early", nullptr, "1", nullptr});
}

TEST(NodeSource, ThePointsOfRealMeshes) {
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(BARYCERT_DATA_DIR)) {
        if (entry.path().extension() != ".node") continue;
        const std::string path = entry.path().string();
        SCOPED_TRACE(path);
        const Result<Mesh> mesh = read_tetgen(path);
        if (!mesh) continue;  // a file of nodes without cells
        const Result<std::vector<double>> points = read_file(path, mesh->dimension, 1000);
        ASSERT_TRUE(points) << points.error().message();
        EXPECT_EQ(bits_of(*points), bits_of(mesh->points));
        ++files;
    }
    EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace barycert::io::testing
