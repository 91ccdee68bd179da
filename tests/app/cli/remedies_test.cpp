// Each command that an error prints does what it says: it is run on a file of that kind, and what it makes is read.

#include <gtest/gtest.h>

#include <filesystem>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

struct Remedy {
    const char* name;
    const char* needs;    ///< programs, and modules of Python as "python:NAME"
    const char* make;     ///< shell that makes the file
    const char* command;  ///< what refuses it
    const char* then;     ///< what works once the commands of the remedy were run; empty: there are none
};

constexpr const char* cube_geo = R"(printf 'SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1};' > cube.geo; )";
constexpr const char* tetrahedron_off =
    "printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' > t.off; ";
constexpr const char* pyramid_off =
    "printf 'OFF\n5 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 .5 1\n4 3 2 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n' > "
    "s.off; ";
/// Points of a cube, then cells: of VTK's legacy format.
constexpr const char* cube_vtk =
    "printf '# vtk DataFile Version 3.0\nm\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n0 0 0 1 0 0 1 1 0 0 1 0 "
    "0 0 1 1 0 1 1 1 1 0 1 1\n' > c.vtk; ";

constexpr const char* vtkhdf =
    "pvpython -c 'import h5py, numpy as np; g = h5py.File(\"c.vtkhdf\", \"w\").create_group(\"VTKHDF\"); "
    "g.attrs[\"Version\"] = (1, 0); t = b\"UnstructuredGrid\"; "
    "g.attrs.create(\"Type\", t, dtype=h5py.string_dtype(\"ascii\", len(t))); "
    "g[\"Points\"] = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in (0, 1, 3, 2, 4, 5, 7, 6)], float); "
    "g[\"NumberOfPoints\"] = g[\"NumberOfConnectivityIds\"] = [8]; g[\"NumberOfCells\"] = [1]; "
    "g[\"Connectivity\"] = np.arange(8); g[\"Offsets\"] = np.array([0, 8]); g[\"Types\"] = np.array([12], np.uint8)'";
constexpr const char* fluent_cas =
    "printf '(2 3)\n(10 (0 1 8 0 3))\n(10 (1 1 8 1 3)\n(\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 "
    "1\n))\n(12 (0 1 "
    "1 0 0))\n(12 (2 1 1 1 4))\n(13 (0 1 6 0 0))\n(13 (3 1 6 3 4)\n(\n1 2 3 4 1 0\n5 8 7 6 1 0\n1 5 6 2 1 0\n2 6 7 3 1 "
    "0\n3 7 8 4 1 0\n4 8 5 1 1 0\n))\n' > c.cas";
constexpr const char* openfoam =
    "mkdir -p constant/polyMesh system; cd constant/polyMesh; "
    "put() { printf 'FoamFile { version 2.0; format ascii; class %s; object %s; }\n%b' \"$1\" \"$2\" \"$3\"; }; "
    "put vectorField points '8\n(\n(0 0 0)\n(1 0 0)\n(1 1 0)\n(0 1 0)\n(0 0 1)\n(1 0 1)\n(1 1 1)\n(0 1 1)\n)\n' > "
    "points; "
    "put faceList faces '6\n(\n4(0 3 2 1)\n4(4 5 6 7)\n4(0 1 5 4)\n4(1 2 6 5)\n4(2 3 7 6)\n4(3 0 4 7)\n)\n' > faces; "
    "put labelList owner '6\n(\n0\n0\n0\n0\n0\n0\n)\n' > owner; put labelList neighbour '0\n(\n)\n' > neighbour; "
    "put polyBoundaryMesh boundary '1\n(\nwalls\n{ type wall; nFaces 6; startFace 0; }\n)\n' > boundary; "
    "put dictionary controlDict 'startTime 0; endTime 1; deltaT 1; writeInterval 1;\n' > ../../system/controlDict";

const Remedy remedies[] = {
    {"msh_of_version_1", "gmsh", "gmsh -3 cube.geo -format msh1 -o a.msh", "check a.msh", "check a-new.msh"},
    {"msh_of_another_2", "gmsh", "gmsh -3 cube.geo -format msh2 -o b.msh; sed 's/^2.2 0 8/2.5 0 8/' b.msh > a.msh",
     "check a.msh", "check a-new.msh"},
    {"msh_of_version_3", "gmsh", "gmsh -3 cube.geo -format msh3 -o a.msh", "check a.msh", "check a-new.msh"},
    {"msh_with_groups", "gmsh",
     "printf 'Physical Volume(7) = {1};' >> cube.geo; gmsh -3 cube.geo -format msh3 -o a.msh", "check a.msh",
     "check a-new.msh"},
    {"unv", "gmsh", "gmsh -3 cube.geo -format unv -o a.unv", "check a.unv", "check a-new.msh"},
    {"geo", "gmsh", "", "check cube.geo", "check cube.msh"},
    {"msh_of_a_closed_surface", "gmsh meshio", "gmsh -2 cube.geo -format msh41 -o a.msh",
     "render mesh a.msh --output b.png", "check a.1"},
    {"msh_of_a_closed_surface_of_order_2", "gmsh", "gmsh -2 -order 2 cube.geo -format msh41 -o a.msh",
     "render mesh a.msh --output b.png", ""},
    {"vtk_of_a_closed_surface", "meshio",
     "printf 'CELLS 4 16\n3 0 2 1\n3 0 1 5\n3 1 2 5\n3 2 0 5\nCELL_TYPES 4\n5 5 5 5\n' >> c.vtk",
     "render mesh c.vtk --output b.png", "check c.1"},
    {"vtk_of_quads_in_space", "", "printf 'CELLS 2 10\n4 0 1 2 3\n4 0 1 5 4\nCELL_TYPES 2\n9 9\n' >> c.vtk",
     "render mesh c.vtk --output b.png", ""},
    {"vtk_of_a_plane_at_z_1", "",
     "printf 'CELLS 1 4\n3 4 5 6\nCELL_TYPES 1\n5\n' >> c.vtk; sed -i 's/0 0 0 1 0 0 1 1 0 "
     "0 1 0 /0 0 1 1 0 1 1 1 1 0 1 1 /' c.vtk",
     "render mesh c.vtk --output b.png", ""},
    {"vtk_of_points_without_edges", "pvpython", "printf 'CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n41\n' >> c.vtk",
     "check c.vtk", "check c-simplices.vtu"},
    {"abaqus_of_a_closed_surface", "meshio",
     "printf '*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*ELEMENT, TYPE=STRI3\n1, 1, 3, 2\n2, 1, 2, 4\n3, "
     "2, 3, 4\n4, 3, 1, 4\n' > s.inp",
     "render mesh s.inp --output b.png", "check s.1"},
    {"medit_of_a_closed_surface", "meshio",
     "printf 'MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTriangles\n4\n1 3 "
     "2 "
     "0\n1 2 4 0\n2 3 4 0\n3 1 4 0\nEnd\n' > c.mesh",
     "render mesh c.mesh --output b.png", "check c.1"},
    {"cgns", "pvpython",
     "printf 'CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n' >> c.vtk; pvpython -c 'from paraview.simple import *; "
     "SaveData(\"c.cgns\", OpenDataFile(\"c.vtk\"))'",
     "check c.cgns", "check c-grid.vtu"},
    {"vtkhdf", "pvpython", vtkhdf, "check c.vtkhdf", "check c-grid.vtu"},
    {"fluent", "pvpython", fluent_cas, "check c.cas", "check c-grid.vtu"},
    {"freefem", "FreeFem++", "echo 'mesh Th = square(2, 2); savemesh(Th, \"a.msh\");' | FreeFem++ -nw -f /dev/stdin",
     "check a.msh", "check a.mesh"},
    {"openfoam", "pvpython", openfoam, "check .", "check ./case-grid.vtu"},
    {"off", "", "", "render mesh s.off --output b.png", "check s.1"},
    {"stl", "meshio", "meshio convert t.off a.stl", "render mesh a.stl --output b.png", "check a.1"},
    {"ply", "",
     "printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
     "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 "
     "0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' > a.ply",
     "render mesh a.ply --output b.png", "check a.1"},
    {"poly", "",
     "printf '4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n4 0\n1\n3 1 3 2\n1\n3 1 2 4\n1\n3 2 3 4\n1\n3 3 1 "
     "4\n0\n0\n' > a.poly",
     "render mesh a.poly --output b.png", "check a.1"},
    {"smesh", "",
     "printf '4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n4 0\n3 1 3 2\n3 1 2 4\n3 2 3 4\n3 3 1 4\n0\n0\n' > "
     "a.smesh",
     "render mesh a.smesh --output b.png", "check a.1"},
    {"step", "gmsh", "gmsh -0 cube.geo -o a.step", "check a.step", "check a.msh"},
    {"packed_by_zstd", "zstd", "printf 'CELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n10\n' >> c.vtk; zstd -q --rm c.vtk",
     "check c.vtk.zst", "check c.vtk"},
    {"packed_by_zip", "zip unzip", "printf 'CELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n10\n' >> c.vtk; zip -qm a.zip c.vtk",
     "check a.zip", "check c.vtk"},
    {"packed_by_tar", "", "printf 'CELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n10\n' >> c.vtk; tar -cf a.tar c.vtk; rm c.vtk",
     "check a.tar", "check c.vtk"},
    {"packed_by_tar_and_gzip", "gzip",
     "printf 'CELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n10\n' >> c.vtk; tar -czf a.tgz c.vtk; rm c.vtk", "check a.tgz",
     "check c.vtk"},
    {"obj", "", "printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' > a.obj",
     "render mesh a.obj --output b.png", "check a.1"},
    {"poly_in_the_plane", "", "printf '# square\n4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n' > a.poly", "check a.poly", ""},
    {"poly_in_the_plane_meshed", "", "printf '4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n' > a.poly", "mesh a.poly", ""},
    {"packed_by_bzip2", "bzip2", "printf 'CELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n10\n' >> c.vtk; bzip2 c.vtk",
     "check c.vtk.bz2", "check c.vtk"},
    {"packed_by_xz", "xz", "printf 'CELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n10\n' >> c.vtk; xz -c c.vtk > a.vtk",
     "check a.vtk", "check plain-a.vtk"},
    {"unknown", "", "echo words > a.tsh", "check a.tsh", ""},
    {"matlab", "", "echo words > a.mat", "check a.mat", ""},
};

bool is_there(const std::string& needs) {
    std::string line;
    for (const std::string& word : lines_of(run_shell("printf '%s\\n' " + needs).out)) {
        const std::string python = "python:";
        line += word.starts_with(python) ? "python3 -c 'import " + word.substr(python.size()) + "' && "
                                         : "command -v " + word + " && ";
    }
    return needs.empty() || run_shell(line + "true").code == 0;
}

Words commands_in(const std::string& message) {
    Words commands;
    for (std::size_t at = message.find('`'); at != std::string::npos; at = message.find('`', at + 1)) {
        const std::size_t end = message.find('`', at + 1);
        if (end == std::string::npos) break;
        commands.push_back(message.substr(at + 1, end - at - 1));
        at = end;
    }
    return commands;
}

class Remedies : public ::testing::TestWithParam<Remedy> {};

TEST_P(Remedies, DoesWhatItSays) {
    const Remedy& remedy = GetParam();
    if (!is_there(remedy.needs)) GTEST_SKIP() << "not installed: " << remedy.needs;
    const Scratch scratch;
    const How here{.folder = scratch.folder()};
    run_shell(std::string(cube_geo) + tetrahedron_off + pyramid_off + cube_vtk, here);
    const Ended made = run_shell(remedy.make, here);
    const Ended refused = run_shell(std::string("barycert ") + remedy.command, here);
    ASSERT_EQ(refused.code, 2) << made.err << refused.err;
    ASSERT_TRUE(contains(refused.err, "; ")) << "no remedy: " << refused.err;
    const Words commands = commands_in(refused.err);
    EXPECT_EQ(commands.empty(), std::string(remedy.then).empty()) << refused.err;
    EXPECT_FALSE(contains(refused.err, "IN.") || contains(refused.err, "OUT.")) << refused.err;
    for (const std::string& command : commands) {
        const Ended done = run_shell(command, here);
        EXPECT_EQ(done.code, 0) << command << '\n' << done.err;
    }
    if (commands.empty()) return;
    const Ended works = run_shell(std::string("barycert ") + remedy.then, here);
    EXPECT_EQ(works.code, 0) << refused.err << works.err;
}

INSTANTIATE_TEST_SUITE_P(errors, Remedies, ::testing::ValuesIn(remedies),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace barycert::cli_test
