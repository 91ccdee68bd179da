// Files that are refused, and the words.

#include "io/medit/medit.hpp"
#include "tests/io/medit/medit_files.hpp"

namespace barycert::testing {
namespace {

const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
const std::string nodes = "Vertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";
const std::string cells = "Tetrahedra\n1\n1 2 3 4 0\n";

struct Refused {
    std::string text;
    std::size_t line;
    const char *what, *expected, *found;
};

TEST(MeditErrors, ASurfaceInSpaceIsToldHowToBeFilled) {
    const TemporaryFolder folder;
    put(folder / "m.mesh", head + nodes + "Triangles 1 1 2 4 0\nEnd\n");
    const Result<Mesh> read = read_mesh(folder / "m.mesh");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().what, "z of point 3 (from 0)");
    EXPECT_NE(read.error().remedy.find("if it is closed, fill it: `meshio convert " + folder / "m.mesh"),
              std::string::npos)
        << read.error().remedy;
}

TEST(MeditErrors, Text) {
    const std::vector<Refused> all{
        {"MFEM mesh v1.0\n", 1, "not a file of Medit", nullptr, "\"MFEM\""},
        {"", 1, "not a file of Medit", nullptr, "an empty file"},
        {"MeshVersionFormatted 5\n", 1, "the version of the format", "a number from 0 to 4", "\"5\""},
        {"MeshVersionFormatted 2 3\n" + nodes, 1, "more behind the version of the format", "a keyword", "\"3\""},
        {"MeshVersionFormatted 0\nMeshVersionFormatted 0\n", 2, "the version of the format again", "it once",
         "it twice"},
        {head + "Vertices\n1\n0,5 0 0 0\n" + cells, 5, "row 1 (from 1) of Vertices", "a number", "\"0,5\""},
        {head + "Vertices\n1\n0x10 0 0 0\n" + cells, 5, "row 1 (from 1) of Vertices", "a number", "\"0x10\""},
        {"MeshVersionFormatted\n", 2, "the version of the format", nullptr, "the end of the section"},
        {"MeshVersionFormatted 2\n" + nodes + cells, 1, "the dimension", "a keyword Dimension", "none"},
        {"MeshVersionFormatted 2\nDimension\n4\n" + nodes, 3, "the dimension", "a number from 2 to 3", "\"4\""},
        {head + "Dimension 2\n" + nodes + cells, 3, "the dimension again", "it once", "it twice"},
        {"MeshVersionFormatted 2\nDimension 2\n" + nodes + cells, 0, "cells in space, and nodes in the plane", nullptr,
         nullptr},
        {"MeshVersionFormatted 2\nDimension 2\n" + nodes + "Triangles 1 1 2 3 0\n", 7, "more numbers in Vertices",
         "4 rows of 3 numbers", nullptr},
        {head + nodes, 0, "the file contains no mesh", nullptr, "Vertices"},
        {head + cells, 0, "the file contains no mesh", nullptr, nullptr},
        {head + nodes + "Tetrahedra 0\nEdges 1 1 2 0\n", 0, "the file contains no mesh", nullptr, nullptr},
        {head + nodes + nodes + cells, 9, "a second section Vertices", "one", "two"},
        {head + nodes + cells + cells, 12, "a second section Tetrahedra", "one", "two"},
        {head + nodes + "Tetrahedra\n1\n0 1 2 3 0\n", 11, "row 1 (from 1) of Tetrahedra", "a node from 1 to 4", "0"},
        {head + nodes + "Tetrahedra\n2\n1 2 3 4 0\n1 2 3\n5 0\n", 13, "row 2 (from 1) of Tetrahedra",
         "a node from 1 to 4", "5"},
        {head + nodes + "Tetrahedra\n1\n1 2 3 -4 0\n", 11, "row 1 (from 1) of Tetrahedra", nullptr, "-4"},
        {head + nodes + "Tetrahedra\n1\n1 2 3 4.5 0\n", 11, "row 1 (from 1) of Tetrahedra", "an integer", "\"4.5\""},
        {head + nodes + cells + "Triangles 1 1 2 9 0\n", 12, "row 1 (from 1) of Triangles", nullptr, "9"},
        {head + nodes + cells + "Edges 1 1 0 0\n", 12, "row 1 (from 1) of Edges", nullptr, "0"},
        {head + nodes + "Tetrahedra\n2\n1 2 3 4 0\n\n\n\nEnd\n", 15, "the end of Tetrahedra", "2 rows of 5 numbers",
         "5 numbers"},
        {head + nodes + "Tetrahedra\n-1\n", 10, "the number of rows", nullptr, "\"-1\""},
        {head + nodes + "Tetrahedra\n2147483647\n1 2 3 4 0\n", 12, "the end of Tetrahedra",
         "2147483647 rows of 5 numbers", "5 numbers"},
        {head + nodes + "Tetrahedra\n99999999999\n", 10, "the number of rows", nullptr, "\"99999999999\""},
        {head + "Vertices\n4\n0 0 0 0\n1 nan 0 0\n0 1 0 0\n0 0 1 0\n" + cells, 6, "row 2 (from 1) of Vertices",
         "a finite coordinate", "nan"},
        {head + "Vertices\n4\n0 0 0 0\n1 0 1e999 0\n0 1 0 0\n0 0 1 0\n" + cells, 6, "row 2 (from 1) of Vertices",
         "a number", "\"1e999\""},
        {head + "Vertices\n4\n0 0 0 0\n1 0 0 .5\n0 1 0 0\n0 0 1 0\n" + cells, 6, "row 2 (from 1) of Vertices",
         "an integer up to 2^53", "0.5"},
        {head + "Vertices\n4\n0 0 0 0\n1 0 0,0 0\n0 1 0 0\n0 0 1 0\n" + cells, 6, "row 2 (from 1) of Vertices",
         "a number", "\"0,0\""},
        {head + nodes + "Tetrahedra\n1\n1 2 3 4 0", 11, "the last row has no line end, so the file may be cut short",
         nullptr, nullptr},
        {head + nodes + cells + "End\nVertices 3\n", 12, "text after the keyword End", nullptr, nullptr},
        {head + nodes + cells + "Hexahedra 1 1 2 3 4 1 2 3 9 0\n", 12, "row 1 (from 1) of Hexahedra",
         "a node from 1 to 4", "9"},
        {head + nodes + cells + "Pyramids 1 1 2 3 4 0 0\n", 12, "row 1 (from 1) of Pyramids", "a node from 1 to 4",
         "0"},
        {head + nodes + "Prisms\n1\n1 2 3 4 1 2\n", 12, "the end of Prisms", "1 rows of 7 numbers", "6 numbers"},
        {head + nodes + "TetrahedraP3 1 1 2 3\n", 10, "the end of TetrahedraP3", "1 rows of 21 numbers", "3 numbers"},
        {head + nodes + cells + "TetrahedraP2 1 1 2 3 4 1 2 3 4 1 2\n", 13, "the end of TetrahedraP2",
         "1 rows of 11 numbers", "10 numbers"},
        {head + nodes + "Triangles 1 1 2 3 0 Quadrilaterals 1 1 2 3 4 0\n", 0, "z of point 3 (from 0)",
         "0, as the mesh is 2D", "1"},
    };
    for (const Refused& one : all) {
        SCOPED_TRACE(one.text);
        expect_error(read_medit_bytes(one.text), ".mesh", one.line, one.what, one.expected, one.found, nullptr);
    }
    // Comments do not move lines.
    expect_error(read_medit_bytes("# a\n" + head + "# b\n" + nodes + "Tetrahedra\n1\n1 2 3 # 4\n9 0\n"), ".mesh", 14,
                 "row 1 (from 1) of Tetrahedra", nullptr, "9", nullptr);
    expect_error(read_medit_bytes(head + nodes + "Tetrahedra\n1\n0 1 2 3 0\n"), ".mesh", 11,
                 "row 1 (from 1) of Tetrahedra", nullptr, "0", "nodes count from 1: add 1");
    expect_error(read_medit_bytes(head + "SolAtVertices 1 1 1\n0\n"), ".mesh", 0, "the file contains no mesh", nullptr,
                 "SolAtVertices", "--field NAME=FILE");
}

TEST(MeditErrors, Binary) {
    const std::string bytes = medit_bytes(two_of_medit(), 2, Form::little);
    const auto changed = [&](std::size_t at, char to) {
        std::string text = bytes;
        text[at] = to;
        return read_medit_bytes(text);
    };
    expect_error(changed(4, 1), ".mesh", 0, "the size of Vertices, at byte 32",
                 "96 bytes for 6 rows, for the version is 1 and the dimension 3", "168", nullptr);
    expect_error(changed(4, 3), ".mesh", 0, "the place of what follows Dimension, at byte 8", nullptr, nullptr,
                 nullptr);
    expect_error(changed(4, 5), ".mesh", 0 + 1, "not a file of Medit", nullptr, nullptr, nullptr);
    expect_error(changed(16, 2), ".mesh", 0, "cells in space, and nodes in the plane", nullptr, "Dimension 2", nullptr);
    expect_error(changed(16, 7), ".mesh", 0, "the dimension, at byte 16", "a number from 2 to 3", "7", nullptr);
    expect_error(changed(24, 4), ".mesh", 0, "the place of what follows Vertices, at byte 20", nullptr, "4", nullptr);
    expect_error(changed(31, 127), ".mesh", 0, "the size of Vertices, at byte 32", nullptr, nullptr, nullptr);
    // The last node of the first triangle.
    const std::size_t triangle = 20 + 12 + 6 * 28 + (12 + 12) + (12 + 4) + 12;
    expect_error(changed(triangle + 8, 0), ".mesh", 0,
                 ("row 1 (from 1) of Triangles, at byte " + std::to_string(triangle + 8)).c_str(), "a node from 1 to 6",
                 "0", nullptr);
    expect_error(read_medit_bytes(bytes.substr(0, bytes.size() - 8)), ".mesh", 0,
                 ("the file ends without the keyword End, at byte " + std::to_string(bytes.size() - 8)).c_str(),
                 nullptr, "0 bytes", nullptr);
}

TEST(MeditErrors, CoordinatesThatAreNotFinite) {
    Medit file = two_of_medit();
    file.parts[0].rows[1][2] = std::numeric_limits<double>::infinity();
    for (const MeditForm& form : medit_forms) {
        const Result<Mesh> mesh = read_medit_bytes(medit_bytes(file, form.version, form.form));
        ASSERT_FALSE(mesh);
        EXPECT_EQ(mesh.error().expected, "a finite coordinate");
        EXPECT_EQ(mesh.error().found, "inf");
    }
}

}  // namespace
}  // namespace barycert::testing
