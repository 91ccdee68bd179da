// Defects with one right repair are repaired, and all else stays.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mesh/adjacency.hpp"
#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

using Indices = std::vector<Mesh::Index>;

/// Two cubes side by side, the first cell of each twice, a flat cell, a cell of three nodes; with everything a mesh
/// has.
Mesh cubes_apart() {
    const Mesh cube = box(3, {1, 1, 1});
    Mesh mesh = joined(cube, mapped(cube, {1, 1, 1}, {1, 0, 0}));
    const Indices first(mesh.cells.begin(), mesh.cells.begin() + 4);
    mesh.cells.insert(mesh.cells.end(), {first[2], first[0], first[1], first[3]});
    mesh.cells.insert(mesh.cells.end(), {0, 1, 2, 3});  // of one side of the cube
    mesh.cells.insert(mesh.cells.end(), {5, 5, 6, 7});
    mesh.neighbours.assign(mesh.cells.size(), -1);
    Field nodes{"T", 1, {}}, cells{"rho", 2, {}};
    Column label{"region", std::vector<std::int64_t>()};
    for (std::size_t n = 0; n < mesh.point_count(); ++n) {
        nodes.data.push_back(static_cast<double>(n % 8));
        mesh.point_markers.push_back(static_cast<std::int64_t>(n));
    }
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        for (const double x : {0.0, 0.5}) cells.data.push_back(static_cast<double>(c) + x);
        std::get<std::vector<std::int64_t>>(label.values).push_back(static_cast<std::int64_t>(c));
    }
    mesh.point_fields = {nodes};
    mesh.cell_fields = {cells};
    mesh.cell_labels = {label};
    const Mesh::Index* const c = mesh.cells.data();
    mesh.faces = {c[1], c[2], c[3], 0, 14, 9};
    mesh.face_markers = {4, 5};
    return mesh;
}

TEST(Fix, MergesDropsAndCarriesAllElse) {
    const Mesh broken = cubes_apart();
    ASSERT_FALSE(quick(broken).certified());
    FixReport done;
    const Mesh fixed = fix_mesh(broken, {}, done).value();
    const CheckReport after = quick(fixed);
    EXPECT_TRUE(after.certified()) << words(found(after));
    EXPECT_EQ(after.parts, 1U);
    EXPECT_EQ(after.negative, 0U);
    ASSERT_EQ(done.merged.size(), 4U);
    EXPECT_EQ(fixed.point_count(), 12U);
    for (const MergedNode& m : done.merged) {
        EXPECT_EQ(node_at(broken, m.node), node_at(broken, m.into));
        EXPECT_LT(m.into, m.node);
        EXPECT_EQ(m.moved, 0);
    }
    ASSERT_EQ(done.dropped.size(), 3U);
    EXPECT_EQ(done.dropped[0].cell, 12);
    EXPECT_EQ(done.dropped[0].why, DefectKind::duplicate_cell);
    EXPECT_EQ(done.dropped[1].why, DefectKind::degenerate_cell);
    EXPECT_EQ(done.dropped[2].why, DefectKind::repeated_node);
    EXPECT_EQ(fixed.cell_count(), 12U);
    EXPECT_EQ(fixed.cell_fields[0].data[23], 11.5);
    EXPECT_EQ(std::get<std::vector<std::int64_t>>(fixed.cell_labels[0].values).size(), 12U);
    EXPECT_EQ(fixed.cell_numbers.size(), 12U);
    EXPECT_EQ(fixed.neighbours, mesh::compute_neighbours(fixed));
    EXPECT_EQ(fixed.faces.size(), 3U) << "one that no cell has";
    EXPECT_EQ(fixed.face_markers, std::vector<std::int64_t>{4});
    EXPECT_EQ(done.dropped_faces, 1U);
    EXPECT_EQ(done.differing_markers, 4U);
    // T is n % 8 in both cubes: nodes at x = 1 and 0 differ.
    ASSERT_EQ(done.fields.size(), 1U);
    EXPECT_EQ(done.fields[0].name, "T");
    EXPECT_EQ(done.fields[0].differ, 4U);
    double most = 0;
    for (const MergedNode& m : done.merged)
        most = std::max(most, std::fabs(static_cast<double>(m.node % 8) - static_cast<double>(m.into % 8)));
    EXPECT_EQ(done.fields[0].max_difference, most);
    // The values of each node that stays are its own.
    std::size_t at = 0;
    for (std::size_t n = 0; n < broken.point_count(); ++n) {
        const bool gone = std::any_of(done.merged.begin(), done.merged.end(),
                                      [&](const MergedNode& m) { return static_cast<std::size_t>(m.node) == n; });
        if (gone) continue;
        EXPECT_EQ(fixed.point_markers[at], static_cast<std::int64_t>(n));
        EXPECT_EQ(fixed.point_fields[0].data[at], static_cast<double>(n % 8));
        EXPECT_EQ(node_at(fixed, static_cast<Mesh::Index>(at++)), node_at(broken, static_cast<Mesh::Index>(n)));
    }
}

TEST(Fix, MergesWithinADistanceAndTellsHowFar) {
    const double ulp = std::numeric_limits<double>::epsilon();
    Mesh mesh = joined(box(2, {1, 1, 1}), mapped(box(2, {1, 1, 1}), {1, 1, 1}, {1, 0, 0}));
    mesh.points[8] += ulp;
    FixReport done;
    const Mesh exact = fix_mesh(mesh, {}, done).value();
    EXPECT_EQ(done.merged.size(), 1U);
    EXPECT_EQ(quick(exact).parts, 2U) << "a slit";
    const Mesh within = fix_mesh(mesh, {.merge_within = ulp}, done).value();
    ASSERT_EQ(done.merged.size(), 2U);
    EXPECT_EQ(std::max(done.merged[0].moved, done.merged[1].moved), ulp);
    EXPECT_TRUE(quick(within).certified());
    EXPECT_EQ(quick(within).parts, 1U);
    EXPECT_EQ(fix_mesh(mesh, {.merge_within = ulp / 2}, done).value().point_count(), 7U);
    // Cells that collapse are dropped and told.
    Mesh thin = mapped(box(2, {1, 1, 1}), {1, 0x1p-30, 1}, {0, 0, 0});
    EXPECT_EQ(fix_mesh(thin, {.merge_within = 0x1p-29}, done).value().cell_count(), 0U);
    EXPECT_EQ(done.collapsed, 2U);
}

TEST(Fix, NodesOfNoCellAreLeftAlone) {
    Mesh mesh = box(2, {1, 1, 1});
    mesh.points.insert(mesh.points.begin(), {0, 0});  // before the node that cells have
    for (Mesh::Index& n : mesh.cells) ++n;
    FixReport done;
    EXPECT_EQ(fix_mesh(mesh, {}, done).value().points, mesh.points);
    EXPECT_FALSE(done.changed());
}

TEST(Fix, LeavesGoodMeshesAsTheyAre) {
    for (const char* name : {"cube-hole", "cube-hole-o2", "bracket", "plate"}) {
        const Mesh mesh = own_mesh(name);
        FixReport done;
        expect_same(fix_mesh(mesh, {}, done).value(), mesh);
        EXPECT_FALSE(done.changed()) << name;
    }
}

TEST(Fix, SecondOrderCellsKeepTheirNodes) {
    const Mesh mesh = own_mesh("cube-hole-o2");
    Mesh twice = mesh;  // each cell of the second half with nodes of its own
    const std::size_t half = mesh.cell_count() / 2;
    for (auto [list, size] : {std::pair(&twice.cells, mesh.corners()), {&twice.mid_nodes, std::size_t{6}}}) {
        for (std::size_t i = half * size; i < list->size(); ++i)
            (*list)[i] += static_cast<Mesh::Index>(mesh.point_count());
    }
    twice.points.insert(twice.points.end(), mesh.points.begin(), mesh.points.end());
    twice.point_fields.clear();
    twice.point_markers.clear();
    twice.faces.clear(), twice.face_markers.clear(), twice.face_mid_nodes.clear(), twice.neighbours.clear();
    FixReport done;
    const Mesh fixed = fix_mesh(twice, {}, done).value();
    EXPECT_TRUE(quick(fixed).certified());
    for (std::size_t i = 0; i < mesh.mid_nodes.size(); ++i) {
        ASSERT_EQ(node_at(fixed, fixed.mid_nodes[i]), node_at(mesh, mesh.mid_nodes[i])) << i;
    }
}

TEST(Fix, DuplicatesWithOtherDataAreTold) {
    Mesh mesh = box(2, {1, 1, 1});
    mesh.cells.insert(mesh.cells.end(), {mesh.cells[0], mesh.cells[2], mesh.cells[1]});
    mesh.cell_fields = {{"region", 1, {1, 2, 4}}, {"same", 1, {5, 6, 5}}};
    mesh.cell_labels = {{"name", std::vector<std::string>{"a", "b", "c"}}, {"id", std::vector<std::int64_t>{7, 8, 7}}};
    FixReport done;
    EXPECT_EQ(fix_mesh(mesh, {}, done).value().cell_count(), 2U);
    ASSERT_EQ(done.cell_fields.size(), 2U);
    EXPECT_EQ(done.cell_fields[0].name, "region");
    EXPECT_EQ(done.cell_fields[0].differ, 1U);
    EXPECT_EQ(done.cell_fields[0].max_difference, 3);
    EXPECT_EQ(done.cell_fields[1].name, "name");
}

TEST(Fix, TwinFacesWithOtherMarkersAreTold) {
    Mesh mesh = cubes_apart();
    // A face between the cubes, once with the nodes of each.
    const auto find = [&](std::size_t first, std::size_t last, double y, double z) {
        for (std::size_t n = first; n < last; ++n) {
            if (node_at(mesh, static_cast<Mesh::Index>(n)) == std::vector<double>{1, y, z})
                return static_cast<Mesh::Index>(n);
        }
        return Mesh::Index{-1};
    };
    mesh.faces.clear(), mesh.face_markers = {1, 2};
    for (const std::size_t first : {0, 8})
        mesh.faces.insert(mesh.faces.end(),
                          {find(first, first + 8, 0, 0), find(first, first + 8, 0, 1), find(first, first + 8, 1, 1)});
    FixReport done;
    EXPECT_EQ(fix_mesh(mesh, {}, done).value().face_markers, std::vector<std::int64_t>{1});
    EXPECT_EQ(done.differing_face_markers, 1U);
}

TEST(Fix, NeighboursCorrectedAreTold) {
    Mesh mesh = box(2, {1, 1, 1});
    mesh.neighbours.assign(6, -1);
    for (const bool turned : {false, true}) {
        if (turned) std::swap(mesh.cells[1], mesh.cells[2]);
        FixReport done;
        const Mesh fixed = fix_mesh(mesh, {}, done).value();
        EXPECT_EQ(done.changed_neighbours, 2U);
        EXPECT_EQ(done.turned, turned ? 1U : 0U);
        EXPECT_EQ(fixed.neighbours, mesh::compute_neighbours(fixed));
        EXPECT_TRUE(done.changed());
    }
}

// Two triangles apart whose common edge has a node in the middle of each, one of them off it.
TEST(Fix, MergedEdgesHaveOneMidEdgeNode) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 2, 2, 1, 1 + 0x1p-30, 2, 1, 1, 2};
    mesh.cells = {0, 1, 2, 6, 8, 7};
    mesh.mid_nodes = {3, 4, 5, 10, 11, 9};
    mesh.mid_edge_order = MidEdgeOrder::vtk;
    mesh.point_fields = {{"T", 1, {0, 1, 2, 3, 4, 5, 1, 2, 8, 9, 10, 11}}};
    FixReport done;
    const Mesh fixed = fix_mesh(mesh, {}, done).value();
    EXPECT_EQ(fixed.mid_nodes[1], fixed.mid_nodes[5]);
    ASSERT_EQ(done.merged.size(), 3U);
    EXPECT_EQ(done.merged[2].node, 9);
    EXPECT_EQ(done.merged[2].into, 4);
    EXPECT_EQ(done.merged[2].moved, 0x1p-30);
    ASSERT_EQ(done.fields.size(), 1U);
    EXPECT_EQ(done.fields[0].max_difference, 5);
    // Cells that had the edge in common before, and disagree, are not what merging made.
    mesh.cells = {0, 1, 2, 1, 8, 2};
    fix_mesh(mesh, {}, done).value();
    EXPECT_TRUE(done.merged.empty());
}

TEST(Fix, RefusesWhatIsNoMeshOrNoDistance) {
    FixReport done;
    Mesh mesh = box(2, {1, 1, 1});
    for (const double d : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        EXPECT_FALSE(fix_mesh(mesh, {.merge_within = d}, done)) << d;
    EXPECT_FALSE(fix_mesh(box(2, {30, 30, 1}), {.merge_within = 1e300}, done)) << "all with all";
    EXPECT_FALSE(fix_mesh(box(2, {500, 500, 1}), {.merge_within = 1e300}, done)) << "and within bounded memory";
    mesh.cells[0] = 99;
    EXPECT_FALSE(fix_mesh(mesh, {}, done));
}

}  // namespace
}  // namespace barycert::testing
