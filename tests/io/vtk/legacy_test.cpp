#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkLookupTable.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>

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
#include "tests/io/vtk/mixed_grid.hpp"
#include "tests/io/vtk/vtk_files.hpp"

namespace barycert::testing {
namespace {

vtkSmartPointer<vtkUnstructuredGrid> read_legacy_by_vtk(const std::string& path) {
    vtkNew<vtkUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    return reader->GetOutput();
}

/// VTK reads what the mesh holds.
void expect_legacy_grid(vtkUnstructuredGrid* grid, const Mesh& mesh) {
    ASSERT_EQ(static_cast<std::size_t>(grid->GetNumberOfPoints()), mesh.point_count());
    ASSERT_EQ(static_cast<std::size_t>(grid->GetNumberOfCells()), mesh.cell_count());
    if (mesh.dimension == 3) {
        EXPECT_EQ(bits_of(grid->GetPoints()->GetData()), bits_of(mesh.points));
    }
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        vtkNew<vtkIdList> nodes;
        grid->GetCellPoints(static_cast<vtkIdType>(cell), nodes);
        for (std::size_t i = 0; i < mesh.corners(); ++i) {
            ASSERT_EQ(nodes->GetId(static_cast<vtkIdType>(i)), mesh.cells[cell * mesh.corners() + i]);
        }
    }
    for (const Field& field : mesh.point_fields) {
        vtkDataArray* const array = grid->GetPointData()->GetArray(field.name.c_str());
        ASSERT_NE(array, nullptr) << field.name;
        EXPECT_EQ(bits_of(array), bits_of(field.data)) << field.name;
    }
}

void expect_legacy_round_trip(const Mesh& mesh) {
    const TemporaryFolder folder;
    Printed printed;
    const Status written = write_vtk(mesh, folder / "m.vtk");
    EXPECT_EQ(printed.text(), "");
    ASSERT_TRUE(written) << written.error().message();
    EXPECT_EQ(folder.file_count(), 1U);
    const Result<Mesh> read = read_quietly(folder / "m.vtk");
    ASSERT_TRUE(read) << read.error().message();
    expect_same(*read, as_in_vtk(mesh));
    EXPECT_TRUE(read->notes.empty());
    expect_legacy_grid(read_legacy_by_vtk(folder / "m.vtk"), mesh);
}

TEST(Legacy, MeshesOfTheDataFolder) {
    for (const char* name : {"cube-hole", "cube-hole-o2", "plate", "bracket", "torus"}) {
        SCOPED_TRACE(name);
        expect_legacy_round_trip(mesh_of_data(name));
    }
}

TEST(Legacy, RandomMeshes) {
    base::Random random(3);
    int tried = 0;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(i);
        const Mesh mesh = any_mesh(random);
        if (mesh.cell_count() == 0) continue;
        ++tried;
        expect_legacy_round_trip(mesh);
    }
    EXPECT_GT(tried, 100);
    for (const int dimension : {2, 3}) expect_legacy_round_trip(second_order_mesh(dimension, MidEdgeOrder::vtk, 20, 5));
}

TEST(Legacy, ValuesAndNamesOfFields) {
    Mesh mesh = mesh_of_data("plate");
    mesh.point_fields.clear();
    mesh.cell_fields.clear();
    std::vector<double> values(mesh.point_count() * 9, -0.0);
    values[0] = std::bit_cast<double>(0x7ff8000000abcdefU);
    values[1] = std::numeric_limits<double>::infinity();
    values[2] = 5e-324;
    for (const std::string& name :
         std::vector<std::string>{"von Mises stress [MPa]", " blanks ", "<a&b>", "\"'>", "tab\tand\nlines\r\n", "100%",
                                  "%41", "Größe ∇φ", "POINTS", "field", "LOOKUP_TABLE", std::string(200, 'x')}) {
        mesh.point_fields.push_back({name, 9, values});
        mesh.cell_fields.push_back({name, 1, std::vector<double>(mesh.cell_count(), 0.1)});
    }
    expect_legacy_round_trip(mesh);
    for (const std::string& name : {std::string(201, 'x'), std::string(67, ' '), std::string("METADATA"),
                                    std::string("NULL_ARRAY"), std::string()}) {
        Mesh bad = mesh;
        bad.cell_fields[0].name = name;
        const TemporaryFolder folder;
        EXPECT_FALSE(write_vtk(bad, folder / "m.vtk")) << name;
        EXPECT_EQ(folder.file_count(), 0U);
    }
}

TEST(Legacy, EveryTypeThatVtkWritesInEveryVersion) {
    for (const int type : {VTK_ASCII, VTK_BINARY}) {
        for (const int version :
             {vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2, vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1}) {
            SCOPED_TRACE(std::to_string(type) + " " + std::to_string(version));
            const auto grid = mixed_grid();
            grid->GetPointData()->GetArray("double")->SetComponentName(0, "a name makes METADATA");
            grid->GetPoints()->GetData()->GetRange();  // and so does a known range
            const TemporaryFolder folder;
            vtkNew<vtkUnstructuredGridWriter> writer;
            writer->SetFileType(type);
            writer->SetFileVersion(version);
            writer->SetFileName((folder / "m.vtk").c_str());
            writer->SetInputData(grid);
            ASSERT_EQ(writer->Write(), 1);
            expect_mixed(folder / "m.vtk", type == VTK_ASCII ? 1e-5 : 0);  // 6 digits
        }
    }
}

TEST(Legacy, BitsThatVtkDoesNotWrite) {
    const auto grid = mixed_grid();
    grid->GetPointData()->Initialize();
    grid->GetPointData()->AddArray(array_of<vtkBitArray>("bits", 2, std::vector<double>(10, 1)));
    grid->GetPointData()->AddArray(array_of<vtkDoubleArray>("behind", 1, {1, 2, 3, 4, 5}));
    const TemporaryFolder folder;
    for (const int type : {VTK_ASCII, VTK_BINARY}) {
        vtkNew<vtkUnstructuredGridWriter> writer;
        writer->SetFileType(type);
        writer->SetFileName((folder / "m.vtk").c_str());
        writer->SetInputData(grid);
        ASSERT_EQ(writer->Write(), 1);
        const Result<Mesh> read = read_quietly(folder / "m.vtk");
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->point_fields.back().data, (std::vector<double>{1, 2, 3, 4, 5}));
        EXPECT_EQ(notes_of(*read).size(), type == VTK_BINARY ? 2U : 1U);  // the first is of cells
        EXPECT_EQ(read->point_fields.size(), type == VTK_BINARY ? 1U : 2U);
    }
}

/// Arrays that have a role of their own are written each in its way.
TEST(Legacy, Attributes) {
    for (const int type : {VTK_ASCII, VTK_BINARY}) {
        SCOPED_TRACE(type);
        const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
        grid->ShallowCopy(mixed_grid());
        vtkPointData* const data = grid->GetPointData();
        data->Initialize();
        const auto scalars = array_of<vtkFloatArray>("my scalars", 1, {1, 2, 3, 4, 5});
        vtkNew<vtkLookupTable> table;
        table->SetNumberOfTableValues(4);
        table->Build();
        scalars->SetLookupTable(table);
        data->SetScalars(scalars);
        data->SetVectors(array_of<vtkDoubleArray>("vectors", 3, std::vector<double>(15, 0.5)));
        data->SetNormals(array_of<vtkFloatArray>("normals", 3, std::vector<double>(15, 0.25)));
        data->SetTCoords(array_of<vtkFloatArray>("texture", 2, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
        data->SetTensors(array_of<vtkDoubleArray>("tensors", 9, std::vector<double>(45, 2)));
        data->SetGlobalIds(array_of<vtkIdTypeArray>("ids", 1, {7, 8, 9, 10, 11}));
        vtkCellData* const cells = grid->GetCellData();
        cells->Initialize();
        cells->SetScalars(array_of<vtkUnsignedCharArray>(
            "colour", 3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 254, 254, 255, 0}));
        cells->SetPedigreeIds(array_of<vtkIdTypeArray>("origin", 1, {0, 1, 2, 3, 4, 5}));
        const TemporaryFolder folder;
        vtkNew<vtkUnstructuredGridWriter> writer;
        writer->SetFileType(type);
        writer->SetFileName((folder / "m.vtk").c_str());
        writer->SetInputData(grid);
        ASSERT_EQ(writer->Write(), 1);
        const Result<Mesh> read = read_quietly(folder / "m.vtk");
        ASSERT_TRUE(read) << read.error().message();
        ASSERT_EQ(read->point_fields.size(), 6U);
        for (const Field& field : read->point_fields) {
            SCOPED_TRACE(field.name);
            vtkDataArray* const array = data->GetArray(field.name.c_str());
            ASSERT_NE(array, nullptr);
            ASSERT_EQ(field.components, array->GetNumberOfComponents());
            for (std::size_t i = 0; i < field.data.size(); ++i) {
                EXPECT_EQ(field.data[i], array->GetVariantValue(static_cast<vtkIdType>(i)).ToDouble());
            }
        }
        ASSERT_EQ(read->cell_fields.size(), 2U);
        EXPECT_EQ(read->cell_fields[0].name, "colour");
        EXPECT_EQ(read->cell_fields[0].data, (std::vector<double>{3, 4, 5, 12, 13, 254}));
        EXPECT_EQ(read->cell_fields[1].data, (std::vector<double>{1, 4}));
    }
}

TEST(Legacy, PolygonDataOfTriangles) {
    for (const int version :
         {vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2, vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1}) {
        vtkNew<vtkPolyData> data;
        vtkNew<vtkPoints> points;
        points->SetDataTypeToDouble();
        for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}})
            points->InsertNextPoint(x, y, 0);
        data->SetPoints(points);
        vtkNew<vtkCellArray> vertices, lines, polygons;
        vertices->InsertNextCell({3});
        lines->InsertNextCell({0, 1, 2});
        polygons->InsertNextCell({0, 1, 2});
        polygons->InsertNextCell({1, 3, 2});
        data->SetVerts(vertices);
        data->SetLines(lines);
        data->SetPolys(polygons);
        data->GetCellData()->AddArray(array_of<vtkDoubleArray>("f", 1, {10, 20, 30, 40}));
        const TemporaryFolder folder;
        vtkNew<vtkPolyDataWriter> writer;
        writer->SetFileVersion(version);
        writer->SetFileTypeToBinary();
        writer->SetFileName((folder / "m.vtk").c_str());
        writer->SetInputData(data);
        ASSERT_EQ(writer->Write(), 1);
        const Result<Mesh> read = read_quietly(folder / "m.vtk");
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->dimension, 2);
        EXPECT_EQ(read->points, (std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1}));
        EXPECT_EQ(read->cells, (std::vector<Mesh::Index>{0, 1, 2, 1, 3, 2}));
        EXPECT_EQ(read->cell_fields[0].data, (std::vector<double>{30, 40}));
        EXPECT_EQ(notes_of(*read)[0].substr(0, 7), "2 cells");
    }
}

TEST(Legacy, FilesOfOthers) {
    const TemporaryFolder folder;
    // An old version, small letters, line ends of Windows, a lookup table left out, numbers across lines.
    put(folder / "m.vtk",
        "# vtk DataFile Version 2.0\r\ntitle\r\nASCII\r\n\r\nDATASET unstructured_grid\r\nPOINTS 4 float\r\n0 0\r\n0 1 "
        "0 0 0 1 "
        "0 0 0 1e0\r\nCELLS 1 5\r\n4 0 1 2 3\r\ncell_types 1\r\n10\r\n\r\nPOINT_DATA 4\r\nSCALARS T "
        "double\r\n1\r\n2\r\n3 4"
        "\r\nSCALARS U int 2\r\nLOOKUP_TABLE default\r\n1 2 3 4 5 6 7 8\r\nCELL_DATA 1\r\nVECTORS v float\r\n1 2 "
        "+3\r\n");
    const Result<Mesh> read = read_quietly(folder / "m.vtk");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->cells, (std::vector<Mesh::Index>{0, 1, 2, 3}));
    ASSERT_EQ(read->point_fields.size(), 2U);
    EXPECT_EQ(read->point_fields[0].data, (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(read->point_fields[1].components, 2);
    EXPECT_EQ(read->cell_fields[0].data, (std::vector<double>{1, 2, 3}));
}

}  // namespace
}  // namespace barycert::testing
