// Hexahedra, prisms, pyramids and quadrilaterals.
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
#include "io/medit/medit.hpp"
#include "tests/io/medit/medit_files.hpp"

namespace barycert::testing {
namespace {

using Types = std::vector<std::uint8_t>;
using Nodes = std::vector<Mesh::Index>;

const MeditPart vertices{"Vertices",
                         4,
                         3,
                         {{0, 0, 0, 1},
                          {1, 0, 0, 0},
                          {1, 1, 0, 0},
                          {0, 1, 0, 0},
                          {0, 0, 1, 0},
                          {1, 0, 1, 0},
                          {1, 1, 1, 0},
                          {0, 1, 1, 0},
                          {2, 0, 0.5, 0},
                          {2, 1, 0.5, 0},
                          {0.5, 0.5, 2, 7}}};

/// A hexahedron, a prism on a face of it, a pyramid on another one, a tetrahedron on that; faces beside them.
Medit one_of_each_shape() {
    return {3,
            {vertices,
             {"Tetrahedra", 8, 0, {{6, 7, 10, 11, 40}}},
             {"Quadrilaterals", 7, 0, {{1, 2, 3, 4, 5}}},
             {"Hexahedra", 10, 0, {{1, 2, 3, 4, 5, 6, 7, 8, 10}}},
             {"Triangles", 6, 0, {{2, 9, 6, 8}}},
             {"Prisms", 9, 0, {{2, 9, 6, 3, 10, 7, 20}}},
             {"Pyramids", 49, 0, {{5, 6, 7, 8, 11, 30}}}}};
}

TEST(MeditShapes, OneOfEach) {
    for (const MeditForm& form : medit_forms) {
        SCOPED_TRACE(name_of(form));
        const Result<Mesh> read = read_medit_bytes(medit_bytes(one_of_each_shape(), form.version, form.form));
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->dimension, 3);
        EXPECT_EQ(read->shapes.types, (Types{10, 12, 13, 14}));
        EXPECT_EQ(read->shapes.nodes, (Nodes{5, 6, 9, 10, 0, 1, 2, 3, 4, 5, 6, 7, 1, 8, 5, 2, 9, 6, 4, 5, 6, 7, 10}));
        EXPECT_EQ(read->shapes.ends, (std::vector<std::int64_t>{4, 12, 18, 23}));
        EXPECT_EQ(read->shapes.parts, (Nodes{0, 1, 7, 10, 12}));
        EXPECT_EQ(read->cell_numbers, (Nodes{0, 1, 1, 1, 1, 1, 1, 2, 2, 2, 3, 3}));
        ASSERT_EQ(read->cell_fields.size(), 1U);
        EXPECT_EQ(read->cell_fields[0].name, "medit:ref");
        EXPECT_EQ(read->cell_fields[0].data, (std::vector<double>{40, 10, 10, 10, 10, 10, 10, 20, 20, 20, 30, 30}));
        EXPECT_EQ(read->point_markers.at(10), 7);
        EXPECT_EQ(read->faces, (Nodes{1, 8, 5}));
        EXPECT_EQ(read->face_markers, std::vector<std::int64_t>{8});
        EXPECT_NE(
            find_note(*read, "4 cells are cut into 12 tetrahedra, each cell and face at its node of lowest number"),
            nullptr);
        EXPECT_NE(find_note(*read, "elements of a lower dimension: 1 Quadrilaterals"), nullptr);
        EXPECT_TRUE(check_mesh(*read).certified());
    }
}

TEST(MeditShapes, InThePlane) {
    const Medit file{2,
                     {{"Vertices", 4, 2, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}}},
                      {"Quadrilaterals", 7, 0, {{1, 2, 3, 4, 5}}},
                      {"Triangles", 6, 0, {{2, 5, 3, 6}}}}};
    for (const MeditForm& form : medit_forms) {
        SCOPED_TRACE(name_of(form));
        const Result<Mesh> read = read_medit_bytes(medit_bytes(file, form.version, form.form));
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->dimension, 2);
        EXPECT_EQ(read->shapes.types, (Types{9, 5}));
        EXPECT_EQ(read->cells, (Nodes{0, 1, 2, 0, 2, 3, 1, 4, 2}));
        EXPECT_EQ(read->cell_fields.at(0).data, (std::vector<double>{5, 5, 6}));
        EXPECT_TRUE(check_mesh(*read).certified());
    }
}

TEST(MeditShapes, SeveralOrders) {
    Medit file = one_of_each_shape();
    // Ten nodes of a tetrahedron, 27 of a hexahedron: more corners, as it is not looked at these.
    file.parts[1] = {"TetrahedraP2", 30, 0, {{6, 7, 10, 11, 1, 2, 3, 4, 5, 8, 40}}};
    std::vector<double> row{1, 2, 3, 4, 5, 6, 7, 8};
    row.resize(27, 9);
    row.push_back(10);
    file.parts[3] = {"HexahedraQ2", 33, 0, {row}};
    file.parts.push_back({"Tetrahedra", 8, 0, {{1, 2, 3, 5, 50}}});
    const Result<Mesh> read = read_medit_bytes(medit_bytes(file, 2, Form::text));
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->shapes.types, (Types{10, 12, 13, 14, 10}));
    EXPECT_EQ(Nodes(read->shapes.nodes.begin(), read->shapes.nodes.begin() + 12),
              (Nodes{5, 6, 9, 10, 0, 1, 2, 3, 4, 5, 6, 7}));
    const Note* const note = find_note(*read, "2 cells of a higher order: they are taken by their corners");
    ASSERT_NE(note, nullptr);
    EXPECT_TRUE(note->important);
    // The same for cells of one type, and of order 3.
    std::vector<double> third{1, 2, 3, 5};
    third.resize(20, 9);
    third.push_back(4);
    const Result<Mesh> alone =
        read_medit_bytes(medit_bytes({3, {vertices, {"TetrahedraP3", 96, 0, {third}}}}, 2, Form::little));
    ASSERT_TRUE(alone) << alone.error().message();
    EXPECT_EQ(alone->cells, (Nodes{0, 1, 2, 4}));
    EXPECT_NE(find_note(*alone, "1 cells of a higher order: they are taken by their corners"), nullptr);
}

TEST(MeditShapes, FieldsOfAllCells) {
    Medit file{3, {vertices, {"Hexahedra", 10, 0, {{1, 2, 3, 4, 5, 6, 7, 8, 0}}}}};
    file.parts.push_back({"SolAtVertices", 62, 1, {}, {1}});
    for (int i = 0; i < 11; ++i) file.parts[2].rows.push_back({0.5 * i});
    const Result<Mesh> read = read_medit_bytes(medit_bytes(file, 2, Form::text));
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->point_fields.at(0).data.at(10), 5);
    // Values of some of the cells are left out.
    file = one_of_each_shape();
    file.parts.push_back({"SolAtTetrahedra", 66, 1, {{2.5}}, {1}});
    const Result<Mesh> some = read_medit_bytes(medit_bytes(file, 2, Form::text));
    ASSERT_TRUE(some) << some.error().message();
    EXPECT_EQ(some->cell_fields.size(), 1U);
    const Note* const note = find_note(*some, "SolAtTetrahedra: not of all cells of the mesh");
    ASSERT_NE(note, nullptr);
    EXPECT_TRUE(note->important);
}

}  // namespace
}  // namespace barycert::testing
