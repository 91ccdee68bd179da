// Hexahedra, prisms, pyramids and quadrangles, made here and by Gmsh.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/sampler.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "tests/io/gmsh/msh_files.hpp"

namespace barycert::testing {
namespace {

using Types = std::vector<std::uint8_t>;
using Nodes = std::vector<Mesh::Index>;

const Note* note_of_cut(const Mesh& mesh) {
    return find_note(mesh, std::to_string(mesh.shapes.count()) + " cells are cut into " +
                               std::to_string(mesh.cell_count()) +
                               (mesh.dimension == 3 ? " tetrahedra, " : " triangles, "));
}

/// A hexahedron, a prism on a face of it, a pyramid on another one, a tetrahedron on that; a quadrangle beside them.
Msh one_of_each() {
    Msh msh;
    const std::array<std::array<double, 3>, 11> places{{{0, 0, 0},
                                                        {1, 0, 0},
                                                        {1, 1, 0},
                                                        {0, 1, 0},
                                                        {0, 0, 1},
                                                        {1, 0, 1},
                                                        {1, 1, 1},
                                                        {0, 1, 1},
                                                        {2, 0, 0.5},
                                                        {2, 1, 0.5},
                                                        {0.5, 0.5, 2}}};
    for (std::size_t i = 0; i < places.size(); ++i)
        msh.nodes.push_back({static_cast<std::int64_t>(10 * i + 3), places[i]});
    const auto tags = [](std::vector<std::int64_t> nodes) {
        for (std::int64_t& node : nodes) node = 10 * node + 3;
        return nodes;
    };
    msh.blocks = {{3, 1, 7, 4, {{40, tags({4, 5, 6, 7, 10})}}},
                  {2, 2, 3, 0, {{30, tags({0, 1, 2, 3})}}},
                  {3, 3, 6, 5, {{20, tags({1, 8, 5, 2, 9, 6})}}},
                  {3, 4, 5, 6, {{10, tags({0, 1, 2, 3, 4, 5, 6, 7})}}},
                  {3, 5, 4, 0, {{50, tags({5, 6, 9, 10})}}}};
    msh.names = {"3 4 \"roof\"", "3 6 \"body\""};
    msh.views = {{"ElementData", "stress", 0, 0.5, 1, {{10, {1.5}}, {20, {2.5}}, {40, {4.5}}, {50, {5.5}}}},
                 {"NodeData", "T", 0, 0.5, 1, {}}};
    for (const Msh::Node& node : msh.nodes) msh.views[1].rows.push_back({node.tag, {node.at[0] - node.at[2] / 3}});
    return msh;
}

TEST(GmshShapes, OneOfEach) {
    for (const MshKind& kind : msh_kinds) {
        SCOPED_TRACE(name_of(kind));
        for (const int threads : {1, 2}) {
            const Result<Mesh> read = read_msh(one_of_each(), kind, {.step = {}, .threads = threads});
            ASSERT_TRUE(read) << read.error().message();
            EXPECT_EQ(read->shapes.types, (Types{14, 13, 12, 10}));
            EXPECT_EQ(read->shapes.nodes,
                      (Nodes{4, 5, 6, 7, 10, 1, 8, 5, 2, 9, 6, 0, 1, 2, 3, 4, 5, 6, 7, 5, 6, 9, 10}));
            EXPECT_EQ(read->shapes.ends, (std::vector<std::int64_t>{5, 11, 19, 23}));
            EXPECT_EQ(read->shapes.parts, (Nodes{0, 2, 5, 11, 12}));
            EXPECT_EQ(read->cell_numbers, (Nodes{0, 0, 2, 2, 2, 3, 3, 3, 3, 3, 3, 4}));
            const auto field = [&](const char* name) {
                const auto found = std::ranges::find(read->cell_fields, name, &Field::name);
                return found == read->cell_fields.end() ? std::vector<double>() : found->data;
            };
            EXPECT_EQ(field("stress"),
                      (std::vector<double>{4.5, 4.5, 2.5, 2.5, 2.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 5.5}));
            EXPECT_EQ(field("gmsh:physical"), (std::vector<double>{4, 4, 5, 5, 5, 6, 6, 6, 6, 6, 6, 0}));
            EXPECT_EQ(field("gmsh:geometrical"), (std::vector<double>{1, 1, 3, 3, 3, 4, 4, 4, 4, 4, 4, 5}));
            std::map<std::string, Column> labels;
            for (const Column& own : read->cell_labels) labels[own.name] = own;
            EXPECT_EQ(std::get<0>(labels["gmsh:tag"].values),
                      (std::vector<std::int64_t>{40, 40, 20, 20, 20, 10, 10, 10, 10, 10, 10, 50}));
            EXPECT_EQ(std::get<2>(labels["gmsh:physical_name"].values),
                      (std::vector<std::string>{"roof", "roof", "", "", "", "body", "body", "body", "body", "body",
                                                "body", ""}));
            EXPECT_EQ(read->point_fields.at(0).data.size(), 11U);
            EXPECT_NE(note_of_cut(*read), nullptr);
            EXPECT_NE(find_note(*read, "elements of a lower dimension: 1 quadrangle"), nullptr);
            EXPECT_TRUE(check_mesh(*read).certified());
        }
    }
}

/// Gmsh wants elements with numbers of their own.
TEST(GmshShapes, PartsAreWrittenUnderDifferentNumbers) {
    const Mesh mesh = read_msh(one_of_each(), msh_kinds.front()).value();
    for (const GmshWriteOptions::Version version : {GmshWriteOptions::Version::v41, GmshWriteOptions::Version::v22}) {
        const std::string path = ::testing::TempDir() + "barycert_parts.msh";
        ASSERT_TRUE(write_gmsh(mesh, path, {version, false}));
        const Mesh again = read_gmsh(path).value();
        std::remove(path.c_str());
        EXPECT_EQ(again.cells, mesh.cells);
        EXPECT_TRUE(std::ranges::none_of(again.cell_labels, [](const Column& c) { return c.name == "gmsh:tag"; }));
    }
}

TEST(GmshShapes, InThePlane) {
    Msh msh;
    msh.nodes = {{1, {0, 0, 0}}, {2, {1, 0, 0}}, {3, {1, 1, 0}}, {4, {0, 1, 0}}, {5, {2, 0, 0}}, {6, {2, 1, 0}}};
    msh.blocks = {{2, 1, 3, 4, {{1, {1, 2, 3, 4}}}}, {2, 1, 2, 4, {{2, {2, 5, 3}}, {3, {5, 6, 3}}}}};
    for (const MshKind& kind : msh_kinds) {
        SCOPED_TRACE(name_of(kind));
        const Result<Mesh> read = read_msh(msh, kind);
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->dimension, 2);
        EXPECT_EQ(read->shapes.types, (Types{9, 5, 5}));
        EXPECT_EQ(read->cell_count(), 4U);
        EXPECT_EQ(read->cell_numbers, (Nodes{0, 0, 1, 2}));
        EXPECT_NE(note_of_cut(*read), nullptr);
        EXPECT_TRUE(check_mesh(*read).certified());
    }
}

/// In 2.2 an element of two groups is there twice, whatever its shape.
TEST(GmshShapes, ElementsThatRepeatForAFurtherGroup) {
    Msh msh = one_of_each();
    msh.views.clear();
    Msh::Block again = msh.blocks[3];
    again.physical = 8;
    again.elements[0].tag = 11;
    msh.blocks.insert(msh.blocks.begin() + 4, again);
    for (const Form form : {Form::text, Form::little, Form::big}) {
        const Result<Mesh> read = read_msh(msh, {22, form});
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->shapes.types, (Types{14, 13, 12, 10}));
        EXPECT_EQ(read->cell_numbers, (Nodes{0, 0, 2, 2, 2, 3, 3, 3, 3, 3, 3, 5}));
        EXPECT_NE(find_note(*read, "1 elements that repeat the one before them"), nullptr);
    }
}

TEST(GmshShapes, SeveralOrders) {
    Msh msh = one_of_each();
    msh.views.clear();
    for (std::int64_t i = 0; i < 16; ++i) msh.nodes.push_back({1000 + i, {0.5, 0.5, 0.01 * static_cast<double>(i)}});
    // The prism and the tetrahedron of order 2, a tetrahedron of order 3.
    const auto raise = [&](std::size_t block, int type, std::int64_t more) {
        msh.blocks[block].type = type;
        for (std::int64_t i = 0; i < more; ++i) msh.blocks[block].elements[0].nodes.push_back(1000 + i);
    };
    raise(2, 18, 9);
    raise(4, 11, 6);
    Msh::Block third = msh.blocks[4];
    third.type = 29;
    third.elements[0].tag = 60;
    for (std::int64_t i = 6; i < 16; ++i) third.elements[0].nodes.push_back(1000 + i);
    msh.blocks.push_back(third);
    for (const MshKind& kind : msh_kinds) {
        SCOPED_TRACE(name_of(kind));
        const Result<Mesh> read = read_msh(msh, kind);
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->shapes.types, (Types{14, 13, 12, 71, 71}));
        ASSERT_EQ(read->shapes.ends, (std::vector<std::int64_t>{5, 11, 19, 29, 49}));
        EXPECT_EQ(Nodes(read->shapes.nodes.begin() + 5, read->shapes.nodes.begin() + 11), (Nodes{1, 8, 5, 2, 9, 6}));
        // Simplices up to order 4 keep their nodes, in VTK's order.
        EXPECT_EQ(Nodes(read->shapes.nodes.begin() + 19, read->shapes.nodes.begin() + 33),
                  (Nodes{5, 6, 9, 10, 11, 12, 13, 14, 16, 15, 5, 6, 9, 10}));
        Nodes third_nodes(read->shapes.nodes.begin() + 33, read->shapes.nodes.end());
        std::ranges::sort(third_nodes);
        EXPECT_EQ(third_nodes.front(), 11);
        EXPECT_EQ(third_nodes.back(), 26);
        EXPECT_EQ(std::set<Mesh::Index>(third_nodes.begin(), third_nodes.end()).size(), 16U);
        const Note* const note = find_note(*read, "1 cells of a higher order: they are taken by their corners");
        ASSERT_NE(note, nullptr);
        EXPECT_TRUE(note->important);
        EXPECT_TRUE(read->mid_nodes.empty());
    }
}

// By Gmsh.

bool done(const std::string& command) {
    return std::system(("(" + command + ") >/dev/null 2>&1 </dev/null").c_str()) == 0;
}

/// Two boxes, one on the other, of 3 x 3 x 2 and 3 x 3 x 3 hexahedra.
const char* const hexahedra = R"(
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {1,1,0}; Point(4) = {0,1,0};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};
Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};
Transfinite Curve {1:4} = 4; Transfinite Surface {1}; Recombine Surface {1};
low[] = Extrude {0,0,1} { Surface{1}; Layers{2}; Recombine; };
high[] = Extrude {0,0,1} { Surface{low[0]}; Layers{3}; Recombine; };
Physical Volume("low half", 7) = {low[1]};
Physical Volume("high half", 9) = {high[1]};
Physical Surface("bottom", 3) = {1};
)";
/// Hexahedra, beside them prisms; above them tetrahedra, and pyramids between these.
const char* const mixed = R"(
Point(1) = {0,0,0,.4}; Point(2) = {1,0,0,.4}; Point(3) = {1,1,0,.4}; Point(4) = {0,1,0,.4};
Point(5) = {2,0,0,.4}; Point(6) = {2,1,0,.4};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1}; Line(5) = {2,5}; Line(6) = {5,6}; Line(7) = {6,3};
Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};
Curve Loop(2) = {5,6,7,-2}; Plane Surface(2) = {2};
Transfinite Curve {1:7} = 3; Transfinite Surface {1}; Recombine Surface {1};
hexes[] = Extrude {0,0,1} { Surface{1}; Layers{2}; Recombine; };
prisms[] = Extrude {0,0,1} { Surface{2}; Layers{2}; Recombine; };
tets[] = Extrude {0,0,1} { Surface{hexes[0]}; };
Physical Volume("hexes", 1) = {hexes[1]};
Physical Volume("prisms", 2) = {prisms[1]};
Physical Volume("tets", 3) = {tets[1]};
)";
/// Values of all elements: their quality.
const char* const quality = R"(
Plugin(AnalyseMeshQuality).ICNMeasure = 1; Plugin(AnalyseMeshQuality).CreateView = 1; Plugin(AnalyseMeshQuality).Run;
PostProcessing.SaveMesh = 1; Mesh.MshFileVersion = 4.1; Mesh.Binary = 0;
Save View[0] "view.msh";
)";

class GmshMakes : public ::testing::Test {
protected:
    void SetUp() override {
        if (!done("gmsh --version")) GTEST_SKIP() << "no gmsh";
    }
    Mesh made(const char* geo, const std::string& arguments) const {
        put(folder_ / "m.geo", geo);
        const std::string command = "cd " + folder_ / "." + " && gmsh m.geo -nt 1 -3 -o m.msh " + arguments;
        EXPECT_TRUE(done(command)) << command;
        Result<Mesh> mesh = read_gmsh(folder_ / "m.msh");
        EXPECT_TRUE(mesh) << mesh.error().message();
        return mesh ? std::move(*mesh) : Mesh{};
    }
    TemporaryFolder folder_;
};

constexpr std::array<const char*, 5> formats{"-format msh22", "-format msh22 -bin", "-format msh40", "-format msh41",
                                             "-format msh41 -bin"};

std::map<int, std::size_t> counts_of(const Mesh& mesh) {
    std::map<int, std::size_t> counts;
    for (const std::uint8_t type : mesh.shapes.types) ++counts[type];
    return counts;
}

/// Its parts together.
double volume_of(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        std::array<std::array<double, 3>, 3> e{};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k)
                e[i][k] = mesh.points[3 * static_cast<std::size_t>(mesh.cells[4 * cell + i + 1]) + k] -
                          mesh.points[3 * static_cast<std::size_t>(mesh.cells[4 * cell]) + k];
        }
        sum += std::abs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                        e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                        e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
               6;
    }
    return sum;
}

TEST_F(GmshMakes, Hexahedra) {
    for (const std::string order : {"1", "2", "3"}) {
        for (const char* format : formats) {
            SCOPED_TRACE(std::string(format) + " order " + order);
            const Mesh mesh = made(hexahedra, std::string(format) + " -order " + order);
            EXPECT_EQ(counts_of(mesh), (std::map<int, std::size_t>{{12, 45}}));
            EXPECT_EQ(mesh.cell_count(), 270U);
            EXPECT_NE(note_of_cut(mesh), nullptr);
            EXPECT_EQ(find_note(mesh, "45 cells of a higher order: they are taken by their corners") != nullptr,
                      order != "1");
            EXPECT_NEAR(volume_of(mesh), 2, 1e-14);
            EXPECT_TRUE(check_mesh(mesh).certified());
            const auto physical = std::ranges::find(mesh.cell_fields, "gmsh:physical", &Field::name);
            const auto names = std::ranges::find(mesh.cell_labels, "gmsh:physical_name", &Column::name);
            ASSERT_NE(physical, mesh.cell_fields.end());
            ASSERT_NE(names, mesh.cell_labels.end());
            std::size_t low = 0;
            for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
                double z = 0;
                for (std::size_t k = 0; k < 4; ++k)
                    z += mesh.points[3 * static_cast<std::size_t>(mesh.cells[4 * cell + k]) + 2] / 4;
                low += z < 1 ? 1 : 0;
                ASSERT_EQ(physical->data[cell], z < 1 ? 7 : 9);
                ASSERT_EQ(std::get<std::vector<std::string>>(names->values)[cell], z < 1 ? "low half" : "high half");
            }
            EXPECT_EQ(low, 18U * 6);
        }
    }
}

/// Every node is found. One on the curved surface has its own value, to the bit; one of a straight cell is the middle
/// of an edge or face as Gmsh rounded it, and has the value of the field there.
TEST_F(GmshMakes, NodesOfBallsAndRings) {
    const char* const ball = "SetFactory(\"OpenCASCADE\"); Sphere(1) = {0,0,0,1}; Mesh.MeshSizeMax = 0.6;\n";
    const char* const ring = "SetFactory(\"OpenCASCADE\"); Torus(1) = {0,0,0,1,0.4}; Mesh.MeshSizeMax = 0.22;\n";
    for (const char* geo : {ball, ring}) {
        for (const std::string order : {"2", "3", "4"}) {
            SCOPED_TRACE(geo + order);
            Mesh mesh = made(geo, "-format msh41 -order " + order);
            mesh.point_fields = {{"f", 1, {}}};
            for (std::size_t i = 0; i < mesh.point_count(); ++i)
                mesh.point_fields[0].data.push_back(std::sin(static_cast<double>(i)));
            const Locator locator = Locator::build(mesh).value();
            EXPECT_TRUE(locator.has_curved_cells());
            EXPECT_EQ(locator.unmapped_cells(), 0U);
            const Table rows = Sampler::build(mesh, {"f"}).value().sample(mesh.points).value();
            EXPECT_EQ(std::ranges::count(rows.cells, -1), 0);
            std::size_t on_the_surface = 0;
            for (std::size_t i = 0; i < mesh.point_count(); ++i) {
                const double* p = mesh.points.data() + 3 * i;
                const double from_axis = std::hypot(p[0], p[1]);
                const double radius =
                    geo == ball ? std::hypot(from_axis, p[2]) - 1 : std::hypot(from_axis - 1, p[2]) - 0.4;
                const bool curved = std::abs(radius) < 1e-12;
                on_the_surface += curved ? 1 : 0;
                const double error = std::abs(rows.values[i] - mesh.point_fields[0].data[i]);
                EXPECT_LE(error, curved ? 0 : 1e-13) << i;
            }
            EXPECT_GT(on_the_surface, 100U);
        }
    }
}

TEST_F(GmshMakes, AllShapesSideBySide) {
    std::map<int, std::size_t> counts;
    for (const char* format : formats) {
        SCOPED_TRACE(format);
        const Mesh mesh = made(mixed, format);
        if (counts.empty()) counts = counts_of(mesh);
        EXPECT_EQ(counts_of(mesh), counts);
        EXPECT_EQ(counts[12], 8U);
        for (const int type : {10, 13, 14}) EXPECT_GT(counts[type], 0U) << type;
        EXPECT_NEAR(volume_of(mesh), 3, 1e-14);
        EXPECT_TRUE(check_mesh(mesh).certified()) << "neighbours cut their faces alike";
        const auto physical = std::ranges::find(mesh.cell_fields, "gmsh:physical", &Field::name);
        ASSERT_NE(physical, mesh.cell_fields.end());
        for (std::size_t i = 0; i < mesh.shapes.count(); ++i) {
            const double group = physical->data[static_cast<std::size_t>(mesh.shapes.parts[i])];
            const int type = mesh.shapes.types[i];
            ASSERT_EQ(group, type == 12 ? 1 : type == 13 ? 2 : 3);
        }
    }
    // Values of elements.
    put(folder_ / "quality.geo", quality);
    ASSERT_TRUE(done("cd " + folder_ / "." + " && gmsh m.msh quality.geo -"));
    const Result<Mesh> read = read_gmsh(folder_ / "view.msh");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(counts_of(*read), counts);
    std::istringstream text(get(folder_ / "view.msh"));
    std::string word;
    while (text >> word && word != "$ElementData") {
    }
    std::map<std::int64_t, double> values;
    // Tags of texts, numbers, integers; then rows.
    std::string line;
    for (int i = 0; i < 3; ++i) {
        text >> word;
        std::getline(text, line);
        for (int k = std::stoi(word); k > 0; --k) std::getline(text, line);
    }
    std::int64_t tag = 0;
    for (double value = 0; text >> tag >> value;) values[tag] = value;
    ASSERT_GE(values.size(), read->shapes.count());
    ASSERT_FALSE(read->cell_fields.empty());
    const Field& field = read->cell_fields.front();
    ASSERT_EQ(field.data.size(), read->cell_count());
    const auto tags = std::ranges::find(read->cell_labels, "gmsh:tag", &Column::name);
    for (std::size_t cell = 0; cell < read->cell_count(); ++cell) {
        const std::int64_t own = tags != read->cell_labels.end()
                                     ? std::get<std::vector<std::int64_t>>(tags->values)[cell]
                                     : std::int64_t{read->cell_numbers[cell]} + 1;
        ASSERT_TRUE(values.contains(own));
        ASSERT_EQ(field.data[cell], values[own]) << own;
    }
    const std::set<double> different(field.data.begin(), field.data.end());
    EXPECT_GT(different.size(), 10U);
}

TEST_F(GmshMakes, QuadranglesOfThePlane) {
    const char* const square = R"(
Point(1) = {0,0,0,0.3}; Point(2) = {1,0,0,0.3}; Point(3) = {1,1,0,0.3}; Point(4) = {0,1,0,0.3};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};
Curve Loop(1) = {1,2,3,4}; Plane Surface(5) = {1}; Recombine Surface {5};
Physical Surface("plate", 11) = {5};
)";
    for (const char* order : {"1", "2"}) {
        for (const char* format : formats) {
            SCOPED_TRACE(std::string(format) + order);
            const Mesh mesh = made(square, std::string(format) + " -2 -order " + order);
            EXPECT_EQ(mesh.dimension, 2);
            EXPECT_GT(counts_of(mesh)[9], 4U);
            EXPECT_TRUE(check_mesh(mesh).certified());
            EXPECT_EQ(mesh.cell_fields.at(0).data, std::vector<double>(mesh.cell_count(), 11));
        }
    }
}

}  // namespace
}  // namespace barycert::testing
