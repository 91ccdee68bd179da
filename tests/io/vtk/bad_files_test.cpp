/// Files that are damaged or that hold no mesh of ours: an error with the file's name, never a crash, nothing printed.
#include <functional>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/io/vtk/good_files.hpp"
#include "tests/io/vtk/mesh_notes.hpp"

namespace barycert::testing {
namespace {

struct Change {
    const char* from;
    const char* to;
    const char* what;  ///< what the error says
    const char* expected;
    const char* found;
    std::size_t line;
};

std::string changed(std::string text, const Change& change) {
    const std::size_t at = text.find(change.from);
    EXPECT_NE(at, std::string::npos) << change.from;
    return text.replace(at, std::string(change.from).size(), change.to);
}

void expect_refusal(const std::string& text, const Change& change) {
    SCOPED_TRACE(change.to);
    const TemporaryFolder folder;
    put(folder / "m", changed(text, change));
    const Result<Mesh> read = read_quietly(folder / "m");
    ASSERT_FALSE(read);
    SCOPED_TRACE(read.error().message());
    EXPECT_EQ(read.error().file, folder / "m");
    EXPECT_EQ(read.error().what, change.what);
    EXPECT_EQ(read.error().expected, change.expected);
    EXPECT_EQ(read.error().found, change.found);
    EXPECT_EQ(read.error().line, change.line);
}

TEST(BadVtkFiles, TheFilesThatAreChangedAreGood) {
    const TemporaryFolder folder;
    for (const std::string& text : {xml, legacy}) {
        put(folder / "m", text);
        const Result<Mesh> read = read_quietly(folder / "m");
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->points[11], 0.5);
        EXPECT_EQ(read->point_fields[0].data, (std::vector<double>{1, 2, 3, 4}));
    }
    put(folder / "m", changed(changed(xml, {"'4' N", "' +4 ' N", "", "", "", 0}),
                              {"NumberOfCells='1'", "NumberOfCells='1\t'", "", "", "", 0}));
    EXPECT_TRUE(read_quietly(folder / "m"));
    // A bracket in a value and elements beside the numbers are none of them.
    put(folder / "m",
        changed(xml, {"Name='f' format='ascii'>1 2 3 4",
                      "Name='a>b' format='ascii'>1 2 3 4<InformationKey name='x'>5</InformationKey>", "", "", "", 0}));
    EXPECT_TRUE(read_quietly(folder / "m"));
    put(folder / "m",
        changed(xml, {">1 2 3 4", ">\n<InformationKey name='x'>5</InformationKey>\n1 2 3 4", "", "", "", 0}));
    EXPECT_TRUE(read_quietly(folder / "m"));
}

TEST(BadVtkFiles, Xml) {
    const char* const array_type = "Int8 to UInt64, Float32, Float64 or Bit";
    for (const Change& change : std::vector<Change>{
             {"'4' N", "'5' N", "the coordinates", "15 numbers", "12", 8},
             {"'4' N", "'3' N", "the coordinates", "9 numbers", "more", 8},
             {"'4' N", "'-1' N", "the attribute NumberOfPoints", "a count, at most 2147483647 in all pieces", "\"-1\"",
              3},
             {"'4' N", "'99999999999999999999' N", "the attribute NumberOfPoints",
              "a count, at most 2147483647 in all pieces", "\"99999999999999999999\"", 3},
             {"'4' N", "'2147483647' N", "the coordinates", "6442450941 numbers", "12", 8},
             {"NumberOfCells='1'", "", "the attribute NumberOfCells", "a count, at most 2147483647 in all pieces",
              "none", 3},
             {"NumberOfCells='1'", "NumberOfCells='2'", "the types of cells", "2 numbers", "1", 13},
             {"NumberOfComponents='3'", "NumberOfComponents='2'", "the components of the points", "3", "\"2\"", 8},
             {"0.5<", "nan<", "z of point 3 (from 0)", "a finite number", "nan", 0},
             {"0.5<", "-inf<", "z of point 3 (from 0)", "a finite number", "-inf", 0},
             {"0.5<", "0,5<", "number 11 (from 0) of the coordinates", "a number of the type of the array", "\"0,5\"",
              8},
             {"0 1 2 3<", "0 1 2 4<", "a node of a cell", "a point below 4", "4", 11},
             {"0 1 2 3<", "0 1 2 -1<", "a node of a cell", "a point below 4", "-1", 11},
             {"0 1 2 3<", "0 1 2 4294967296<", "number 3 (from 0) of the connectivity",
              "a number that fits what it stands for", "4294967296", 11},
             {"0 1 2 3<", "0 1 2<", "the connectivity", "4 numbers", "3", 11},
             {">4<", ">5<", "the connectivity", "5 numbers", "4", 11},
             {">4<", ">-4<", "the offsets of cells", "none below the one before it", "-4 after 0", 12},
             {">4<", ">3<", "the connectivity", "3 numbers", "more", 11},
             {">10<", ">41<", "cells whose corners are not known",
              "polygons, polyhedra and what has a shape of its own", "1 vtkConvexPointSet (type 41)", 0},
             {">10<", ">200<", "cells whose corners are not known",
              "polygons, polyhedra and what has a shape of its own", "1 unknown type 200 (type 200)", 0},
             {">10<", ">42<", "the faces of polyhedra", "an array faceoffsets", "none", 3},
             {">10<", ">12<", "the nodes of cell 0 (from 0)", "8 in a vtkHexahedron (type 12)", "4", 0},
             {">10<", ">72<", "the nodes of cell 0 (from 0)", "8 or more in a vtkLagrangeHexahedron (type 72)", "4", 0},
             {">10<", ">24<", "the nodes of cell 0 (from 0)", "10 in a vtkQuadraticTetra (type 24)", "4", 0},
             {">10<", ">5<", "the nodes of cell 0 (from 0)", "3 in a vtkTriangle (type 5)", "4", 0},
             {">10<", ">4<", "the file contains no mesh", "cells that fill space, or polygons in the plane z = 0",
              "1 cells of other kinds", 0},
             {">10<", ">256<", "number 0 (from 0) of the types of cells", "a number of the type of the array",
              "\"256\"", 13},
             {"Name='types'", "Name='kinds'", "the cells of a piece", "arrays connectivity, offsets and types",
              "not all three", 3},
             {"Int64' Name='c", "Int65' Name='c", "the type of the connectivity", array_type, "\"Int65\"", 11},
             {"1 2 3 4<", "1 2 3<", "array \"f\"", "4 numbers", "3", 5},
             {"1 2 3 4<", "1 2 3,5 4<", "number 2 (from 0) of array \"f\"", "a number of the type of the array",
              "\"3,5\"", 5},
             {"Float32' Name='f'", "Float2' Name='f'", "the attribute type of array \"f\"",
              "Int8 to UInt64, Float32, Float64, Bit or String", "\"Float2\"", 5},
             {"format='ascii'", "format='text'", "the format of array \"f\"", "ascii, binary or appended", "\"text\"",
              5},
             {"format='ascii'", "format='appended'", "the offset of array \"f\" into the appended data",
              "less than 0, the bytes from there to the end of the file", "\"\"", 5},
             {"format='ascii'", "format='ascii' NumberOfComponents='0'", "the components of array \"f\"",
              "a count of 1 or more", "\"0\"", 5},
             {"</PointData>", "<DataArray type='Int8' Name='f'>1 2 3 4</DataArray></PointData>",
              "two arrays in one PointData", "different names", "\"f\" twice", 6},
             {"LittleEndian", "MiddleEndian", "the attribute byte_order of the file", "LittleEndian, BigEndian",
              "\"MiddleEndian\"", 1},
             {"byte_order", "header_type='UInt16' byte_order", "the attribute header_type of the file",
              "UInt32, UInt64", "\"UInt16\"", 1},
             {"byte_order", "compressor='zip' byte_order", "the attribute compressor of the file",
              "vtkZLibDataCompressor, vtkLZ4DataCompressor, vtkLZMADataCompressor", "\"zip\"", 1},
             {"type='UnstructuredGrid'", "type='PUnstructuredGrid'", "the kind of the file",
              "a VTKFile of type UnstructuredGrid, PolyData, ImageData, RectilinearGrid or StructuredGrid",
              "no element of its type \"PUnstructuredGrid\"", 1},
         }) {
        expect_refusal(xml, change);
    }
}

TEST(BadVtkFiles, Legacy) {
    const char* const data_types = "double, float, int and the like";
    for (const Change& change : std::vector<Change>{
             {"POINTS 4", "POINTS 5", "number 12 (from 0) of the coordinates", "a number of the type of the array",
              "\"CELLS\"", 7},
             {"POINTS 4", "POINTS 2147483648", "the number of points", "a count up to 2147483647", "\"2147483648\"", 5},
             {"POINTS 4", "POINTS -4", "the number of points", "a count up to 2147483647", "\"-4\"", 5},
             {"POINTS 4 double", "POINTS 4 real", "the type of the points", data_types, "\"real\"", 5},
             {"POINTS 4 double", "POINTS 3 double", "a keyword of the format", "POINTS, CELLS, POINT_DATA and the like",
              "\"0\"", 6},
             {"0 0 0.5", "0 0 nan", "z of point 3 (from 0)", "a finite number", "nan", 0},
             {"4 0 1 2 3", "5 0 1 2 3", "the nodes of cell 0 (from 0)",
              "as many as fit in the 5 numbers of the section", "5", 8},
             {"4 0 1 2 3", "100000000 0 1 2 3", "the nodes of cell 0 (from 0)",
              "as many as fit in the 5 numbers of the section", "100000000", 8},
             {"4 0 1 2 3", "-4 0 1 2 3", "the nodes of cell 0 (from 0)",
              "as many as fit in the 5 numbers of the section", "-4", 8},
             {"4 0 1 2 3", "3 0 1 2 3", "the size of the cells", "4 numbers, as the cells have", "5", 8},
             {"4 0 1 2 3", "4 0 1 2 7", "a node of cell 0 (from 0)", "a point below 4", "7", 0},
             {"CELLS 1", "CELLS 2", "the nodes of cell 1 (from 0)", "as many as fit in the 5 numbers of the section",
              "none", 8},
             {"CELL_TYPES 1\n10\n", "", "the cell types", "1, one a cell", "0", 13},
             {"\n10\n", "\n11\n", "the nodes of cell 0 (from 0)", "8 in a vtkVoxel (type 11)", "4", 0},
             {"\n10\n", "\n41\n", "cells whose corners are not known",
              "polygons, polyhedra and what has a shape of its own", "1 vtkConvexPointSet (type 41)", 0},
             {"POINT_DATA 4", "POINT_DATA 3", "the rows of POINT_DATA", "4, one a point", "3", 11},
             {"f 1 4 float", "f 1 5 float", "the rows of array \"f\"", "4", "5", 13},
             {"f 1 4 float", "f 0 4 float", "the components of array \"f\"", "1 or more", "0", 13},
             {"f 1 4 float", "f 2147483647 4 float", "array \"f\"", "8589934588 numbers", "4", 13},
             {"f 1 4 float", "f 1 4 quad", "the type of array \"f\"", data_types, "\"quad\"", 13},
             {"FieldData 1", "FieldData 2", "the components of array \"\"", "a count up to 2147483647",
              "the end of the file", 15},
             {"1 2 3 4\n", "1 2 3", "array \"f\"", "4 numbers", "3", 13},
             {"1 2 3 4\n", "1 2 3 4", "the last row has no line end, so the file may be cut short", "a line end",
              "the end of the file", 14},
             {"1 2 3 4", "1 +-2 3 4", "number 1 (from 0) of array \"f\"", "a number of the type of the array",
              "\"+-2\"", 14},
             {"0 1 2 3\nC", "0 +-1 2 3\nC", "number 2 (from 0) of the cells", "a number of the type of the array",
              "\"+-1\"", 8},
             {"0 0 0.5", "0 0 0x10", "number 11 (from 0) of the coordinates", "a number of the type of the array",
              "\"0x10\"", 6},
             {"0 0 0.5", "0 0 0,5", "number 11 (from 0) of the coordinates", "a number of the type of the array",
              "\"0,5\"", 6},
             {"Version 4.2", "Version 4.2x", "the first line", "\"# vtk DataFile Version 4.2\" or the like", "\"4.2x\"",
              1},
             {"Version 4.2", "Version x", "the first line", "\"# vtk DataFile Version 4.2\" or the like", "\"x\"", 1},
             {"Version 4.2", "Version 5.1", "a keyword of the format", "OFFSETS", "\"4\"", 8},
             {"ASCII", "TEXT", "the third line", "ASCII or BINARY", "\"TEXT\"", 3},
             {"ASCII", "BINARY", "a keyword of the format", "POINTS, CELLS, POINT_DATA and the like", "\"4\"", 0},
             {"UNSTRUCTURED_GRID", "FIELD", "the kind of the data set",
              "UNSTRUCTURED_GRID, POLYDATA, STRUCTURED_POINTS, RECTILINEAR_GRID or STRUCTURED_GRID", "\"FIELD\"", 4},
             {"UNSTRUCTURED_GRID", "RECTILINEAR_GRID", "the points of the grid",
              "DIMENSIONS and what lies along the axes", "POINTS", 5},
             {"UNSTRUCTURED_GRID", "STRUCTURED_GRID", "the points of the grid", "DIMENSIONS before POINTS", "none", 5},
             {"UNSTRUCTURED_GRID", "STRUCTURED_GRID\nDIMENSIONS 2 2 1", "a keyword of the format",
              "POINTS, CELLS, POINT_DATA and the like", "\"CELLS\"", 8},
         }) {
        expect_refusal(legacy, change);
    }
}

TEST(BadVtkFiles, ANumberNamesItsOwnLine) {
    const char* const not_of_type = "a number of the type of the array";
    const char* const does_not_fit = "a number that fits what it stands for";
    const char* const coordinate = "number 10 (from 0) of the coordinates";
    const char* const node = "number 3 (from 0) of the connectivity";
    expect_refusal(xml, {"0 0 0.5<", "\n0\nO 0.5<", coordinate, not_of_type, "\"O\"", 10});
    expect_refusal(xml, {"0 1 2 3<", "0\n1 2\n\n3000000000 <", node, does_not_fit, "3000000000", 14});
    expect_refusal(legacy, {"0 0 0.5\n", "\n0\nO 0.5\n", coordinate, not_of_type, "\"O\"", 8});
    expect_refusal(legacy, {"4 0 1 2 3", "4\n0 1 2\n3000000000", "number 4 (from 0) of the cells", not_of_type,
                            "\"3000000000\"", 10});
    // Far behind the line where the array begins, in a part that another thread reads.
    std::string many;
    for (int i = 0; i < 100000; ++i) many += "0 0 0.25\n";
    expect_refusal(
        "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='100001' NumberOfCells='0'>"
        "<Points><DataArray type='Float64' NumberOfComponents='3'>\n" +
            many +
            "0 0 0\n</DataArray></Points>"
            "</Piece></UnstructuredGrid></VTKFile>",
        {"0 0 0\n", "0 0 z\n", "number 300002 (from 0) of the coordinates", not_of_type, "\"z\"", 100002});
}

TEST(BadVtkFiles, OffsetsOfVersion5) {
    const std::string text =
        "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 "
        "0.5\n"
        "CELLS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2 3\nCELL_TYPES 1\n10\n";
    const TemporaryFolder folder;
    put(folder / "m", text);
    ASSERT_TRUE(read_quietly(folder / "m"));
    const char* const expected = "0 first, none below the one before it, 4 last";
    for (const char* offsets : {"0 5", "0 3", "1 4", "4 0", "0 -4", "4 4"}) {
        expect_refusal(text, {"\n0 4\n", (std::string("\n") + offsets + "\n").c_str(), "the offsets of cells", expected,
                              "others", 11});
    }
    expect_refusal(text, {"CELLS 2 4", "CELLS 1 4", "a keyword of the format", "CONNECTIVITY", "\"4\"", 9});
}

TEST(BadVtkFiles, TrianglesOffThePlane) {
    const TemporaryFolder folder;
    std::string text = changed(xml, {"0 1 2 3<", "0 1 2<", "", "", "", 0});
    text = changed(changed(text, {">4<", ">3<", "", "", "", 0}), {">10<", ">5<", "", "", "", 0});
    put(folder / "m", text);
    const Result<Mesh> read = read_quietly(folder / "m");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().what, "z of point 3 (from 0)");
    EXPECT_EQ(read.error().found, "0.5");
    EXPECT_NE(read.error().remedy.find("a surface in space is no mesh here"), std::string::npos);
    put(folder / "m", changed(text, {"0.5<", "-0.0<", "", "", "", 0}));
    EXPECT_TRUE(read_quietly(folder / "m"));
}

TEST(BadVtkFiles, NoFiles) {
    const TemporaryFolder folder;
    for (const auto& [text, what] : {std::pair{"", "the file is empty"},
                                     {"4 3 0 0\n", "not a file of VTK"},
                                     {" \n ", "not a file of VTK"},
                                     {"<", "not a well-formed XML file"},
                                     {"<VTKFile", "not a well-formed XML file"},
                                     {"<html><body></html>", "not a well-formed XML file"},
                                     {"<html/>", "the kind of the file"},
                                     {"# vtk", "the first line"}}) {
        put(folder / "m", text);
        const Result<Mesh> read = read_quietly(folder / "m");
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().what, what);
        EXPECT_EQ(read.error().file, folder / "m");
        EXPECT_FALSE(read_vtk_points(folder / "m", 3));
    }
    EXPECT_EQ(read_quietly(folder / "none.vtu").error().file, folder / "none.vtu");
    EXPECT_FALSE(read_quietly(folder / ""));
    std::string deep;
    for (int i = 0; i < 200000; ++i) deep += "<a>";
    put(folder / "m", deep);
    EXPECT_FALSE(read_quietly(folder / "m"));
    for (int i = 0; i < 200000; ++i) deep += "</a>";
    put(folder / "m", deep);
    EXPECT_FALSE(read_quietly(folder / "m"));
}

/// Who asks for points alone is not stopped by an array.
TEST(BadVtkFiles, PointsAreReadBesideABadArray) {
    const TemporaryFolder folder;
    put(folder / "m.vtu",
        "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='1' NumberOfCells='0'>"
        "<PointData><DataArray type='Float64' Name='bad' format='ascii'>x</DataArray></PointData>"
        "<Points><DataArray type='Float64' NumberOfComponents='3' format='ascii'>1 2 3</DataArray></Points>"
        "</Piece></UnstructuredGrid></VTKFile>");
    EXPECT_EQ(read_vtk_points(folder / "m.vtu", 3).value(), (std::vector<double>{1, 2, 3}));
    EXPECT_FALSE(read_vtk_point_data(folder / "m.vtu", 3));
}

/// A compressed array whose header is hostile. VTK's own reader divides by the size of a block.
TEST(BadVtkFiles, HeadersOfCompressedData) {
    const TemporaryFolder folder;
    const auto read = [&](const std::vector<std::uint32_t>& words) {
        std::string raw(reinterpret_cast<const char*>(words.data()), words.size() * 4);
        put(folder / "m",
            "<VTKFile type='UnstructuredGrid' compressor='vtkZLibDataCompressor'><UnstructuredGrid>"
            "<Piece NumberOfPoints='4' NumberOfCells='0'><Points><DataArray type='Float64' "
            "NumberOfComponents='3' format='appended' offset='0'/></Points></Piece></UnstructuredGrid>"
            "<AppendedData encoding='raw'>_" +
                raw + "</AppendedData></VTKFile>");
        Printed printed;
        const Result<std::vector<double>> points = read_vtk_points(folder / "m", 3);
        EXPECT_EQ(printed.text(), "");
        ASSERT_FALSE(points);
        EXPECT_EQ(points.error().file, folder / "m");
    };
    for (const std::vector<std::uint32_t>& words :
         std::vector<std::vector<std::uint32_t>>{{1, 0, 96, 4, 0},
                                                 {1, 96, 0, 4, 0},
                                                 {1, 96, 0, 0xffffffff},
                                                 {0, 0, 0},
                                                 {0xffffffff, 96, 0},
                                                 {2, 0xffffffff, 96, 4, 4, 0, 0},
                                                 {1, 96, 97, 4, 0},
                                                 {1, 96, 96, 0},
                                                 {96, 1, 0},
                                                 {},
                                                 {1},
                                                 {2, 95, 1, 1, 1, 0},
                                                 {1, 0xffffffff, 96, 8, 0, 0}}) {
        read(words);
    }
}

}  // namespace
}  // namespace barycert::testing
