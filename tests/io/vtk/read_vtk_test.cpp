#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tests/io/tetgen/random_mesh.hpp"
#include "tests/io/vtk/mixed_grid.hpp"
#include "tests/io/vtk/vtk_files.hpp"

namespace barycert::testing {
namespace {

namespace fs = std::filesystem;

vtkSmartPointer<vtkUnstructuredGrid> with_float32_points(vtkSmartPointer<vtkUnstructuredGrid> grid) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToFloat();
    points->DeepCopy(grid->GetPoints());
    EXPECT_EQ(points->GetDataType(), VTK_FLOAT);
    grid->SetPoints(points);
    return grid;
}

TEST(ReadVtk, EveryTypeAndEncodingThatVtkWrites) {
    const TemporaryFolder folder;
    for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
        for (const int encode : {0, 1}) {
            for (const int compressor :
                 {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA}) {
                for (const int header : {vtkXMLWriter::UInt32, vtkXMLWriter::UInt64}) {
                    for (const int order : {vtkXMLWriter::LittleEndian, vtkXMLWriter::BigEndian}) {
                        SCOPED_TRACE(std::to_string(mode) + " " + std::to_string(encode) + " " +
                                     std::to_string(compressor) + " " + std::to_string(header) + " " +
                                     std::to_string(order));
                        for (const bool narrow : {false, true}) {
                            const auto grid = narrow ? with_float32_points(mixed_grid()) : mixed_grid();
                            vtkNew<vtkXMLUnstructuredGridWriter> writer;
                            writer->SetDataMode(mode);
                            writer->SetEncodeAppendedData(encode);
                            writer->SetCompressorType(compressor);
                            writer->SetHeaderType(header);
                            writer->SetByteOrder(order);
                            writer->SetBlockSize(64);  // several blocks, the last one shorter
                            writer->SetFileName((folder / "m.vtu").c_str());
                            writer->SetInputData(grid);
                            ASSERT_EQ(writer->Write(), 1);
                            expect_mixed(folder / "m.vtu", mode == vtkXMLWriter::Ascii ? 1e-10 : 0,
                                         narrow) /* 11 digits */;
                        }
                    }
                }
            }
        }
    }
}

TEST(ReadVtk, PointsOfFloat32AreWidenedExactly) {
    auto grid = mixed_grid();
    grid = with_float32_points(grid);
    const TemporaryFolder folder;
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetFileName((folder / "m.vtu").c_str());
    writer->SetInputData(grid);
    ASSERT_EQ(writer->Write(), 1);
    const Result<Mesh> read = read_quietly(folder / "m.vtu");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->points[3], static_cast<double>(0.1F));
}

TEST(ReadVtk, BitsOfSeveralComponents) {
    const auto grid = mixed_grid();
    const std::vector<double> bits{1, 0, 0, 1, 1, 0, 0, 1, 1, 1};
    grid->GetPointData()->Initialize();
    grid->GetPointData()->AddArray(array_of<vtkBitArray>("bits", 2, bits));
    const TemporaryFolder folder;
    for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Appended}) {
        vtkNew<vtkXMLUnstructuredGridWriter> writer;
        writer->SetDataMode(mode);
        writer->SetFileName((folder / "m.vtu").c_str());
        writer->SetInputData(grid);
        ASSERT_EQ(writer->Write(), 1);
        const Result<Mesh> read = read_quietly(folder / "m.vtu");
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->point_fields[0].data, bits);
    }
}

TEST(ReadVtk, FilesOfOthers) {
    const std::string shared = std::string(BARYCERT_SHARED_DATA_DIR) + "/vtk";
    if (!fs::exists(shared)) GTEST_SKIP() << "no " << shared;
    for (const auto& [name, nodes] : {std::pair{"vtkdata_Tetrahedron.vtu", 4U}, {"vtkdata_QuadraticTetra.vtu", 10U}}) {
        SCOPED_TRACE(name);
        const std::string path = shared + "/" + name;
        const Result<Mesh> read = read_quietly(path);
        ASSERT_TRUE(read) << read.error().message();
        vtkNew<vtkXMLUnstructuredGridReader> reader;
        reader->SetFileName(path.c_str());
        reader->Update();
        vtkUnstructuredGrid* const grid = reader->GetOutput();
        ASSERT_EQ(static_cast<std::size_t>(grid->GetNumberOfCells()), read->cell_count());
        ASSERT_EQ(static_cast<std::size_t>(grid->GetNumberOfPoints()), read->point_count());
        ASSERT_EQ(read->mid_nodes.size(), read->cell_count() * (nodes - 4));
        for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
            vtkNew<vtkIdList> ids;
            grid->GetCellPoints(cell, ids);
            for (unsigned i = 0; i < nodes; ++i) {
                const auto c = static_cast<std::size_t>(cell);
                ASSERT_EQ(ids->GetId(i), i < 4 ? read->cells[c * 4 + i] : read->mid_nodes[c * 6 + i - 4]);
            }
        }
        for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_EQ(grid->GetPoint(i)[axis], read->points[static_cast<std::size_t>(3 * i + axis)]);
            }
        }
        ASSERT_EQ(static_cast<int>(read->point_fields.size()), grid->GetPointData()->GetNumberOfArrays());
        for (const Field& field : read->point_fields) {
            vtkDataArray* const array = grid->GetPointData()->GetArray(field.name.c_str());
            ASSERT_NE(array, nullptr);
            for (std::size_t i = 0; i < field.data.size(); ++i) {
                ASSERT_EQ(array->GetTuple(static_cast<vtkIdType>(i))[0], field.data[i]);
            }
        }
    }
    const Result<Mesh> mixed = read_quietly(shared + "/vtkdata_quadraticTetra01.vtu");
    ASSERT_TRUE(mixed) << mixed.error().message();
    EXPECT_EQ(mixed->cell_count(), 1U);  // beside two quadratic triangles
    EXPECT_EQ(mixed->mid_nodes.size(), 6U);
}

}  // namespace
}  // namespace barycert::testing
