// Contents of a .msh file, read the same from every version and form.
#include <cmath>

#include "tests/io/gmsh/msh_files.hpp"

namespace barycert::testing {
namespace {

TEST(GmshRead, TetrahedraOfSparseTags) {
    for (const MshKind& kind : msh_kinds) {
        SCOPED_TRACE(name_of(kind));
        const Result<Mesh> mesh = read_msh(two_tetrahedra(), kind);
        ASSERT_TRUE(mesh) << mesh.error().message();
        EXPECT_EQ(mesh->dimension, 3);
        EXPECT_EQ(mesh->points, (std::vector<double>{1, 1, 1, 0, 0, 0, 0.1, 0, 0, 0, 1e-3, 0, 0, 0, 1.25, 9, 9, 9}));
        EXPECT_EQ(mesh->cells, (std::vector<Mesh::Index>{1, 2, 3, 4, 2, 3, 4, 0}));
        EXPECT_EQ(mesh->cell_numbers, (std::vector<Mesh::Index>{2, 3}));
        EXPECT_TRUE(mesh->mid_nodes.empty());
        ASSERT_EQ(mesh->cell_fields.size(), 2U);
        EXPECT_EQ(mesh->cell_fields[0].name, "gmsh:physical");
        EXPECT_EQ(mesh->cell_fields[0].data, (std::vector<double>{7, 0}));
        EXPECT_EQ(mesh->cell_fields[1].name, "gmsh:geometrical");
        EXPECT_EQ(mesh->cell_fields[1].data, (std::vector<double>{5, 2}));
        ASSERT_EQ(mesh->cell_labels.size(), 2U);
        EXPECT_EQ(mesh->cell_labels[0].name, "gmsh:physical_name");
        EXPECT_EQ(mesh->cell_labels[0].values, Column::Values(std::vector<std::string>{"inner \"part\"", ""}));
        EXPECT_EQ(mesh->cell_labels[1].name, "gmsh:tag");
        EXPECT_EQ(mesh->cell_labels[1].values, Column::Values(std::vector<std::int64_t>{20, 10}));
        const Note* const lower = find_note(*mesh, "elements of a lower dimension: 1 triangle, 1 point");
        ASSERT_NE(lower, nullptr);
        EXPECT_FALSE(lower->important) << "what Gmsh always writes must not be told each time";
        ASSERT_NE(find_note(*mesh, "1 nodes of no cell"), nullptr);
        EXPECT_EQ(mesh->notes.size(), 2U);
    }
}

TEST(GmshRead, ElementsApartFromTheCellsAreImportant) {
    Msh msh = two_tetrahedra();
    msh.blocks[0].elements[0].nodes = {3};
    for (const MshKind& kind : msh_kinds) {
        const Mesh mesh = read_msh(msh, kind).value();
        const Note* const lower = find_note(mesh, "some have nodes that no cell has");
        ASSERT_NE(lower, nullptr) << name_of(kind);
        EXPECT_TRUE(lower->important);
    }
}

TEST(GmshRead, TrianglesInThePlane) {
    Msh msh;
    msh.nodes = {{1, {0, 0, 0}}, {2, {1, 0, -0.0}}, {3, {0, 1, 0}}, {4, {1, 1, 0}}};
    msh.blocks = {{1, 1, 1, 0, {{1, {1, 2}}}}, {2, 1, 2, 0, {{2, {1, 2, 3}}, {3, {2, 4, 3}}}}};
    for (const MshKind& kind : msh_kinds) {
        SCOPED_TRACE(name_of(kind));
        const Result<Mesh> mesh = read_msh(msh, kind);
        ASSERT_TRUE(mesh) << mesh.error().message();
        EXPECT_EQ(mesh->dimension, 2);
        EXPECT_EQ(mesh->points, (std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1}));
        EXPECT_EQ(mesh->cells, (std::vector<Mesh::Index>{0, 1, 2, 1, 3, 2}));
        EXPECT_TRUE(mesh->cell_fields.empty()) << "one entity, 1, and no group say nothing";
        EXPECT_TRUE(mesh->cell_labels.empty()) << "tags 1, 2, 3 are the numbers that users see";
        EXPECT_EQ(mesh->cell_numbers, (std::vector<Mesh::Index>{1, 2}));
        Msh off = msh;
        off.nodes[3].at[2] = 1e-9;
        const Result<Mesh> bent = read_msh(off, kind);
        ASSERT_FALSE(bent);
        EXPECT_EQ(bent.error().what, "z of node 3 (from 0)");
    }
}

TEST(GmshRead, SecondOrder) {
    for (const int dimension : {2, 3}) {
        Msh msh;
        const std::size_t nodes = dimension == 3 ? 10 : 6;
        Msh::Element cell{1, {}};
        for (std::size_t i = 0; i < nodes; ++i) {
            msh.nodes.push_back({static_cast<std::int64_t>(100 - i), {double(i), double(i * i), 0}});
            cell.nodes.push_back(static_cast<std::int64_t>(100 - i));
        }
        msh.blocks = {{dimension, 1, dimension == 3 ? 11 : 9, 0, {cell}}};
        for (const MshKind& kind : msh_kinds) {
            SCOPED_TRACE(name_of(kind));
            const Mesh mesh = read_msh(msh, kind).value();
            if (dimension == 3) {  // the last two change places
                EXPECT_EQ(mesh.cells, (std::vector<Mesh::Index>{0, 1, 2, 3}));
                EXPECT_EQ(mesh.mid_nodes, (std::vector<Mesh::Index>{4, 5, 6, 7, 9, 8}));
                EXPECT_EQ(mesh.mid_edge_order, MidEdgeOrder::gmsh);
            } else {
                EXPECT_EQ(mesh.cells, (std::vector<Mesh::Index>{0, 1, 2}));
                EXPECT_EQ(mesh.mid_nodes, (std::vector<Mesh::Index>{3, 4, 5}));
                EXPECT_EQ(mesh.mid_edge_order, MidEdgeOrder::vtk);
            }
        }
    }
}

TEST(GmshRead, TextAsItComes) {
    // Gmsh takes any white space: all of a section on one line, a number a line, CR LF.
    for (const int version : {22, 40, 41}) {
        SCOPED_TRACE(version);
        Msh msh = two_tetrahedra();
        msh.views = {{"NodeData", "T", 0, 0, 1, {{50, {1}}, {7, {2}}, {9, {3}}, {8, {4}}, {1000, {5}}, {3, {6}}}}};
        const std::string text = MshBytes(msh, version, Form::text).bytes();
        const Mesh mesh = read_bytes(text).value();
        EXPECT_EQ(mesh.point_fields.at(0).data, (std::vector<double>{1, 2, 3, 4, 5, 6}));
        std::string windows, apart, dense;
        std::istringstream lines(text);
        bool numbers = false;
        for (std::string line; std::getline(lines, line);) {
            windows += line + "\r\n";
            if (line.starts_with("$")) {
                if (numbers) apart += '\n', dense += '\n';
                numbers = line == "$Nodes" || line == "$Elements" || line == "$Entities";
                apart += line + "\n";
                dense += line + "\n";
                continue;
            }
            for (const char c : line) apart += numbers && c == ' ' ? '\n' : c;
            dense += line;
            apart += '\n';
            dense += numbers ? "  " : "\n";
        }
        expect_same_with_labels(read_bytes(windows).value(), mesh);
        expect_same_with_labels(read_bytes(apart).value(), mesh);
        expect_same_with_labels(read_bytes(dense).value(), mesh);
        expect_same_with_labels(read_bytes("\xEF\xBB\xBF" + text).value(), mesh);
    }
}

TEST(GmshRead, ParametricNodesOfVersion2) {
    const std::string text =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$ParametricNodes\n4\n1 0 0 0 0 1\n2 1 0 0 1 4 0.5\n3 0 1 0 2 9 .5 .25\n"
        "4 0 0 1 3 1\n$EndParametricNodes\n$Elements\n1\n1 4 3 99 2 1 1 2 3 4\n$EndElements\n";
    const Result<Mesh> mesh = read_bytes(text);
    ASSERT_TRUE(mesh) << mesh.error().message();
    EXPECT_EQ(mesh->points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
    EXPECT_EQ(mesh->cell_fields.at(0).data, (std::vector<double>{99}));
    EXPECT_NE(find_note(*mesh, "partitions"), nullptr);
}

TEST(GmshRead, ElementsThatRepeatForAFurtherGroup) {
    // As Gmsh writes 2.2 where a volume is in several groups.
    Msh msh = two_tetrahedra();
    msh.blocks = {{3, 5, 4, 7, {{1, {7, 9, 8, 1000}}}},
                  {3, 5, 4, 9, {{2, {7, 9, 8, 1000}}}},
                  {3, 5, 4, 7, {{3, {9, 8, 1000, 50}}}},
                  {3, 5, 4, 9, {{4, {9, 8, 1000, 50}}}}};
    for (const Form form : {Form::text, Form::little}) {
        const Mesh mesh = read_msh(msh, {22, form}).value();
        EXPECT_EQ(mesh.cells, (std::vector<Mesh::Index>{1, 2, 3, 4, 2, 3, 4, 0}));
        EXPECT_EQ(mesh.cell_numbers, (std::vector<Mesh::Index>{0, 2}));
        EXPECT_EQ(mesh.cell_fields.at(0).data, (std::vector<double>{7, 7}));
        const Note* const note = find_note(mesh, "2 elements that repeat the one before them");
        ASSERT_NE(note, nullptr);
        EXPECT_TRUE(note->important);
    }
    // In the same group twice, they are cells that overlap, and the check says so.
    msh.blocks[1].physical = msh.blocks[3].physical = 7;
    EXPECT_EQ(read_msh(msh, {22, Form::text}).value().cell_count(), 4U);
}

TEST(GmshRead, ThreadsDoNotMatter) {
    base::Random random(5);
    Msh msh;
    for (std::int64_t i = 0; i < 30000; ++i)
        msh.nodes.push_back({i * 3 + 1, {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)}});
    msh.blocks = {{2, 1, 2, 0, {}}, {3, 1, 4, 0, {}}, {3, 2, 4, 0, {}}};
    Msh::View view{"ElementData", "c", 0, 0, 1, {}};
    for (std::int64_t i = 0; i < 60000; ++i) {
        Msh::Element e{i + 1, {}};
        for (int k = 0; k < (i < 5000 ? 3 : 4); ++k)
            e.nodes.push_back(static_cast<std::int64_t>(random.below(30000)) * 3 + 1);
        msh.blocks[i < 5000 ? 0 : i < 40000 ? 1 : 2].elements.push_back(e);
        if (i >= 5000) view.rows.push_back({i + 1, {random.uniform(0, 1)}});
    }
    msh.views = {view};
    for (const MshKind& kind : msh_kinds) {
        SCOPED_TRACE(name_of(kind));
        const Mesh one = read_msh(msh, kind, {.step = {}, .threads = 1}).value();
        EXPECT_EQ(one.cell_count(), 55000U);
        EXPECT_EQ(one.cell_fields.at(0).data.at(54999), view.rows[54999].second[0]);
        for (const int threads : {2, 7})
            expect_same_with_labels(read_msh(msh, kind, {.step = {}, .threads = threads}).value(), one);
    }
}

}  // namespace
}  // namespace barycert::testing
