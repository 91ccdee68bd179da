// Files that Gmsh and meshio write are read, and files that are written are read by them. Both are skipped where they
// are not installed.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "mesh/mid_edges.hpp"
#include "tests/io/gmsh/msh_files.hpp"

namespace barycert::testing {
namespace {

bool runs(const std::string& command) {
    return std::system(("(" + command + ") >/dev/null 2>&1 </dev/null").c_str()) == 0;
}
#define SKIP_WITHOUT_GMSH() \
    if (!runs("gmsh --version")) GTEST_SKIP() << "no gmsh"

/// The python3 that has meshio; empty if none has.
std::string meshio_python() {
    for (const char* python : {"python3", "/usr/bin/python3"}) {
        if (runs(std::string(python) + " -c 'import meshio'")) return python;
    }
    return {};
}

/// A box of 2 x 1 x 1 in two halves, in groups of their own; its bottom is one, too.
const char* const two_halves = R"(
Point(1) = {0,0,0,0.4}; Point(2) = {1,0,0,0.4}; Point(3) = {1,1,0,0.4}; Point(4) = {0,1,0,0.4};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};
Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};
low[] = Extrude {0,0,1} { Surface{1}; };
high[] = Extrude {0,0,1} { Surface{low[0]}; };
Physical Volume("low half", 7) = {low[1]};
Physical Volume("high half", 9) = {high[1]};
Physical Surface("bottom", 3) = {1};
)";
const char* const square = R"(
Point(1) = {0,0,0,0.3}; Point(2) = {1,0,0,0.3}; Point(3) = {1,1,0,0.3}; Point(4) = {0,1,0,0.3};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};
Curve Loop(1) = {1,2,3,4}; Plane Surface(5) = {1};
Physical Surface("plate", 11) = {5}; Physical Curve("edge", 12) = {1};
)";

struct Option {
    const char* text;
    int version;
    bool binary;
};
constexpr std::array<Option, 5> options{{{"-format msh22", 22, false},
                                         {"-format msh22 -bin", 22, true},
                                         {"-format msh40", 40, false},
                                         {"-format msh41", 41, false},
                                         {"-format msh41 -bin", 41, true}}};

Mesh made_by_gmsh(const char* geo, const std::string& arguments) {
    const TemporaryFolder folder;
    put(folder / "m.geo", geo);
    const std::string command = "gmsh " + folder / "m.geo" + " -nt 1 -o " + folder / "m.msh" + " " + arguments;
    EXPECT_TRUE(runs(command)) << command;
    Result<Mesh> mesh = read_gmsh(folder / "m.msh");
    EXPECT_TRUE(mesh) << mesh.error().message();
    return mesh ? std::move(*mesh) : Mesh{};
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-15) << "Gmsh writes 16 digits";
}

/// Each mid-edge node is where its edge, in the order `vtk`, has its middle; no other edge is so near.
void expect_midpoints(const Mesh& mesh) {
    const auto edges = mesh::edges_of(mesh.dimension);
    const auto size = static_cast<std::size_t>(mesh.dimension);
    ASSERT_EQ(mesh.mid_nodes.size(), mesh.cell_count() * edges.size());
    for (std::size_t i = 0; i < mesh.mid_nodes.size(); ++i) {
        const Mesh::Index* const corners = &mesh.cells[i / edges.size() * mesh.corners()];
        const auto [a, b] = edges[i % edges.size()];
        for (std::size_t axis = 0; axis < size; ++axis) {
            const auto at = [&](Mesh::Index node) { return mesh.points[static_cast<std::size_t>(node) * size + axis]; };
            ASSERT_NEAR(at(mesh.mid_nodes[i]), (at(corners[a]) + at(corners[b])) / 2, 1e-12) << "node " << i;
        }
    }
}

TEST(GmshPrograms, GmshWritesBoxes) {
    SKIP_WITHOUT_GMSH();
    for (const char* order : {"1", "2"}) {
        Mesh first;
        for (const Option& option : options) {
            SCOPED_TRACE(std::string(option.text) + " order " + order);
            const Mesh mesh = made_by_gmsh(two_halves, std::string("-3 -order ") + order + " " + option.text);
            ASSERT_EQ(mesh.dimension, 3);
            EXPECT_TRUE(check_mesh(mesh).certified());
            ASSERT_EQ(mesh.cell_fields.size(), 2U);
            const Field &physical = mesh.cell_fields[0], &geometrical = mesh.cell_fields[1];
            EXPECT_EQ(physical.name, "gmsh:physical");
            EXPECT_EQ(geometrical.name, "gmsh:geometrical");
            const auto& names = std::get<std::vector<std::string>>(mesh.cell_labels.at(0).values);
            for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
                double z = 0;
                for (std::size_t k = 0; k < 4; ++k)
                    z += mesh.points[static_cast<std::size_t>(mesh.cells[4 * cell + k]) * 3 + 2] / 4;
                ASSERT_EQ(physical.data[cell], z < 1 ? 7 : 9);
                ASSERT_EQ(names[cell], z < 1 ? "low half" : "high half");
                ASSERT_EQ(geometrical.data[cell], z < 1 ? 1 : 2);
            }
            EXPECT_NE(find_note(mesh, "elements of a lower dimension: "), nullptr);
            EXPECT_FALSE(mesh.cell_numbers.empty());
            if (*order == '2') {
                EXPECT_EQ(mesh.mid_edge_order, MidEdgeOrder::gmsh);
                expect_midpoints(mesh);
            }
            if (option.version == 41) {
                if (first.cells.empty()) first = mesh;
                expect_near(mesh.points, first.points);
                EXPECT_EQ(mesh.cells, first.cells);
                EXPECT_EQ(mesh.mid_nodes, first.mid_nodes);
            }
        }
    }
}

TEST(GmshPrograms, GmshWritesSquares) {
    SKIP_WITHOUT_GMSH();
    for (const char* order : {"1", "2"}) {
        for (const Option& option : options) {
            SCOPED_TRACE(std::string(option.text) + " order " + order);
            const Mesh mesh = made_by_gmsh(square, std::string("-2 -order ") + order + " " + option.text);
            ASSERT_EQ(mesh.dimension, 2);
            EXPECT_TRUE(check_mesh(mesh).certified());
            EXPECT_EQ(mesh.cell_fields.at(0).data, std::vector<double>(mesh.cell_count(), 11));
            EXPECT_EQ(mesh.cell_fields.at(1).data, std::vector<double>(mesh.cell_count(), 5));
            if (*order == '2') expect_midpoints(mesh);
        }
    }
}

TEST(GmshPrograms, WhatElseGmshWrites) {
    SKIP_WITHOUT_GMSH();
    const Mesh plain = made_by_gmsh(two_halves, "-3 -format msh41");
    for (const char* more : {"-3 -format msh41 -save_parametric", "-3 -format msh41 -bin -save_parametric",
                             "-3 -format msh40 -save_parametric", "-3 -format msh22 -save_parametric"}) {
        SCOPED_TRACE(more);
        const Mesh mesh = made_by_gmsh(two_halves, more);
        expect_near(mesh.points, plain.points);
        EXPECT_EQ(mesh.cells, plain.cells);
    }
    for (const char* more : {"-3 -part 3 -format msh41", "-3 -part 3 -format msh41 -bin", "-3 -part 3 -format msh22"}) {
        SCOPED_TRACE(more);
        const Mesh mesh = made_by_gmsh(two_halves, more);
        EXPECT_EQ(mesh.cell_count(), plain.cell_count());
        EXPECT_TRUE(check_mesh(mesh).certified());
        EXPECT_NE(find_note(mesh, "partitions of the mesh"), nullptr);
        const auto& data = mesh.cell_fields.at(0).data;
        EXPECT_EQ(std::set<double>(data.begin(), data.end()), (std::set<double>{7, 9})) << "groups of the whole";
        const auto& of = mesh.cell_fields.at(1).data;
        EXPECT_EQ(std::set<double>(of.begin(), of.end()), (std::set<double>{1, 2})) << "entities of the whole";
    }
    // A volume in two groups: 2.2 repeats its elements.
    const std::string twice = std::string(two_halves) + "Physical Volume(\"all\", 20) = {low[1], high[1]};\n";
    for (const Option& option : options) {
        SCOPED_TRACE(option.text);
        const Mesh mesh = made_by_gmsh(twice.c_str(), std::string("-3 ") + option.text);
        EXPECT_EQ(mesh.cell_count(), plain.cell_count());
        EXPECT_TRUE(std::any_of(mesh.notes.begin(), mesh.notes.end(), [](const Note& n) { return n.important; }));
    }
}

/// The coordinates of each of these nodes.
std::vector<double> by_cells(const Mesh& mesh, const std::vector<Mesh::Index>& nodes) {
    std::vector<double> points;
    const auto size = static_cast<std::size_t>(mesh.dimension);
    for (const Mesh::Index node : nodes) {
        const double* const at = &mesh.points[static_cast<std::size_t>(node) * size];
        points.insert(points.end(), at, at + size);
    }
    return points;
}

/// The commands between backquotes.
std::vector<std::string> commands_in(const std::string& text) {
    std::vector<std::string> commands;
    for (std::size_t at = text.find('`'); at != std::string::npos;) {
        const std::size_t end = text.find('`', at + 1);
        commands.push_back(text.substr(at + 1, end - at - 1));
        at = text.find('`', end + 1);
    }
    return commands;
}

TEST(GmshPrograms, TheCommandsThatErrorsNameWork) {
    SKIP_WITHOUT_GMSH();
    for (const char* arguments : {"-3 -format msh1", "-3 -format msh3", "-3 -format msh22 -bin -save_parametric"}) {
        SCOPED_TRACE(arguments);
        const TemporaryFolder folder;
        put(folder / "m.geo", two_halves);
        const std::string path = folder / "a b.msh";
        ASSERT_TRUE(runs("gmsh " + folder / "m.geo" + " -o '" + path + "' " + arguments));
        const Result<Mesh> refused = read_gmsh(path);
        ASSERT_FALSE(refused);
        const std::vector<std::string> commands = commands_in(refused.error().remedy);
        EXPECT_FALSE(commands.empty()) << refused.error().message();
        for (const std::string& command : commands)
            EXPECT_TRUE(runs("cd " + folder / "." + " && " + command)) << command;
        const Result<Mesh> mesh = read_gmsh(folder / "a b-new.msh");
        ASSERT_TRUE(mesh) << mesh.error().message();
        EXPECT_GT(mesh->cell_count(), 100U);
    }
}

TEST(GmshPrograms, GmshReadsWhatIsWritten) {
    SKIP_WITHOUT_GMSH();
    Mesh mesh = made_by_gmsh(two_halves, "-3 -order 2 -format msh41 -bin");
    mesh.point_fields = {{"T", 1, {}}, {"v", 3, {}}};
    for (std::size_t i = 0; i < mesh.point_count(); ++i) {
        mesh.point_fields[0].data.push_back(0.1 * static_cast<double>(i));
        for (int c = 0; c < 3; ++c) mesh.point_fields[1].data.push_back(static_cast<double>(i) / (c + 1));
    }
    mesh.cell_fields.insert(mesh.cell_fields.begin(), {"c", 1, std::vector<double>(mesh.cell_count(), 0.3)});
    for (const auto version : {GmshWriteOptions::Version::v41, GmshWriteOptions::Version::v22}) {
        for (const bool binary : {true, false}) {
            SCOPED_TRACE(std::string(version == GmshWriteOptions::Version::v41 ? "4.1" : "2.2") +
                         (binary ? " binary" : ""));
            const TemporaryFolder folder;
            ASSERT_TRUE(write_gmsh(mesh, folder / "m.msh", {version, binary}));
            put(folder / "views.geo", "Mesh.MshFileVersion = 4.1; Mesh.Binary = 1;\nSave \"" + folder / "again.msh" +
                                          "\";\nFor i In {0:2}\n"
                                          "  Save View[i] Sprintf(\"" +
                                          folder / "view%g.msh" + "\", i);\nEndFor\n");
            ASSERT_TRUE(runs("gmsh " + folder / "m.msh " + folder / "views.geo" + " -"));
            const Result<Mesh> again = read_gmsh(folder / "again.msh");
            ASSERT_TRUE(again) << again.error().message();
            // Gmsh may number nodes anew.
            EXPECT_EQ(bits_of(by_cells(*again, again->cells)), bits_of(by_cells(mesh, mesh.cells)));
            EXPECT_EQ(bits_of(by_cells(*again, again->mid_nodes)), bits_of(by_cells(mesh, mesh.mid_nodes)));
            EXPECT_EQ(again->cell_fields.at(0).data, mesh.cell_fields.at(1).data);
            EXPECT_EQ(again->cell_labels.at(0).values, mesh.cell_labels.at(0).values);
            for (int i = 0; i < 3; ++i) {
                const std::vector<GmshStep> steps = gmsh_steps(folder / ("view" + std::to_string(i) + ".msh")).value();
                ASSERT_EQ(steps.size(), 1U);
                EXPECT_EQ(steps[0].field, i == 0 ? "T" : i == 1 ? "v" : "c");
                EXPECT_EQ(steps[0].of_cells, i == 2);
                EXPECT_EQ(steps[0].components, i == 1 ? 3 : 1);
            }
        }
    }
}

TEST(GmshPrograms, MeshioReadsAndWritesTheSame) {
    const std::string python = meshio_python();
    if (python.empty()) GTEST_SKIP() << "no meshio";
    Msh two = two_tetrahedra();
    two.blocks[3].physical = 9;  // meshio fails where a cell is of no group, whoever wrote the file
    Mesh mesh = read_msh(two, {41, Form::text}).value();
    mesh.cell_labels.clear();
    mesh.cell_numbers.clear();
    mesh.point_fields = {{"T", 1, {1, 0.1, 5e-324, -3, 4, 5}}, {"v", 3, std::vector<double>(18, 1.0 / 3)}};
    mesh.cell_fields.insert(mesh.cell_fields.begin(), {"c", 1, {0.3, 1e300}});
    for (const auto version : {GmshWriteOptions::Version::v41, GmshWriteOptions::Version::v22}) {
        for (const bool binary : {true, false}) {
            SCOPED_TRACE(std::string(version == GmshWriteOptions::Version::v41 ? "4.1" : "2.2") +
                         (binary ? " binary" : ""));
            const TemporaryFolder folder;
            ASSERT_TRUE(write_gmsh(mesh, folder / "m.msh", {version, binary}));
            put(folder / "again.py",
                "import meshio, sys\n"
                "m = meshio.read('m.msh')\n"
                "meshio.gmsh.write('old.msh', m, '2.2', binary=False, float_fmt='.17g')\n"
                "meshio.gmsh.write('old-binary.msh', m, '2.2', binary=True)\n"
                "meshio.gmsh.write('new.msh', m, '4.1', binary=False, float_fmt='.17g')\n"
                "meshio.gmsh.write('new-binary.msh', m, '4.1', binary=True)\n");
            ASSERT_TRUE(runs("cd " + folder / "." + " && " + python + " again.py"));
            for (const char* name : {"old.msh", "old-binary.msh", "new.msh", "new-binary.msh"}) {
                SCOPED_TRACE(name);
                const Result<Mesh> again = read_gmsh(folder / name);
                ASSERT_TRUE(again) << again.error().message();
                EXPECT_EQ(bits_of(again->points), bits_of(mesh.points));
                EXPECT_EQ(again->cells, mesh.cells);
                expect_same_fields(again->point_fields, mesh.point_fields);
                ASSERT_FALSE(again->cell_fields.empty());
                EXPECT_EQ(bits_of(again->cell_fields[0].data), bits_of(mesh.cell_fields[0].data));
            }
        }
    }
}

}  // namespace
}  // namespace barycert::testing
