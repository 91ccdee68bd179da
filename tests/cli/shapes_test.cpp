// Files of cells that are no simplices: rows, means and maps are of these, not of the simplices that they are cut into.

#include <gtest/gtest.h>

#include <filesystem>

#include "process.hpp"

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

}  // namespace
}  // namespace barycert::cli_test
