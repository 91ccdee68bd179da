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

TEST(gmsh, sample_takes_fields_from_the_file) {
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

TEST(gmsh, resample_writes_what_it_reads) {
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

TEST(gmsh, what_is_wrong_is_told_with_the_way_out) {
    const Scratch scratch;
    expect_error({"check", scratch.path("no.msh")}, "no such file");
    expect_error({"check", scratch.put("a.inp", "*Node\n")}, "meshio convert");
    expect_error({"check", scratch.put("b.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n")}, "b.msh:4: ");
    expect_error({"sample", scratch.put("c.h5", "\x89HDF\r\n\x1a\n"), "--points", "p.csv", "--output", "-"}, "");
}

/// The python3 that has meshio; empty if none has.
std::string meshio_python() {
    for (const std::string python : {"python3", "/usr/bin/python3"}) {
        if (run_shell(python + " -c 'import meshio, h5py'").code == 0) return python;
    }
    return {};
}

TEST(other_formats, the_commands_that_are_told_convert_them) {
    const std::string python = meshio_python();
    if (python.empty() || run_shell("gmsh --version && meshio --version").code != 0)
        GTEST_SKIP() << "no meshio with h5py, or no Gmsh";
    const Scratch scratch;
    const Words names{"t.xdmf", "t.inp", "t.su2", "t.vol", "t.mesh", "t.avs", "t.med"};
    std::string script =
        "import meshio, numpy as np\n"
        "p = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1.]])\n"
        "m = meshio.Mesh(p, [('tetra', np.array([[0, 1, 2, 3], [1, 2, 3, 4]]))],\n"
        "    point_data={'point_tags': np.ones(5, int)}, cell_data={'cell_tags': [np.array([-6, -6])]})\n"
        "m.point_tags = {1: ['a']}\nm.cell_tags = {-6: ['b']}\n";
    for (const std::string& name : names) script += "m.write('" + name + "')\n";
    scratch.put("write.py", script);
    const Ended made = run_shell(python + " write.py", {.folder = scratch.folder()});
    ASSERT_EQ(made.code, 0) << made.err;
    for (const std::string& name : names) {
        const Ended refused = run_shell("barycert check " + name, {.folder = scratch.folder()});
        ASSERT_EQ(refused.code, 2) << name;
        const std::size_t begin = refused.err.find('`') + 1, end = refused.err.find('`', begin);
        ASSERT_NE(end, std::string::npos) << refused.err;
        const std::string command = refused.err.substr(begin, end - begin);
        ASSERT_EQ(run_shell(command, {.folder = scratch.folder()}).code, 0) << command;
        const std::string output = contains(command, "gmsh") ? "t.msh" : "t.vtu";
        const Ended read = run_shell("barycert check " + output + " && rm " + output, {.folder = scratch.folder()});
        EXPECT_EQ(read.code, 0) << command << '\n' << read.out << read.err;
        EXPECT_TRUE(contains(read.out, "2 cells")) << read.out;
    }
}

}  // namespace
}  // namespace barycert::cli_test
