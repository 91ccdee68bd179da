/// Strings and wide integers of cells, cell numbers, ghost cells and notes, in files written here.
#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

#include "tests/io/vtk/mesh_notes.hpp"

namespace barycert::testing {
namespace {

using Numbers = std::vector<std::int64_t>;
using Texts = std::vector<std::string>;
constexpr std::int64_t wide = 9007199254740993;  // 2^53 + 1

/// Three cells of a mesh of tetrahedra: a triangle between two tetrahedra. `more`: arrays of cells.
std::string three_cells(const std::string& more, const std::string& of_file = "") {
    return "<VTKFile type='UnstructuredGrid' " + of_file +
           "><UnstructuredGrid><FieldData><DataArray type='Float64' Name='TimeValue'>1</DataArray>"
           "<DataArray type='Float64' Name='density'>7.8</DataArray></FieldData>"
           "<Piece NumberOfPoints='5' NumberOfCells='3'><PointData/><CellData>" +
           more +
           "</CellData><Points><DataArray type='Float32' NumberOfComponents='3'>0 0 0 1 0 0 0 1 0 0 0 1 1 1 1"
           "</DataArray></Points><Cells><DataArray type='Int32' Name='connectivity'>0 1 2 3 0 1 2 1 2 3 4</DataArray>"
           "<DataArray type='Int32' Name='offsets'>4 7 11</DataArray><DataArray type='UInt8' Name='types'>10 5 10"
           "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
}

Mesh read_text_of(const std::string& text) {
    const TemporaryFolder folder;
    put(folder / "m.vtu", text);
    Result<Mesh> mesh = read_vtk(folder / "m.vtu");
    EXPECT_TRUE(mesh) << mesh.error().message();
    return mesh ? *mesh : Mesh();
}

TEST(VtkLabels, OfCellsThatStay) {
    const Mesh mesh = read_text_of(three_cells(
        "<DataArray type='Int64' Name='id'>9007199254740993 2 -9007199254740993</DataArray>"
        "<Array type='String' Name='material'>97 0 98 99 0 195 164 0</Array>"
        "<DataArray type='Int64' Name='small'>5 6 7</DataArray>"
        "<DataArray type='UInt64' Name='huge'>18446744073709551615 0 1</DataArray>"
        "<DataArray type='Int64' NumberOfComponents='2' Name='pairs'>9007199254740993 0 1 2 3 4</DataArray>"));
    EXPECT_EQ(mesh.cells, (std::vector<Mesh::Index>{0, 1, 2, 3, 1, 2, 3, 4}));
    EXPECT_EQ(mesh.cell_numbers, (std::vector<Mesh::Index>{0, 2}));
    ASSERT_EQ(mesh.cell_labels.size(), 2U);
    EXPECT_EQ(mesh.cell_labels[0].name, "id");
    EXPECT_EQ(std::get<Numbers>(mesh.cell_labels[0].values), (Numbers{wide, -wide}));
    EXPECT_EQ(mesh.cell_labels[1].name, "material");
    EXPECT_EQ(std::get<Texts>(mesh.cell_labels[1].values), (Texts{"a", "ä"}));
    ASSERT_EQ(mesh.cell_fields.size(), 1U);
    EXPECT_EQ(mesh.cell_fields[0].data, (std::vector<double>{5, 7}));
    EXPECT_EQ(notes_of(mesh),
              (Texts{"1 cells that are no tetrahedra: 1 vtkTriangle",
                     "cell array \"huge\": it holds 18446744073709551615, which is not exactly a double",
                     "cell array \"pairs\": it holds 9007199254740993, which is not exactly a double",
                     "arrays of neither points nor cells (field data): \"density\""}));
    EXPECT_EQ(notes_of(mesh, Note::Kind::converted), (Texts{"float32 to double: the coordinates"}));
    EXPECT_TRUE(mesh.notes.front().important);
    EXPECT_FALSE(mesh.notes.back().important);
}

TEST(VtkLabels, TextsThatDoNotFit) {
    const TemporaryFolder folder;
    for (const char* bytes : {"97 0 98 0", "97 0 98 0 99", "97 0 98 0 99 0 0", "", "97 0 98 0 256 0", "a"}) {
        put(folder / "m.vtu", three_cells(std::string("<Array type='String' Name='s'>") + bytes + "</Array>"));
        const Result<Mesh> mesh = read_vtk(folder / "m.vtu");
        ASSERT_FALSE(mesh) << bytes;
        EXPECT_NE(mesh.error().message().find("array \"s\""), std::string::npos) << mesh.error().message();
    }
}

TEST(VtkLabels, GhostCellsAreLeftOut) {
    const Mesh mesh = read_text_of(three_cells("<DataArray type='UInt8' Name='vtkGhostType'>1 0 0</DataArray>"));
    EXPECT_EQ(mesh.cells, (std::vector<Mesh::Index>{1, 2, 3, 4}));
    EXPECT_EQ(mesh.cell_numbers, (std::vector<Mesh::Index>{2}));
    EXPECT_EQ(notes_of(mesh)[1], "1 ghost cells, which stand for cells of other pieces or are hidden (vtkGhostType)");
    const Mesh whole = read_text_of(three_cells("<DataArray type='UInt8' Name='vtkGhostType'>2 4 16</DataArray>"));
    EXPECT_EQ(whole.cell_numbers, (std::vector<Mesh::Index>{0, 2}));
    const TemporaryFolder folder;
    put(folder / "m.vtu", three_cells("<DataArray type='UInt8' Name='vtkGhostType'>1 1 32</DataArray>"));
    EXPECT_FALSE(read_vtk(folder / "m.vtu"));
}

/// Pieces of two tetrahedra each, of which those have ghost cells that `ghosts` names.
std::string pieces(const std::vector<std::string>& ghosts) {
    std::string text = "<VTKFile type='UnstructuredGrid'><UnstructuredGrid>";
    for (const std::string& own : ghosts) {
        text += "<Piece NumberOfPoints='5' NumberOfCells='2'><CellData>";
        if (!own.empty()) text += "<DataArray type='UInt8' Name='vtkGhostType'>" + own + "</DataArray>";
        text +=
            "</CellData><Points><DataArray type='Float64' NumberOfComponents='3'>0 0 0 1 0 0 0 1 0 0 0 1 1 1 1"
            "</DataArray></Points><Cells><DataArray type='Int32' Name='connectivity'>0 1 2 3 1 2 3 4</DataArray>"
            "<DataArray type='Int32' Name='offsets'>4 8</DataArray><DataArray type='UInt8' Name='types'>10 10"
            "</DataArray></Cells></Piece>";
    }
    return text + "</UnstructuredGrid></VTKFile>";
}

TEST(VtkLabels, GhostCellsOfSomePieces) {
    using Cells = std::vector<Mesh::Index>;
    const std::vector<std::pair<std::vector<std::string>, Cells>> files{
        {{"0 1", ""}, {0, 2, 3}}, {{"", "0 1"}, {0, 1, 2}}, {{"", "1 0", ""}, {0, 1, 3, 4, 5}}};
    for (const auto& [ghosts, left] : files) {
        const Mesh mesh = read_text_of(pieces(ghosts));
        EXPECT_EQ(mesh.cell_numbers, left);
        EXPECT_EQ(notes_of(mesh), (Texts{"1 ghost cells, which stand for cells of other pieces or are hidden "
                                         "(vtkGhostType)"}));
    }
}

/// Only the integer of a cell that is left out is no double.
TEST(VtkLabels, WhatIsLeftMayBeAField) {
    const TemporaryFolder folder;
    const auto read = [&](const std::string& first, const std::string& second) {
        put(folder / "m.vtk",
            "# vtk DataFile Version 3.0\nm\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n0 0 0\n1 0 0\n0 1 0\n"
            "CELLS 2 6\n1 0\n3 0 1 2\nCELL_TYPES 2\n1\n5\nCELL_DATA 2\nFIELD FieldData 1\nid 1 2 vtktypeint64\n" +
                first + " " + second + "\n");
        return read_vtk(folder / "m.vtk").value();
    };
    const Mesh field = read("9007199254740993", "-7"), label = read("-7", "9007199254740993"),
               least = read("9007199254740993", "-9223372036854775808"),
               greatest = read("9007199254740993", "9223372036854775807");
    ASSERT_EQ(field.cell_fields.size(), 1U);
    EXPECT_EQ(field.cell_fields[0].data, std::vector<double>{-7});
    EXPECT_TRUE(field.cell_labels.empty());
    ASSERT_EQ(label.cell_labels.size(), 1U);
    EXPECT_EQ(std::get<Numbers>(label.cell_labels[0].values), Numbers{9007199254740993});
    EXPECT_TRUE(label.cell_fields.empty());
    EXPECT_EQ(least.cell_fields.size(), 1U);
    EXPECT_EQ(greatest.cell_labels.size(), 1U);
}

TEST(VtkLabels, RoundTrips) {
    Mesh mesh = mesh_of_data("plate");
    Column ids{"id", Numbers(mesh.cell_count(), wide)}, names{"material", Texts(mesh.cell_count(), "")};
    std::get<Texts>(names.values)[1] = "steel 12% \"x\"";
    std::get<Texts>(names.values)[2] = std::string(70, 'y') + "ä";
    std::get<Texts>(names.values)[3] = std::string(20000, 'z');
    mesh.cell_labels = {ids, names};
    const TemporaryFolder folder;
    for (const VtkData data : {VtkData::raw, VtkData::zlib, VtkData::lz4, VtkData::lzma, VtkData::ascii}) {
        for (const char* name : {"m.vtu", "m.vtk"}) {
            SCOPED_TRACE(std::string(name) + " " + std::string(barycert::name(data)));
            const Status written = write_vtk(mesh, folder / name, data);
            const bool legacy = std::string_view(name) == "m.vtk";
            ASSERT_EQ(written.has_value(), !legacy || data == VtkData::raw || data == VtkData::ascii);
            if (!written) continue;
            const Result<Mesh> read = read_vtk(folder / name);
            ASSERT_TRUE(read) << read.error().message();
            expect_same(*read, as_in_vtk(mesh));
            ASSERT_EQ(read->cell_labels.size(), 2U);
            for (std::size_t i = 0; i < 2; ++i) {
                EXPECT_EQ(read->cell_labels[i].name, mesh.cell_labels[i].name);
                EXPECT_EQ(read->cell_labels[i].values, mesh.cell_labels[i].values);
            }
            EXPECT_TRUE(read->notes.empty());
        }
    }
    std::get<Texts>(mesh.cell_labels[1].values)[0] = std::string("a\0b", 3);
    EXPECT_FALSE(write_vtu(mesh, folder / "n.vtu"));
    mesh.cell_labels = {{"short", Numbers{1}}};
    EXPECT_FALSE(write_vtu(mesh, folder / "n.vtu"));
}

}  // namespace
}  // namespace barycert::testing
