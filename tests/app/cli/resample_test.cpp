// barycert resample: grids and other meshes; every value is that of barycert sample.

#include <cstring>

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

/// The first columns of every row, as points.
std::string points_of(const std::string& rows, int dimension) {
    std::string points;
    for (const std::string& line : lines_of(rows)) {
        std::size_t end = 0;
        for (int k = 0; k < dimension; ++k) end = line.find(',', end + 1);
        points += line.substr(0, end) + "\n";
    }
    return points;
}

TEST(Resample, GivesTheRowsOfSampleAtThePointsOfTheGrid) {
    const Scratch scratch;
    for (const Words& grid : std::vector<Words>{{"cube-hole", "--grid", "13x11x9"},
                                                {"cube-hole-o2", "--grid", "7x6x5", "--bounds=-.1,1.1,-.1,1.1,.2,.8"},
                                                {"bracket", "--spacing", "0.3x0.25x0.5"},
                                                {"plate", "--grid", "40x30"},
                                                {"plate", "--spacing", "0.0625", "--bounds=-1,3,0,2"}}) {
        for (const std::string policy : {"nan", "fill=3", "nearest", "extrapolate"}) {
            const Words options{"--outside", policy, "--quiet", "--output", "-"};
            const Ended r = run(plus(plus({"resample", mesh(grid[0])}, Words(grid.begin() + 1, grid.end())), options));
            ASSERT_EQ(r.code, 0) << r.err;
            const std::string points = scratch.put("p.csv", points_of(r.out, grid[0] == "plate" ? 2 : 3));
            const Ended s = run(plus({"sample", mesh(grid[0]), "--points", points}, options));
            EXPECT_TRUE(r.out == s.out) << grid[0] << ' ' << policy;
            EXPECT_GT(lines_of(r.out).size(), 100U);
        }
    }
}

TEST(Resample, ArraysHaveXFastest) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch);
    // On this grid attribute0 is 1 + 2x + 4y + 8z, and (1, 1, 0), (1, 0, 1), (0, 1, 1) lie outside.
    const Words line{"resample", two, "--grid", "2x2x3", "--outside", "fill=-1", "--output"};
    EXPECT_EQ(run(plus(line, {scratch.path("a.npy"), "--fields", "attribute0"})).code, 0);
    const std::string file = read_file(scratch.path("a.npy"));
    EXPECT_EQ(file.substr(10, 66), "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2, 2), }    ");
    ASSERT_EQ(file.size() % 64, 32U);
    std::vector<double> values(12);
    std::memcpy(values.data(), file.data() + file.size() - 96, 96);
    EXPECT_EQ(values, (std::vector<double>{1, 3, 5, -1, 5, -1, -1, -1, 9, -1, -1, 15}));
    EXPECT_EQ(run(plus(line, {scratch.path("b.npy")})).code, 0);
    const std::string both = read_file(scratch.path("b.npy"));
    EXPECT_TRUE(contains(both, "'shape': (3, 2, 2, 2), }"));
    values.resize(24);
    std::memcpy(values.data(), both.data() + both.size() - 192, 192);
    EXPECT_EQ((std::vector<double>{values.begin(), values.begin() + 6}), (std::vector<double>{1, 7, 3, 7, 5, 7}));
    EXPECT_EQ(run(plus(line, {scratch.path("a.vti"), "--fields", "attribute0"})).code, 0);
    const std::string vti = read_file(scratch.path("a.vti"));
    for (const std::string part : {"WholeExtent=\"0 1 0 1 0 2\"", "Name=\"attribute0\"", "Name=\"vtkValidPointMask\"",
                                   "Name=\"cell\"", "Spacing=\"1 1 0.5\""})
        EXPECT_TRUE(contains(vti, part)) << part;
    EXPECT_TRUE(contains(vti, file.substr(file.size() - 96))) << "the same numbers";
    EXPECT_TRUE(contains(vti, std::string("\1\1\1\0\1\0\0\0\1\0\0\1", 12))) << "the mask";
}

TEST(Resample, APictureOfALayer) {
    const Scratch scratch;
    const std::string png = scratch.path("s.png");
    const Words line{"resample", mesh("cube-hole"), "--output", png, "--fields", "attribute1"};
    const Ended r = run(plus(line, {"--grid", "40x30x1", "--range", "0,0.5", "--json", scratch.path("j")}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "\npicture    colours from 0 to 0.5; ")) << r.out;
    EXPECT_EQ(read_file(png).substr(0, 8), "\x89PNG\r\n\x1a\n");
    const auto j = parse(read_file(scratch.path("j")));
    EXPECT_EQ(j["from"], "grid");
    EXPECT_EQ(j["grid"]["counts"].dump(), "[40,30,1]");
    EXPECT_EQ(j["grid"]["origin"][2], 0.5);
    EXPECT_EQ(j["points"], 1200);
    EXPECT_EQ(j["picture"]["drawn"], j["inside"]["count"]);
    EXPECT_EQ(j["method"], "grid");
    for (const std::string grid : {"40x1x30", "1x40x30"}) EXPECT_EQ(run(plus(line, {"--grid", grid})).code, 0) << grid;
    EXPECT_EQ(run({"resample", mesh("plate"), "--grid", "40x30", "--output", png, "--fields", "attribute0"}).code, 0);
    const std::string before = read_file(png);
    for (const std::string grid : {"40x30x2", "40x1x1"})
        expect_error(plus(line, {"--grid", grid}), "expected one point along exactly one axis");
    expect_error(
        {"resample", mesh("cube-hole"), "--output", png, "--grid", "4x4x1"},
        "a picture shows one column: expected a field of one component, chosen by --fields, found attribute0, ");
    expect_error(plus(line, {"--grid", "4x4x1", "--range", "1,1"}), "--range");
    expect_error(plus(line, {"--grid", "2000000x4x1"}), "too many points for a picture");
    EXPECT_TRUE(read_file(png) == before);
}

TEST(Resample, OntoAnotherMesh) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), onto = scratch.path("onto");
    scratch.put("onto.node", "4 3 1 1\n1 0 0 0 99 5\n2 0 .5 0 99 6\n3 .25 .25 .5 99 7\n4 2 2 2 99 8\n");
    scratch.put("onto.ele", "1 4 0\n1 1 2 3 4\n");
    const Words line{"resample", two, "--onto", onto, "--fields", "attribute0", "--output"};
    const std::string rows =
        "x,y,z,cell,feature,attribute0\n0,0,0,0,vertex,1\n0,0.5,0,0,edge,3\n"
        "0.25,0.25,0.5,0,face,6.5\n2,2,2,-1,outside,nan\n";
    EXPECT_EQ(run(plus(line, {"-", "--quiet"})).out, rows);
    EXPECT_EQ(run(plus(line, {scratch.path("r.csv")})).code, 0);
    EXPECT_EQ(read_file(scratch.path("r.csv")), rows);
    expect_error(plus(line, {scratch.path("r")}), "field \"attribute0\" is not finite at node 3, counted from 0");
    EXPECT_EQ(scratch.names(), (Words{"onto.ele", "onto.node", "r.csv", "two.ele", "two.node"}));
    for (const std::string name : {"r.1", "s.node"}) {
        EXPECT_EQ(run(plus(line, {scratch.path(name), "--outside", "fill=-2"})).code, 0);
        const std::string stem = name.substr(0, name[0] == 'r' ? 3 : 1);
        EXPECT_EQ(lines_of(read_file(scratch.path(stem + ".node"))),
                  (Words{"4 3 1 1", "1 0 0 0 1 5", "2 0 0.5 0 3 6", "3 0.25 0.25 0.5 6.5 7", "4 2 2 2 -2 8"}));
        EXPECT_EQ(lines_of(read_file(scratch.path(stem + ".ele"))), (Words{"1 4 0", "1 1 2 3 4"}));
    }
    for (const std::string name : {"v.vtu", "v.vtk"}) {
        const Ended r = run(plus(line, {scratch.path(name), "--outside", "fill=-2"}));
        EXPECT_EQ(r.code, 0) << r.err;
        // Read again at its own nodes: what was written there.
        const std::string points = scratch.put("p.csv", points_of(rows, 3));
        EXPECT_EQ(run({"sample", scratch.path(name), "--points", points, "--output", "-", "--quiet"}).out,
                  "x,y,z,cell,feature,attribute0,point:vtkValidPointMask,point:cell\n0,0,0,0,vertex,1,1,0\n"
                  "0,0.5,0,0,vertex,3,1,0\n0.25,0.25,0.5,0,vertex,6.5,1,0\n2,2,2,0,vertex,-2,0,-1\n");
    }
}

TEST(Resample, VtkFilesAreMeshesAndPointsAndRows) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), mesh = scratch.path("m.vtu"), points = scratch.path("q.vtu");
    ASSERT_EQ(run({"check", two, "--vtu", mesh, "--quiet"}).code, 0);
    const std::string csv = scratch.put("p.csv", six_points);
    const Words fields{"--fields", "attribute0", "--quiet", "--output"};
    EXPECT_EQ(run(plus(plus({"sample", mesh, "--points", csv}, fields), {"-"})).out, six_rows);
    EXPECT_EQ(run(plus(plus({"sample", two, "--points", csv}, fields), {points})).code, 0);
    EXPECT_EQ(run(plus(plus({"sample", two, "--points", points}, fields), {"-"})).out, six_rows);
    expect_error({"sample", mesh, "--points", csv, "--output", mesh}, "--output would overwrite the mesh");
}

TEST(Resample, WhatIsNotUnderstoodIsRefused) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch), out = scratch.path("r.vti");
    const Words line{"resample", two, "--output", out};
    const std::vector<std::pair<Words, std::string>> refusals{
        {line, "no target: expected one of --grid, --spacing and --onto"},
        {plus(line, {"--grid", "2x2x2", "--spacing", "1"}), "more than one target"},
        {plus(line, {"--grid", "2x2"}), "--grid does not fit the mesh: expected 3 numbers of points"},
        {plus(line, {"--grid", "2x2x0"}), "--grid"},
        {plus(line, {"--grid", "2x2x-2"}), "--grid"},
        {plus(line, {"--grid", "2x2x2x2"}), "--grid"},
        {plus(line, {"--grid", "2,2,2"}), "--grid"},
        {plus(line, {"--grid", ""}), "--grid"},
        {plus(line, {"--grid", "3000000000x2x2"}), "points of the grid along x"},
        {plus(line, {"--spacing", "0"}), "--spacing"},
        {plus(line, {"--spacing", "1x1"}), "--spacing does not fit the mesh: expected one number or 3"},
        {plus(line, {"--spacing", "1e-300"}), "points of the grid along x"},
        {plus(line, {"--grid", "2x2x2", "--bounds", "0,1,0,1"}), "--bounds does not fit the mesh: expected 6 numbers"},
        {plus(line, {"--grid", "2x2x2", "--bounds", "1,0,0,1,0,1"}), "bounds of the grid along x"},
        {plus(line, {"--grid", "2x2x2", "--bounds", "0,1,0,1,0,inf"}), "--bounds"},
        {plus(line, {"--onto", two, "--bounds", "0,1,0,1,0,1"}), "--bounds cannot be combined with --onto"},
        {plus(line, {"--onto", ""}), "--onto"},
        {plus(line, {"--grid", "2x2x2", "--range", "0,1"}), "--range needs a picture"},
        {plus(line, {"--onto", two}), "found \".vti\""},
        {{"resample", two, "--output", scratch.path("r.csv"), "--onto", mesh("plate")}, "different dimensions"},
        {{"resample", two, "--output", scratch.path("r.vtu"), "--grid", "2x2x2"}, "found \".vtu\""},
        {{"resample", two, "--output", two + ".node", "--onto", mesh("bracket")}, "--output would overwrite the mesh"},
        {{"resample", mesh("bracket"), "--output", two, "--onto", two}, "--output would overwrite the mesh of --onto"},
        {plus(line, {"--grid", "2x2x2", "--outside", "error"}),
         "point 3 of the grid, counted from 0, is outside the mesh: found (1, 1, 0)"}};
    for (const auto& [arguments, says] : refusals) expect_error(arguments, says);
    EXPECT_EQ(scratch.names(), (Words{"two.ele", "two.node"}));
    EXPECT_EQ(run({"resample", "--help"}).code, 0);
}

TEST(Resample, FilesAppearWholeOrNotAtAll) {
    const Scratch scratch;
    for (const std::string name : {"r.vti", "r.npy", "r.csv", "r.png"}) {
        const std::string file = scratch.put(name, "old");
        const Words line{"resample", mesh("cube-hole"), "--grid",   "400x300x1",
                         "--fields", "attribute0",      "--output", file};
        const Ended r = run(plus(line, {"--quiet"}), {.max_file = 2000});
        EXPECT_EQ(r.code, 2) << name << ' ' << r.signal;
        EXPECT_TRUE(contains(r.err, "File too large")) << r.err;
        EXPECT_EQ(read_file(file), "old");
    }
    EXPECT_EQ(scratch.names(), (Words{"r.csv", "r.npy", "r.png", "r.vti"}));
}

}  // namespace
}  // namespace barycert::cli_test
