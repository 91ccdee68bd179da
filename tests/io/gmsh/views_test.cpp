// $NodeData and $ElementData: fields, gaps, steps.
#include <cmath>

#include "tests/io/gmsh/msh_files.hpp"

namespace barycert::testing {
namespace {

Msh with_views(std::vector<Msh::View> views) {
    Msh msh = two_tetrahedra();
    msh.views = std::move(views);
    return msh;
}

TEST(GmshViews, FieldsOfNodesAndCells) {
    const Msh msh = with_views(
        {{"NodeData", "T", 0, 0, 1, {{50, {1}}, {7, {2}}, {9, {0.1}}, {8, {5e-324}}, {1000, {INFINITY}}, {3, {-6}}}},
         {"ElementData", "flux", 0, 0, 3, {{10, {1, 2, 3}}, {20, {4, 5, 6}}}},
         {"NodeData", "empty", 0, 0, 9, {}}});
    for (const MshKind& kind : msh_kinds) {
        SCOPED_TRACE(name_of(kind));
        const Result<Mesh> mesh = read_msh(msh, kind);
        ASSERT_TRUE(mesh) << mesh.error().message();
        ASSERT_EQ(mesh->point_fields.size(), 1U);
        EXPECT_EQ(mesh->point_fields[0].name, "T");
        EXPECT_EQ(mesh->point_fields[0].data, (std::vector<double>{1, 2, 0.1, 5e-324, INFINITY, -6}));
        ASSERT_EQ(mesh->cell_fields.size(), 3U);
        EXPECT_EQ(mesh->cell_fields[0].name, "flux");
        EXPECT_EQ(mesh->cell_fields[0].components, 3);
        EXPECT_EQ(mesh->cell_fields[0].data, (std::vector<double>{4, 5, 6, 1, 2, 3}));
    }
}

TEST(GmshViews, GapsAreNanAndTold) {
    const Msh msh = with_views({{"NodeData", "T", 0, 0, 1, {{9, {3}}, {8, {4}}}},
                                {"NodeData", "parts", 0, 0, 1, {{9, {1}}, {8, {2}}, {3, {3}}}},
                                {"NodeData", "parts", 0, 0, 1, {{7, {4}}, {50, {5}}, {1000, {6}}}},
                                {"ElementData", "on faces", 0, 0, 1, {{30, {1}}}},
                                {"ElementData", "mixed", 0, 0, 1, {{10, {1}}, {20, {2}}, {30, {3}}}}});
    for (const MshKind& kind : msh_kinds) {
        SCOPED_TRACE(name_of(kind));
        const Mesh mesh = read_msh(msh, kind).value();
        ASSERT_EQ(mesh.point_fields.size(), 2U);
        const std::vector<double>& t = mesh.point_fields[0].data;
        EXPECT_TRUE(std::isnan(t[0]) && std::isnan(t[1]) && std::isnan(t[4]) && std::isnan(t[5]));
        EXPECT_EQ(t[2], 3);
        EXPECT_EQ(t[3], 4);
        const Note* const gaps = find_note(mesh, "NaN for the values of \"T\" at 4 of 6 nodes");
        ASSERT_NE(gaps, nullptr);
        EXPECT_TRUE(gaps->important);
        EXPECT_EQ(mesh.point_fields[1].data, (std::vector<double>{5, 4, 1, 2, 6, 3})) << "the parts of one view";
        EXPECT_EQ(find_note(mesh, "\"parts\""), nullptr);
        const Note* const lost = find_note(mesh, "1 values of \"on faces\", of what is no cell");
        ASSERT_NE(lost, nullptr);
        EXPECT_TRUE(lost->important) << "nothing is left of that view";
        EXPECT_EQ(mesh.cell_fields.at(0).name, "mixed");
        EXPECT_FALSE(find_note(mesh, "1 values of \"mixed\"")->important);
    }
}

TEST(GmshViews, Steps) {
    const auto rows = [](double x) {
        return std::vector<std::pair<std::int64_t, std::vector<double>>>{{50, {x}}, {7, {x}},    {9, {x}},
                                                                         {8, {x}},  {1000, {x}}, {3, {x}}};
    };
    const Msh msh = with_views({{"NodeData", "T", 2, 0.5, 1, rows(2)},
                                {"NodeData", "T", 1, 0.25, 1, rows(1)},
                                {"NodeData", "once", 7, 0, 1, rows(7)},
                                {"NodeData", "T", 3, 0.75, 1, rows(3)}});
    for (const MshKind& kind : msh_kinds) {
        SCOPED_TRACE(name_of(kind));
        const Mesh first = read_msh(msh, kind).value();
        ASSERT_EQ(first.point_fields.size(), 2U);
        EXPECT_EQ(first.point_fields[0].data.at(0), 1);
        EXPECT_EQ(first.point_fields[1].data.at(0), 7);
        const Note* const steps = find_note(first, "\"T\" has 3 steps, 1 to 3: all but step 1 (time 0.25)");
        ASSERT_NE(steps, nullptr);
        EXPECT_TRUE(steps->important);
        const Mesh third = read_msh(msh, kind, {.step = 3, .threads = 0}).value();
        EXPECT_EQ(third.point_fields.at(0).data.at(0), 3);
        EXPECT_EQ(third.point_fields.at(1).data.at(0), 7) << "what has one step holds in all";
        EXPECT_EQ(find_note(third, "steps"), nullptr);
        const Mesh none = read_msh(msh, kind, {.step = 9, .threads = 0}).value();
        EXPECT_EQ(none.point_fields.size(), 1U);
        EXPECT_TRUE(find_note(none, "none of them is 9")->important);

        const TemporaryFolder folder;
        put(folder / "m.msh", MshBytes(msh, kind.version, kind.form).bytes());
        EXPECT_EQ(gmsh_steps(folder / "m.msh").value(), (std::vector<GmshStep>{{"T", false, 1, 2, 0.5},
                                                                               {"T", false, 1, 1, 0.25},
                                                                               {"once", false, 1, 7, 0},
                                                                               {"T", false, 1, 3, 0.75}}));
    }
}

TEST(GmshViews, Contradictions) {
    const Msh twice = with_views({{"NodeData", "T", 0, 0, 1, {{9, {3}}, {9, {4}}}}});
    EXPECT_EQ(read_msh(twice, {41, Form::text}).error().what, "two values of \"T\" for one node");
    const Msh again =
        with_views({{"NodeData", "T", 0, 0, 1, {{9, {3}}}}, {"NodeData", "T", 0, 0, 1, {{9, {4}}, {8, {5}}}}});
    const Mesh mesh = read_msh(again, {41, Form::little}).value();
    EXPECT_EQ(mesh.point_fields.at(0).data.at(2), 3);
    EXPECT_TRUE(std::isnan(mesh.point_fields.at(0).data.at(3)));
    EXPECT_TRUE(find_note(mesh, "a second section \"T\" of step 0")->important);
    Msh same_tags = with_views({{"ElementData", "c", 0, 0, 1, {{10, {1}}}}});
    same_tags.blocks[2].elements[0].tag = 10;
    EXPECT_EQ(read_msh(same_tags, {41, Form::text}).error().what, "two cells with the tag 10");
    same_tags.views.clear();
    EXPECT_TRUE(read_msh(same_tags, {41, Form::text})) << "where nothing refers to tags, they are mere labels";
}

TEST(GmshViews, WhatHasNoPlaceIsTold) {
    const std::string text = MshBytes(two_tetrahedra(), 41, Form::text).bytes() +
                             "$ElementNodeData\n1\n\"stress\"\n1\n0\n3\n0\n1\n1\n10 4 1 2 3 4\n$EndElementNodeData\n"
                             "$Periodic\n0\n$EndPeriodic\n$Comments\n$Nodes is not here\n$EndComments\n"
                             "$NodeData\n2\n\"p\"\n\"scheme\"\n0\n3\n0\n1\n0\n$EndNodeData\n";
    const Result<Mesh> mesh = read_bytes(text);
    ASSERT_TRUE(mesh) << mesh.error().message();
    EXPECT_TRUE(find_note(*mesh, "\"stress\" ($ElementNodeData)")->important);
    EXPECT_NE(find_note(*mesh, "section $Periodic"), nullptr);
    EXPECT_NE(find_note(*mesh, "the interpolation scheme of \"p\""), nullptr);
    EXPECT_EQ(find_note(*mesh, "Comments"), nullptr);
}

}  // namespace
}  // namespace barycert::testing
