// Meshes in formats that are read by way of meshio.

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

constexpr const char* python = "/usr/bin/python3";

/// Two tetrahedra on a face; x, y, z of the fifth node have no short form.
constexpr const char* abaqus =
    "*HEADING\ntwo\n*NODE\n10, 0, 0, 0\n20, 1, 0, 0\n30, 0, 1, 0\n40, 0, 0, 1\n50, 0.1, 0.7, 1.3000000000000003\n"
    "*ELEMENT, TYPE=S3\n1, 10, 20, 30\n*ELEMENT, TYPE=C3D4\n2, 10, 20, 30, 40\n3, 20, 30, 40, 50\n"
    "*NSET, NSET=base\n10, 20, 30\n";

bool has_meshio() {
    static const bool there = run_shell(std::string(python) + " -c 'import meshio'").code == 0;
    return there;
}

class Converted : public ::testing::Test {
protected:
    void SetUp() override {
        if (!has_meshio()) GTEST_SKIP() << "no meshio";
    }
    Ended barycert(const Words& words, Words environment = {}) const {
        environment.push_back(std::string("BARYCERT_MESHIO=") + python);
        return run(words, {.environment = environment, .folder = scratch_.folder()});
    }
    void shell(const std::string& line) const {
        const Ended done = run_shell(line, {.folder = scratch_.folder()});
        ASSERT_EQ(done.code, 0) << done.err;
    }
    /// A meshio of the test's own, before that of the system.
    Words fake(const std::string& text) const {
        std::filesystem::create_directory(scratch_.path("fake"));
        scratch_.put("fake/meshio.py", text);
        return {"PYTHONPATH=" + scratch_.path("fake")};
    }
    Scratch scratch_;
};

TEST(NotConverted, TextWithoutAKeywordDoesNotReachMeshio) {
    const Scratch scratch;
    std::string text;
    while (text.size() < 70000) text += "aaa bbb ccc ddd eee\n";
    const Ended r = run({"check", scratch.put("a.inp", text)}, {.environment = {"BARYCERT_MESHIO=/none/python"}});
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(contains(r.err, "a.inp: not a mesh of Abaqus: expected a keyword, such as *NODE")) << r.err;
    const Ended good = run({"check", scratch.put("b.inp", "** aaa\n*HEADING\n" + text)},
                           {.environment = {"BARYCERT_MESHIO=/none/python"}});
    EXPECT_TRUE(contains(good.err, "meshio, which is not installed")) << good.err;
}

TEST_F(Converted, NodesAndCellsInTheOrderOfTheFile) {
    scratch_.put("a.inp", abaqus);
    const Ended check = barycert({"check", "a.inp"});
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_TRUE(contains(check.err + check.out, "a.inp: converted: by meshio ")) << check.err << check.out;
    EXPECT_TRUE(contains(check.err + check.out, "point sets base")) << check.err << check.out;
    const Ended rows = barycert({"sample", "a.inp", "--points", "a.inp", "--output", "-"});
    EXPECT_EQ(rows.code, 0) << rows.err;
    EXPECT_EQ(rows.out,
              "x,y,z,cell,feature\n0,0,0,1,vertex\n1,0,0,1,vertex\n0,1,0,1,vertex\n0,0,1,1,vertex\n"
              "0.1,0.7,1.3000000000000003,2,vertex\n");
}

TEST_F(Converted, NoFileIsLeftOrOverwritten) {
    scratch_.put("a.inp", abaqus);
    shell("mkdir tmp");
    EXPECT_EQ(barycert({"check", "a.inp"}, {"TMPDIR=" + scratch_.path("tmp")}).code, 0);
    EXPECT_EQ(scratch_.names(), (Words{"a.inp", "tmp"}));
    EXPECT_EQ(barycert({"sample", "a.inp", "--points", "a.inp", "--output", "-", "--json", "a.inp"}).code, 2);
    EXPECT_EQ(read_file(scratch_.path("a.inp")), abaqus);
}

/// Doubles with all their bits, integers, vectors, values of cells in several blocks.
TEST_F(Converted, FieldsToTheBit) {
    scratch_.put("make.py", R"(
import meshio, numpy as np
r = np.random.default_rng(1)
p = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1/3, 1, 1]])
t = r.standard_normal(5) * 10.0 ** r.integers(-300, 300, 5)
m = meshio.Mesh(p, [("triangle", [[0, 1, 2]]), ("tetra", [[0, 1, 2, 3], [1, 2, 3, 4]])],
                point_data={"T": t, "v": r.random((5, 3)), "n": np.arange(5)}, cell_data={"q": [[7.5], [0.1, 0.2]]})
m.write("a.xdmf")
m.write("b.vtu")
)");
    shell(std::string(python) + " make.py");
    const auto rows = [&](const std::string& mesh) {
        const Ended r =
            barycert({"sample", mesh, "--points", "b.vtu", "--output", "-", "--fields", "T,v,n,q", "--quiet"});
        EXPECT_EQ(r.code, 0) << r.err;
        return r.out;
    };
    const std::string expected = rows("b.vtu");
    EXPECT_EQ(lines_of(expected).size(), 6U);
    EXPECT_EQ(rows("a.xdmf"), expected);
    // Arrays for another mesh of the same nodes.
    scratch_.put("c.inp", abaqus);
    for (const std::string file : {"a.xdmf", "b.vtu"}) {
        const Ended r = barycert({"sample", "c.inp", "--points", "b.vtu", "--output", "-", "--field",
                                  "w=" + file + ":T", "--fields", "w", "--quiet"});
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_TRUE(contains(r.out, ",w\n")) << r.out;
        scratch_.put(file + ".csv", r.out);
    }
    EXPECT_EQ(read_file(scratch_.path("a.xdmf.csv")), read_file(scratch_.path("b.vtu.csv")));
}

/// Files beside it that meshio opens, under any name, in Python or by HDF5.
TEST_F(Converted, FilesBesideItAreNoOutputs) {
    scratch_.put("make.py", R"(
import meshio, os
m = meshio.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.]], [("tetra", [[0, 1, 2, 3]])])
for kind, beside in ("HDF", "a.h5"), ("Binary", "a0.bin"):
    m.write("a.xdmf", data_format=kind)
    os.rename(beside, kind)
    with open(kind + ".xdmf", "w") as f:
        f.write(open("a.xdmf").read().replace(beside, kind))
)");
    shell(std::string(python) + " make.py");
    scratch_.put("els.txt", abaqus);
    scratch_.put("a.inp", "*HEADING\nall\n*INCLUDE, INPUT=els.txt\n");
    for (const auto& [mesh, beside] : {std::pair("HDF.xdmf", "HDF"), {"Binary.xdmf", "Binary"}, {"a.inp", "els.txt"}}) {
        const std::string before = read_file(scratch_.path(beside));
        const Ended r = barycert({"check", mesh, "--json", beside, "--quiet"});
        EXPECT_EQ(r.code, 2) << mesh;
        EXPECT_TRUE(contains(r.err, beside)) << r.err;
        EXPECT_EQ(read_file(scratch_.path(beside)), before) << mesh;
    }
}

/// Abaqus and VTK have one order of mid-edge nodes; here each node is off its middle on its own, so that none is
/// guessed.
TEST_F(Converted, SecondOrderCells) {
    scratch_.put("a.inp",
                 "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, .5, 0, 0\n6, .5, .5, 0\n7, 0, .5, 0\n"
                 "8, 0, 0, .5\n9, .5, 0, .5\n10, 0, .5, .5\n*ELEMENT, TYPE=C3D10\n1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10\n");
    const Ended rows = barycert({"sample", "a.inp", "--points", "a.inp", "--output", "-"});
    EXPECT_EQ(rows.code, 0) << rows.err;
    EXPECT_EQ(lines_of(rows.out).at(10), "0,0.5,0.5,0,edge");
}

TEST_F(Converted, OtherFormats) {
    scratch_.put("make.py", R"(
import meshio, numpy as np
p = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1.0, 1, 1]])
m = meshio.Mesh(p, [("tetra", np.array([[0, 1, 2, 3], [1, 2, 3, 4]]))])
for suffix in "inp xdmf med vol xml avs ugrid mdpa f3grid h5m hmf post dat bdf".split():
    m.write("a." + suffix)
)");
    shell(std::string(python) + " make.py");
    scratch_.put("a.su2",
                 "NDIME= 3\nNELEM= 2\n10 0 1 2 3 0\n10 1 2 3 4 1\nNPOIN= 5\n0 0 0 0\n1 0 0 1\n0 1 0 2\n0 0 1 3\n"
                 "1 1 1 4\nNMARK= 1\nMARKER_TAG= w\nMARKER_ELEMS= 1\n5 0 1 2\n");
    // Lines of order 3 do not keep it from being read.
    shell("sed 's/^End Elements/End Elements\\n/' a.mdpa > /dev/null; gzip -k a.inp");
    for (const char* suffix : {"inp", "xdmf", "med", "vol", "xml", "avs", "ugrid", "mdpa", "f3grid", "h5m", "hmf",
                               "post", "dat", "bdf", "su2", "inp.gz"}) {
        const std::string name = std::string("a.") + suffix;
        const Ended check = barycert({"check", name});
        EXPECT_EQ(check.code, 0) << name << check.err;
        EXPECT_TRUE(contains(check.out, "2 cells")) << name << check.out;
    }
}

TEST_F(Converted, WhatCannotBeReadIsAnError) {
    scratch_.put("a.inp", "*NODE\n1, 0, 0\n*ELEMENT, TYPE=XYZ\n1, 1\n");
    const Ended bad = barycert({"check", "a.inp"});
    EXPECT_EQ(bad.code, 2);
    EXPECT_TRUE(contains(bad.err, "a.inp: meshio ") && contains(bad.err, "cannot read the file")) << bad.err;
    scratch_.put("b.inp", std::string(100000, '\0'));
    EXPECT_TRUE(contains(barycert({"check", "b.inp"}).err, "not a mesh of Abaqus"));
    scratch_.put("c.vol", "mesh3d\n");
    EXPECT_EQ(barycert({"check", "c.vol"}).code, 2);
    // Faults of the mesh are told of the file itself.
    scratch_.put("q.inp", "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,5\n*ELEMENT, TYPE=CPS4\n1, 1,2,3,4\n");
    const Ended off_plane = barycert({"render", "mesh", "q.inp", "--output", "q.png"});
    EXPECT_EQ(off_plane.code, 2);
    EXPECT_TRUE(contains(off_plane.err, "q.inp: z of point 3 (from 0)")) << off_plane.err;
    EXPECT_FALSE(contains(off_plane.err, "/proc/")) << off_plane.err;
}

/// All that meshio has of each kind, of both orders, in one file; values of cells come through.
TEST_F(Converted, CellsOfAllShapes) {
    scratch_.put("make.py", R"(
import meshio, numpy as np
x = np.array([[i, j, k] for k in (0, 1, 2) for j in (0, 1) for i in (0, 1, 2)] + [[2.5, .5, .5]], float)
cells = [("hexahedron", [[0, 1, 4, 3, 6, 7, 10, 9]]), ("wedge", [[6, 7, 9, 12, 13, 15], [7, 10, 9, 13, 16, 15]]),
         ("pyramid", [[2, 5, 11, 8, 18]]), ("quad", [[0, 1, 4, 3]]), ("tetra", [[1, 2, 4, 7]])]
meshio.Mesh(x, cells, cell_data={"q": [[5.], [1., 2.], [3.], [7.], [9.]]}).write("a.xdmf")
)");
    shell(std::string(python) + " make.py");
    const Ended check = barycert({"check", "a.xdmf", "--json", "a.json", "--quiet"});
    EXPECT_TRUE(
        contains(check.err + check.out + read_file(scratch_.path("a.json")), "5 cells are cut into 15 tetrahedra"))
        << check.err << read_file(scratch_.path("a.json"));
    scratch_.put("p.csv", "x,y,z\n.25,.5,.5\n.2,.25,1.5\n.8,.9,1.5\n2.25,.5,.5\n");
    const Ended rows = barycert({"sample", "a.xdmf", "--points", "p.csv", "--output", "-", "--fields", "q", "--quiet"});
    EXPECT_EQ(lines_of(rows.out).size(), 5U) << rows.err;
    for (const char* end : {",5\n", ",1\n", ",2\n", ",3\n"}) EXPECT_TRUE(contains(rows.out, end)) << rows.out;
    scratch_.put("h.inp",
                 "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
                 "*ELEMENT, TYPE=C3D8\n1, 1,2,3,4,5,6,7,8\n");
    const Ended hexahedron = barycert({"sample", "h.inp", "--points", "h.inp", "--output", "-"});
    EXPECT_EQ(hexahedron.code, 0) << hexahedron.err;
    EXPECT_EQ(lines_of(hexahedron.out).at(7), "1,1,1,0,vertex");
    scratch_.put("q.inp", "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n*ELEMENT, TYPE=CPS4\n1, 1,2,3,4\n");
    const Ended quad = barycert({"sample", "q.inp", "--points", "q.inp", "--output", "-"});
    EXPECT_EQ(quad.code, 0) << quad.err;
    EXPECT_EQ(lines_of(quad.out).at(4), "0,1,0,vertex") << quad.out;
}

/// meshio keeps the last block of nodes alone; a number in two blocks is one of two parts.
TEST_F(Converted, SeveralBlocksOfNodesOfAbaqus) {
    const std::string two =
        "*NODE\n10, 0, 0, 0\n20, 1, 0, 0\n*NODE\n30, 0, 1, 0\n40, 0, 0, 1\n*ELEMENT, TYPE=C3D4\n1, 10, 20, 30, 40\n"
        "*NODE\n5, 1, 1, 1\n*ELEMENT, TYPE=C3D4\n2, 20, 30, 40, 5\n";
    scratch_.put("a.inp", two);
    const Ended rows = barycert({"sample", "a.inp", "--points", "a.inp", "--output", "-", "--quiet"});
    EXPECT_EQ(rows.code, 0) << rows.err;
    EXPECT_EQ(rows.out,
              "x,y,z,cell,feature\n0,0,0,0,vertex\n1,0,0,0,vertex\n0,1,0,0,vertex\n0,0,1,0,vertex\n1,1,1,1,vertex\n");
    scratch_.put("b.inp", two + "*NODE\n30, 9, 9, 9\n");
    const Ended twice = barycert({"check", "b.inp"});
    EXPECT_EQ(twice.code, 2);
    EXPECT_TRUE(contains(twice.err, "b.inp: a number of two nodes") && contains(twice.err, "node 30")) << twice.err;
    scratch_.put("c.inp", two + "*NODE\n31, 9, 9\n");
    EXPECT_EQ(barycert({"check", "c.inp"}).code, 2);
}

TEST_F(Converted, ZonesOfSu2) {
    const std::string zone = "NDIME= 2\nNELEM= 1\n5 0 1 2 0\nNPOIN= 3\n0 0 0\n1 0 1\n0 1 2\nNMARK= 0\n";
    scratch_.put("one.su2", "NZONE= 1 % all\nIZONE= 1\n" + zone);
    EXPECT_EQ(barycert({"check", "one.su2"}).code, 0);
    scratch_.put("two.su2", "NZONE=2\nIZONE= 1\n" + zone + "IZONE= 2\n" + zone);
    scratch_.put("more.su2", zone + zone);
    for (const char* name : {"two.su2", "more.su2"}) {
        const Ended zones = barycert({"check", name});
        EXPECT_EQ(zones.code, 2);
        EXPECT_TRUE(contains(zones.err, std::string(name) + ": a mesh of SU2 in several zones")) << zones.err;
    }
}

TEST_F(Converted, ElementsAndGeometriesOfKratos) {
    const std::string nodes = "Begin Nodes\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\nEnd Nodes\n";
    const std::string geometries = "Begin Geometries Tetrahedra3D4 // all\n1 1 2 3 4\nEnd Geometries\n";
    scratch_.put("a.mdpa", nodes + geometries);
    const Ended check = barycert({"check", "a.mdpa"});
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_TRUE(contains(check.out, "1 cell")) << check.out;
    scratch_.put("b.mdpa", nodes + "Begin Elements Element3D4N\n1 0 1 2 3 4\nEnd Elements\n" + geometries);
    const Ended both = barycert({"check", "b.mdpa"});
    EXPECT_EQ(both.code, 0) << both.err;
    EXPECT_TRUE(contains(both.out, "geometries, beside the elements")) << both.out;
    scratch_.put("s.mdpa",
                 nodes +
                     "Begin Elements ShellThinElement3D3N\n1 0 1 3 2\n2 0 1 2 4\n3 0 2 3 4\n4 0 3 1 4\nEnd Elements\n"
                     "Begin Conditions LineCondition3D2N\n1 0 1 2\nEnd Conditions\n");
    const Ended shell = barycert({"check", "s.mdpa"});
    EXPECT_EQ(shell.code, 0) << shell.err;
    EXPECT_TRUE(contains(shell.out, "4 triangles")) << shell.out;
    scratch_.put("c.mdpa", "Begin Nodes\n1 0 0 0\n3 1 0 0\n2 0 1 0\n4 0 0 1\nEnd Nodes\n" + geometries);
    const Ended order = barycert({"check", "c.mdpa"});
    EXPECT_EQ(order.code, 2);
    EXPECT_TRUE(contains(order.err, "node 3 in place of 2")) << order.err;
}

TEST_F(Converted, SurfacesInSpace) {
    scratch_.put("a.inp",
                 "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
                 "*ELEMENT, TYPE=S4\n1, 1,4,3,2\n2, 5,6,7,8\n3, 1,2,6,5\n4, 2,3,7,6\n5, 3,4,8,7\n"
                 "*ELEMENT, TYPE=S3\n6, 4,1,5\n7, 4,5,8\n");
    const Ended check = barycert({"check", "a.inp"});
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_TRUE(contains(check.out, "12 triangles")) << check.out;
    EXPECT_TRUE(contains(check.err + check.out, "5 polygons, which are cut into triangles")) << check.err;
}

TEST_F(Converted, ItIsTurnedOffByAnEmptyVariable) {
    scratch_.put("a.inp", abaqus);
    const Ended off = run({"check", scratch_.path("a.inp")}, {.environment = {"BARYCERT_MESHIO="}});
    EXPECT_EQ(off.code, 2);
    EXPECT_TRUE(contains(off.err, "BARYCERT_MESHIO turns off")) << off.err;
    const Ended none = run({"check", scratch_.path("a.inp")}, {.environment = {"BARYCERT_MESHIO=/nowhere/python"}});
    EXPECT_EQ(none.code, 2);
    EXPECT_TRUE(contains(none.err, "apt install python3-meshio")) << none.err;
}

TEST_F(Converted, ModulesOfTheWorkingFolderAreNotRun) {
    scratch_.put("a.inp", abaqus);
    for (const char* module : {"meshio.py", "numpy.py", "json.py", "resource.py"})
        scratch_.put(module, "open('ran', 'w')\n");
    EXPECT_EQ(barycert({"check", "a.inp"}).code, 0);
    EXPECT_FALSE(std::filesystem::exists(scratch_.path("ran")));
}

TEST_F(Converted, MessagesArePassedOnOnce) {
    scratch_.put("a.inp", abaqus);
    const Words environment = fake(
        "import sys, numpy\n__version__ = 'of a test'\n"
        "class Block:\n    type = 'tetra'\n    data = numpy.array([[0, 1, 2, 3]])\n"
        "class Mesh:\n    points = numpy.eye(4, 3)\n    cells = [Block]\n"
        "    point_data = {'T': numpy.arange(4.), 'lost': numpy.arange(3.), 'text': numpy.array(list('abcd'))}\n"
        "    cell_data = {'big': [numpy.array([1j])]}\n"
        "def read(path, file_format):\n    print('Warning: half of it\\x1b[31m')\n    print('x\\n' * 3)\n"
        "    sys.stderr.write('y' * 1000000)\n    return Mesh\n");
    const Ended check = barycert({"check", "a.inp"}, environment);
    EXPECT_EQ(check.code, 0) << check.err;
    const std::string all = check.out + check.err;
    for (const char* part :
         {"by meshio of a test, as abaqus", "meshio says: Warning: half of it\\x1b[31m",
          "point data lost, which does not have one row for each", "point data text", "cell data big"})
        EXPECT_TRUE(contains(all, part)) << part << '\n' << all.substr(0, 3000);
    EXPECT_EQ(check.err.find("meshio says: x"), check.err.rfind("meshio says: x"));
    EXPECT_LT(all.size(), 10000U);
}

/// Whether a process that wrote its number to `file` is there, once it did.
bool lives(const std::string& file) {
    std::string number;
    for (int i = 0; i < 600 && (number.empty() || number.back() != '\n'); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (std::filesystem::exists(file)) number = read_file(file);
    }
    // One that has ended and that nobody waits for is no more.
    const auto is_there = [&] {
        return run_shell("grep -q '^State:.[^ZX]' /proc/" + std::to_string(std::stoi(number)) + "/status").code == 0;
    };
    for (int i = 0; i < 500 && is_there(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return is_there();
}

TEST_F(Converted, ItEndsWithTheRun) {
    scratch_.put("a.inp", abaqus);
    const Words environment = fake("import os, time\nopen('pid', 'w').write(f'{os.getpid()}\\n')\ntime.sleep(50)\n");
    Words all = environment;
    all.push_back(std::string("BARYCERT_MESHIO=") + python);
    const Ended killed =
        run({"check", "a.inp"},
            {.environment = all, .folder = scratch_.folder(), .kill_after = std::chrono::microseconds(4000000)});
    EXPECT_EQ(killed.signal, SIGKILL);
    EXPECT_FALSE(lives(scratch_.path("pid")));
}

TEST_F(Converted, WhatItStartsEndsWithIt) {
    scratch_.put("a.inp", abaqus);
    // The child keeps a copy of the answer's stream open, and would live for long.
    const Words environment = fake(
        "import os, time\n"
        "if os.fork() == 0:\n    open('pid', 'w').write(f'{os.getpid()}\\n')\n    for f in range(5): os.close(f)\n"
        "    time.sleep(50)\n"
        "while not os.path.exists('pid'): time.sleep(.01)\nraise ValueError('no')\n");
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(barycert({"check", "a.inp"}, environment).code, 2);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
    EXPECT_FALSE(lives(scratch_.path("pid")));
}

TEST_F(Converted, MemoryAndOutputHaveLimits) {
    scratch_.put("a.inp", abaqus);
    const Ended memory = barycert({"check", "a.inp"}, fake("import numpy\n__version__ = '1'\n"
                                                           "def read(*a, **k): return numpy.empty(1 << 45, 'u1')\n"));
    EXPECT_EQ(memory.code, 2);
    EXPECT_TRUE(contains(memory.err, "emoryError")) << memory.err;
    const Ended crash = barycert({"check", "a.inp"}, fake("import os\nos.abort()\n"));
    EXPECT_EQ(crash.code, 2);
    EXPECT_TRUE(contains(crash.err, "meshio did not come to its end")) << crash.err;
}

}  // namespace
}  // namespace barycert::cli_test
