// Which reader a file goes to, and what is said of files that none reads.
#include "io/mesh_format.hpp"

#include <cstdlib>
#include <filesystem>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "io/other_formats.hpp"
#include "tests/io/tetgen/mesh_files.hpp"

namespace barycert::testing {
namespace {

using io::MeshFormat;

const char* const msh_text =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 "
    "1\n$EndNodes\n"
    "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";
const char* const vtk_text =
    "# vtk DataFile Version 3.0\nm\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\n"
    "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";

TEST(MeshFormat, FirstBytesCountMoreThanSuffixes) {
    const TemporaryFolder folder;
    for (const char* name : {"a.msh", "a.vtk", "a.VTU", "a", "a.dat", "a.mesh", "a.node"}) {
        put(folder / name, msh_text);
        EXPECT_EQ(io::mesh_format(folder / name).value(), MeshFormat::gmsh) << name;
        EXPECT_EQ(read_mesh(folder / name).value().cell_count(), 1U) << name;
        EXPECT_EQ(mesh_files(folder / name), std::vector<std::string>{folder / name});
        put(folder / name, vtk_text);
        EXPECT_EQ(io::mesh_format(folder / name).value(), MeshFormat::vtk) << name;
        EXPECT_EQ(read_mesh(folder / name).value().cell_count(), 1U) << name;
        std::filesystem::remove(folder / name);
    }
}

TEST(MeshFormat, StemsOfTetgen) {
    const TemporaryFolder folder;
    for (const char* stem : {"m", "m.1", "m.msh", "m.vtu", "m.inp"}) {
        put(folder / (std::string(stem) + ".node"), tetrahedron_node);
        put(folder / (std::string(stem) + ".ele"), tetrahedron_ele);
        for (const char* suffix : {"", ".node", ".ele"})
            EXPECT_EQ(read_mesh(folder / (std::string(stem) + suffix)).value().cell_count(), 1U) << stem << suffix;
    }
    // The file itself, if there is one with a suffix that says what it is.
    put(folder / "m.msh", msh_text);
    EXPECT_EQ(io::mesh_format(folder / "m.msh").value(), MeshFormat::gmsh);
    put(folder / "m.1", "notes");
    EXPECT_EQ(io::mesh_format(folder / "m.1").value(), MeshFormat::tetgen);
}

struct Other {
    const char* name;
    std::string bytes;
    const char* what;    ///< part of it
    const char* remedy;  ///< part of it
};

TEST(MeshFormat, FilesThatAreNotRead) {
    const std::string hdf5 = "\x89HDF\r\n\x1a\n and more";
    const std::vector<Other> others{
        {"a.cgns", hdf5, "a CGNS file", "SaveData(sys.argv[2], MergeBlocks(OpenDataFile(sys.argv[1])))'"},
        {"a.h5", hdf5, "an HDF5 file", ".xdmf"},
        {"a.msh", hdf5, "an HDF5 file", ".xdmf"},
        {"a.unv", "    -1\n  2411\n", "a universal file of I-deas", "gmsh "},
        {"a.foam", "", "a case of OpenFOAM", "pvpython"},
        {"points", "FoamFile\n{\n", "a case of OpenFOAM", "name the folder of the case"},
        {"a.stl", "", "a surface, not a mesh", "`barycert mesh "},
        {"a.off", "OFF\n", "a surface, not a mesh", "`barycert mesh "},
        {"a.ply", "ply\nformat ascii 1.0\n", "a surface, not a mesh", "`barycert mesh "},
        {"a.ply", "ply\nformat binary_little_endian 1.0\n", "a surface, not a mesh", "`barycert mesh "},
        {"a.obj", "", "a surface, not a mesh", "`barycert mesh "},
        {"a.geo", "", "a geometry, not a mesh", "`gmsh -3 "},
        {"a.step", "", "a geometry, not a mesh", "`gmsh -3 "},
        {"a.vtu.gz", "\x1f\x8b", "the file is packed by gzip", "pack it again"},
        {"a.vtu", "\x1f\x8b", "the file is packed by gzip", "pack it again"},
        {"a.node", "\x1f\x8b", "the file is packed by gzip", "pack it again"},
        {"a.vtu", "BZh", "a file packed by bzip2", "`bzip2 -dc "},
        {"a.poly", "4 2 0\n", "a PLC in the plane, not a mesh", "Triangle"},
        {"a.zip", "PK\x03\x04", "a ZIP archive", "`unzip "},
        {"a.csv", "x,y\n", "a table, not a mesh", "--points"},
        {"a.npy", "\x93NUMPY", "a table, not a mesh", "--points"},
        {"a.msh", "5 2 6\n0 0 1\n", "a mesh of FreeFem", "savemesh"},
        {"a.rst", "?", "does not read this format", ".vtu or Gmsh's .msh"},
        {"it's a.unv", "", "a universal file of I-deas", "it'\\''s a.unv' "},
    };
    const TemporaryFolder folder;
    for (const Other& other : others) {
        SCOPED_TRACE(other.name);
        put(folder / other.name, other.bytes);
        const Result<Mesh> mesh = read_mesh(folder / other.name);
        ASSERT_FALSE(mesh);
        SCOPED_TRACE(mesh.error().message());
        EXPECT_EQ(mesh.error().file, folder / other.name);
        EXPECT_NE(mesh.error().what.find(other.what), std::string::npos);
        EXPECT_NE(mesh.error().remedy.find(other.remedy), std::string::npos);
        EXPECT_EQ(mesh.error().message().find("no such file"), std::string::npos);
        std::filesystem::remove(folder / other.name);
        if (!io::other_format_by_suffix(other.name)) continue;
        // A file that is not there is missing, whatever it would be.
        const Result<Mesh> missing = read_mesh(folder / other.name);
        EXPECT_EQ(missing.error().what, "no such file");
        EXPECT_NE(missing.error().remedy.find("would not be read"), std::string::npos);
    }
}

TEST(MeshFormat, FilesThatMeshioReads) {
    const std::string hdf5 = "\x89HDF\r\n\x1a\n and more";
    const std::vector<Other> others{
        {"a.inp", "", "abaqus", ""},
        {"a", "*Heading\n", "abaqus", ""},
        {"a.msh", "** a comment\n\n*NODE, NSET=a\n", "abaqus", ""},
        {"a.inp", "# a comment\n3 1 0 0 0\n1 0 0 0\n", "avsucd", ""},
        {"a.inp", "3 1 0 0 0\n1 2 3\n", "abaqus", ""},
        {"a.ucd", "", "avsucd", ""},
        {"a.xdmf", "", "xdmf", ""},
        {"a.vtu", "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">", "xdmf", ""},
        {"a.xmf", "", "xdmf", ""},
        {"a.med", hdf5, "med", ""},
        {"a.e", hdf5, "exodus", ""},
        {"a.exo", "CDF\x01", "exodus", ""},
        {"a.vol", "mesh3d\n", "netgen", ""},
        {"a.su2", "", "su2", ""},
        {"a.foo", "% comment\nNDIME= 3\n", "su2", ""},
        {"a.bdf", "", "nastran", ""},
        {"a.mdpa", "", "mdpa", ""},
        {"a.xml", "<dolfin/>", "dolfin-xml", ""},
        {"a.msh", "(0 \"GAMBIT to Fluent File\")\n", "ansys", ""},
    };
    const TemporaryFolder folder;
    for (const Other& other : others) {
        put(folder / other.name, other.bytes);
        EXPECT_EQ(io::mesh_format(folder / other.name).value(), MeshFormat::by_meshio) << other.name;
        EXPECT_EQ(io::meshio_format(folder / other.name), other.what) << other.name;
        EXPECT_EQ(mesh_files(folder / other.name), std::vector<std::string>{folder / other.name});
        std::filesystem::remove(folder / other.name);
    }
}

TEST(MeshFormat, PackedPartsOfAMesh) {
    const TemporaryFolder folder;
    put(folder / "a.node", "\x1f\x8b\x08");
    put(folder / "a.ele", "\x1f\x8b\x08");
    const Result<Mesh> mesh = read_mesh(folder / "a");  // by its stem
    ASSERT_FALSE(mesh);
    EXPECT_NE(mesh.error().what.find("packed by gzip"), std::string::npos) << mesh.error().message();
    put(folder / "p.csv", "\x1f\x8b\x08");
    EXPECT_NE(open_points(folder / "p.csv", 3).error().what.find("packed by gzip"), std::string::npos);
    put(folder / "p.poly", "\x1f\x8b\x08");
    EXPECT_NE(read_plc(folder / "p.poly").error().what.find("packed by gzip"), std::string::npos);
}

TEST(MeshFormat, WhatIsNotThere) {
    const TemporaryFolder folder;
    for (const char* name : {"a.msh", "a.vtu", "a.VTK"}) {
        const Error error = read_mesh(folder / name).error();
        EXPECT_EQ(error.what, "no such file");
        EXPECT_EQ(error.remedy, "check the path");
    }
    EXPECT_NE(read_mesh(folder / "part.1").error().remedy.find("MESH is the stem of TetGen's files"),
              std::string::npos);
    put(folder / "part.msh", msh_text);
    EXPECT_EQ(read_mesh(folder / "part").error().remedy,
              "there is " + folder / "part.msh" + ": name it with its suffix");
    EXPECT_EQ(read_mesh(folder / ".").error().what, "this is a folder");
    std::filesystem::create_directories(folder / "case/constant/polyMesh");
    EXPECT_NE(read_mesh(folder / "case").error().what.find("a case of OpenFOAM"), std::string::npos);
    put(folder / "bin.node", "4\t3\t0\t0\tBIN\nxxxx");
    put(folder / "bin.ele", "1\t4\t0\tBIN\nxxxx");
    EXPECT_EQ(read_mesh(folder / "bin").error().what, "a binary file");
    EXPECT_NE(read_mesh(folder / "bin").error().remedy.find("Chaste"), std::string::npos);
}

TEST(MeshFormat, WriteBySuffix) {
    const TemporaryFolder folder;
    put(folder / "a.msh", msh_text);
    const Mesh mesh = read_mesh(folder / "a.msh").value();
    for (const char* name : {"b.msh", "b.vtu", "b.vtk", "b.node", "c.1", "d"}) {
        const Status written = write_mesh(mesh, folder / name);
        ASSERT_TRUE(written) << written.error().message();
        const Mesh read = read_mesh(folder / name).value();
        EXPECT_EQ(read.points, mesh.points) << name;
        EXPECT_EQ(read.cells, mesh.cells) << name;
    }
    const Status other = write_mesh(mesh, folder / "b.mesh");
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().found, "\".mesh\"");
}

}  // namespace
}  // namespace barycert::testing
