// Why a boundary meets itself: nodes that hang on a cell, coincide or nearly do; voids of one cell.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "barycert/mesh/adjacency.hpp"
#include "check/meshes.hpp"

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

TEST(NearNodes, a_hanging_node_is_named_with_its_edge) {
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

TEST(NearNodes, a_hanging_node_is_decided_exactly) {
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

TEST(NearNodes, what_leaves_a_crack_is_listed_whole) {
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

TEST(NearNodes, are_notes_where_nothing_meets) {
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

// The two sides of a thin plate are one cell apart, not a crack.
TEST(NearNodes, are_not_those_of_one_cell) {
    const CheckReport r = quick(mapped(box(3, {3, 3, 1}), {1, 1, 0x1p-20}, {0, 0, 0}));
    EXPECT_TRUE(r.certified());
    EXPECT_LE(r.find(K::near_nodes) == nullptr ? 0 : the(r, K::near_nodes).count, 0U);
}

// Nodes that no cell has for a vertex harm nothing, wherever they are.
TEST(NearNodes, coincident_with_an_unused_node_is_a_note) {
    Mesh mesh = box(2, {1, 1, 1});
    add_node(mesh, node_at(mesh, 0));
    const CheckReport r = quick(mesh);
    EXPECT_TRUE(r.certified());
    EXPECT_FALSE(the(r, K::coincident_nodes).breaks());
}

TEST(NearNodes, a_void_of_one_cell_is_told) {
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
