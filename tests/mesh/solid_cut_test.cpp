#include "mesh/solid_cut.hpp"
#include "core/vtk_cell.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/pulling.hpp"

#include "tests/mesh/cut_oracle.hpp"
#include "tests/mesh/octree_cell.hpp"

namespace barycert::test {
namespace {

using Index = Mesh::Index;

/// The cell as a polyhedron whose place i has the number order[i].
Mesh mesh_of(const PlacedRings& cell, const std::vector<Index>& order, const std::vector<std::vector<Index>>& rings) {
    Mesh mesh;
    mesh.points.resize(3 * cell.places.size());
    for (std::size_t i = 0; i < cell.places.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) mesh.points[3 * static_cast<std::size_t>(order[i]) + k] = cell.places[i][k];
    }
    add_shape(mesh, vtk_polyhedron, order, rings);
    return mesh;
}

std::vector<Index> random_order(std::size_t n, std::mt19937& random) {
    std::vector<Index> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::shuffle(order, random);
    return order;
}

std::vector<std::vector<Index>> numbered(const PlacedRings& cell, const std::vector<Index>& order) {
    std::vector<std::vector<Index>> rings;
    for (const auto& ring : cell.rings) {
        auto& own = rings.emplace_back();
        for (const Index place : ring) own.push_back(order[static_cast<std::size_t>(place)]);
    }
    return rings;
}

/// How a cell was cut.
enum class How : std::uint8_t { cone, search, uncut };

/// Cut once, and again with faces and rings in another order: both must be right and the same.
How expect_filled(const PlacedRings& cell, const std::vector<Index>& order, std::mt19937& random) {
    std::vector<std::vector<Index>> rings = numbered(cell, order);
    Mesh mesh = mesh_of(cell, order, rings);
    const Whole volume = volume_inside(mesh, rings);
    cut(mesh);
    if (!mesh::uncut_parts(mesh).empty()) {
        EXPECT_EQ(mesh.cell_count(), 1U);
        EXPECT_EQ(measure(mesh, 0), 0);
        return How::uncut;
    }
    EXPECT_EQ(fault_of_parts(mesh, volume), "");
    // All of each face is there, in triangles of the rule.
    std::set<std::set<Index>> outer;
    for (std::size_t part = 0; part < mesh.cell_count(); ++part) {
        for (std::size_t k = 0; k < 4; ++k) {
            std::set<Index> facet(mesh.corners_of(part).begin(), mesh.corners_of(part).end());
            facet.erase(mesh.corners_of(part)[k]);
            if ((mesh.shapes.inside[part] >> k & 1U) == 0) outer.insert(facet);
        }
    }
    std::set<std::set<Index>> expected;
    for (auto ring : rings) {
        if (random() % 2 == 0) std::ranges::reverse(ring);
        std::ranges::rotate(ring, ring.begin() + static_cast<std::ptrdiff_t>(random() % ring.size()));
        std::vector<mesh::NodeTriangle> triangles;
        EXPECT_TRUE(mesh::cut_face({mesh.points.data(), 3, {}}, ring, triangles));
        for (const auto& t : triangles) expected.emplace(t.begin(), t.end());
    }
    EXPECT_EQ(outer, expected);
    for (auto& ring : rings) {
        if (random() % 2 == 0) std::ranges::reverse(ring);
        std::ranges::rotate(ring, ring.begin() + static_cast<std::ptrdiff_t>(random() % ring.size()));
    }
    std::ranges::shuffle(rings, random);
    Mesh other = mesh_of(cell, order, rings);
    cut(other);
    EXPECT_EQ(sets_of_corners(other), sets_of_corners(mesh));
    for (Index node = 0; static_cast<std::size_t>(node) < order.size(); ++node) {
        bool all = true;
        for (std::size_t part = 0; part < mesh.cell_count(); ++part)
            all = all && std::ranges::count(mesh.corners_of(part), node) == 1;
        if (all) return How::cone;
    }
    return How::search;
}

TEST(SolidCut, FillsCellsOfOctreesWithAnySidesRefined) {
    std::mt19937 random(1);
    std::array<std::size_t, 3> counts{};
    for (unsigned sides = 0; sides < 64; ++sides) {
        for (int round = 0; round < 6; ++round) {
            const unsigned edges = round % 2 == 0 ? 0 : random() & random() & 0xfffU;
            const PlacedRings cell = octree_cell(sides, edges);
            const How how = expect_filled(cell, random_order(cell.places.size(), random), random);
            ++counts[static_cast<std::size_t>(how)];
            ASSERT_TRUE(edges != 0 || how != How::uncut) << "sides " << sides;
            ASSERT_FALSE(::testing::Test::HasFailure()) << "sides " << sides << ", edges " << edges;
        }
    }
    EXPECT_GT(counts[0], 100U);
    EXPECT_GT(counts[1], 50U);
    EXPECT_LT(counts[2], 5U);  // faces with one corner that is flat may be cut so that no tetrahedra fill the cell
}

TEST(SolidCut, FillsExtrudedConcavePolygons) {
    const std::vector<std::vector<std::array<int, 2>>> bases{
        {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}},                  // L
        {{0, 0}, {6, 0}, {6, 2}, {4, 2}, {4, 5}, {2, 5}, {2, 2}, {0, 2}},  // T
        {{0, 0}, {6, 0}, {6, 6}, {4, 6}, {4, 2}, {2, 2}, {2, 6}, {0, 6}},  // U
        {{0, 0}, {4, 0}, {1, 1}, {0, 4}},                                  // an arrow
        {{0, 0}, {2, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}, {0, 2}},  // L with flat corners
        {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 4}, {4, 4}, {4, 2}, {0, 2}},  // C
    };
    std::mt19937 random(2);
    std::size_t uncut = 0;
    for (const auto& base : bases) {
        PlacedRings cell;
        const auto n = static_cast<Index>(base.size());
        for (const int z : {0, 3}) {
            for (const auto& [x, y] : base) cell.places.push_back({x, y, z});
        }
        std::vector<Index> top, bottom;
        for (Index i = 0; i < n; ++i) {
            top.push_back(n + i);
            bottom.push_back(n - 1 - i);
            const Index next = (i + 1) % n;
            cell.rings.push_back({i, next, n + next, n + i});
        }
        cell.rings.push_back(top);
        cell.rings.push_back(bottom);
        for (int round = 0; round < 40; ++round)
            uncut += expect_filled(cell, random_order(cell.places.size(), random), random) == How::uncut ? 1 : 0;
    }
    EXPECT_LT(uncut, 24U);  // a tenth: diagonals of the sides may bar all tetrahedra, as in Schoenhardt's prism
}

// An L in space: of a cube of eight smaller ones, some.
TEST(SolidCut, FillsWhatCubesMake) {
    std::mt19937 random(3);
    std::size_t uncut = 0;
    for (const unsigned cubes : {0b01111111U, 0b00010111U, 0b00000111U, 0b00110111U}) {
        const PlacedRings cell = union_of_cubes(cubes);
        for (int round = 0; round < 25; ++round)
            uncut += expect_filled(cell, random_order(cell.places.size(), random), random) == How::uncut ? 1 : 0;
    }
    EXPECT_LT(uncut, 5U);
}

TEST(SolidCut, FillsWarpedHexahedraOrTellsThatItCannot) {
    std::mt19937 random(4);
    std::size_t lowest = 0, others = 0, uncut = 0;
    for (int round = 0; round < 4000; ++round) {
        const std::vector<Index> order = random_order(8, random);
        Mesh mesh;
        mesh.points.resize(24);
        const auto places = places_of(12);
        for (std::size_t i = 0; i < 8; ++i) {
            for (std::size_t k = 0; k < 3; ++k)
                mesh.points[3 * static_cast<std::size_t>(order[i]) + k] =
                    places[i][k] * 4 + static_cast<int>(random() % 17) - 8;
        }
        add_shape(mesh, 12, order);
        cut(mesh);
        if (!mesh::uncut_parts(mesh).empty()) {
            ++uncut;
            ASSERT_EQ(mesh.cell_count(), 1U);
            ASSERT_EQ(measure(mesh, 0), 0);
            continue;
        }
        std::vector<std::vector<Index>> triangles;
        for (const auto& places_of_ring : mesh::rings_of(12)) {
            std::vector<Index> ring;
            for (const Index place : places_of_ring) ring.push_back(order[static_cast<std::size_t>(place)]);
            std::vector<mesh::NodeTriangle> own;
            ASSERT_TRUE(mesh::cut_face({mesh.points.data(), 3, {}}, ring, own));
            for (const auto& t : own) triangles.emplace_back(t.begin(), t.end());
        }
        ASSERT_EQ(fault_of_parts(mesh, volume_inside(mesh, triangles)), "") << "round " << round;
        bool all = true;
        for (std::size_t part = 0; part < mesh.cell_count(); ++part)
            all = all && std::ranges::count(mesh.corners_of(part), 0) == 1;
        ++(all ? lowest : others);
    }
    EXPECT_GT(lowest, 1000U);
    EXPECT_GT(others, 50U);
    EXPECT_GT(uncut, 5U);
}

// Schoenhardt's: a prism turned about its axis, its sides bent inwards. No tetrahedron has a face of it and four nodes.
TEST(SolidCut, APolyhedronWithoutTetrahedraIsTold) {
    Mesh mesh;
    mesh.points = {6, 0, 0, -3, 5, 0, -3, -5, 0, 5, 4, 6, -6, 2, 6, 1, -6, 6};
    add_shape(mesh, 10, {0, 1, 2, 3});
    add_shape(mesh, vtk_polyhedron, {0, 1, 2, 3, 4, 5},
              {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}});
    // One way the sides bend outwards, the other way inwards.
    Mesh turned;
    turned.points = mesh.points;
    add_shape(turned, 10, {0, 1, 2, 3});
    add_shape(turned, vtk_polyhedron, {0, 1, 2, 3, 4, 5},
              {{0, 2, 1}, {3, 4, 5}, {0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}, {2, 0, 5}, {0, 3, 5}});
    cut(mesh);
    cut(turned);
    const bool first = mesh::uncut_parts(mesh).empty(), second = mesh::uncut_parts(turned).empty();
    EXPECT_NE(first, second);
    const Mesh& uncut = first ? turned : mesh;
    EXPECT_EQ(mesh::uncut_parts(uncut), std::vector<Index>{1});
    EXPECT_EQ(uncut.cell_count(), 2U);
    EXPECT_EQ(measure(uncut, 1), 0);
    EXPECT_EQ(mesh::told_uncut(uncut),
              "1 cell cannot be cut into tetrahedra without new points, and owns nothing: cell 1 (from 0)");
    EXPECT_EQ(mesh::told_uncut(first ? mesh : turned), "");
}

// In either order: VTK documents one, and its functions have the other.
TEST(SolidCut, WedgesHavePositiveParts) {
    for (const bool flat_face : {false, true}) {
        for (const bool other : {false, true}) {
            std::vector<Index> order{0, 1, 2, 3, 4, 5};
            do {
                Mesh mesh = one_cell(13, order);
                if (flat_face) mesh.points[3 * static_cast<std::size_t>(order[5]) + 2] += 1;
                if (other) {
                    for (const std::size_t i : {0U, 3U}) std::swap(mesh.shapes.nodes[i], mesh.shapes.nodes[i + 1]);
                }
                cut(mesh);
                ASSERT_EQ(mesh.cell_count(), 3U);
                for (std::size_t part = 0; part < 3; ++part) ASSERT_GT(measure(mesh, part), 0);
                for (std::size_t part = 0; part < 3; ++part) {
                    const auto zeros = [&](std::size_t k) { return 0xfU & ~(1U << k); };
                    for (std::size_t k = 0; k < 4; ++k)
                        ASSERT_EQ(mesh::feature_of_whole(mesh.shapes.inside[part], zeros(k), 3), Feature::vertex);
                }
                ASSERT_EQ(fault_of_parts(mesh, measure(mesh, 0) + measure(mesh, 1) + measure(mesh, 2)), "");
            } while (std::ranges::next_permutation(order).found);
        }
    }
}

}  // namespace
}  // namespace barycert::test
