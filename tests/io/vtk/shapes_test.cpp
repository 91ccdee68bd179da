/// Cells of all shapes: what is written is read back; structured grids as text; files that are wrong.
#include <sys/resource.h>

#include "core/base/random.hpp"
#include "mesh/consistency.hpp"
#include "tests/io/vtk/all_shapes.hpp"

namespace barycert::testing {
namespace {

using Texts = std::vector<std::string>;
using Types = std::vector<std::uint8_t>;
using Nodes = std::vector<Mesh::Index>;

TEST(VtkShapes, WhatIsWrittenIsReadBack) {
    const TemporaryFolder folder;
    for (const Mesh& mesh : {all_solids(), all_polygons()}) {
        ASSERT_GT(mesh.cell_count(), mesh.shapes.count());
        for (const VtkData data : {VtkData::raw, VtkData::ascii, VtkData::zlib, VtkData::lz4, VtkData::lzma}) {
            SCOPED_TRACE(static_cast<int>(data));
            ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu", data));
            const Result<Mesh> read = read_quietly(folder / "m.vtu");
            ASSERT_TRUE(read) << read.error().message();
            expect_same_shapes(*read, mesh);
            if (data != VtkData::raw && data != VtkData::ascii) continue;
            ASSERT_TRUE(write_vtk(mesh, folder / "m.vtk", data));
            const Result<Mesh> legacy = read_quietly(folder / "m.vtk");
            ASSERT_TRUE(legacy) << legacy.error().message();
            expect_same_shapes(*legacy, mesh);
            // Written again it is the same file.
            ASSERT_TRUE(write_vtk(*legacy, folder / "again.vtk", data));
            EXPECT_EQ(get(folder / "again.vtk"), get(folder / "m.vtk"));
        }
    }
}

/// A .vtu file of one piece, whose points are on the curve (i, i^2, i^3), with `more` in Cells.
/// Points on a curve of which no four are in one plane. The ring 1 2 4 3 of a polyhedron is convex: 3 and 4 are
/// exchanged.
std::string on_curve(std::size_t i, bool flat, bool exchanged) {
    const std::size_t at = exchanged && (i == 3 || i == 4) ? 7 - i : i;
    return std::to_string(at) + " " + std::to_string(at * at) + " " + std::to_string(flat ? 0 : at * at * at) + "\n";
}

std::string cells_file(std::size_t points, const std::string& types, const std::string& offsets,
                       const std::string& connectivity, const std::string& more = "", const std::string& data = "",
                       bool flat = false) {
    std::string places;
    const bool polyhedra = types.find("42") != std::string::npos;
    for (std::size_t i = 0; i < points; ++i) places += on_curve(i, flat, polyhedra);
    std::string offsets_left = offsets;
    const auto count = std::ranges::count(offsets_left, ' ') + 1;
    const auto array = [](const std::string& name, const std::string& numbers) {
        return "<DataArray type='Int64' Name='" + name + "'>" + numbers + "</DataArray>\n";
    };
    return "<VTKFile type='UnstructuredGrid'>\n<UnstructuredGrid>\n<Piece NumberOfPoints='" + std::to_string(points) +
           "' NumberOfCells='" + std::to_string(count) + "'>\n" + data +
           "<Points><DataArray type='Float64' NumberOfComponents='3'>" + places + "</DataArray></Points>\n<Cells>" +
           array("types", types) + array("offsets", offsets) + array("connectivity", connectivity) + more +
           "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

Result<Mesh> read_text(const std::string& text) {
    const TemporaryFolder folder;
    put(folder / "m", text);
    return read_quietly(folder / "m");
}

std::string up_to(std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : " ") + std::to_string(i);
    return text;
}

struct Higher {
    int type;
    std::size_t nodes;
    std::uint8_t linear;
};

TEST(VtkShapes, HigherOrdersAreTakenByTheirCorners) {
    for (const auto& [type, nodes, linear] : std::vector<Higher>{
             {25, 20, 12}, {29, 27, 12}, {33, 24, 12}, {72, 27, 12}, {79, 64, 12}, {26, 15, 13}, {31, 12, 13},
             {32, 18, 13}, {73, 40, 13}, {80, 18, 13}, {27, 13, 14}, {37, 19, 14}, {74, 14, 14}, {64, 20, 10},
             {71, 56, 10}, {78, 10, 10}, {23, 8, 9},   {28, 9, 9},   {30, 6, 9},   {62, 16, 9},  {70, 9, 9},
             {77, 9, 9},   {34, 7, 5},   {61, 10, 5},  {69, 21, 5},  {76, 6, 5},   {36, 10, 7}}) {
        SCOPED_TRACE(type);
        const bool flat = linear < 10;
        const Result<Mesh> read =
            read_text(cells_file(nodes, std::to_string(type), std::to_string(nodes), up_to(nodes), "", "", flat));
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->dimension, flat ? 2 : 3);
        EXPECT_EQ(read->shapes.types, Types{linear});
        const std::size_t corners = linear == 7 ? nodes / 2 : mesh::cell_type(linear).corners;
        Nodes expected(corners);
        std::iota(expected.begin(), expected.end(), 0);
        if (type == 73 || type == 80) expected = {0, 2, 1, 3, 5, 4};  // seen from the other side: vtkLagrangeWedge.h
        EXPECT_EQ(read->shapes.nodes, expected);
        EXPECT_EQ(read->point_count(), nodes);
        const Texts converted = notes_of(*read, Note::Kind::converted);
        ASSERT_EQ(converted.size(), 2U);
        EXPECT_EQ(converted[0], "1 cells of a higher order: they are taken by their corners");
        EXPECT_EQ(converted[1].substr(0, 23), "1 cells are cut into " + std::to_string(read->cell_count()) + " ")
            << converted[1];
    }
    // Simplices of order 2 to 4 keep their nodes.
    for (const auto& [type, nodes, linear] :
         std::vector<Higher>{{71, 10, 71}, {71, 20, 71}, {71, 35, 71}, {69, 6, 69}, {69, 10, 69}, {69, 15, 69}}) {
        SCOPED_TRACE(nodes);
        const bool flat = linear == 69;
        const Result<Mesh> read =
            read_text(cells_file(nodes, std::to_string(type), std::to_string(nodes), up_to(nodes), "", "", flat));
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->shapes.types, Types{linear});
        EXPECT_EQ(read->shapes.nodes.size(), nodes);
        EXPECT_EQ(read->cells, flat ? (Nodes{0, 1, 2}) : (Nodes{0, 1, 2, 3}));
    }
    // Both orders in one mesh; a line of each order beside it.
    const Result<Mesh> both = read_text(cells_file(10, "24 3 10 21", "10 12 16 19", up_to(10) + " 0 1 1 2 3 4 0 1 2"));
    ASSERT_TRUE(both) << both.error().message();
    EXPECT_EQ(both->shapes.types, (Types{24, 10}));
    EXPECT_EQ(both->shapes.nodes, (Nodes{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 1, 2, 3, 4}));
    EXPECT_EQ(both->cells, (Nodes{0, 1, 2, 3, 1, 2, 3, 4}));
    EXPECT_EQ(both->cell_numbers, (Nodes{0, 2}));
    EXPECT_TRUE(both->mid_nodes.empty());
    // Mid-edge nodes of cells of one order are the mesh's own.
    const Result<Mesh> quadratic = read_text(cells_file(10, "24", "10", up_to(10)));
    ASSERT_TRUE(quadratic) << quadratic.error().message();
    EXPECT_TRUE(quadratic->shapes.types.empty());
    EXPECT_EQ(quadratic->mid_nodes.size(), 6U);
}

TEST(VtkShapes, ANumberOfNodesThatIsNone) {
    struct Wrong {
        int type;
        std::size_t nodes;
        const char* expected;
    };
    for (const auto& [type, nodes, expected] :
         std::vector<Wrong>{{5, 4, "3 in a vtkTriangle (type 5)"},
                            {6, 2, "3 or more in a vtkTriangleStrip (type 6)"},
                            {7, 2, "3 or more in a vtkPolygon (type 7)"},
                            {8, 3, "4 in a vtkPixel (type 8)"},
                            {9, 5, "4 in a vtkQuad (type 9)"},
                            {10, 5, "4 in a vtkTetra (type 10)"},
                            {11, 7, "8 in a vtkVoxel (type 11)"},
                            {12, 9, "8 in a vtkHexahedron (type 12)"},
                            {13, 5, "6 in a vtkWedge (type 13)"},
                            {14, 4, "5 in a vtkPyramid (type 14)"},
                            {15, 9, "10 in a vtkPentagonalPrism (type 15)"},
                            {16, 11, "12 in a vtkHexagonalPrism (type 16)"},
                            {25, 8, "20 in a vtkQuadraticHexahedron (type 25)"},
                            {36, 5, "6 or more in a vtkQuadraticPolygon (type 36)"},
                            {72, 7, "8 or more in a vtkLagrangeHexahedron (type 72)"}}) {
        SCOPED_TRACE(type);
        const Result<Mesh> alone =
            read_text(cells_file(12, std::to_string(type), std::to_string(nodes), up_to(nodes), "", "", true));
        expect_error(alone, "m", 0, "the nodes of cell 0 (from 0)", expected, std::to_string(nodes).c_str(), nullptr);
        // Behind another one of its kind, in a legacy file.
        std::string legacy = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 12 double\n";
        for (std::size_t i = 0; i < 12; ++i) legacy += std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
        legacy += "CELLS 2 " + std::to_string(nodes + 6) + "\n4 0 1 2 3\n" + std::to_string(nodes) + " " +
                  up_to(nodes) + "\nCELL_TYPES 2\n" + (type < 10 || type == 36 ? "9 " : "10 ") + std::to_string(type) +
                  "\n";
        expect_error(read_text(legacy), "m", 0, "the nodes of cell 1 (from 0)", expected, std::to_string(nodes).c_str(),
                     nullptr);
    }
    // Without a node it is no crash either.
    EXPECT_FALSE(read_text(cells_file(0, "7", "0", "")));
    EXPECT_FALSE(read_text(cells_file(0, "42", "0", "")));
}

// Polyhedra.

std::string faces_of(const std::string& faces, const std::string& offsets) {
    return "<DataArray type='Int64' Name='faces'>" + faces + "</DataArray><DataArray type='Int64' Name='faceoffsets'>" +
           offsets + "</DataArray>";
}

/// A polyhedron with these faces: in XML, and as a legacy file.
Texts polyhedron_files(const std::string& stream) {
    const std::string count = std::to_string(stream.empty() ? 0 : std::ranges::count(stream, ' ') + 1);
    std::string legacy = "# vtk DataFile Version 4.2\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n";
    for (std::size_t i = 0; i < 5; ++i) legacy += on_curve(i, false, true);
    legacy += "CELLS 1 " + std::to_string(std::stoi(count) + 1) + "\n" + count + " " + stream + "\nCELL_TYPES 1\n42\n";
    return {cells_file(5, "42", "5", up_to(5), faces_of(stream, count)), legacy};
}

TEST(VtkShapes, FacesThatAreNone) {
    // A pyramid on the ring 1 2 4 3.
    const std::string pyramid = "5 4 1 2 4 3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1";
    for (const std::string& text : polyhedron_files(pyramid)) {
        const Result<Mesh> read = read_text(text);
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->shapes.types, Types{42});
        EXPECT_EQ(read->cell_count(), 2U);
        EXPECT_EQ(read->shapes.face_ends, std::vector<std::int64_t>{5});
        EXPECT_EQ(read->shapes.ring_ends, (std::vector<std::int64_t>{4, 7, 10, 13, 16}));
    }
    const char* const below = "nodes of faces below 5";
    for (const char* stream :
         {"", "5", "-1", "5 4 1 2 4 3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3", "5 4 1 2 4 3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1 0",
          "6 4 1 2 4 3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1", "4 4 1 2 4 3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1",
          "5 4 1 2 4 5 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1", "5 4 1 2 4 -3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1",
          "5 -4 1 2 4 3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1", "2000000000 4 1 2 4 3", "1 2000000000 1 2 4 3"}) {
        SCOPED_TRACE(stream);
        const Texts files = polyhedron_files(stream);
        const Result<Mesh> xml = read_text(files[0]), legacy = read_text(files[1]);
        expect_error(legacy, "m", 0, "the faces of cell 0 (from 0)", below, "others", nullptr);
        ASSERT_FALSE(xml);
        EXPECT_EQ(xml.error().what, "the faces of cell 0 (from 0) of the piece");
        EXPECT_EQ(xml.error().expected, below);
        EXPECT_GT(xml.error().line, 0U);
    }
    // Faces that are there, and do not close: one is missing, one is there twice, an edge has three faces, none.
    for (const char* stream :
         {"4 4 1 2 4 3 3 0 1 2 3 0 2 4 3 0 4 3", "6 4 1 2 4 3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1 3 0 3 1",
          "6 4 1 2 4 3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1 3 1 3 4", "0", "1 3 0 1 2", "2 3 0 1 2 2 0 1", "1 0",
          "5 4 1 4 2 3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1"}) {
        SCOPED_TRACE(stream);
        for (const std::string& text : polyhedron_files(stream))
            expect_error(read_text(text), "m", 0, "the faces of cell 0 (from 0) do not close",
                         "each edge in two faces of the polyhedron", nullptr, "write the file again with all faces");
    }
    // A node that follows itself around a face is one; so is that which closes the face.
    for (const char* stream :
         {"5 5 1 2 4 3 1 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1", "5 4 1 2 4 3 4 0 1 1 2 3 0 2 4 3 0 4 3 3 0 3 1",
          "6 4 1 2 4 3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1 2 0 1"}) {
        for (const std::string& text : polyhedron_files(stream)) {
            const Result<Mesh> read = read_text(text);
            ASSERT_TRUE(read) << read.error().message();
            EXPECT_EQ(read->cell_count(), 2U);
        }
    }
}

TEST(VtkShapes, OffsetsOfFacesThatAreNone) {
    const std::string pyramid = "5 4 1 2 4 3 3 0 1 2 3 0 2 4 3 0 4 3 3 0 3 1";
    const auto two = [&](const std::string& faces, const std::string& offsets) {
        return read_text(cells_file(5, "42 10 42", "5 9 14", "0 1 2 3 4 0 1 2 3 0 1 2 3 4", faces_of(faces, offsets)));
    };
    const Result<Mesh> good = two(pyramid + " " + pyramid, "22 -1 44");
    ASSERT_TRUE(good) << good.error().message();
    EXPECT_EQ(good->shapes.types, (Types{42, 10, 42}));
    EXPECT_EQ(good->shapes.face_ends, (std::vector<std::int64_t>{5, 5, 10}));
    EXPECT_EQ(good->cell_numbers, (Nodes{0, 0, 1, 2, 2}));
    // Numbers behind the last offset, or fewer than it.
    for (const char* offsets : {"22 -1 43", "22 -1 45", "22 -1 2000000000", "22 -1 9223372036854775807"}) {
        const Result<Mesh> read = two(pyramid + " " + pyramid, offsets);
        ASSERT_FALSE(read) << offsets;
        EXPECT_EQ(read.error().what, "faces") << offsets;
    }
    for (const char* offsets : {"22 -1 21", "-5 -1 44", "44 -1 22", "44 -1 44", "23 -1 44"}) {
        const Result<Mesh> read = two(pyramid + " " + pyramid, offsets);
        ASSERT_FALSE(read) << offsets;
    }
    for (const char* missing : {"faces", "faceoffsets"}) {
        std::string text = cells_file(5, "42", "5", up_to(5), faces_of(pyramid, "22"));
        const std::string name = std::string("Name='") + missing + "'";
        text.replace(text.find(name), name.size(), "Name='x'");
        const Result<Mesh> read = read_text(text);
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().what, "the faces of polyhedra");
        EXPECT_EQ(read.error().expected, std::string("an array ") + missing);
    }
    // A node of no point, in the cell itself.
    expect_error(read_text(cells_file(5, "42", "5", "0 1 2 3 5", faces_of(pyramid, "22"))), "m", 12, "a node of a cell",
                 "a point below 5", "5", nullptr);
}

/// As VTK writes them since 9.4: faces have numbers, and two cells share one.
std::string numbered(const std::string& offsets, const std::string& of_cells, const std::string& face_offsets,
                     const std::string& nodes) {
    const auto array = [](const char* name, const std::string& numbers) {
        return std::string("<DataArray type='Int64' Name='") + name + "'>" + numbers + "</DataArray>";
    };
    return array("polyhedron_offsets", offsets) + array("polyhedron_to_faces", of_cells) +
           array("face_offsets", face_offsets) + array("face_connectivity", nodes);
}

TEST(VtkShapes, FacesWithNumbers) {
    // Two tetrahedra on the face 1 2 3, and a plain one between them in the file.
    const std::string faces = "1 2 3 0 1 2 0 2 3 0 3 1 4 1 2 4 2 3 4 3 1", ends = "3 6 9 12 15 18 21";
    const auto file = [](const std::string& arrays) {
        return cells_file(5, "42 10 42", "4 8 12", "0 1 2 3 0 1 2 4 1 2 3 4", arrays);
    };
    const Result<Mesh> read = read_text(file(numbered("4 4 8", "0 1 2 3 0 4 5 6", ends, faces)));
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->shapes.face_ends, (std::vector<std::int64_t>{4, 4, 8}));
    EXPECT_EQ(read->shapes.rings, (Nodes{1, 2, 3, 0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 2, 3, 4, 1, 2, 4, 2, 3, 4, 3, 1}));
    EXPECT_EQ(read->cell_count(), 3U);
    for (const auto& [offsets, of_cells, face_offsets, nodes] : std::vector<std::array<std::string, 4>>{
             {"4 4 8", "0 1 2 3 0 4 5 -6", ends, faces},
             {"4 4 8", "0 1 2 3 0 4 5 7", ends, faces},
             {"4 4 8", "0 1 2 3 0 4 5 9223372036854775807", ends, faces},
             {"4 4 7", "0 1 2 3 0 4 5 6", ends, faces},
             {"4 4 9", "0 1 2 3 0 4 5 6", ends, faces},
             {"4 3 8", "0 1 2 3 0 4 5 6", ends, faces},
             {"-4 4 8", "0 1 2 3 0 4 5 6", ends, faces},
             {"4 5 8", "0 1 2 3 0 4 5 6", ends, faces},
             {"4 4 8", "0 1 2 3 0 4 5 6", "3 6 9 12 15 18 22", faces},
             {"4 4 8", "0 1 2 3 0 4 5 6", "3 6 9 12 15 18 20", faces},
             {"4 4 8", "0 1 2 3 0 4 5 6", "3 6 5 12 15 18 21", faces},
             {"4 4 8", "0 1 2 3 0 4 5 6", "-3 6 9 12 15 18 21", faces},
             {"4 4 8", "0 1 2 3 0 4 5 6", ends, "1 2 3 0 1 2 0 2 3 0 3 1 4 1 2 4 2 3 4 3 5"},
             {"4 4 8", "0 1 2 3 0 4 5 6", ends, "1 2 3 0 1 2 0 2 3 0 3 1 4 1 2 4 2 3 4 3 -1"},
             {"4 4 8", "0 1 2 3 0 0 0 0", "3 6 9 12", "1 2 3 0 1 2 0 2 3 0 3 1"}}) {
        const std::string arrays = numbered(offsets, of_cells, face_offsets, nodes);
        EXPECT_FALSE(read_text(file(arrays))) << arrays;
    }
}

// Structured grids.

std::string xml_grid(const std::string& type, const std::string& attributes, const std::string& extent,
                     const std::string& inside) {
    return "<VTKFile type='" + type + "'>\n<" + type + " WholeExtent='" + extent + "' " + attributes +
           ">\n<Piece Extent='" + extent + "'>\n" + inside + "</Piece></" + type + "></VTKFile>\n";
}

const std::string grid_fields =
    "<PointData><DataArray type='Float64' Name='T'>0 1 2 3 4 5 6 7 8 9 10 11</DataArray></PointData><CellData>"
    "<DataArray type='Float64' Name='q'>.5 .25</DataArray></CellData>";

/// 3 x 2 x 2 points, of which x are 0 1 3, y 0 2, z 0 1: in all kinds of files with points that may be any.
Texts boxes(bool flat) {
    std::string points;
    for (int k = 0; k < (flat ? 1 : 2); ++k) {
        for (int j = 0; j < 2; ++j) {
            for (const char* x : {"0 ", "1 ", "3 "})
                points += x + std::to_string(2 * j) + " " + std::to_string(k) + "\n";
        }
    }
    const std::string extent = flat ? "0 2 0 1 0 0" : "0 2 0 1 0 1", z = flat ? "0" : "0 1",
                      fields = flat ? "" : grid_fields, count = flat ? "6" : "12";
    std::string coordinates = "<Coordinates>";
    for (const std::string& axis : {std::string("0 1 3"), std::string("0 2"), z})
        coordinates += "<DataArray type='Float64'>" + axis + "</DataArray>";
    const std::string head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET ",
                      dimensions = std::string("DIMENSIONS 3 2 ") + (flat ? "1\n" : "2\n"),
                      legacy_fields = flat
                                          ? ""
                                          : "CELL_DATA 2\nSCALARS q double 1\nLOOKUP_TABLE default\n.5 .25\nPOINT_DATA "
                                            "12\nSCALARS T double\nLOOKUP_TABLE default\n0 1 2 3 4 5 6 7 8 9 10 11\n";
    return {xml_grid("RectilinearGrid", "", extent, fields + coordinates + "</Coordinates>"),
            xml_grid("StructuredGrid", "", extent,
                     fields + "<Points><DataArray type='Float64' NumberOfComponents='3'>" + points +
                         "</DataArray></Points>"),
            head + "RECTILINEAR_GRID\n" + dimensions + "X_COORDINATES 3 double\n0 1 3\nY_COORDINATES 2 double\n0 2\n" +
                "Z_COORDINATES " + (flat ? "1" : "2") + " double\n" + z + "\n" + legacy_fields,
            head + "STRUCTURED_GRID\n" + dimensions + "POINTS " + count + " double\n" + points + legacy_fields};
}

TEST(VtkShapes, StructuredGrids) {
    const std::vector<double> places{0, 0, 0, 1, 0, 0, 3, 0, 0, 0, 2, 0, 1, 2, 0, 3, 2, 0,
                                     0, 0, 1, 1, 0, 1, 3, 0, 1, 0, 2, 1, 1, 2, 1, 3, 2, 1};
    const Texts solid = boxes(false), plane = boxes(true);
    for (std::size_t i = 0; i < solid.size(); ++i) {
        SCOPED_TRACE(solid[i]);
        const bool along_axes = i % 2 == 0;
        const Result<Mesh> read = read_text(solid[i]);
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->dimension, 3);
        EXPECT_EQ(read->points, places);
        EXPECT_EQ(read->shapes.types, along_axes ? (Types{11, 11}) : (Types{12, 12}));
        EXPECT_EQ(read->shapes.nodes, along_axes ? (Nodes{0, 1, 3, 4, 6, 7, 9, 10, 1, 2, 4, 5, 7, 8, 10, 11})
                                                 : (Nodes{0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10}));
        ASSERT_EQ(read->cell_count(), 12U);
        EXPECT_EQ(read->cell_numbers, (Nodes{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
        EXPECT_EQ(read->cell_fields.at(0).data,
                  (std::vector<double>{.5, .5, .5, .5, .5, .5, .25, .25, .25, .25, .25, .25}));
        EXPECT_EQ(read->point_fields.at(0).data, (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
        EXPECT_TRUE(notes_of(*read).empty());
        const TemporaryFolder folder;
        put(folder / "g.vtk", solid[i]);
        EXPECT_EQ(read_vtk_points(folder / "g.vtk", 3).value(), places);
        const Result<PointData> data = read_vtk_point_data(folder / "g.vtk", 3);
        ASSERT_TRUE(data) << data.error().message();
        EXPECT_EQ(data->fields.at(0).data.size(), 12U);
        const Result<Mesh> unlisted = read_mesh(folder / "g.vtk", {.list_grids = false});
        ASSERT_TRUE(unlisted) << unlisted.error().message();
        ASSERT_NE(unlisted->is_listed(), along_axes);
        EXPECT_EQ(unlisted->point_count(), 12U);
        EXPECT_EQ(unlisted->whole_count(), 2U);
        EXPECT_EQ(unlisted->point_fields.at(0).data, read->point_fields.at(0).data);
        if (along_axes) {
            EXPECT_EQ(unlisted->axes, (std::array<std::vector<double>, 3>{{{0, 1, 3}, {0, 2}, {0, 1}}}));
            EXPECT_TRUE(unlisted->points.empty() && unlisted->cells.empty() && unlisted->shapes.types.empty());
            EXPECT_EQ(unlisted->cell_fields.at(0).data, (std::vector<double>{.5, .25}));
        }

        const Result<Mesh> flat = read_text(plane[i]);
        ASSERT_TRUE(flat) << flat.error().message();
        EXPECT_EQ(flat->dimension, 2);
        EXPECT_EQ(flat->points, (std::vector<double>{0, 0, 1, 0, 3, 0, 0, 2, 1, 2, 3, 2}));
        EXPECT_EQ(flat->shapes.types, along_axes ? (Types{8, 8}) : (Types{9, 9}));
        EXPECT_EQ(flat->shapes.nodes, along_axes ? (Nodes{0, 1, 3, 4, 1, 2, 4, 5}) : (Nodes{0, 1, 4, 3, 1, 2, 5, 4}));
        EXPECT_EQ(flat->cell_count(), 4U);
    }
}

TEST(VtkShapes, Images) {
    // origin + spacing * index, with two roundings.
    const std::string vti = xml_grid("ImageData", "Origin='.1 -1 0' Spacing='.1 2 -3'", "-1 1 5 6 0 1", grid_fields),
                      vtk =
                          "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\nSPACING "
                          ".1 2 -3\nORIGIN .1 -1 0\nCELL_DATA 2\nSCALARS q double\nLOOKUP_TABLE default\n.5 .25\n";
    const Result<Mesh> image = read_text(vti), legacy = read_text(vtk);
    ASSERT_TRUE(image) << image.error().message();
    ASSERT_TRUE(legacy) << legacy.error().message();
    EXPECT_EQ(image->shapes.types, (Types{11, 11}));
    EXPECT_TRUE(image->shapes == legacy->shapes);
    EXPECT_EQ(image->cell_fields.at(0).data, legacy->cell_fields.at(0).data);
    const double tenth = .1;
    for (std::size_t i = 0; i < 12; ++i) {
        const auto n = static_cast<double>(i % 3);
        EXPECT_EQ(image->points[3 * i], tenth + tenth * (n - 1));
        EXPECT_EQ(legacy->points[3 * i], tenth + tenth * n);
        EXPECT_EQ(image->points[3 * i + 1], i / 3 % 2 == 0 ? 9 : 11);
        EXPECT_EQ(legacy->points[3 * i + 1], i / 3 % 2 == 0 ? -1 : 1);
        EXPECT_EQ(legacy->points[3 * i + 2], i < 6 ? 0 : -3);
    }
    // Points alone, where cells have values.
    const TemporaryFolder folder;
    put(folder / "g.vtk", vtk);
    EXPECT_EQ(read_vtk_points(folder / "g.vtk", 3).value(), legacy->points);
    put(folder / "g.vti", vti);
    EXPECT_EQ(read_vtk_points(folder / "g.vti", 3).value(), image->points);
    EXPECT_EQ(mesh_files(folder / "g.vti"), Texts{folder / "g.vti"});
    EXPECT_TRUE(read_mesh(folder / "g.vti"));
    // Grids without increasing axes are listed: the third coordinates of these fall. So are ghosts, other planes, and
    // grids of one file.
    for (const std::string& text : {vti, vtk}) {
        put(folder / "g.vtk", text);
        EXPECT_TRUE(read_mesh(folder / "g.vtk", {.list_grids = false})->is_listed());
    }
    const std::string ghosts = "<CellData><DataArray type='UInt8' Name='vtkGhostType'>0 32</DataArray></CellData>";
    for (const std::string& fields : {std::string(), ghosts}) {
        put(folder / "g.vti", xml_grid("ImageData", "", "0 2 0 1 0 1", fields));
        EXPECT_EQ(read_mesh(folder / "g.vti", {.list_grids = false})->is_listed(), !fields.empty());
        EXPECT_TRUE(read_mesh(folder / "g.vti")->is_listed());
    }
    put(folder / "g.vti", xml_grid("ImageData", "", "0 2 0 1 0 1", ""));
    put(folder / "h.vti", xml_grid("ImageData", "Origin='5 0 0'", "0 2 0 1 0 1", ""));
    put(folder / "b.vtm",
        "<VTKFile type='vtkMultiBlockDataSet'><vtkMultiBlockDataSet><DataSet index='0' file='g.vti'/>"
        "<DataSet index='1' file='h.vti'/></vtkMultiBlockDataSet></VTKFile>");
    const Result<Mesh> blocks = read_mesh(folder / "b.vtm", {.list_grids = false});
    ASSERT_TRUE(blocks) << blocks.error().message();
    EXPECT_TRUE(blocks->is_listed());
    EXPECT_EQ(blocks->shapes.count(), 4U);
    // A billion cells without values in some kilobytes.
    put(folder / "g.vti", xml_grid("ImageData", "", "0 1000 0 1000 0 1000", ""));
    const Result<Mesh> large = read_mesh(folder / "g.vti", {.list_grids = false});
    ASSERT_TRUE(large) << large.error().message();
    EXPECT_EQ(large->cell_count(), 1000000000U);
    // Grids along one axis, of one point or none have no cells that make a mesh; other planes are none of a mesh.
    for (const char* extent : {"0 2 0 0 0 0", "0 0 0 0 0 0", "0 -1 0 -1 0 -1", "5 6 0 0 0 0"}) {
        const Result<Mesh> read = read_text(xml_grid("ImageData", "", extent, ""));
        ASSERT_FALSE(read) << extent;
        EXPECT_EQ(read.error().what, "the file contains no mesh") << extent;
    }
    const Result<Mesh> upright = read_text(xml_grid("ImageData", "", "0 2 0 0 0 1", ""));
    expect_error(upright, "m", 0, "z of point 3 (from 0)", "0, as the mesh is 2D", "1", "z = 0");
}

TEST(VtkShapes, BlankedCells) {
    const std::string ghosts =
        "<CellData><DataArray type='UInt8' Name='vtkGhostType'>0 32 0 1</DataArray>"
        "<DataArray type='Float64' Name='q'>1 2 3 4</DataArray></CellData>";
    const Result<Mesh> image = read_text(xml_grid("ImageData", "", "0 2 0 2 0 1", ghosts));
    ASSERT_TRUE(image) << image.error().message();
    EXPECT_EQ(image->shapes.types, (Types{11, 11}));
    EXPECT_EQ(image->shapes.nodes.front(), 0);
    EXPECT_EQ(image->shapes.nodes[8], 3);
    EXPECT_EQ(image->cell_numbers, (Nodes{0, 0, 0, 0, 0, 0, 2, 2, 2, 2, 2, 2}));
    const auto q = std::ranges::find(image->cell_fields, "q", &Field::name);
    ASSERT_NE(q, image->cell_fields.end());
    EXPECT_EQ(q->data, (std::vector<double>{1, 1, 1, 1, 1, 1, 3, 3, 3, 3, 3, 3}));
    EXPECT_EQ(notes_of(*image),
              Texts{"2 ghost cells, which stand for cells of other pieces or are hidden (vtkGhostType)"});
    EXPECT_EQ(image->point_count(), 18U);
}

struct BadGrid {
    std::string text;
    std::size_t line;
    const char *what, *expected, *found;
};

TEST(VtkShapes, GridsThatAreNone) {
    const std::string head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET ", points = head + "STRUCTURED_POINTS\n",
                      axes = head + "RECTILINEAR_GRID\n", grid = head + "STRUCTURED_GRID\n",
                      xyz = "X_COORDINATES 2 double\n0 1\nY_COORDINATES 2 double\n0 1\nZ_COORDINATES 2 double\n0 1\n",
                      eight = "POINTS 8 double\n" + std::string(8, ' ') +
                              "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\n";
    ASSERT_TRUE(read_text(axes + "DIMENSIONS 2 2 2\n" + xyz));
    ASSERT_TRUE(read_text(grid + "DIMENSIONS 2 2 2\n" + eight));
    ASSERT_TRUE(read_text(points + "DIMENSIONS 2 2 2\n"));
    const char* const of_grid = "the points of the grid";
    const char* const most = "2147483647 points at most";
    for (const BadGrid& bad : std::vector<BadGrid>{
             {points, 5, of_grid, "DIMENSIONS before data", "none"},
             {points + "DIMENSIONS 0 2 2\n", 0, "the file contains no mesh", nullptr, "0 cells of other kinds"},
             {points + "DIMENSIONS 2147483647 0 0\n", 0, "the file contains no mesh", nullptr, nullptr},
             {points + "DIMENSIONS 2 2\n", 6, "the points along an axis", "a count up to 2147483647",
              "the end of the file"},
             {points + "DIMENSIONS 2 2 -2\n", 5, "the points along an axis", nullptr, "\"-2\""},
             {points + "DIMENSIONS 2 2 99999999999999999999\n", 5, "the points along an axis", nullptr, nullptr},
             {points + "DIMENSIONS 2147483647 2147483647 2147483647\n", 5, of_grid, most, "more"},
             {points + "DIMENSIONS 65536 32768 1\n", 5, of_grid, most, "more"},
             {points + "DIMENSIONS 2 2 2\nDIMENSIONS 1 1 1\n", 6, "a second line DIMENSIONS", "one", "two"},
             {points + "DIMENSIONS 2 2 2\nSPACING 1 1 nan\n", 6, "the origin or spacing of the grid", "a finite number",
              "\"nan\""},
             {points + "DIMENSIONS 2 2 2\nORIGIN 1 1\n", 7, "the origin or spacing of the grid", nullptr, "\"\""},
             {points + "DIMENSIONS 2 2 2\n" + eight, 6, of_grid, "DIMENSIONS and what lies along the axes", "POINTS"},
             {points + "DIMENSIONS 2 2 2\nX_COORDINATES 2 double\n0 1\n", 6, "a keyword of the format", nullptr,
              "\"X_COORDINATES\""},
             {points + "DIMENSIONS 2 2 2\nCELL_TYPES 1\n12\n", 6, "a keyword of the format", nullptr, "\"CELL_TYPES\""},
             {points + "DIMENSIONS 2 2 2\nCELL_DATA 2\n", 6, "the rows of CELL_DATA", "1, one a cell", "2"},
             {points + "DIMENSIONS 2 2 2\nPOINT_DATA 7\n", 6, "the rows of POINT_DATA", "8, one a point", "7"},
             {points + "DIMENSIONS 2 2 2\nCELL_DATA 1\nSCALARS q double\nLOOKUP_TABLE default\n", 8, "array \"q\"",
              "1 numbers", "0"},
             {axes + "DIMENSIONS 2 2 2\n", 6, of_grid, "X_COORDINATES before data", "none"},
             {axes + xyz, 5, "the points along an axis", "0, as DIMENSIONS says", "2"},
             {axes + "DIMENSIONS 2 3 2\n" + xyz, 8, "the points along an axis", "3, as DIMENSIONS says", "2"},
             {axes + "DIMENSIONS 2 2 2\n" + xyz + "X_COORDINATES 2 double\n0 1\n", 12, "a second section X_COORDINATES",
              "one", "two"},
             {axes + "DIMENSIONS 2147483647 1 1\nX_COORDINATES 2147483647 double\n0 1\n", 5, of_grid, nullptr, "more"},
             {axes + "X_COORDINATES 0 double\nY_COORDINATES 0 double\nZ_COORDINATES 0 double\nDIMENSIONS 2 2 2\n", 9,
              of_grid, "X_COORDINATES before data", "none"},
             {grid + eight, 5, of_grid, "DIMENSIONS before POINTS", "none"},
             {grid + "DIMENSIONS 2 2 2\nPOINT_DATA 8\n", 6, of_grid, "POINTS before data", "none"},
             {grid + "DIMENSIONS 2 2 2\n", 6, of_grid, "POINTS before data", "none"},
             {grid + "DIMENSIONS 2 2 3\n" + eight, 6, "the number of points", "12, as DIMENSIONS says", "8"},
             {grid + "DIMENSIONS 2 2 2\n" + eight + "DIMENSIONS 3 3 3\n", 8, "a second line DIMENSIONS", "one", "two"},
             {grid + "DIMENSIONS 1 1 1\nCELL_TYPES 1\n12\nPOINTS 1 double\n0 0 0\n", 6, "a keyword of the format",
              nullptr, "\"CELL_TYPES\""},
             {grid + "DIMENSIONS 2 2 2\n" + eight + "CELLS 1 9\n8 0 1 2 3 4 5 6 7\n", 8, "a keyword of the format",
              nullptr, "\"CELLS\""},
             {xml_grid("ImageData", "", "0 1 0 1 0", ""), 3, "the extent of the piece", nullptr, nullptr},
             {xml_grid("ImageData", "", "0 1 0 1 0 1 0", ""), 3, "the extent of the piece", nullptr, nullptr},
             {xml_grid("ImageData", "", "0 1 0 1 0 99999999999999999999", ""), 3, "the extent of the piece", nullptr,
              nullptr},
             {xml_grid("ImageData", "", "-2147483647 2147483647 -2147483647 2147483647 0 0", ""), 3, of_grid, most,
              nullptr},
             {xml_grid("ImageData", "", "0 65535 0 32767 0 0", ""), 3, of_grid, most, nullptr},
             {xml_grid("ImageData", "Spacing='1 1'", "0 1 0 1 0 1", ""), 2, "the origin and spacing of the grid",
              "three finite numbers each", "\"0 0 0\" and \"1 1\""},
             {xml_grid("ImageData", "Spacing='1 1 inf'", "0 1 0 1 0 1", ""), 2, "the origin and spacing of the grid",
              nullptr, nullptr},
             {xml_grid("ImageData", "Direction='0 1 0 1 0 0 0 0 1'", "0 1 0 1 0 1", ""), 2, "the direction of the grid",
              nullptr, nullptr},
             {xml_grid("ImageData", "", "0 1 0 1 0 1",
                       "<CellData><DataArray type='Int8' Name='q'>1 2</DataArray></CellData>"),
              4, "array \"q\"", "1 numbers", "more"},
             {xml_grid("ImageData", "", "0 1 0 1 0 1",
                       "<PointData><DataArray type='Int8' Name='q'>1 2</DataArray></PointData>"),
              4, "array \"q\"", "8 numbers", "2"},
             {xml_grid("RectilinearGrid", "", "0 1 0 1 0 1", ""), 3, "the points of a piece",
              "three arrays in Coordinates", "0"},
             {xml_grid("RectilinearGrid", "", "0 1 0 2147483647 0 1", ""), 3, of_grid, most, nullptr},
             {xml_grid("RectilinearGrid", "", "0 1 0 1 0 1",
                       "<Coordinates><DataArray type='Int8'>0 1</DataArray><DataArray type='Int8'>0 1</DataArray>"
                       "</Coordinates>"),
              3, "the points of a piece", "three arrays in Coordinates", "2"},
             {xml_grid("RectilinearGrid", "", "0 1 0 1 0 2",
                       "<Coordinates><DataArray type='Int8'>0 1</DataArray><DataArray type='Int8'>0 1</DataArray>"
                       "<DataArray type='Int8'>0 1</DataArray></Coordinates>"),
              4, "the coordinates along an axis", "3 numbers", "2"},
             {xml_grid("StructuredGrid", "", "0 1 0 1 0 1", ""), 3, "the points of a piece", "an array in Points",
              "none"},
             {xml_grid("StructuredGrid", "", "0 1 0 1 0 1",
                       "<Points><DataArray type='Float64' NumberOfComponents='3'>1 2 3</DataArray></Points>"),
              4, "the coordinates", "24 numbers", "3"},
         }) {
        SCOPED_TRACE(bad.text);
        expect_error(read_text(bad.text), "m", bad.line, bad.what, bad.expected, bad.found, nullptr);
    }
    // Grids of another piece, or of several.
    std::string part = xml_grid("ImageData", "", "0 1 0 1 0 1", "");
    part.replace(part.find("<Piece Extent='0 1"), 18, "<Piece Extent='0 0");
    EXPECT_EQ(read_text(part).error().what, "the extent of the piece");
    std::string more = xml_grid("ImageData", "", "0 1 0 1 0 1", "</Piece><Piece Extent='0 1 0 1 0 1'>");
    EXPECT_EQ(read_text(more).error().what, "a grid in several pieces");
}

/// A few bytes that name billions of points are refused before there is memory for them.
TEST(VtkShapes, HugeGridsTakeNoMemory) {
    rusage before{}, after{};
    getrusage(RUSAGE_SELF, &before);
    const TemporaryFolder folder;
    for (const char* counts : {"2147483647 1 1", "46340 46340 1", "1290 1290 1290", "2147483647 0 0"}) {
        for (const char* kind : {"STRUCTURED_POINTS", "RECTILINEAR_GRID", "STRUCTURED_GRID"}) {
            put(folder / "m.vtk", std::string("# vtk DataFile Version 3.0\nt\nBINARY\nDATASET ") + kind +
                                      "\nDIMENSIONS " + counts + "\nX_COORDINATES 2147483647 double\n");
            EXPECT_FALSE(read_quietly(folder / "m.vtk")) << kind << counts;
        }
    }
    for (const char* extent : {"0 2147483646 0 0 0 0", "0 46339 0 46339 0 0", "1 1290 1 1290 1 1290"}) {
        for (const char* kind : {"ImageData", "RectilinearGrid", "StructuredGrid"}) {
            put(folder / "m.vtu", xml_grid(kind, "", extent, ""));
            EXPECT_FALSE(read_quietly(folder / "m.vtu")) << kind << extent;
        }
    }
    getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100000) << "kilobytes";
}

/// Numbers of files that are others: an error, or a mesh that is consistent.
TEST(VtkShapes, NumbersThatAreOthers) {
    const TemporaryFolder folder;
    Texts files = boxes(false);
    for (const Mesh& mesh : {all_solids(), all_polygons()}) {
        ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu", VtkData::ascii));
        ASSERT_TRUE(write_vtk(mesh, folder / "m.vtk", VtkData::ascii));
        files.push_back(get(folder / "m.vtu"));
        files.push_back(get(folder / "m.vtk"));
    }
    files.push_back(cells_file(
        5, "42 10 42", "4 8 12", "0 1 2 3 0 1 2 4 1 2 3 4",
        numbered("4 4 8", "0 1 2 3 0 4 5 6", "3 6 9 12 15 18 21", "1 2 3 0 1 2 0 2 3 0 3 1 4 1 2 4 2 3 4 3 1")));
    base::Random random(42);
    std::size_t good = 0, bad = 0;
    for (const std::string& text : files) {
        std::vector<std::size_t> words;  // where numbers begin
        for (std::size_t i = 1; i < text.size(); ++i) {
            const bool digit = text[i] >= '0' && text[i] <= '9';
            if (digit && std::string_view(" >\n'\"").find(text[i - 1]) != std::string_view::npos) words.push_back(i);
        }
        ASSERT_GT(words.size(), 20U);
        for (int i = 0; i < 400; ++i) {
            std::string changed = text;
            const std::size_t at = words[static_cast<std::size_t>(random.below(words.size()))],
                              end = text.find_first_not_of("0123456789.", at);
            constexpr std::array<const char*, 14> others{"0",  "1",  "2",  "3",  "4",  "5",          "7",
                                                         "12", "42", "-1", "-9", "71", "2000000000", ""};
            const char* const other = others[static_cast<std::size_t>(random.below(others.size()))];
            changed.replace(at, end - at, other);
            put(folder / "d", changed);
            const Result<Mesh> read = read_quietly(folder / "d");
            ++(read ? good : bad);
            if (!read) continue;
            const char* const fault = mesh::inconsistency(*read, mesh::FieldValues::any);
            EXPECT_EQ(fault, nullptr) << changed;
            EXPECT_EQ(read->cell_numbers.empty() ? read->cell_count() : read->cell_numbers.size(), read->cell_count());
        }
    }
    EXPECT_GT(good, 300U);
    EXPECT_GT(bad, 300U);
}

}  // namespace
}  // namespace barycert::testing
