#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

#include <sys/resource.h>
#include <vtkAbstractArray.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>

#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/io/tetgen/random_mesh.hpp"
#include "tests/io/vtk/vtk_files.hpp"

namespace barycert::testing {
namespace {

namespace fs = std::filesystem;

constexpr double infinity = std::numeric_limits<double>::infinity();

Mesh tetrahedron() {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1};
    mesh.cells = {0, 1, 2, 3};
    return mesh;
}

vtkSmartPointer<vtkUnstructuredGrid> read_vtu_by_vtk(const std::string& path) {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    return reader->GetOutput();
}

void expect_fields(vtkFieldData* data, const std::vector<Field>& fields, std::size_t others) {
    ASSERT_EQ(static_cast<std::size_t>(data->GetNumberOfArrays()), fields.size() + others);
    for (const Field& field : fields) {
        SCOPED_TRACE(field.name);
        vtkDataArray* const array = data->GetArray(field.name.c_str());
        ASSERT_NE(array, nullptr);
        EXPECT_EQ(array->GetDataType(), VTK_DOUBLE);
        EXPECT_EQ(array->GetNumberOfComponents(), field.components);
        EXPECT_EQ(bits_of(array), bits_of(field.data));
    }
}

void expect_cells(vtkUnstructuredGrid* grid, const Mesh& mesh) {
    const std::size_t corners = mesh.corners();
    const std::size_t mids = mesh.mid_nodes.empty() ? 0 : mesh::edges_of(mesh.dimension).size();
    int type = mesh.dimension == 3 ? VTK_TETRA : VTK_TRIANGLE;
    if (mids != 0) type = mesh.dimension == 3 ? VTK_QUADRATIC_TETRA : VTK_QUADRATIC_TRIANGLE;
    ASSERT_EQ(static_cast<std::size_t>(grid->GetNumberOfCells()), mesh.cell_count());
    vtkNew<vtkIdList> nodes;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        ASSERT_EQ(grid->GetCellType(static_cast<vtkIdType>(cell)), type);
        grid->GetCellPoints(static_cast<vtkIdType>(cell), nodes);
        ASSERT_EQ(static_cast<std::size_t>(nodes->GetNumberOfIds()), corners + mids);
        for (std::size_t i = 0; i < corners + mids; ++i) {
            const Mesh::Index node =
                i < corners ? mesh.cells[cell * corners + i] : mesh.mid_nodes[cell * mids + i - corners];
            ASSERT_EQ(nodes->GetId(static_cast<vtkIdType>(i)), node) << "cell " << cell << ", node " << i;
        }
    }
}

/// Everything that VTK reads is what the mesh holds, doubles by their bits.
void expect_vtu_grid(vtkUnstructuredGrid* grid, const Mesh& mesh) {
    ASSERT_EQ(static_cast<std::size_t>(grid->GetNumberOfPoints()), mesh.point_count());
    if (mesh.point_count() != 0) {
        ASSERT_EQ(grid->GetPoints()->GetDataType(), VTK_DOUBLE);
        std::vector<double> points = mesh.points;
        if (mesh.dimension == 2) {
            points.clear();
            for (std::size_t i = 0; i < mesh.points.size(); i += 2) {
                points.insert(points.end(), {mesh.points[i], mesh.points[i + 1], 0});
            }
        }
        EXPECT_EQ(bits_of(grid->GetPoints()->GetData()), bits_of(points));
    }
    expect_cells(grid, mesh);
    expect_fields(grid->GetPointData(), mesh.point_fields, mesh.point_markers.empty() ? 0 : 1);
    expect_fields(grid->GetCellData(), mesh.cell_fields, 0);
    if (mesh.point_markers.empty()) return;
    vtkDataArray* const markers = grid->GetPointData()->GetArray("marker");
    ASSERT_NE(markers, nullptr);
    EXPECT_EQ(markers->GetNumberOfComponents(), 1);
    ASSERT_EQ(static_cast<std::size_t>(markers->GetNumberOfValues()), mesh.point_markers.size());
    ASSERT_EQ(markers->GetDataTypeSize(), 8);
    EXPECT_EQ(std::memcmp(markers->GetVoidPointer(0), mesh.point_markers.data(), mesh.point_markers.size() * 8), 0);
}

void expect_vtu_round_trip(const Mesh& mesh) {
    const TemporaryFolder folder;
    const Status status = write_vtu(mesh, folder / "m.vtu");
    ASSERT_TRUE(status) << status.error().message();
    EXPECT_EQ(folder.file_count(), 1U);
    expect_vtu_grid(read_vtu_by_vtk(folder / "m.vtu"), mesh);
}

TEST(Vtu, MeshesOfTheDataFolder) {
    for (const char* name : {"cube-hole", "cube-hole-o2", "plate", "bracket", "torus"}) {
        SCOPED_TRACE(name);
        Mesh mesh = mesh_of_data(name);
        ASSERT_GT(mesh.cell_count(), 0U);
        expect_vtu_round_trip(mesh);
        mesh.point_markers.clear();
        expect_vtu_round_trip(mesh);
    }
}

TEST(Vtu, RandomMeshes) {
    base::Random random(1);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(i);
        expect_vtu_round_trip(any_mesh(random));
    }
}

/// VTK's own cell says which nodes stand on an edge; the third one is to lie near its midpoint.
void expect_mid_nodes(const Mesh& mesh, double bend) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu"));
    const auto grid = read_vtu_by_vtk(folder / "m.vtu");
    ASSERT_GT(grid->GetNumberOfCells(), 0);
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
        vtkCell* const cell = grid->GetCell(i);
        ASSERT_EQ(cell->GetNumberOfEdges(), mesh.dimension == 3 ? 6 : 3);
        for (int e = 0; e < cell->GetNumberOfEdges(); ++e) {
            vtkCell* const edge = cell->GetEdge(e);
            ASSERT_EQ(edge->GetNumberOfPoints(), 3);
            double length = 0;
            double off = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const double a = grid->GetPoint(edge->GetPointId(0))[axis];
                const double b = grid->GetPoint(edge->GetPointId(1))[axis];
                const double middle = grid->GetPoint(edge->GetPointId(2))[axis];
                length = std::hypot(length, b - a);
                off = std::hypot(off, middle - (a / 2 + b / 2));
            }
            // Other edges of the cell have their midpoints half of an edge away.
            EXPECT_LE(off, bend * length) << "cell " << i << ", edge " << e;
        }
    }
}

TEST(Vtu, MidEdgeNodesStandOnTheEdgesVtkHasThemOn) {
    ASSERT_FALSE(mesh_of_data("cube-hole-o2").mid_nodes.empty());
    expect_mid_nodes(mesh_of_data("cube-hole-o2"), 1e-12);  // TetGen rounds a midpoint to the digits it prints
    for (const int dimension : {2, 3}) {
        for (const MidEdgeOrder order : orders_in(dimension)) {
            const Mesh mesh = second_order_mesh(dimension, order, 20, 5);
            expect_vtu_round_trip(mesh);
            expect_mid_nodes(mesh, 1e-15);  // a midpoint is rounded once, by an ulp of coordinates below 2
        }
    }
}

TEST(Vtu, ValuesThatAreNoNumbersKeepTheirBits) {
    Mesh mesh = tetrahedron();
    const double payload = std::bit_cast<double>(0x7ff8000000abcdefU);
    const double signalling = std::bit_cast<double>(0xfff0000000000001U);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    mesh.point_fields = {{"all NaN", 1, {nan, nan, nan, nan}},
                         {"some", 1, {payload, signalling, infinity, -infinity}},
                         {"nine", 9, std::vector<double>(36, nan)},
                         {"ends", 2, {5e-324, -0.0, 0.0, 1e308, -1e308, 0.1, nan, infinity}}};
    mesh.cell_fields = {{"NaN", 3, {nan, -infinity, 0}}};
    expect_vtu_round_trip(mesh);
}

TEST(Vtu, NamesOfFields) {
    Mesh mesh = tetrahedron();
    for (const char* name : {"von Mises stress [MPa]", " blank before", "blank after ", "<a&b>", "\"'", "&lt;", "]]>",
                             "tab\tand\nlines\r\n", "Größe ∇φ 🜁", "Points", "connectivity", "offsets", "types",
                             "vtkGhostType", "GlobalNodeIds", "%s%n", "\x7f", "marker"}) {
        mesh.point_fields.push_back({name, 1, {1, 2, 3, static_cast<double>(mesh.point_fields.size())}});
        mesh.cell_fields.push_back({name, 2, {0.5, static_cast<double>(mesh.point_fields.size())}});
    }
    mesh.point_fields.push_back({std::string(100000, 'x'), 1, {1, 2, 3, 4}});
    expect_vtu_round_trip(mesh);
}

TEST(Vtu, EmptyMeshes) {
    Mesh mesh;
    expect_vtu_round_trip(mesh);
    mesh.dimension = 2;
    expect_vtu_round_trip(mesh);
    mesh = tetrahedron();
    mesh.cells.clear();  // nodes alone
    mesh.point_fields = {{"f", 1, {1, 2, 3, 4}}};
    expect_vtu_round_trip(mesh);
}

TEST(Vtu, TheSameMeshGivesTheSameBytes) {
    const Mesh mesh = mesh_of_data("cube-hole-o2");
    const TemporaryFolder folder;
    ASSERT_TRUE(write_vtu(mesh, folder / "a"));
    ASSERT_TRUE(write_vtu(mesh, folder / "b"));
    EXPECT_EQ(get(folder / "a"), get(folder / "b"));
}

TEST(Vtu, TheFileIsAsLargeAsItsNumbers) {
    Mesh mesh = mesh_of_data("cube-hole");
    mesh.point_fields.clear();
    mesh.cell_fields.clear();
    const TemporaryFolder folder;
    ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu"));
    const std::string text = get(folder / "m.vtu");
    const std::string head = text.substr(0, text.find("<AppendedData encoding=\"raw\">"));
    ASSERT_LT(head.size(), 4096U);
    EXPECT_EQ(head.find("compressor"), std::string::npos);
    EXPECT_NE(head.find("header_type=\"UInt64\""), std::string::npos);  // else an array of 4 GiB is too long
    const std::size_t numbers = 24 * mesh.point_count() + 21 * mesh.cell_count() + 8 * mesh.point_markers.size();
    EXPECT_GT(text.size(), numbers + head.size());
    EXPECT_LT(text.size(), numbers + head.size() + 200);
}

void expect_refusal(const Mesh& mesh, const std::string& what) {
    const TemporaryFolder folder;
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    const Status status = write_vtu(mesh, folder / "m.vtu");
    EXPECT_EQ(::testing::internal::GetCapturedStdout() + ::testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(folder.file_count(), 0U);
    ASSERT_FALSE(status) << what;
    EXPECT_EQ(status.error().what, "cannot write the mesh: " + what);
    EXPECT_EQ(status.error().file, folder / "m.vtu");
}

TEST(Vtu, AnInconsistentMeshIsAnErrorAndLeavesNothing) {
    const auto refused = [&](auto change, const char* what) {
        Mesh mesh = tetrahedron();
        change(mesh);
        expect_refusal(mesh, what);
    };
    refused([](Mesh& m) { m.dimension = 0; }, "its dimension is neither 2 nor 3");
    refused([](Mesh& m) { m.points.pop_back(); }, "the number of coordinates is not a multiple of the dimension");
    refused([](Mesh& m) { m.points[1] = infinity; }, "a coordinate is not finite");
    refused([](Mesh& m) { m.cells[3] = 4; }, "a vertex of a cell is not a node");
    refused([](Mesh& m) { m.mid_nodes = {0, 1, 2}; }, "the mid-edge nodes do not match the cells");
    refused([](Mesh& m) { m.point_markers = {0}; }, "the markers do not match the nodes");
    refused([](Mesh& m) { m.point_fields = {{"f", 1, {1}}}; }, "a field does not have one value per node or cell");
    refused([](Mesh& m) { m.cell_fields = {{"f", 0, {}}}; }, "a field has no components");
}

TEST(Vtu, NamesThatTheFormatCannotHold) {
    const auto refused = [&](auto change, const std::string& what) {
        Mesh mesh = tetrahedron();
        change(mesh);
        expect_refusal(mesh, what);
    };
    const Field point{"f", 1, {1, 2, 3, 4}};
    const Field cell{"f", 1, {1}};
    refused([&](Mesh& m) { m.point_fields = {{"", 1, point.data}}; }, "a field has no name");
    refused([&](Mesh& m) { m.cell_fields = {{"", 1, cell.data}}; }, "a field has no name");
    refused(
        [&](Mesh& m) {
            m.cell_fields = {{"a\x01", 1, cell.data}};
        },
        "the name of field \"a\x01\" has bytes that XML cannot hold");
    refused([&](Mesh& m) { m.point_fields = {point, {"g", 1, point.data}, point}; }, "two fields are named \"f\"");
    refused([&](Mesh& m) { m.cell_fields = {cell, cell}; }, "two fields are named \"f\"");
    refused(
        [&](Mesh& m) {
            m.point_fields = {{"marker", 1, point.data}};
            m.point_markers = {1, 2, 3, 4};
        },
        "two fields are named \"marker\"");
    Mesh both = tetrahedron();  // of different kinds
    both.point_fields = {point};
    both.cell_fields = {cell, {"marker", 1, {1}}};
    both.point_markers = {1, 2, 3, 4};
    expect_vtu_round_trip(both);
}

TEST(Vtu, AFileThatCannotBeWritten) {
    const TemporaryFolder folder;
    const Status missing = write_vtu(tetrahedron(), folder / "none/m.vtu");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().file, folder / "none/m.vtu");
    EXPECT_EQ(missing.error().found, "No such file or directory");
    fs::create_directory(folder / "d");
    EXPECT_FALSE(write_vtu(tetrahedron(), folder / "d"));
    EXPECT_FALSE(write_vtu(tetrahedron(), ""));
    EXPECT_EQ(folder.file_count(), 1U);
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    const Status full = write_vtu(tetrahedron(), "/dev/full");
    ASSERT_FALSE(full);
    EXPECT_EQ(full.error().found, "No space left on device");
}

TEST(Vtu, AFileThatMayNotGrowLeavesTheOldOne) {
    const Mesh mesh = mesh_of_data("cube-hole");
    const TemporaryFolder folder;
    put(folder / "m.vtu", "old");
    struct rlimit before {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const struct rlimit small { 4096, before.rlim_max };
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Status status = write_vtu(mesh, folder / "m.vtu");
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().file, folder / "m.vtu");
    EXPECT_EQ(get(folder / "m.vtu"), "old");
    EXPECT_EQ(folder.file_count(), 1U);
}

}  // namespace
}  // namespace barycert::testing
