// Files of cells that are no simplices: rows, means and maps are of these, not of the simplices that they are cut into.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

/// Two hexahedra side by side, with numbers of cells (c) and values of nodes (t); `top`: the z of one of their nodes.
std::string two_hexahedra(const std::string& top) {
    return "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 12 double\n"
           "0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0\n0 0 1 1 0 1 2 0 1 0 1 1 1 1 " +
           top +
           " 2 1 1\nCELLS 2 18\n8 0 1 4 3 6 7 10 9\n8 1 2 5 4 7 8 11 10\nCELL_TYPES 2\n12 12\n"
           "CELL_DATA 2\nSCALARS c double 1\nLOOKUP_TABLE default\n0\n1\n"
           "POINT_DATA 12\nSCALARS t double 1\nLOOKUP_TABLE default\n0 1 0 2 0 3 0 5 0 7 0 11\n";
}

TEST(Shapes, MeansAreOfWholeCells) {
    const Scratch scratch;
    const std::string mesh = scratch.put("two.vtk", two_hexahedra("1"));
    const std::string points = scratch.put("p.csv", "x,y,z\n1,0,0\n1,1,0\n1,0,1\n1,1,1\n0,0,0\n2,1,1\n");
    const Ended rows = run({"sample", mesh, "--points", points, "--fields", "mean(c)", "--output", "-", "--quiet"});
    EXPECT_EQ(rows.out,
              "x,y,z,cell,feature,mean(c)\n1,0,0,0,vertex,0.5\n1,1,0,0,vertex,0.5\n1,0,1,0,vertex,0.5\n"
              "1,1,1,0,vertex,0.5\n0,0,0,0,vertex,0\n2,1,1,1,vertex,1\n")
        << rows.err;
}

TEST(Shapes, AFileOfValuesHasARowForEachCellOfTheFile) {
    const Scratch scratch;
    const std::string mesh = scratch.put("two.vtk", two_hexahedra("1"));
    const std::string points = scratch.put("p.csv", "x,y,z\n0.5,0.5,0.5\n1.5,0.25,0.5\n");
    const Words sample{"sample", mesh, "--points", points, "--fields", "g", "--output", "-", "--quiet", "--field"};
    const Ended rows = run(plus(sample, {"g=" + scratch.put("g.txt", "10\n20\n")}));
    EXPECT_TRUE(contains(rows.out, ",0,interior,10\n")) << rows.out << rows.err;
    EXPECT_TRUE(contains(rows.out, ",1,interior,20\n")) << rows.out << rows.err;
    const Ended short_one = run(plus(sample, {"g=" + scratch.put("h.txt", "10\n20\n30\n")}));
    EXPECT_EQ(short_one.code, 2);
    EXPECT_TRUE(contains(short_one.err, "2, one for each cell")) << short_one.err;
}

TEST(Shapes, ASeriesOfValuesHasARowForEachCellOfTheFile) {
    const Scratch scratch;
    const std::string mesh = scratch.put("two.vtk", two_hexahedra("1"));
    const std::string points = scratch.put("p.csv", "x,y,z\n0.5,0.5,0.5\n1.5,0.25,0.5\n");
    scratch.put("g-1.txt", "10\n20\n");
    scratch.put("g-2.txt", "30\n40\n");
    const Ended rows = run({"sample", mesh, "--points", points, "--cell-field", "g@" + scratch.path("g-*.txt"),
                            "--fields", "g", "--output", scratch.path("r-{step}.csv"), "--quiet"});
    EXPECT_EQ(rows.code, 0) << rows.err;
    EXPECT_TRUE(contains(read_file(scratch.path("r-2.csv")), ",1,interior,40\n"));
}

TEST(Shapes, ImagesWithoutListsOfCells) {
    const Scratch scratch;
    const std::string cells = "<CellData><DataArray type='Int64' Name='c'>7 8</DataArray></CellData>",
                      values =
                          "<PointData><DataArray type='Float64' Name='t'>0 1 0 2 0 3 0 5 0 7 0 11</DataArray>"
                          "</PointData>";
    const auto image = [&](const std::string& axes) {
        return "<VTKFile type='ImageData'><ImageData WholeExtent='0 2 0 1 0 1' " + axes +
               "><Piece Extent='0 2 0 1 0 1'>" + values + cells + "</Piece></ImageData></VTKFile>";
    };
    const std::string mesh = scratch.put("i.vti", image("Spacing='1 1 1'"));
    const std::string points = scratch.put("p.csv", "x,y,z\n0.7,0.6,0.9\n1,0.5,0.25\n1.25,1,0.1\n2,1,1\n3,0,0\n");
    const auto sample = [&](const Words& more) { return run(plus({"sample", mesh, "--points", points}, more)); };
    for (const char* how : {"linear", "multilinear"}) {
        const Words interpolation{"--interpolation", how};
        const Ended rows = sample(plus(interpolation, {"--output", "-", "--json", scratch.path("r.json")}));
        EXPECT_EQ(rows.code, 0) << rows.err;
        EXPECT_EQ(parse(read_file(scratch.path("r.json")))["method"], "axes");
        EXPECT_TRUE(contains(rows.out, "1,0.5,0.25,0,face,")) << rows.out;
        // A map asks for lists.
        const Ended listed = sample(
            plus(interpolation, {"--output", "-", "--save-map", scratch.path("m"), "--json", scratch.path("l.json")}));
        EXPECT_EQ(listed.out, rows.out);
        EXPECT_EQ(parse(read_file(scratch.path("l.json")))["method"], "walk");
    }
    for (const char* fields : {"grad(t)", "mean(c)"})
        EXPECT_EQ(sample({"--fields", fields, "--output", "-", "--quiet"}).code, 0) << fields;
    EXPECT_EQ(sample({"--outside", "nearest", "--output", "-", "--quiet"}).code, 0);
}

TEST(Shapes, MapsAreOfOneInterpolation) {
    const Scratch scratch;
    const std::string mesh = scratch.put("two.vtk", two_hexahedra("1.5")), map = scratch.path("m.map");
    const std::string points = scratch.put("p.csv", "x,y,z\n0.7,0.6,0.9\n1.2,0.8,1.1\n0.9,0.9,0.2\n");
    const auto sample = [&](const Words& more) { return plus({"sample", mesh, "--output", "-", "--quiet"}, more); };
    const Words multilinear{"--interpolation", "multilinear"};
    std::string linear_rows;
    for (const Words& made : {Words{}, multilinear}) {
        const Ended rows = run(sample(plus(made, {"--points", points, "--save-map", map})));
        EXPECT_EQ(rows.code, 0) << rows.err;
        EXPECT_NE(std::exchange(linear_rows, rows.out), rows.out);
        EXPECT_EQ(run(sample(plus(made, {"--map", map}))).out, rows.out);
        const Ended other = run(sample(plus(made.empty() ? multilinear : Words{}, {"--map", map})));
        EXPECT_EQ(other.code, 2);
        EXPECT_TRUE(contains(other.err, "the map was made of cells taken otherwise")) << other.err;
    }
}

TEST(Shapes, ResultsOfTheOtherInterpolationAreToldAsSuch) {
    const Scratch scratch;
    const std::string mesh = scratch.put("two.vtk", two_hexahedra("1")), rows = scratch.path("rows.csv");
    std::string points = "x,y,z\n";
    for (int i = 1; i < 20; ++i) points += fmt::format("{},{},{}\n", 0.0987 * i, 0.3 + 0.02 * i, 0.9 - 0.03 * i);
    scratch.put("p.csv", points);
    const auto with = [&](const char* command, const char* how) {
        return Words{command, mesh, "--interpolation", how};
    };
    for (const char* how : {"linear", "multilinear"}) {
        const std::string other = how == std::string("linear") ? "multilinear" : "linear";
        ASSERT_EQ(run(plus(with("sample", how), {"--points", scratch.path("p.csv"), "--output", rows})).code, 0);
        EXPECT_EQ(run(plus(with("verify", how), {"--results", rows})).code, 0);
        const Ended wrong = run(plus(with("verify", other.c_str()), {"--results", rows}));
        EXPECT_EQ(wrong.code, 1);
        EXPECT_TRUE(
            contains(wrong.out, fmt::format("these values are those of {} interpolation: by it 0 of the first 19 "
                                            "rows are wrong, by {} interpolation",
                                            how, other)))
            << wrong.out;
        EXPECT_TRUE(contains(wrong.out, "see --interpolation")) << wrong.out;
        EXPECT_EQ(contains(wrong.out, "--interpolation multilinear --points -"), other == "multilinear") << wrong.out;
        // Wrong by both.
        std::string text = read_file(rows);
        for (char& c : text) c = c == '7' ? '8' : c;
        const Ended none = run(plus(with("verify", other.c_str()), {"--results", scratch.put("bad.csv", text)}));
        EXPECT_FALSE(contains(none.out, "these values are")) << none.out;
    }
}

TEST(Shapes, CurvedSimplicesBesideOthersMayBeRefused) {
    const Scratch scratch;
    std::string text = "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 18 double\n";
    for (int i = 0; i < 8; ++i)
        text += std::to_string((i + 1) / 2 % 2) + " " + std::to_string(i / 2 % 2) + " " + std::to_string(i / 4) + "\n";
    text +=
        "4 0 0 6 0 0 4 2 0 4 0 2 5 0 0 5 1 0 4 1 0 4 0 1 5 0 1 4 1 1\nCELLS 2 20\n8 0 1 2 3 4 5 6 7\n"
        "10 8 9 10 11 12 13 14 15 16 17\nCELL_TYPES 2\n12 24\n";
    const Words sample{"sample",   scratch.put("two.vtk", text),
                       "--points", scratch.put("p.csv", "x,y,z\n0.5,0.5,0.5\n"),
                       "--output", "-",
                       "--quiet"};
    for (const std::string how : {"isoparametric", "straight", "refuse", "exact"})
        EXPECT_EQ(run(plus(sample, {"--curved", how})).code, 0) << how;
    // Its sides were straight.
    text.replace(text.find("5 0 0 5 1 0"), 5, "5 -1 0");
    scratch.put("two.vtk", text);
    EXPECT_EQ(run(sample).code, 0);
    const Ended refused = run(plus(sample, {"--curved", "refuse"}));
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(contains(refused.err, "the mesh is curved")) << refused.err;
    EXPECT_EQ(run(plus(sample, {"--curved", "straight"})).code, 0);
}

// Parts of a quadrilateral and of a polygon of the same nodes are alike, what is taken there is not.
TEST(Shapes, MapsAreOfCellsOfOneType) {
    const Scratch scratch;
    const std::string points = scratch.put("p.csv", "x,y\n0.7,0.6\n0.2,0.8\n"), map = scratch.path("m.map");
    const auto mesh = [&](const std::string& type) {
        return scratch.put(type + ".vtk",
                           "# vtk DataFile Version 3.0\none\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                           "POINTS 4 double\n0 0 0 1 0 0 1 1 0 0 2 0\nCELLS 1 5\n4 0 1 2 3\n"
                           "CELL_TYPES 1\n" +
                               type + "\n");
    };
    const Words multilinear{"--interpolation", "multilinear", "--output", scratch.path("r.csv"), "--quiet"};
    const Ended saved = run(plus({"sample", mesh("9"), "--points", points, "--save-map", map}, multilinear));
    EXPECT_EQ(saved.code, 0) << saved.err;
    EXPECT_EQ(run(plus({"sample", mesh("7"), "--map", map}, multilinear)).code, 2);
    // Where no cell has products, a map is one of linear cells.
    EXPECT_EQ(run(plus({"sample", mesh("7"), "--points", points, "--save-map", map}, multilinear)).code, 0);
    EXPECT_EQ(run({"sample", mesh("7"), "--map", map, "--output", "-", "--quiet"}).code, 0);
}

}  // namespace
}  // namespace barycert::cli_test
