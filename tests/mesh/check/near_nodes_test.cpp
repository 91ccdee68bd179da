// Why a boundary meets itself: nodes that hang on a cell, coincide or nearly do; voids of one cell.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "mesh/adjacency.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

using K = DefectKind;
using Triple = std::array<Mesh::Index, 3>;

Mesh triangles(std::vector<double> points, std::vector<Mesh::Index> cells) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = std::move(points);
    mesh.cells = std::move(cells);
    return mesh;
}

const Defect& the(const CheckReport& r, DefectKind kind) {
    static const Defect none;
    EXPECT_NE(r.find(kind), nullptr) << words(found(r));
    return r.find(kind) == nullptr ? none : *r.find(kind);
}

// Cell 0 1 2 3 was halved at the middle of the edge 1 2; its neighbour beyond the facet 1 2 3 was not.
Mesh halved() {
    Mesh mesh;
    mesh.points = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 2, 2, 2, 1, 1, 0};
    mesh.cells = {0, 1, 5, 3, 0, 5, 2, 3, 1, 2, 3, 4};
    return mesh;
}

TEST(NearNodes, AHangingNodeIsNamedWithItsEdge) {
    const CheckReport r = quick(halved());
    EXPECT_EQ(words(found(r)), "boundary_contact pinched_ridge hanging_node");
    const Defect& hanging = the(r, K::hanging_node);
    ASSERT_EQ(hanging.places.size(), 1U);
    EXPECT_EQ(hanging.places[0].nodes, (Triple{5, -1, -1}));
    EXPECT_EQ(hanging.places[0].other_nodes, (Triple{1, 2, -1}));
    EXPECT_EQ(hanging.places[0].cells[0], 2);
    EXPECT_EQ(the(r, K::boundary_contact).remedy(), "split the cells at the hanging nodes below");
    EXPECT_NE(r.measures.defects[2] & defect_bit(K::hanging_node), 0U);
    EXPECT_EQ(r.measures.defects[0] & defect_bit(K::hanging_node), 0U);
    // The remedy is one: cell 1 2 3 4 split at the node.
    Mesh split = halved();
    split.cells = {0, 1, 5, 3, 0, 5, 2, 3, 1, 5, 3, 4, 5, 2, 3, 4};
    EXPECT_TRUE(quick(split).certified());
}

TEST(NearNodes, AHangingNodeIsDecidedExactly) {
    for (const double x : {1.0, std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0)}) {
        Mesh mesh = halved();
        mesh.points[15] = x;
        EXPECT_EQ(quick(mesh).find(K::hanging_node) != nullptr, x == 1.0) << x;
    }
    // Within a facet, in the plane an edge; at a corner it coincides and does not hang.
    const Mesh plane = triangles({0, 0, 8, 0, 0, 8, 4, 0, 5, -1, 3, -1}, {0, 1, 2, 3, 5, 4});
    EXPECT_EQ(the(quick(plane), K::hanging_node).places.at(0).other_nodes, (Triple{0, 1, -1}));
    const Mesh corner = triangles({0, 0, 8, 0, 0, 8, 0, 0, 8, 0, 4, -1}, {0, 1, 2, 3, 5, 4});
    EXPECT_EQ(quick(corner).find(K::hanging_node), nullptr);
    Mesh face;
    face.points = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, 0, 1, 1, -1, 2, 1, -1, 1, 2, -1};
    face.cells = {0, 1, 2, 3, 4, 5, 6, 7};
    EXPECT_EQ(the(quick(face), K::hanging_node).places.at(0).other_nodes, (Triple{0, 1, 2}));
    EXPECT_EQ(the(quick(face), K::hanging_node).count, 1U);
}

/// Two cubes side by side, each with nodes of its own; one of the pairs of nodes between them is `gap` apart.
Mesh cracked(int d, double gap) {
    const Mesh cube = box(d, {1, 1, 1});
    Mesh mesh = joined(cube, mapped(cube, {1, 1, 1}, {1, 0, 0}));
    mesh.points[cube.points.size()] += gap;  // the node at x = 1
    return mesh;
}

TEST(NearNodes, WhatLeavesACrackIsListedWhole) {
    const double ulp = std::numeric_limits<double>::epsilon();
    for (const int d : {2, 3}) {
        const CheckReport r = quick(cracked(d, ulp));
        const std::uint64_t between = d == 2 ? 2 : 4, facets = d == 2 ? 1 : 2;
        EXPECT_FALSE(r.certified());
        EXPECT_EQ(the(r, K::coincident_nodes).count, between - 1);
        const Defect& near = the(r, K::near_nodes);
        ASSERT_EQ(near.count, 1U);
        EXPECT_EQ(near.places[0].distance, ulp);
        EXPECT_DOUBLE_EQ(near.places[0].relative, ulp);
        EXPECT_EQ(the(r, K::crack).count, facets) << "those that merging would join";
        for (const DefectKind kind : {K::coincident_nodes, K::near_nodes, K::crack}) {
            EXPECT_TRUE(the(r, kind).breaks()) << "it stands with what it causes";
        }
        EXPECT_EQ(the(r, K::boundary_contact).remedy(), "merge the coincident and near nodes below");
        EXPECT_NE(the(r, K::boundary_contact).places.at(0).other_nodes[0], -1) << "both facets";
    }
}

TEST(NearNodes, AreNotesWhereNothingMeets) {
    Mesh slit = cracked(2, 0x1p-40);
    for (std::size_t i = slit.points.size() / 2; i < slit.points.size(); i += 2) {
        if (slit.points[i] == 1) slit.points[i] += 0x1p-40;
    }
    const CheckReport r = quick(slit);
    EXPECT_TRUE(r.certified()) << words(found(r));
    EXPECT_EQ(the(r, K::near_nodes).count, 2U);
    EXPECT_EQ(the(r, K::crack).count, 1U);
    EXPECT_FALSE(the(r, K::near_nodes).breaks());
    EXPECT_EQ(quick(cracked(2, 0x1p-5)).find(K::near_nodes), nullptr) << "a 32nd of the edges";
    CheckOptions wide;
    wide.near = 0x1p-4;
    EXPECT_NE(check_mesh(cracked(2, 0x1p-5), wide).find(K::near_nodes), nullptr);
    wide.near = 0;
    EXPECT_EQ(check_mesh(cracked(2, 0x1p-50), wide).find(K::near_nodes), nullptr);
}

// A slit within a mesh whose upper side is an ulp too low: its facets meet only at common nodes, and cells overlap.
TEST(NearNodes, AreTheCauseOfAnOverlapWithoutContacts) {
    Mesh mesh = box(2, {6, 6, 1});
    for (Mesh::Index& n : mesh.cells) {
        const std::size_t cell = static_cast<std::size_t>(&n - mesh.cells.data()) / 3;
        const auto at = node_at(mesh, n);
        const bool above = std::max({node_at(mesh, mesh.cells[3 * cell])[1], node_at(mesh, mesh.cells[3 * cell + 1])[1],
                                     node_at(mesh, mesh.cells[3 * cell + 2])[1]}) > 3;
        if (above && at[1] == 3 && at[0] > 1 && at[0] < 5) n = add_node(mesh, {at[0], std::nextafter(3.0, 0.0)});
    }
    FixReport merged;
    mesh = fix_mesh(mesh, {}, merged).value();
    const CheckReport r = quick(mesh);
    EXPECT_EQ(r.find(K::boundary_contact), nullptr);
    EXPECT_TRUE(the(r, K::near_nodes).breaks());
    EXPECT_TRUE(the(r, K::crack).breaks());
    EXPECT_EQ(the(r, K::near_nodes).count, 3U);
    EXPECT_NE(the(r, K::nested_part).remedy().find("first merge"), std::string_view::npos);
    EXPECT_NE(the(r, K::overlapping_cells).remedy().find("below"), std::string_view::npos);
    EXPECT_TRUE(quick(fix_mesh(mesh, {.merge_within = 1e-12}, merged).value()).certified());
    // Near nodes that no two such cells have are no cause: a slit that is open, beside cells that overlap.
    Mesh apart = joined(cracked(2, 0x1p-40), mapped(box(2, {2, 2, 1}), {1, 1, 1}, {9, 0, 0}));
    for (std::size_t i = 8; i < 16; i += 2) apart.points[i] += apart.points[i] == 1 ? 0x1p-40 : 0;
    apart = joined(std::move(apart), mapped(box(2, {1, 1, 1}), {0.25, 0.25, 1}, {9.5, 0.125, 0}));
    EXPECT_NE(quick(apart).find(K::overlapping_cells), nullptr);
    EXPECT_FALSE(the(quick(apart), K::near_nodes).breaks());
}

TEST(NearNodes, AreNoHangingNodes) {
    for (const int d : {2, 3}) {
        // The second of two boxes reaches an ulp into the first: nodes lie within edges that end at their twins.
        Mesh second = mapped(box(d, {2, 2, 2}), {1, 1, 1}, {2, 0, 0});
        for (double& x : second.points) x = x == 2 ? std::nextafter(2.0, 0.0) : x;
        const CheckReport r = quick(joined(box(d, {2, 2, 2}), second));
        EXPECT_EQ(r.find(K::hanging_node), nullptr);
        EXPECT_EQ(the(r, K::boundary_contact).remedy(), "merge the coincident and near nodes below");
    }
}

TEST(NearNodes, ANodeBesideAnEdgeOrAFacetNearlyHangs) {
    for (const double off : {0x1p-50, 0x1p-1040}) {
        // An ulp off an edge: nothing meets, and two parts are certified. In the unit 2^-990 likewise.
        const double unit = off < 0x1p-1000 ? 0x1p-990 : 1;
        const Mesh plane = triangles({0, 0, 8 * unit, 0, 0, 8 * unit, 4 * unit, -off, 5 * unit, -unit, 3 * unit, -unit},
                                     {0, 1, 2, 3, 5, 4});
        const CheckReport r = quick(plane);
        EXPECT_TRUE(r.certified());
        const Defect& hanging = the(r, K::near_hanging);
        ASSERT_EQ(hanging.places.size(), 1U);
        EXPECT_FALSE(hanging.breaks());
        EXPECT_EQ(hanging.places[0].nodes, (Triple{3, -1, -1}));
        EXPECT_EQ(hanging.places[0].other_nodes, (Triple{0, 1, -1}));
        EXPECT_EQ(hanging.places[0].distance, off);
        EXPECT_EQ(hanging.places[0].cells[0], 0);
    }
    // Beyond the ratio, or near a node of the edge, it is none.
    for (const double x : {4.0, 8 - 0x1p-40}) {
        const Mesh plane =
            triangles({0, 0, 8, 0, 0, 8, x, x == 4 ? -0.25 : -0x1p-40, 5, -1, 3, -1}, {0, 1, 2, 3, 5, 4});
        EXPECT_EQ(quick(plane).find(K::near_hanging), nullptr) << x;
    }
    Mesh face;
    face.points = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, -0x1p-45, 1, 1, -1, 2, 1, -1, 1, 2, -1};
    face.cells = {0, 1, 2, 3, 4, 5, 6, 7};
    EXPECT_EQ(the(quick(face), K::near_hanging).places.at(0).other_nodes, (Triple{0, 1, 2}));
    EXPECT_EQ(the(quick(face), K::near_hanging).places.at(0).distance, 0x1p-45);
    // Where cells overlap for it, it is the cause: halved cells, the node beside the middle of the edge.
    for (const double x : {std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0)}) {
        Mesh mesh = halved();
        mesh.points[15] = x;
        const CheckReport r = quick(mesh);
        EXPECT_EQ(the(r, K::near_hanging).places.at(0).other_nodes, (Triple{1, 2, -1}));
        EXPECT_EQ(the(r, K::near_hanging).breaks(), !r.certified()) << words(found(r));
    }
}

// One cell fills what is between: nothing hangs, however flat it is. Nor across a plate that is thin.
TEST(NearNodes, ThinCellsDoNotHang) {
    const Mesh sliver = triangles({0, 0, 8, 0, 0, 8, 4, -0x1p-40, 4, -4}, {0, 1, 2, 0, 3, 1, 0, 4, 3, 3, 4, 1});
    EXPECT_TRUE(quick(sliver).certified());
    EXPECT_EQ(quick(sliver).find(K::near_hanging), nullptr);
    // Nodes of the two sides of the plate are at different places.
    const double t = 0x1p-20;
    const Mesh plate =
        triangles({0, 0, 2, 0, 4, 0, 1, t, 3, t, -1, t, 5, t}, {0, 1, 3, 1, 4, 3, 1, 2, 4, 0, 3, 5, 2, 6, 4});
    EXPECT_TRUE(quick(plate).certified());
    EXPECT_EQ(quick(plate).find(K::near_hanging), nullptr) << words(found(quick(plate)));
}

TEST(NearNodes, ThatAreTooManyToCountAreToldAsAtLeast) {
    // 2^17 cells of their own along a line, each with a node near one of the next.
    Mesh mesh;
    mesh.dimension = 2;
    for (Mesh::Index i = 0; i < 1 << 17; ++i) {
        mesh.points.insert(mesh.points.end(), {1.0 * i, 0, i + 1 - 0x1p-30, 0, i + 0.5, 1});
        mesh.cells.insert(mesh.cells.end(), {3 * i, 3 * i + 1, 3 * i + 2});
    }
    const CheckReport r = quick(mesh);
    EXPECT_EQ(the(r, K::near_nodes).count, 100000U);
    EXPECT_TRUE(the(r, K::near_nodes).at_least);
    CheckOptions threads;
    threads.threads = 2;
    const CheckReport again = check_mesh(mesh, threads);
    EXPECT_EQ(the(again, K::near_nodes).places.back().nodes, the(r, K::near_nodes).places.back().nodes);
}

// The two sides of a thin plate are one cell apart, not a crack.
TEST(NearNodes, AreNotThoseOfOneCell) {
    const CheckReport r = quick(mapped(box(3, {3, 3, 1}), {1, 1, 0x1p-20}, {0, 0, 0}));
    EXPECT_TRUE(r.certified());
    EXPECT_LE(r.find(K::near_nodes) == nullptr ? 0 : the(r, K::near_nodes).count, 0U);
}

// Nodes that no cell has for a vertex harm nothing, wherever they are.
TEST(NearNodes, CoincidentWithAnUnusedNodeIsANote) {
    Mesh mesh = box(2, {1, 1, 1});
    add_node(mesh, node_at(mesh, 0));
    const CheckReport r = quick(mesh);
    EXPECT_TRUE(r.certified());
    EXPECT_FALSE(the(r, K::coincident_nodes).breaks());
}

TEST(NearNodes, AVoidOfOneCellIsTold) {
    for (const int d : {2, 3}) {
        const Mesh whole = box(d, {3, 3, 3});
        const std::size_t middle = d == 2 ? 8 : 13 * 6 + 1;
        std::vector<bool> keep(whole.cell_count(), true);
        keep[middle] = false;
        const CheckReport r = quick(only(whole, keep));
        EXPECT_TRUE(r.certified());
        const Defect& missing = the(r, K::missing_cell);
        ASSERT_EQ(missing.count, 1U);
        EXPECT_FALSE(missing.breaks());
        std::vector<Mesh::Index> nodes(missing.places[0].nodes.begin(), missing.places[0].nodes.end());
        if (d == 3) nodes.push_back(missing.places[0].other_nodes[0]);
        const auto n = static_cast<std::ptrdiff_t>(whole.corners());
        const auto cell = whole.cells.begin() + static_cast<std::ptrdiff_t>(middle) * n;
        EXPECT_TRUE(std::is_permutation(nodes.begin(), nodes.end(), cell, cell + n));
        keep[static_cast<std::size_t>(mesh::compute_neighbours(whole)[middle * whole.corners()])] = false;
        EXPECT_EQ(quick(only(whole, keep)).find(K::missing_cell), nullptr) << "of two cells";
        EXPECT_EQ(quick(whole).find(K::missing_cell), nullptr);
    }
}

}  // namespace
}  // namespace barycert::testing
