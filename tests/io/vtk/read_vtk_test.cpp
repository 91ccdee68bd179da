#include "barycert/vtk.hpp"

#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <bit>
#include <cmath>
#include <limits>

#include "io/tetgen/random_mesh.hpp"
#include "io/vtk/mixed_grid.hpp"
#include "io/vtk/vtk_files.hpp"

namespace barycert::testing {
namespace {

namespace fs = std::filesystem;

void expect_round_trip(const Mesh& mesh) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu"));
    const Result<Mesh> read = read_quietly(folder / "m.vtu");
    ASSERT_TRUE(read) << read.error().message();
    expect_same(*read, as_in_vtk(mesh));
    EXPECT_TRUE(read->notes.empty());
    EXPECT_TRUE(read->cell_numbers.empty());
}

TEST(ReadVtk, meshes_of_the_data_folder) {
    for (const char* name : {"cube-hole", "cube-hole-o2", "plate", "bracket", "torus"}) {
        SCOPED_TRACE(name);
        const Mesh mesh = mesh_of_data(name);
        ASSERT_GT(mesh.cell_count(), 0U);
        expect_round_trip(mesh);
    }
}

TEST(ReadVtk, random_meshes) {
    base::Random random(2);
    int tried = 0;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(i);
        const Mesh mesh = any_mesh(random);
        if (mesh.cell_count() == 0) continue;
        ++tried;
        expect_round_trip(mesh);
    }
    EXPECT_GT(tried, 100);
    for (const int dimension : {2, 3}) expect_round_trip(second_order_mesh(dimension, MidEdgeOrder::vtk, 20, 5));
}

TEST(ReadVtk, values_and_names_of_fields) {
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
    expect_round_trip(mesh);
}

TEST(ReadVtk, every_type_and_encoding_that_vtk_writes) {
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
                        vtkNew<vtkXMLUnstructuredGridWriter> writer;
                        writer->SetDataMode(mode);
                        writer->SetEncodeAppendedData(encode);
                        writer->SetCompressorType(compressor);
                        writer->SetHeaderType(header);
                        writer->SetByteOrder(order);
                        writer->SetBlockSize(64);  // several blocks, the last one shorter
                        writer->SetFileName((folder / "m.vtu").c_str());
                        writer->SetInputData(mixed_grid());
                        ASSERT_EQ(writer->Write(), 1);
                        expect_mixed(folder / "m.vtu", mode == vtkXMLWriter::Ascii ? 1e-10 : 0) /* 11 digits */;
                    }
                }
            }
        }
    }
}

TEST(ReadVtk, points_of_float32_are_widened_exactly) {
    auto grid = mixed_grid();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToFloat();
    points->DeepCopy(grid->GetPoints());
    ASSERT_EQ(points->GetDataType(), VTK_FLOAT);
    grid->SetPoints(points);
    const TemporaryFolder folder;
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetFileName((folder / "m.vtu").c_str());
    writer->SetInputData(grid);
    ASSERT_EQ(writer->Write(), 1);
    const Result<Mesh> read = read_quietly(folder / "m.vtu");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->points[3], static_cast<double>(0.1F));
}

TEST(ReadVtk, bits_of_several_components) {
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

TEST(ReadVtk, pieces_are_put_together) {
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

TEST(ReadVtk, integers_that_are_no_doubles) {
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

TEST(ReadVtk, files_of_others) {
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
