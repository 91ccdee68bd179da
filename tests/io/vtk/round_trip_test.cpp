#include <bit>
#include <limits>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/io/tetgen/random_mesh.hpp"
#include "tests/io/vtk/mesh_notes.hpp"

namespace barycert::testing {
namespace {

void expect_same_back(const Mesh& mesh) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu"));
    const Result<Mesh> read = read_quietly(folder / "m.vtu");
    ASSERT_TRUE(read) << read.error().message();
    expect_same(*read, as_in_vtk(mesh));
    EXPECT_TRUE(read->notes.empty());
    EXPECT_TRUE(read->cell_numbers.empty());
}

TEST(VtkRoundTrip, MeshesOfTheDataFolder) {
    for (const char* name : {"cube-hole", "cube-hole-o2", "plate", "bracket", "torus"}) {
        SCOPED_TRACE(name);
        const Mesh mesh = mesh_of_data(name);
        ASSERT_GT(mesh.cell_count(), 0U);
        expect_same_back(mesh);
    }
}

TEST(VtkRoundTrip, RandomMeshes) {
    base::Random random(2);
    int tried = 0;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(i);
        const Mesh mesh = any_mesh(random);
        if (mesh.cell_count() == 0) continue;
        ++tried;
        expect_same_back(mesh);
    }
    EXPECT_GT(tried, 100);
    for (const int dimension : {2, 3}) expect_same_back(second_order_mesh(dimension, MidEdgeOrder::vtk, 20, 5));
}

TEST(VtkRoundTrip, ValuesAndNamesOfFields) {
    Mesh mesh = mesh_of_data("plate");
    mesh.point_fields.clear();
    mesh.cell_fields.clear();
    const double nan = std::bit_cast<double>(0x7ff8000000abcdefU);
    std::vector<double> values(mesh.point_count() * 9, -0.0);
    values[0] = nan;
    values[1] = std::numeric_limits<double>::infinity();
    values[2] = 5e-324;
    for (const char* name : {"von Mises stress [MPa]", " blanks ", "<a&b>", "\"'>", "tab\tand\nlines\r\n", "Größe ∇φ 🜁",
                             "connectivity", "Points"}) {
        mesh.point_fields.push_back({name, 9, values});
        mesh.cell_fields.push_back({name, 1, std::vector<double>(mesh.cell_count(), nan)});
    }
    expect_same_back(mesh);
}

TEST(VtkRoundTrip, PiecesArePutTogether) {
    const TemporaryFolder folder;
    const std::string piece =
        "<Piece NumberOfPoints='3' NumberOfCells='1'><PointData><DataArray Name='f' type='Int8'>1 2 3</DataArray>"
        "<DataArray Name='@' type='Int8'>1 2 3</DataArray></PointData>"
        "<Points><DataArray type='Float32' NumberOfComponents='3'>0 0 0 1 0 0 0 1 0</DataArray></Points><Cells>"
        "<DataArray type='Int32' Name='connectivity'>0 1 2</DataArray><DataArray type='Int32' Name='offsets'>3"
        "</DataArray><DataArray type='UInt8' Name='types'>5</DataArray></Cells></Piece>";
    const auto with = [&](const char* name) { return std::string(piece).replace(piece.find('@'), 1, name); };
    const std::string empty = "<Piece NumberOfPoints='0' NumberOfCells='0'></Piece>";
    put(folder / "m.vtu", "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>" + empty + with("a") + with("b") +
                              empty + "</UnstructuredGrid></VTKFile>");
    const Result<Mesh> read = read_quietly(folder / "m.vtu");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->cells, (std::vector<Mesh::Index>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(read->point_count(), 6U);
    ASSERT_EQ(read->point_fields.size(), 1U);
    EXPECT_EQ(read->point_fields[0].data, (std::vector<double>{1, 2, 3, 1, 2, 3}));
    EXPECT_EQ(notes_of(*read), (std::vector<std::string>{"point array \"a\": it is missing in a piece of the file",
                                                         "point array \"b\": it is missing in a piece of the file"}));
}

TEST(VtkRoundTrip, IntegersThatAreNoDoubles) {
    const TemporaryFolder folder;
    const std::string text =
        "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='3' NumberOfCells='1'><PointData>"
        "<DataArray Name='id' type='Int64'>9007199254740992 9007199254740993 -9007199254740994</DataArray>"
        "<DataArray Name='big' type='UInt64'>18446744073709549568 9007199254740994 0</DataArray></PointData>"
        "<Points><DataArray type='Float32' NumberOfComponents='3'>0 0 0 1 0 0 0 1 0</DataArray></Points><Cells>"
        "<DataArray type='Int32' Name='connectivity'>0 1 2</DataArray><DataArray type='Int32' Name='offsets'>3"
        "</DataArray><DataArray type='UInt8' Name='types'>5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
    put(folder / "m.vtu", text);
    const Result<Mesh> read = read_quietly(folder / "m.vtu");
    ASSERT_TRUE(read) << read.error().message();
    ASSERT_EQ(read->point_fields.size(), 1U);
    EXPECT_EQ(read->point_fields[0].data, (std::vector<double>{0x1p64 - 2048, 0x1p53 + 2, 0}));
    EXPECT_EQ(notes_of(*read), (std::vector<std::string>{"point array \"id\": it holds 9007199254740993, which is not "
                                                         "exactly a double"}));
}

}  // namespace
}  // namespace barycert::testing
