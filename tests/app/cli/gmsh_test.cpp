// .msh files through the program.

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

/// The mesh of put_two_cells as Gmsh would write it: a point and a triangle first; tags with gaps.
std::string put_msh(const Scratch& scratch, const std::string& name = "two.msh") {
    return scratch.put(
        name,
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 6 \"steel\"\n$EndPhysicalNames\n"
        "$Entities\n0 0 0 2\n1 0 0 0 1 1 1 1 6 0 \n2 0 0 0 1 1 1 0 0 \n$EndEntities\n"
        "$Nodes\n1 5 10 50\n3 1 0 5\n10\n20\n30\n40\n50\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n"
        "$Elements\n4 4 1 4\n0 1 15 1\n1 10 \n2 1 2 1\n2 20 30 40 \n3 1 4 1\n3 10 20 30 40 \n3 2 4 1\n4 20 30 40 50 \n"
        "$EndElements\n"
        "$NodeData\n1\n\"attribute0\"\n1\n0\n3\n0\n1\n5\n10 1\n20 3\n30 5\n40 9\n50 15\n$EndNodeData\n"
        "$ElementData\n1\n\"c\"\n1\n0\n3\n0\n1\n2\n3 7\n4 9\n$EndElementData\n");
}

TEST(Gmsh, SampleTakesFieldsFromTheFile) {
    const Scratch scratch;
    const std::string two = put_msh(scratch), points = scratch.put("p.csv", six_points);
    const std::string stem = put_two_cells(scratch, "tetgen");
    const auto rows = [&](const std::string& mesh, const std::string& fields) {
        const Ended r = run({"sample", mesh, "--points", points, "--output", "-", "--fields", fields, "--quiet"});
        EXPECT_EQ(r.code, 0) << r.err;
        return r.out;
    };
    // The same values; cells are the file's own numbers, of which the point and the triangle take two.
    std::string expected = six_rows;
    for (const auto& [from, to] : {std::pair{",0,interior", ",2,interior"},
                                   {",1,interior", ",3,interior"},
                                   {",0,face", ",2,face"},
                                   {",0,edge", ",2,edge"},
                                   {",0,vertex", ",2,vertex"}})
        expected.replace(expected.find(from), std::string(from).size(), to);
    EXPECT_EQ(rows(two, "attribute0"), expected);
    EXPECT_TRUE(contains(rows(two, "c,gmsh:physical"), ",interior,7,6\n"));
    EXPECT_EQ(run({"check", two}).code, 0);
}

TEST(Gmsh, ResampleWritesWhatItReads) {
    const Scratch scratch;
    const std::string two = put_msh(scratch), stem = put_two_cells(scratch, "tetgen");
    const Ended r = run(
        {"resample", stem, "--onto", two, "--output", scratch.path("out.msh"), "--fields", "attribute0", "--quiet"});
    EXPECT_EQ(r.code, 0) << r.err;
    const Ended back = run_shell(
        "printf 'x,y,z\\n.25,.25,.25\\n' | barycert sample out.msh --points - --output - --fields "
        "attribute0,c,gmsh:physical --quiet",
        {.folder = scratch.folder()});
    EXPECT_EQ(back.code, 0) << back.err;
    EXPECT_TRUE(contains(back.out, ",4.5,7,6\n")) << back.out;
    EXPECT_TRUE(contains(read_file(scratch.path("out.msh")), "3 6 \"steel\""));
    // No output is an input.
    expect_error({"resample", stem, "--onto", two, "--output", two}, "");
    expect_error({"resample", stem, "--onto", two, "--output", scratch.path("out.mesh")}, ".msh");
}

TEST(Gmsh, WhatIsWrongIsToldWithTheWayOut) {
    const Scratch scratch;
    expect_error({"check", scratch.path("no.msh")}, "no such file");
    expect_error({"check", scratch.put("b.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n")}, "b.msh:4: ");
    expect_error({"sample", scratch.put("c.h5", "\x89HDF\r\n\x1a\n"), "--points", "p.csv", "--output", "-"}, "");
}

}  // namespace
}  // namespace barycert::cli_test
