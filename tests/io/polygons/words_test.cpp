// Numbers in text are whole words, and lines have as many as their format says: in every format of surfaces.
#include <gtest/gtest.h>

#include <functional>
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

/// A tetrahedron as text, with `word` in place of the first coordinate of its first node.
struct Format {
    const char* name;
    std::size_t line;  ///< of that node
    std::function<std::string(const std::string& word)> text;
};

const std::string three_nodes = "1 0 0\n0 1 0\n0 0 1\n";

std::string stl_facet(const std::string& a, const std::string& b, const std::string& c) {
    return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c + "\nendloop\nendfacet\n";
}

const std::vector<Format> formats{
    {"a.off", 3,
     [](const std::string& x) {
         return "OFF\n4 4 6\n" + x + " 0 0\n" + three_nodes + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
     }},
    {"a.obj", 1,
     [](const std::string& x) {
         return "v " + x + " 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
     }},
    {"a.ply", 10,
     [](const std::string& x) {
         return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 4\nproperty list uchar int vertex_indices\nend_header\n" +
                x + " 0 0\n" + three_nodes + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
     }},
    {"a.stl", 4,
     [](const std::string& x) {
         return "solid a\n" + stl_facet(x + " 0 0", "0 1 0", "1 0 0") + stl_facet("0 0 0", "1 0 0", "0 0 1") +
                stl_facet("1 0 0", "0 1 0", "0 0 1") + stl_facet("0 1 0", "0 0 0", "0 0 1") + "endsolid a\n";
     }},
    {"a.poly", 2,
     [](const std::string& x) {
         return "4 3\n0 " + x +
                " 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0\n1\n3 0 2 1\n1\n3 0 1 3\n1\n3 1 2 3\n1\n3 2 0 3\n0\n0\n";
     }},
    {"a.smesh", 2,
     [](const std::string& x) {
         return "4 3\n0 " + x + " 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n0\n0\n";
     }},
};

TEST(SurfaceWords, NumbersAreWholeWords) {
    const Scratch scratch;
    for (const Format& format : formats) {
        for (const char* good : {"0", "-0", "+0.0", ".0", "0.", "0e5", "0.0E-3", "1e-999"})
            EXPECT_TRUE(read_surface(scratch.put(format.name, format.text(good)))) << format.name << ' ' << good;
        for (const char* bad :
             {"0,5", "0.0abc", "0x10", "0X1p3", "1.5.3", "--1", "+-1", "-+1", "1e", "1e+", "0;0",     "1.0D+03",
              "0_0", "0f",     "nan",  "-inf",  "1e999", "0/1", "0'",  ".",   "e5", "-",   "1.#QNAN", "0\v1"}) {
            const Result<Surface> read = read_surface(scratch.put(format.name, format.text(bad)));
            ASSERT_FALSE(read) << format.name << ' ' << bad;
            EXPECT_EQ(read.error().line, format.line) << read.error().message();
            EXPECT_EQ(read.error().file, scratch.path(format.name));
        }
        const Result<Surface> commas = read_surface(scratch.put(format.name, format.text("0,5")));
        EXPECT_NE(commas.error().remedy.find("point"), std::string::npos) << commas.error().message();
    }
}

TEST(SurfaceWords, LinesHaveAsManyAsTheirFormatSays) {
    const Scratch scratch;
    for (const Format& format : formats) {
        for (const char* bad : {"0 word", "0 word 5", "0 1 2 3 4 5 6 7", ""}) {
            const Result<Surface> read = read_surface(scratch.put(format.name, format.text(bad)));
            ASSERT_FALSE(read) << format.name << ' ' << bad;
            EXPECT_EQ(read.error().line, format.line) << read.error().message();
        }
    }
    const auto fails = [&](const char* name, const std::string& text, std::size_t line) {
        const Result<Surface> read = read_surface(scratch.put(name, text));
        ASSERT_FALSE(read) << text;
        EXPECT_EQ(read.error().line, line) << read.error().message();
    };
    const std::string four = "0 0 0\n" + three_nodes;
    fails("a.off", "OFF\n4 1 0 7\n" + four + "3 0 1 2\n", 2);
    fails("a.off", "OFF\n4 1 0\n" + four + "3 0 1 2 5 5\n", 7);
    fails("a.off", "OFF\n4 1 0\n" + four + "3 0 1 2 1 1 1 1 1\n", 7);
    fails("a.off", "OFF\n4 1 0\n" + four + "3 0 1 2 red\n", 7);
    fails("a.off", "OFF\n4 1 0\n" + four + "3 0,1,2\n", 7);
    fails("a.off", "OFF\n4 1 0\n" + four + "3 0 1\n2 5 5\n", 8);
    fails("a.obj", "v 0 0 0 1 1\n", 1);
    fails("a.obj", "v 0 0 0 1 1 1 1 1\n", 1);
    for (const char* corner : {"1/", "1//", "1/2/3/4", "1/x", "1.5", "1a", "/1"}) {
        const bool good = std::string_view(corner) == "1/" || std::string_view(corner) == "1//";
        const std::string path = scratch.put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf " + std::string(corner) + " 2 3\n");
        EXPECT_EQ(static_cast<bool>(read_surface(path)), good) << corner;
    }
    const std::string ply_head =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n";
    const std::string ply_rows = "0 0 0\n1 0 0\n0 1 1\n";
    fails("a.ply", "ply\nformat ascii inf\n", 2);
    fails("a.ply", "ply\nformat ascii 1.0 2\n", 2);
    fails("a.ply", "ply\nformat ascii 1.0\nelement vertex 3 3\n", 3);
    fails("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x y\n", 4);
    fails("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\npropperty float x\n", 4);
    fails("a.ply", ply_head + "end_header\n" + ply_rows + "3 0 1 2 2\n", 13);
    fails("a.ply", ply_head + "end_header\n" + ply_rows + "3.5 0 1 2\n", 13);
    fails("a.ply", ply_head + "end_header\n" + ply_rows + "3 0 1 1.5\n", 13);
    fails("a.ply", ply_head + "end_header\n" + ply_rows + "259 0 1 2\n", 13);
    fails("a.ply", ply_head + "end_header\n" + ply_rows + "3 0 1 2\n3 0 1 2\n", 14);
    const std::string nodes = "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
    fails("a.poly", "4 3 0 0 9\n0 0 0 0\n", 1);
    fails("a.poly", nodes + "1 0 5\n1\n3 0 1 2\n", 6);
    fails("a.poly", nodes + "1 0\n1 0 5 5\n3 0 1 2\n", 7);
    fails("a.poly", nodes + "1 0\n1\n3 0 1 2 3\n", 8);
    fails("a.poly", nodes + "1 0\n1\n3 0 1 2\n1 1\n1 0 0 0\n", 9);
    fails("a.poly", nodes + "1 0\n1\n3 0 1 2\n1\n1 0,5 0,5 0,5\n", 10);
    fails("a.poly", nodes + "1 0\n1\n3 0 1 2\n0\n1\n1 0 0 0 1 2 3\n", 11);
    fails("a.smesh", nodes + "1 0\n3 0 1 2 3\n", 7);
}

TEST(SurfaceWords, WhatStandsBehindNumbersWhereTheFormatHasIt) {
    const Scratch scratch;
    const auto notes_of = [&](const char* name, const std::string& text) {
        const Result<Surface> read = read_surface(scratch.put(name, text));
        EXPECT_TRUE(read) << (read ? "" : read.error().message());
        return read ? read->notes : Notes();
    };
    const std::string off = "OFF\n4 4 6\n0 0 0 # a\n" + three_nodes;
    EXPECT_EQ(notes_of("a.off", off + "3 0 2 1 255 0 0\n3 0 1 3 .1 .2 .3 1\n3 1 2 3 7\n3 2 0 3 # b\n").size(), 1);
    // Corners on several lines: what is left on the last of them is the colour.
    EXPECT_EQ(notes_of("a.off", off + "3\n0 2 1\n3 0 # c\n1 3 255 0 0\n3 1 2\n3 7\n3 2 0 3\n").size(), 1);
    EXPECT_EQ(notes_of("a.off", off + "3 0\n2 1\n3 0\n1\n3\n3 1 2 3\n3 2 0 3\n").size(), 0);
    const std::string obj = "v 0 0 0 1 # a\nv 1 0 0 .5 .5 .5\nv 0 1 0 1 .5 .5 .5\nv 0 0 1\n";
    const Notes notes = notes_of("a.obj", obj + "f 1/1/1 3/2/2 2\nf 1//1 2//2 4\nf 2/1 3/1 4/1\nf -2 -4 -1\n");
    ASSERT_EQ(notes.size(), 1);
    EXPECT_NE(notes[0].text.find("3 nodes"), std::string::npos) << notes[0].text;
    // Normals of degenerate triangles, as C and Microsoft's C print them.
    for (const char* normal : {"", " normal 0 0 1", " normal nan nan nan", " normal -nan(ind) 1.#QNAN -1.#IND"}) {
        std::string text = formats[3].text("0");
        for (std::size_t at = 0; (at = text.find(" normal 0 0 0", at)) != std::string::npos; ++at)
            text.replace(at, 13, normal);
        EXPECT_EQ(notes_of("a.stl", text).size(), 0) << normal;
    }
    EXPECT_FALSE(
        read_surface(scratch.put("a.stl", "solid\n" + stl_facet("0 0 0", "1 0 0", "0 1 1") + "facet normal 0 0")));
    // Two solids, a colour between them, and a word more in a loop.
    const std::string solid = formats[3].text("0");
    EXPECT_EQ(notes_of("a.stl", solid + "\ncolor 1 0 0\n" + solid).size(), 1);
    EXPECT_FALSE(read_surface(scratch.put("a.stl", solid.substr(0, solid.find("endloop")) + "color 1 0 0\n")));
}

TEST(SurfaceWords, ALastLineWithoutAnEndIsTakenAndTold) {
    const Scratch scratch;
    for (const Format& format : formats) {
        const std::string text = format.text("0"), whole = scratch.put(format.name, text);
        const Surface expected = read_surface(whole).value();
        EXPECT_TRUE(expected.notes.empty()) << format.name;
        const Result<Surface> read = read_surface(scratch.put(format.name, text.substr(0, text.size() - 1)));
        ASSERT_TRUE(read) << format.name << read.error().message();
        EXPECT_EQ(read->points, expected.points);
        EXPECT_EQ(read->cells, expected.cells);
        const bool number = std::string_view(format.name) != "a.stl";
        EXPECT_EQ(read->notes.size(), number ? 1U : 0U) << format.name;
        if (!number) continue;
        EXPECT_TRUE(read->notes.front().important) << "a number may be cut";
    }
}

TEST(SurfaceWords, TextBehindAPlcIsToldAndLeftOut) {
    const Scratch scratch;
    const Plc plc = read_plc(scratch.put("a.poly", formats[4].text("0") + "\nthe end\n2\n")).value();
    ASSERT_EQ(plc.notes.size(), 1);
    EXPECT_NE(plc.notes[0].text.find("from line 18 on: \"the end\""), std::string::npos) << plc.notes[0].text;
    EXPECT_EQ(plc.facets.size(), 4);
    // A marker that no header announces, as TetGen passes over it.
    const std::string nodes = "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
    const Plc marked = read_plc(scratch.put("b.poly", nodes + "1\n1 0 5\n3 0 1 2\n0\n")).value();
    EXPECT_EQ(marked.facets[0].marker, 0);
    EXPECT_EQ(marked.notes.size(), 1);
}

}  // namespace
}  // namespace barycert::testing
