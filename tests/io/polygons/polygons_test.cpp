// Triangles in space from every format.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/scratch.hpp"

namespace barycert::testing {
namespace {

using test::Scratch;

const std::vector<double> tetrahedron{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const std::vector<Mesh::Index> faces{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

template <class T>
void put(std::string& bytes, T x, bool swap = false) {
    char raw[sizeof(T)];
    std::memcpy(raw, &x, sizeof(T));
    if (swap) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
}

std::string binary_stl() {
    std::string bytes(80, '\0');
    put(bytes, std::uint32_t{4});
    for (std::size_t t = 0; t < 4; ++t) {
        for (int i = 0; i < 3; ++i) put(bytes, 0.0F);
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t k = 0; k < 3; ++k)
                put(bytes, static_cast<float>(tetrahedron[3 * static_cast<std::size_t>(faces[3 * t + c]) + k]));
        }
        put(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string ply(const char* format) {
    const bool text = std::string_view(format) == "ascii", swap = std::string_view(format) == "binary_big_endian";
    std::string bytes =
        std::string("ply\nformat ") + format +
        " 1.0\ncomment two fields\nelement vertex 4\nproperty float x\nproperty double y\nproperty float z\n"
        "property uchar red\nelement face 4\nproperty list uchar int vertex_indices\nproperty short id\n"
        "element edge 1\nproperty int vertex1\nend_header\n";
    for (std::size_t i = 0; i < 4; ++i) {
        const double* const p = &tetrahedron[3 * i];
        if (text) {
            bytes += std::to_string(p[0]) + ' ' + std::to_string(p[1]) + ' ' + std::to_string(p[2]) + ' ' +
                     std::to_string(10 * i) + '\n';
            continue;
        }
        put(bytes, static_cast<float>(p[0]), swap);
        put(bytes, p[1], swap);
        put(bytes, static_cast<float>(p[2]), swap);
        put(bytes, static_cast<std::uint8_t>(10 * i));
    }
    for (std::size_t t = 0; t < 4; ++t) {
        if (text) bytes += "3";
        if (!text) put(bytes, std::uint8_t{3});
        for (std::size_t c = 0; c < 3; ++c) {
            if (text) bytes += ' ' + std::to_string(faces[3 * t + c]);
            if (!text) put(bytes, std::int32_t{faces[3 * t + c]}, swap);
        }
        if (text) bytes += " -" + std::to_string(t) + '\n';
        if (!text) put(bytes, static_cast<std::int16_t>(-static_cast<int>(t)), swap);
    }
    if (text) bytes += "7\n";
    if (!text) put(bytes, std::int32_t{7}, swap);
    return bytes;
}

Surface read(const std::string& path) {
    Result<Surface> s = read_surface(path);
    EXPECT_TRUE(s) << (s ? "" : s.error().message());
    return s ? std::move(*s) : Surface();
}

TEST(Polygons, TheSameFromEveryFormat) {
    const Scratch scratch;
    const std::string off =
        scratch.put("a.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    const std::string obj = scratch.put(
        "a.obj",
        "# a\no x\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nf 1 3 2\nf 1/1/1 2//1 4\nf -3 -2 -1\nf 3 1 4\n");
    const std::string one =
        scratch.put("b.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 1 3 2\n3 1 2 4\n3 2 3 4\n3 3 1 4\n");
    const std::string poly = scratch.put(
        "a.poly", "4 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n4\n1\n3 1 3 2\n1\n3 1 2 4\n1\n3 2 3 4\n1\n3 3 1 4\n0\n0\n");
    for (const std::string& path : {off, obj, one, poly}) {
        const Surface s = read(path);
        EXPECT_EQ(s.points, tetrahedron) << path;
        EXPECT_EQ(s.cells, faces) << path;
        EXPECT_TRUE(s.facets.empty());
    }
    EXPECT_EQ(read(obj).notes.size(), 1);  // o and vn
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const Surface s = read(scratch.put(std::string(format) + ".ply", ply(format)));
        EXPECT_EQ(s.points, tetrahedron) << format;
        EXPECT_EQ(s.cells, faces) << format;
        ASSERT_EQ(s.point_fields.size(), 1);
        EXPECT_EQ(s.point_fields[0].data, (std::vector<double>{0, 10, 20, 30}));
        ASSERT_EQ(s.cell_fields.size(), 1);
        EXPECT_EQ(s.cell_fields[0].data, (std::vector<double>{0, -1, -2, -3}));
        EXPECT_EQ(s.notes.size(), 1) << "the edge";
    }
}

TEST(Polygons, StlJoinsEqualCorners) {
    const Scratch scratch;
    const Surface s = read(scratch.put("a.stl", binary_stl()));
    EXPECT_EQ(s.point_count(), 4);
    EXPECT_EQ(s.cell_count(), 4);
    std::string text = "solid a\n";
    for (std::size_t t = 0; t < 4; ++t) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (std::size_t c = 0; c < 3; ++c) {
            text += "vertex";
            for (std::size_t k = 0; k < 3; ++k)
                text += ' ' + std::to_string(tetrahedron[3 * static_cast<std::size_t>(faces[3 * t + c]) + k]);
            text += '\n';
        }
        text += "endloop\nendfacet\n";
    }
    const Surface same = read(scratch.put("b.stl", text + "endsolid a\n"));
    EXPECT_EQ(same.points, s.points);
    EXPECT_EQ(same.cells, s.cells);
    EXPECT_FALSE(read_surface(scratch.put("c.stl", text)));
    std::string loud = text + "END SOLID a\n";
    for (const auto& [from, to] : {std::pair("solid", "SOLID"), {"facet", "Facet"}, {"endloop", "end loop"}}) {
        for (std::size_t at = 0; (at = loud.find(from, at)) != std::string::npos; at += std::string_view(to).size())
            loud.replace(at, std::string_view(from).size(), to);
    }
    for (const char* before : {"", "\n\n", "  \t", "\xEF\xBB\xBF"}) {
        const Surface other = read(scratch.put("d.stl", before + loud));
        EXPECT_EQ(other.points, s.points) << before;
        EXPECT_EQ(other.cells, s.cells) << before;
        EXPECT_TRUE(other.notes.empty());
    }
}

TEST(Polygons, BytesBehindABinaryFileAreTold) {
    const Scratch scratch;
    const Surface whole = read(scratch.put("a.stl", binary_stl()));
    EXPECT_TRUE(whole.notes.empty());
    const Surface more = read(scratch.put("b.stl", binary_stl() + std::string(7, 'x')));
    EXPECT_EQ(more.cells, whole.cells);
    ASSERT_EQ(more.notes.size(), 1);
    EXPECT_TRUE(more.notes[0].text.starts_with("7 bytes behind the last of the 4 triangles")) << more.notes[0].text;
    EXPECT_EQ(read(scratch.put("a.ply", ply("binary_little_endian") + "xyz")).notes.size(), 2) << "the edge, and these";
    std::string none(100, '\0');  // no triangles, and something behind them
    EXPECT_FALSE(read_surface(scratch.put("c.stl", none)));
}

TEST(Polygons, PolygonsBecomeTriangles) {
    const Scratch scratch;
    // A square, a pentagon that is not convex, and a bow-tie.
    const Surface s = read(scratch.put("a.off",
                                       "OFF\n9 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n4 0 1\n4 4 1\n2 1 1\n0 4 1\n4 3 "
                                       "2 1 0\n5 4 5 6 7 8\n4 0 2 1 3\n"));
    EXPECT_EQ(s.facets, (std::vector<Mesh::Index>{0, 0, 1, 1, 1}));
    EXPECT_EQ(std::vector(s.cells.begin(), s.cells.begin() + 6), (std::vector<Mesh::Index>{0, 3, 2, 0, 2, 1}));
    ASSERT_EQ(s.notes.size(), 1);
    EXPECT_NE(s.notes[0].text.find("polygons that cross themselves or are flat (1)"), std::string::npos);
}

TEST(Polygons, FilesOfMeshesWithTrianglesInSpace) {
    const Scratch scratch;
    const std::string vtk = scratch.put(
        "a.vtk",
        "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 5 double\n0 0 0 1 0 0 1 1 1 0 1 1 2 2 2\n"
        "POLYGONS 2 9\n4 0 1 2 3\n3 2 4 3\nCELL_DATA 2\nSCALARS c double 1\nLOOKUP_TABLE default\n5 7\n");
    const Surface s = read(vtk);
    EXPECT_EQ(s.cell_count(), 3);
    ASSERT_EQ(s.cell_fields.size(), 1);
    EXPECT_EQ(s.cell_fields[0].data, (std::vector<double>{5, 5, 7}));
    EXPECT_EQ(s.facets, (std::vector<Mesh::Index>{0, 0, 1}));
    const std::string msh = scratch.put(
        "a.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n4\n"
        "1 2 2 0 1 1 3 2\n2 2 2 0 1 1 2 4\n3 2 2 0 1 2 3 4\n4 2 2 0 1 3 1 4\n$EndElements\n");
    EXPECT_EQ(read(msh).cells, faces);
    EXPECT_EQ(read(msh).points, tetrahedron);
    EXPECT_FALSE(read_mesh(msh)) << "it is no mesh in the plane";
    const std::string medit = scratch.put(
        "a.mesh",
        "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTriangles\n4\n"
        "1 3 2 0\n1 2 4 0\n2 3 4 0\n3 1 4 0\nEnd\n");
    EXPECT_EQ(read(medit).cells, faces);
    // Own files come back.
    Surface with = read(msh);
    with.point_fields = {{"f", 1, {1, 2, 3, 4}}};
    ASSERT_TRUE(write_surface(with, scratch.path("b.vtp")));
    ASSERT_TRUE(write_surface(with, scratch.path("b.ply")));
    for (const char* name : {"b.vtp", "b.ply"}) {
        const Surface again = read(scratch.path(name));
        EXPECT_EQ(again.points, with.points);
        EXPECT_EQ(again.cells, with.cells);
        ASSERT_EQ(again.point_fields.size(), 1);
        EXPECT_EQ(again.point_fields[0].data, with.point_fields[0].data);
    }
}

TEST(Polygons, BadFilesAreErrorsWithALine) {
    const Scratch scratch;
    const auto fails = [&](const char* name, const std::string& text, const std::string& says) {
        const Result<Surface> s = read_surface(scratch.put(name, text));
        ASSERT_FALSE(s) << name << text;
        EXPECT_NE(s.error().message().find(says), std::string::npos) << s.error().message();
    };
    fails("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", ":3: no such node");
    fails("a.obj", "v 0 0\n", ":1: cannot read");
    fails("a.obj", "v 0 0 nan\n", "a finite number");
    fails("a.obj", "v 0 0 0\n", "no triangles");
    fails("a.off", "OFF\n1 1 0\n0 0 0\n2 0 0\n", ":4: cannot read");
    fails("a.off", "OFF\n0 1 0\n3 0 1 2\n", "as there are no nodes");
    const std::string corner = "vertex 0 0 0\n", four = "facet\nouter loop\n" + corner + corner + corner + corner;
    std::string facets = "solid a\n";
    for (int i = 0; i < 3; ++i) facets += four + "endloop\nendfacet\n";
    fails("a.stl", facets + "endsolid\n", ":7: cannot read");
    fails("a.ply",
          "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
          "z\nend_header\nxx",
          "truncated");
    fails("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
          "properties x, y and z");
    fails("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty hex x\nend_header\n", ":4: cannot read");
    fails("a.stl", std::string(100, '\0'), "neither a text nor a whole binary");
    const std::string whole = binary_stl();
    for (const std::size_t cut : {0UL, 40UL, 84UL, 100UL, 283UL})
        EXPECT_FALSE(read_surface(scratch.put("cut.stl", whole.substr(0, cut))));
    EXPECT_FALSE(read_surface(scratch.path("none.stl")));
}

}  // namespace
}  // namespace barycert::testing
