#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
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
#include "tests/io/vtk/vtk_files.hpp"

namespace barycert::testing {
namespace {

TEST(VtkPoints, OfEveryKindOfFile) {
    const TemporaryFolder folder;
    const Mesh solid = mesh_of_data("cube-hole"), plate = mesh_of_data("plate");
    for (const char* name : {"m.vtu", "m.vtk"}) {
        ASSERT_TRUE(write_vtk(solid, folder / name));
        EXPECT_EQ(bits_of(read_vtk_points(folder / name, 3).value()), bits_of(solid.points));
        EXPECT_FALSE(read_vtk_points(folder / name, 2));
        ASSERT_TRUE(write_vtk(plate, folder / name));
        EXPECT_EQ(bits_of(read_vtk_points(folder / name, 2).value()), bits_of(plate.points));
        EXPECT_EQ(read_vtk_points(folder / name, 3).value().size(), plate.points.size() / 2 * 3);
        EXPECT_FALSE(read_vtk_points(folder / name, 4));
    }
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->InsertNextPoint(0.1, 0.2, 0);
    points->InsertNextPoint(0.3, 0.4, 0);
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName((folder / "m.vtp").c_str());
    writer->SetInputData(data);
    ASSERT_EQ(writer->Write(), 1);
    EXPECT_EQ(read_vtk_points(folder / "m.vtp", 2).value(), (std::vector<double>{0.1, 0.2, 0.3, 0.4}));
    const Result<Mesh> mesh = read_quietly(folder / "m.vtp");
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().what, "the file contains no mesh");
    put(folder / "m.vtk",
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 1 1\nPOINTS 2 float\n1 2 0 3 4 "
        "0\n");
    EXPECT_EQ(read_vtk_points(folder / "m.vtk", 2).value(), (std::vector<double>{1, 2, 3, 4}));
    put(folder / "m.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n");
    EXPECT_FALSE(read_vtk_points(folder / "m.vtk", 2));
}

TEST(VtkPoints, OfEitherByteOrder) {
    const TemporaryFolder folder;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->InsertNextPoint(0.1, 0.25, 0);
    points->InsertNextPoint(0.3, 0.25, 0);
    vtkNew<vtkPolyData> polygons;
    polygons->SetPoints(points);
    vtkNew<vtkStructuredGrid> structured;
    structured->SetDimensions(2, 1, 1);
    structured->SetPoints(points);
    vtkNew<vtkDoubleArray> x;
    for (const double value : {0.1, 0.3}) x->InsertNextValue(value);
    vtkNew<vtkFloatArray> y;
    y->InsertNextValue(0.25F);
    vtkNew<vtkRectilinearGrid> rectilinear;
    rectilinear->SetDimensions(2, 1, 1);
    rectilinear->SetXCoordinates(x);
    rectilinear->SetYCoordinates(y);
    const auto expect_read = [&](vtkXMLWriter* writer, vtkDataSet* data, const char* name) {
        for (const int order : {vtkXMLWriter::LittleEndian, vtkXMLWriter::BigEndian}) {
            SCOPED_TRACE(std::string(name) + " " + std::to_string(order));
            writer->SetInputData(data);
            writer->SetByteOrder(order);
            writer->SetFileName((folder / name).c_str());
            ASSERT_EQ(writer->Write(), 1);
            const Result<std::vector<double>> read = read_vtk_points(folder / name, 2);
            ASSERT_TRUE(read) << read.error().message();
            EXPECT_EQ(*read, (std::vector<double>{0.1, 0.25, 0.3, 0.25}));
        }
    };
    expect_read(vtkNew<vtkXMLPolyDataWriter>(), polygons, "m.vtp");
    expect_read(vtkNew<vtkXMLStructuredGridWriter>(), structured, "m.vts");
    expect_read(vtkNew<vtkXMLRectilinearGridWriter>(), rectilinear, "m.vtr");
}

TEST(VtkPoints, RowsAreReadByVtk) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> points{0, 1, 2, 3, 4, 0.1}, distances{0, 0, 0.5}, values{1, 2, 3, 4, nan, nan};
    const std::vector<Mesh::Index> cells{7, 0, -1};
    const std::vector<Feature> features{Feature::interior, Feature::vertex, Feature::outside};
    const std::vector<std::uint8_t> inside{1, 1, 0};
    for (const int dimension : {3, 2}) {
        const std::size_t count = points.size() / static_cast<std::size_t>(dimension);
        const TableView rows{.dimension = dimension,
                             .points = points,
                             .cells = std::span(cells).first(count),
                             .features = std::span(features).first(count),
                             .values = std::span(values).first(2 * count),
                             .distances = std::span(distances).first(count)};
        const TemporaryFolder folder;
        Printed printed;
        const auto sink =
            open_table(folder / "p.vtu", {.dimension = dimension, .fields = {{"u <v>", 2}}, .distances = true}).value();
        Status status = sink->write(rows);
        if (status) status = sink->commit();
        EXPECT_EQ(printed.text(), "");
        ASSERT_TRUE(status) << status.error().message();
        vtkNew<vtkXMLUnstructuredGridReader> reader;
        reader->SetFileName((folder / "p.vtu").c_str());
        reader->Update();
        vtkUnstructuredGrid* const grid = reader->GetOutput();
        ASSERT_EQ(static_cast<std::size_t>(grid->GetNumberOfPoints()), count);
        ASSERT_EQ(static_cast<std::size_t>(grid->GetNumberOfCells()), count);
        vtkPointData* const data = grid->GetPointData();
        ASSERT_EQ(data->GetNumberOfArrays(), 5);
        for (const auto& [name, type] : {std::pair{"cell", "Int64"},
                                         {"feature", "UInt8"},
                                         {"vtkValidPointMask", "Int8"},
                                         {"distance", "Float64"},
                                         {"u <v>", "Float64"}}) {
            ASSERT_NE(data->GetArray(name), nullptr) << name;
            EXPECT_NE(get(folder / "p.vtu")
                          .find("type=\"" + std::string(type) + "\" Name=\"" +
                                (name[0] == 'u' ? "u &#60;v&#62;" : name) + "\""),
                      std::string::npos)
                << name;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto row = static_cast<vtkIdType>(i);
            EXPECT_EQ(grid->GetCellType(row), VTK_VERTEX);
            for (int axis = 0; axis < 3; ++axis) {
                const double expected =
                    axis < dimension ? points[i * static_cast<std::size_t>(dimension) + static_cast<std::size_t>(axis)]
                                     : 0;
                EXPECT_EQ(grid->GetPoint(row)[axis], expected);
            }
            EXPECT_EQ(data->GetArray("cell")->GetTuple1(row), cells[i]);
            EXPECT_EQ(data->GetArray("feature")->GetTuple1(row), static_cast<double>(features[i]));
            EXPECT_EQ(data->GetArray("vtkValidPointMask")->GetTuple1(row), inside[i]);
            EXPECT_EQ(data->GetArray("distance")->GetTuple1(row), distances[i]);
        }
        EXPECT_EQ(bits_of({data->GetArray("u <v>")->GetTuple(0), data->GetArray("u <v>")->GetTuple(0) + 2}),
                  bits_of({1, 2}));
    }
    const TemporaryFolder folder;
    ASSERT_TRUE(open_table(folder / "none.vtu", {}).value()->commit());
    EXPECT_TRUE(read_vtk_points(folder / "none.vtu", 3).value().empty());
}

TEST(VtkPoints, CodesOfFeatures) {
    EXPECT_EQ(static_cast<int>(Feature::interior), 0);
    EXPECT_EQ(static_cast<int>(Feature::face), 1);
    EXPECT_EQ(static_cast<int>(Feature::edge), 2);
    EXPECT_EQ(static_cast<int>(Feature::vertex), 3);
    EXPECT_EQ(static_cast<int>(Feature::outside), 4);
    EXPECT_EQ(static_cast<int>(Feature::degenerate), 5);
}

TEST(VtkPoints, Endings) {
    const TemporaryFolder folder;
    const Status status = write_vtk(mesh_of_data("plate"), folder / "m.ele");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().expected, ".vtu or .vtk");
    EXPECT_EQ(folder.file_count(), 0U);
    for (const char* name : {"none/m.vtk", "none/m.vtu"}) {
        const Status missing = write_vtk(mesh_of_data("plate"), folder / name);
        ASSERT_FALSE(missing);
        EXPECT_EQ(missing.error().found, "No such file or directory");
    }
}

}  // namespace
}  // namespace barycert::testing
