// Meshes in all versions and forms.
#include "io/medit/medit.hpp"
#include "tests/io/medit/medit_files.hpp"

namespace barycert::testing {
namespace {

TEST(MeditRead, AllVersionsAndForms) {
    for (const MeditForm& form : medit_forms) {
        SCOPED_TRACE(name_of(form));
        const Result<Mesh> mesh = read_medit_bytes(medit_bytes(two_of_medit(), form.version, form.form));
        ASSERT_TRUE(mesh) << mesh.error().message();
        EXPECT_EQ(mesh->dimension, 3);
        EXPECT_EQ(mesh->points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 0.125, 0, 0, 0, 1.25, 1, 1, 1, 9, 9, 9}));
        EXPECT_EQ(mesh->cells, (std::vector<Mesh::Index>{0, 1, 2, 3, 1, 2, 3, 4}));
        EXPECT_EQ(mesh->point_markers, (std::vector<std::int64_t>{7, 0, -3, 0, 9, 0}));
        EXPECT_EQ(mesh->faces, (std::vector<Mesh::Index>{0, 1, 2, 1, 2, 4}));
        EXPECT_EQ(mesh->face_markers, (std::vector<std::int64_t>{10, 20}));
        ASSERT_EQ(mesh->cell_fields.size(), 1U);
        EXPECT_EQ(mesh->cell_fields[0].name, "medit:ref");
        EXPECT_EQ(mesh->cell_fields[0].data, (std::vector<double>{1, 2}));
        EXPECT_TRUE(mesh->cell_numbers.empty()) << "each section counts its own";
        EXPECT_EQ(mesh->index_base, 1);
        const Note* const lower = find_note(*mesh, "elements of a lower dimension: 1 Edges");
        ASSERT_NE(lower, nullptr);
        EXPECT_FALSE(lower->important);
        EXPECT_NE(find_note(*mesh, "sections \"Ridges\""), nullptr);
        EXPECT_EQ(find_note(*mesh, "float32") != nullptr, form.version == 1 && form.form != Form::text);
        EXPECT_TRUE(
            read_medit_bytes(medit_bytes(two_of_medit(), form.version, form.form), {.faces = false})->faces.empty());
    }
}

TEST(MeditRead, DoublesKeepTheirBits) {
    Medit file = two_of_medit();
    file.parts[0].rows[0] = {0.1, 0x1p-1074, 1.7976931348623157e308, 0};
    for (const MeditForm& form : medit_forms) {
        if (form.version == 1 && form.form != Form::text) continue;
        const Mesh mesh = read_medit_bytes(medit_bytes(file, form.version, form.form)).value();
        EXPECT_EQ(mesh.points[0], 0.1);
        EXPECT_EQ(mesh.points[1], 0x1p-1074);
        EXPECT_EQ(mesh.points[2], 1.7976931348623157e308);
    }
}

TEST(MeditRead, TextInAnyLayout) {
    const Mesh plain = read_medit_bytes(medit_bytes(two_of_medit(), 2, Form::text)).value();
    const std::string body = "6 0 0 0 7 1 0 0 0 0 .125 0 -3 0\n0\n1.25 0\n1 1 1 9 9 9 9 0\n";
    const std::string cells = "Tetrahedra 2 1 2 3 4 1\t2 3 4 5 2\nTriangles\n2\n1 2 3 10\n2 3 5 20\n";
    for (const std::string& text : {
             "MeshVersionFormatted\n2\n\nDimension\n3\n\nVertices\n" + body + cells,  // no End
             "\xEF\xBB\xBF# made by hand\n MESHVERSIONFORMATTED 1 dimension 3 vertices " + body + cells + "END",
             "MeshVersionFormatted 2 # Tetrahedra\nDimension 3\n# Vertices\nVertices # 5\n" + body + "#\n" + cells +
                 "End # it",
             "MeshVersionFormatted 2\r\nDimension 3\r\nVertices\r\n" + body + cells +
                 "Corners 1 1 Nonsense nan 2 -inf\r\nEnd\r\n",
             "MeshVersionFormatted 2\nDimension 3\nGeometry \"Vertices 3\"\n" + cells + "Vertices " + body +
                 "Normals 1 0 1e3 .5\n",
         }) {
        SCOPED_TRACE(text);
        const Result<Mesh> mesh = read_medit_bytes(text);
        ASSERT_TRUE(mesh) << mesh.error().message();
        expect_same(*mesh, plain);
    }
}

TEST(MeditRead, FoundByItsFirstBytes) {
    const TemporaryFolder folder;
    for (const MeditForm& form : medit_forms) {
        put(folder / "m.dat", medit_bytes(two_of_medit(), form.version, form.form));
        const Result<Mesh> mesh = read_mesh(folder / "m.dat");
        EXPECT_TRUE(mesh) << name_of(form) << mesh.error().message();
    }
    EXPECT_EQ(mesh_files(folder / "m.dat"), std::vector<std::string>{folder / "m.dat"});
    put(folder / "m.meshb", medit_bytes(two_of_medit(), 2, Form::text));
    EXPECT_EQ(read_mesh(folder / "m.meshb")->cell_count(), 2U) << "the suffix does not count";
    const Result<Mesh> stem = read_mesh(folder / "m");
    EXPECT_NE(stem.error().remedy.find("m.meshb: name it with its suffix"), std::string::npos);
}

TEST(MeditRead, InThePlane) {
    const std::vector<std::vector<double>> triangles{{1, 2, 3, 5}, {2, 4, 3, 6}};
    const Medit flat{
        2, {{"Vertices", 4, 2, {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}, {"Triangles", 6, 0, triangles}}};
    Medit in_space{3,
                   {{"Vertices", 4, 3, {{0, 0, 0, 1}, {1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0}}},
                    {"Quadrilaterals", 7, 0, {}},
                    {"Edges", 5, 0, {{1, 2, 3}}},
                    {"Triangles", 6, 0, triangles}}};
    for (const MeditForm& form : medit_forms) {
        SCOPED_TRACE(name_of(form));
        for (const Medit* const file : {&flat, static_cast<const Medit*>(&in_space)}) {
            const Result<Mesh> mesh = read_medit_bytes(medit_bytes(*file, form.version, form.form));
            ASSERT_TRUE(mesh) << mesh.error().message();
            EXPECT_EQ(mesh->dimension, 2);
            EXPECT_EQ(mesh->points, (std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1}));
            EXPECT_EQ(mesh->cells, (std::vector<Mesh::Index>{0, 1, 2, 1, 3, 2}));
            EXPECT_EQ(mesh->cell_fields.at(0).data, (std::vector<double>{5, 6}));
            EXPECT_TRUE(mesh->faces.empty());
        }
    }
    in_space.parts[0].rows[3][2] = 0.5;
    const Result<Mesh> surface = read_medit_bytes(medit_bytes(in_space, 2, Form::text));
    ASSERT_FALSE(surface);
    EXPECT_EQ(surface.error().what, "z of point 3 (from 0)");
}

/// One tetrahedron whose mid-edge nodes stand on edges in that sequence.
Medit second_order(const std::vector<std::array<int, 2>>& edges) {
    Medit file{3,
               {{"Vertices", 4, 3, {{0, 0, 0, 0}, {2, 0, 0, 0}, {0, 4, 0, 0}, {0, 0, 8, 0}}},
                {"TetrahedraP2", 30, 0, {{1, 2, 3, 4}}}}};
    auto& nodes = file.parts[0].rows;
    auto& cell = file.parts[1].rows[0];
    for (const auto& [a, b] : edges) {
        std::vector<double> middle(4, 0);
        for (std::size_t k = 0; k < 3; ++k)
            middle[k] = (nodes[static_cast<std::size_t>(a)][k] + nodes[static_cast<std::size_t>(b)][k]) / 2;
        nodes.push_back(middle);
        cell.push_back(static_cast<double>(nodes.size()));
    }
    cell.push_back(0);
    return file;
}

TEST(MeditRead, SecondOrder) {
    const std::vector<std::pair<MidEdgeOrder, std::vector<std::array<int, 2>>>> orders{
        {MidEdgeOrder::vtk, {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}},
        {MidEdgeOrder::gmsh, {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}},
        {MidEdgeOrder::tetgen15, {{2, 3}, {0, 3}, {0, 1}, {1, 2}, {1, 3}, {0, 2}}}};
    for (const MeditForm& form : medit_forms) {
        SCOPED_TRACE(name_of(form));
        for (const auto& [order, edges] : orders) {
            Medit file = second_order(edges);
            file.parts.push_back({"TrianglesP2", 24, 0, {{1, 2, 3, 5, 6, 7, 4}}});
            const Result<Mesh> mesh = read_medit_bytes(medit_bytes(file, form.version, form.form));
            ASSERT_TRUE(mesh) << mesh.error().message();
            EXPECT_EQ(mesh->mid_edge_order, order);
            EXPECT_EQ(mesh->cells, (std::vector<Mesh::Index>{0, 1, 2, 3}));
            const auto where = [&](std::size_t k) {
                const auto node = static_cast<std::size_t>(mesh->mid_nodes[k]) * 3;
                return std::array{mesh->points[node], mesh->points[node + 1], mesh->points[node + 2]};
            };
            EXPECT_EQ(where(0), (std::array<double, 3>{1, 0, 0}));
            EXPECT_EQ(where(4), (std::array<double, 3>{1, 0, 4}));
            EXPECT_EQ(where(5), (std::array<double, 3>{0, 2, 4}));
            EXPECT_EQ(mesh->faces, (std::vector<Mesh::Index>{0, 1, 2}));
            EXPECT_EQ(mesh->face_mid_nodes, (std::vector<Mesh::Index>{4, 5, 6}));
            EXPECT_EQ(find_note(*mesh, "mid-edge nodes"), nullptr);
        }
    }
    // A cell that tells nothing: all nodes in one place.
    Medit file = second_order(orders[1].second);
    for (auto& row : file.parts[0].rows) row = {1, 1, 1, 0};
    const Mesh guessed = read_medit_bytes(medit_bytes(file, 2, Form::text)).value();
    EXPECT_EQ(guessed.mid_edge_order, MidEdgeOrder::vtk);
    EXPECT_NE(find_note(guessed, "in the order of Medit"), nullptr);
    // Another order.
    const Result<Mesh> other =
        read_medit_bytes(medit_bytes(second_order({{2, 3}, {1, 3}, {0, 1}, {0, 2}, {0, 3}, {1, 2}}), 2, Form::text));
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().what, "the order of the mid-edge nodes is unknown");
}

TEST(MeditRead, SecondOrderInThePlane) {
    const Medit file{2,
                     {{"Vertices", 4, 2, {{0, 0, 0}, {2, 0, 0}, {0, 4, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}}},
                      {"EdgesP2", 25, 0, {{1, 2, 4, 1}}},
                      {"TrianglesP2", 24, 0, {{1, 2, 3, 4, 5, 6, 0}}}}};
    for (const MeditForm& form : medit_forms) {
        const Result<Mesh> mesh = read_medit_bytes(medit_bytes(file, form.version, form.form));
        ASSERT_TRUE(mesh) << name_of(form) << mesh.error().message();
        EXPECT_EQ(mesh->mid_edge_order, MidEdgeOrder::vtk);
        EXPECT_EQ(mesh->mid_nodes, (std::vector<Mesh::Index>{3, 4, 5}));
        EXPECT_TRUE(mesh->cell_fields.empty()) << "all references are 0";
        EXPECT_TRUE(mesh->point_markers.empty());
    }
}

TEST(MeditRead, WhatHasNodesOfItsOwnIsTold) {
    Medit file = two_of_medit();
    file.parts[3].rows.push_back({1, 2, 6, 0});
    const Mesh mesh = read_medit_bytes(medit_bytes(file, 2, Form::text)).value();
    EXPECT_TRUE(mesh.faces.empty()) << "a shell beside the cells is no face of theirs";
    const Note* const note = find_note(mesh, "1 Edges, 3 Triangles; some have nodes that no cell has");
    ASSERT_NE(note, nullptr);
    EXPECT_TRUE(note->important);
}

TEST(MeditRead, ReferencesThatNoDoubleRepresentsAreLabels) {
    Medit file = two_of_medit();
    file.parts[4].rows[1][4] = 0x1p60;
    for (const Form form : {Form::text, Form::little, Form::big}) {
        const Mesh mesh = read_medit_bytes(medit_bytes(file, 4, form)).value();
        EXPECT_TRUE(mesh.cell_fields.empty());
        EXPECT_EQ(std::get<std::vector<std::int64_t>>(mesh.cell_labels.at(0).values),
                  (std::vector<std::int64_t>{1, std::int64_t{1} << 60}));
    }
}

TEST(MeditRead, AsPoints) {
    const TemporaryFolder folder;
    put(folder / "m.mesh", medit_bytes(two_of_medit(), 2, Form::text));
    const auto source = open_points(folder / "m.mesh", 3, {.keep = {"all"}});
    ASSERT_TRUE(source) << source.error().message();
    std::vector<double> points;
    EXPECT_EQ((*source)->read(100, points).value(), 6U);
    EXPECT_EQ(points, read_mesh(folder / "m.mesh")->points);
    EXPECT_EQ((*source)->carried().at(0).name, "marker");
}

}  // namespace
}  // namespace barycert::testing
