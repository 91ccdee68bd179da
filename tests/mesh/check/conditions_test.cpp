// Each condition of the theorem violated alone, the others holding: the defects name that one, and what follows.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "mesh/adjacency.hpp"
#include "tests/mesh/check/judge.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

Mesh solid(std::vector<double> points, std::vector<Mesh::Index> cells) {
    Mesh mesh;
    mesh.points = std::move(points);
    mesh.cells = std::move(cells);
    return mesh;
}

void expect_only(const Mesh& mesh, DefectSet problems, std::size_t contacts = 0) {
    const CheckReport r = quick(mesh, 20);
    EXPECT_FALSE(r.certified());
    EXPECT_EQ(words(found(r) & ~set_of(DefectKind::mixed_orientation)), words(problems));
    EXPECT_EQ(r.contacts.size(), contacts);
    EXPECT_FALSE(r.certificate.covers(mesh));
}

TEST(Conditions, P1) {
    const Mesh good =
        solid({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 5, 5, 6, 5, 5, 5, 6, 5, 5, 5, 6}, {0, 1, 2, 3, 4, 5, 6, 7});
    EXPECT_TRUE(quick(good).certified());
    Mesh bad = good;
    bad.points[23] = std::numeric_limits<double>::infinity();
    expect_only(bad, set_of(DefectKind::not_finite));
    bad = good, bad.cells[7] = 8;
    expect_only(bad, set_of(DefectKind::index_out_of_range, DefectKind::unused_node));
    bad = good, bad.cells[7] = 6;
    expect_only(bad, set_of(DefectKind::repeated_node, DefectKind::unused_node));
    // On one line: no facet has an area, so that P2 to P4 say nothing of it.
    bad = good;
    for (std::size_t i = 12; i < 24; ++i) bad.points[i] = static_cast<double>(5 + (i - 12) / 3);
    expect_only(bad, set_of(DefectKind::degenerate_cell));
}

TEST(Conditions, KindsOfDegenerateCellsAlongEveryAxis) {
    const auto kind = [](const std::vector<double>& points) {
        const CheckReport r = quick(solid(points, {0, 1, 2, 3}));
        return std::string(r.find(DefectKind::degenerate_cell)->places.at(0).detail);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        std::vector<double> flat(12, 1), line(12, 1);  // in a plane across the axis; along it
        flat[3 + (k + 1) % 3] = flat[9 + (k + 1) % 3] = flat[6 + (k + 2) % 3] = flat[9 + (k + 2) % 3] = 2;
        for (std::size_t i = 0; i < 4; ++i) line[3 * i + k] = static_cast<double>(i);
        EXPECT_EQ(kind(flat), "coplanar") << k;
        EXPECT_EQ(kind(line), "collinear") << k;
    }
    EXPECT_EQ(kind(std::vector<double>(12, 1)), "a point");
}

// If as many cells are in either order, the negative ones are told, which --fix-orientation would turn.
TEST(Conditions, CellsOfTheRarerOrderAreTold) {
    const Mesh good = box(2, {3, 1, 1});
    for (const std::vector<std::size_t>& turned : {std::vector<std::size_t>{4}, {0, 2, 5}, {0, 1, 3, 4, 5}}) {
        Mesh mesh = good;
        std::vector<Mesh::Index> told;
        for (std::size_t cell = 0; cell < 6; ++cell) {
            const bool negative = std::count(turned.begin(), turned.end(), cell) != 0;
            if (negative) std::swap(mesh.cells[3 * cell], mesh.cells[3 * cell + 1]);
            if (negative == (turned.size() <= 3)) told.push_back(static_cast<Mesh::Index>(cell));
        }
        const CheckReport r = quick(mesh);
        ASSERT_NE(r.find(DefectKind::mixed_orientation), nullptr);
        std::vector<Mesh::Index> found;
        for (const DefectPlace& place : r.find(DefectKind::mixed_orientation)->places) found.push_back(place.cells[0]);
        EXPECT_EQ(found, told);
    }
}

// One cell folded into another, a third that keeps clear at the facet that comes first: P3 and P4 hold.
TEST(Conditions, P2SameSide) {
    const Mesh folded =
        solid({1, -5, 1, 0, 0, 0, 8, 0, 0, 0, 8, 0, 2, 2, 2, 0, 0, 8}, {1, 2, 3, 4, 1, 2, 3, 5, 0, 1, 2, 5});
    // Cell 2 hangs at a facet of cell 1, outside of both.
    expect_only(folded, set_of(DefectKind::same_side, DefectKind::open_boundary, DefectKind::overlapping_cells), 1);
    EXPECT_EQ(quick(folded).find(DefectKind::same_side)->count, 1U);
    EXPECT_EQ(judge(folded).overlaps.size(), 1U);
}

// A cell within a box twice: its facets have three cells, but the boundary is that of the box.
TEST(Conditions, P2Overfull) {
    Mesh mesh = box(3, {3, 3, 3});
    const std::size_t inner = 13 * 6 + 1;  // in the cube in the middle
    for (std::size_t i = 0; i < 4; ++i) mesh.cells.push_back(mesh.cells[inner * 4 + i]);
    expect_only(mesh, set_of(DefectKind::duplicate_cell, DefectKind::overfull_facet, DefectKind::overlapping_cells), 1);
    EXPECT_EQ(quick(mesh).find(DefectKind::overfull_facet)->count, 4U);
    EXPECT_EQ(quick(mesh).find(DefectKind::duplicate_cell)->count, 1U);
}

// Two cells that touch face to face, node to node, but have no common nodes: no cell overlaps another.
TEST(Conditions, P3) {
    const Mesh crack =
        solid({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1}, {0, 1, 2, 3, 4, 5, 6, 7});
    expect_only(crack, set_of(DefectKind::boundary_contact, DefectKind::coincident_nodes, DefectKind::crack), 1);
    EXPECT_EQ(quick(crack).find(DefectKind::boundary_contact)->count, 16U);  // every facet meets every other
    // A corner on a face.
    const Mesh corner =
        solid({0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, 0, 1, 1, -1, 2, 1, -1, 1, 2, -1}, {0, 1, 2, 3, 4, 5, 6, 7});
    expect_only(corner, set_of(DefectKind::boundary_contact, DefectKind::hanging_node), 1);
    // Edges that cross: no corner is on anything.
    const Mesh edges =
        solid({-1, 0, 0, 1, 0, 0, 0, -1, -1, 0, 1, -1, 0, -1, 0, 0, 1, 0, -1, 0, 1, 1, 0, 1}, {0, 1, 2, 3, 4, 5, 6, 7});
    expect_only(edges, set_of(DefectKind::boundary_contact), 1);
}

// Two facets in one plane that cross as a hexagram: each edge of one crosses two of the other, no corner is on the
// other. Pairs: these two; each with three facets at the edges of the other; and of these facets the six that cross.
TEST(Conditions, P3InOnePlane) {
    const Mesh star = solid({3, 0, 0, -3, 3, 0, -3, -3, 0, 0, 0, 5, -3.5, 0, 0, 2, 3, 0, 2, -3, 0, 0, 0, -5},
                            {0, 1, 2, 3, 4, 5, 6, 7});
    expect_only(star, set_of(DefectKind::boundary_contact), 1);
    EXPECT_EQ(quick(star).find(DefectKind::boundary_contact)->count, 13U);
    EXPECT_EQ(quick(star, 1).contacts[0].dimension, 2);
}

// A cell inside another: the boundaries keep clear of each other.
TEST(Conditions, P4) {
    const Mesh nested =
        solid({0, 0, 0, 8, 0, 0, 0, 8, 0, 0, 0, 8, 1, 1, 1, 2, 1, 1, 1, 2, 1, 1, 1, 2}, {0, 1, 2, 3, 4, 5, 6, 7});
    expect_only(nested, set_of(DefectKind::nested_part, DefectKind::overlapping_cells), 1);
    EXPECT_EQ(quick(nested).volume.equal, true);  // volumes alone would not tell
}

TEST(Conditions, P5) {
    Mesh mesh = box(3, {2, 2, 2});
    mesh.neighbours = mesh::compute_neighbours(mesh);
    mesh.faces = {mesh.cells[3], mesh.cells[1], mesh.cells[2]};
    EXPECT_TRUE(quick(mesh).certified());
    Mesh bad = mesh;
    bad.neighbours[10] = bad.neighbours[10] == 5 ? 6 : 5;
    expect_only(bad, set_of(DefectKind::wrong_neighbour));
    EXPECT_EQ(quick(bad).find(DefectKind::wrong_neighbour)->count, 1U);
    bad = mesh, bad.neighbours.pop_back();
    expect_only(bad, set_of(DefectKind::wrong_neighbour));
    for (const std::array<Mesh::Index, 3> face : {std::array{0, 0, 1}, std::array{0, 2, 26}, std::array{-1, 0, 1}}) {
        bad = mesh, bad.faces.insert(bad.faces.end(), face.begin(), face.end());
        expect_only(bad, set_of(DefectKind::wrong_face));
        EXPECT_EQ(quick(bad).find(DefectKind::wrong_face)->count, 1U);
    }
    bad = mesh, bad.faces.push_back(0);
    expect_only(bad, set_of(DefectKind::wrong_face));
}

// Triangles in the plane have no faces, whatever stands there.
TEST(Conditions, P5InThePlane) {
    Mesh mesh = box(2, {2, 2, 0});
    EXPECT_TRUE(quick(mesh).certified());
    mesh.faces = {mesh.cells[0], mesh.cells[1], mesh.cells[2]};
    expect_only(mesh, set_of(DefectKind::wrong_face));
    const CheckReport report = quick(mesh);
    ASSERT_NE(report.find(DefectKind::wrong_face), nullptr);
    EXPECT_STREQ(report.find(DefectKind::wrong_face)->places[0].detail, "a mesh of triangles has no faces");
    mesh.faces.pop_back();
    expect_only(mesh, set_of(DefectKind::wrong_face));
}

// The plane has the same conditions.
TEST(Conditions, Plane) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 8, 0, 0, 8, 1, 1, 2, 1, 1, 2};
    mesh.cells = {0, 1, 2, 3, 4, 5};
    expect_only(mesh, set_of(DefectKind::nested_part, DefectKind::overlapping_cells), 1);
    mesh.points = {0, 0, 8, 0, 0, 8, 0, 0, 8, 0, 4, -1};
    expect_only(mesh, set_of(DefectKind::boundary_contact, DefectKind::coincident_nodes, DefectKind::crack), 1);
    mesh.points = {0, 0, 8, 0, 0, 8, 4, 0, 5, -1, 3, -1};
    expect_only(mesh, set_of(DefectKind::boundary_contact, DefectKind::hanging_node), 1);
    // Folded along 0 1, with a cell that keeps clear at the facet that comes first.
    mesh.points = {0, 9, 8, 0, 0, 0, 0, 8, 2, 2};
    mesh.cells = {1, 2, 3, 1, 2, 4, 0, 1, 3};
    expect_only(mesh, set_of(DefectKind::same_side, DefectKind::open_boundary, DefectKind::overlapping_cells), 1);
}

}  // namespace
}  // namespace barycert::testing
