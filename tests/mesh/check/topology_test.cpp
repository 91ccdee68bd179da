// Domains of several parts, with cavities and tunnels, and such as touch themselves: certified, and counted rightly.
#include <gtest/gtest.h>

#include "tests/mesh/check/judge.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

struct Counts {
    std::uint64_t parts, pieces;
    std::optional<std::uint64_t> cavities;
    std::optional<std::int64_t> tunnels;
};

void expect_certified(const Mesh& mesh, DefectSet told, const Counts& c) {
    const CheckReport r = quick(mesh);
    EXPECT_TRUE(r.certified());
    EXPECT_EQ(words(found(r)), words(told));
    EXPECT_EQ(r.parts, c.parts);
    EXPECT_EQ(r.boundary.pieces, c.pieces);
    EXPECT_EQ(r.boundary.cavities, c.cavities);
    if (mesh.dimension == 3 && r.boundary.manifold) {
        EXPECT_EQ(r.boundary.tunnels, c.tunnels);
    }
    if (mesh.dimension == 2) {
        EXPECT_FALSE(r.boundary.tunnels);
    }
    EXPECT_EQ(r.boundary.manifold, (told & set_of(DefectKind::pinched_node, DefectKind::pinched_ridge)) == 0);
    EXPECT_TRUE(r.boundary.closed);
    EXPECT_TRUE(r.volume.equal);
}

/// A box without the cubes for which `gone` holds; unused nodes are told.
template <class F>
Mesh box_without(int d, std::array<int, 3> cubes, F gone) {
    const Mesh mesh = box(d, cubes);
    const std::size_t in_cube = d == 2 ? 2 : 6;
    std::vector<bool> keep;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        const int cube = static_cast<int>(c / in_cube);
        keep.push_back(!gone(cube % cubes[0], cube / cubes[0] % cubes[1], cube / cubes[0] / cubes[1]));
    }
    return only(mesh, keep);
}

TEST(Topology, EmptyAndOne) {
    for (const int d : {2, 3}) {
        Mesh none;
        none.dimension = d;
        expect_certified(none, 0, {0, 0, 0, 0});
        EXPECT_EQ(quick(none).volume.cells, 0);
        none.points.assign(static_cast<std::size_t>(d), 7);
        expect_certified(none, set_of(DefectKind::unused_node), {0, 0, 0, 0});
        Mesh one = box(d, {1, 1, 1});
        std::vector<bool> keep(one.cell_count(), false);
        keep[0] = true;
        expect_certified(only(one, keep), set_of(DefectKind::unused_node), {1, 1, 0, 0});
        EXPECT_EQ(quick(one).volume.cells, 1);
    }
}

TEST(Topology, PartsAndCavities) {
    for (const int d : {2, 3}) {
        const Mesh solid = box(d, {3, 3, 3});
        expect_certified(solid, 0, {1, 1, 0, 0});
        expect_certified(joined(solid, mapped(solid, {1, 1, 1}, {3.5, 0, 0})), 0, {2, 2, 0, 0});
        const Mesh hollow =
            box_without(d, {3, 3, 3}, [&](int x, int y, int z) { return x == 1 && y == 1 && (d == 2 || z == 1); });
        expect_certified(hollow, 0, {1, 2, 1, 0});
        EXPECT_EQ(quick(hollow).volume.cells, d == 2 ? 8 : 26);
        // A part in the cavity of another: not nested in the sense of P4, for no cell is over it.
        const Mesh inner = mapped(box(d, {1, 1, 1}), {0.5, 0.5, 0.5}, {1.25, 1.25, 1.25});
        expect_certified(joined(hollow, inner), 0, {2, 3, 1, 0});
        expect_certified(joined(inner, hollow), 0, {2, 3, 1, 0});
    }
}

TEST(Topology, Tunnels) {
    const auto ring = [](int x, int y, int) { return x == 1 && y == 1; };
    expect_certified(box_without(3, {3, 3, 1}, ring), 0, {1, 1, 0, 1});
    expect_certified(box_without(3, {5, 3, 1}, [](int x, int y, int) { return x % 2 == 1 && y == 1; }), 0,
                     {1, 1, 0, 2});
    // A cavity in the shape of a ring: one tunnel more, of that piece.
    expect_certified(box_without(3, {5, 5, 3},
                                 [&](int x, int y, int z) {
                                     return z == 1 && x >= 1 && x <= 3 && y >= 1 && y <= 3 && !(x == 2 && y == 2);
                                 }),
                     0, {1, 2, 1, 1});
    // Three bars through the middle of a cube: six openings, genus five.
    expect_certified(box_without(3, {3, 3, 3}, [](int x, int y, int z) { return (x == 1) + (y == 1) + (z == 1) >= 2; }),
                     0, {1, 1, 0, 5});
}

// Cubes that touch in one node or along one edge, with common nodes: a complex, though no manifold.
TEST(Topology, Pinched) {
    const auto diagonal = [](int x, int y, int z) { return x != y || y != z; };
    expect_certified(box_without(3, {2, 2, 2}, diagonal), set_of(DefectKind::unused_node, DefectKind::pinched_node),
                     {2, 2, 0, {}});
    expect_certified(box_without(3, {2, 2, 1}, [](int x, int y, int) { return x != y; }),
                     set_of(DefectKind::unused_node, DefectKind::pinched_ridge), {2, 2, {}, {}});
    expect_certified(box_without(3, {3, 3, 3}, diagonal), set_of(DefectKind::unused_node, DefectKind::pinched_node),
                     {3, 3, 0, {}});
    const Mesh squares = box_without(2, {2, 2, 1}, [](int x, int y, int) { return x != y; });
    const CheckReport r = quick(squares);
    EXPECT_TRUE(r.certified());
    EXPECT_EQ(words(found(r)), "unused_node pinched_ridge");
    EXPECT_EQ(r.find(DefectKind::pinched_ridge)->count, 1U);
    EXPECT_EQ(r.find(DefectKind::pinched_ridge)->places[0].nodes[0], 4);
    EXPECT_EQ(r.parts, 2U);
    EXPECT_FALSE(r.boundary.cavities);
}

// One node is told once, however many cells touch there alone.
TEST(Topology, HundredsOfCellsAtOneNode) {
    Mesh mesh;
    mesh.dimension = 3;
    add_node(mesh, {0, 0, 0});
    constexpr int cells = 600;
    for (int i = 0; i < cells; ++i) {
        const double y = 4.0 * i;
        mesh.cells.insert(mesh.cells.end(),
                          {0, add_node(mesh, {1, y, 0}), add_node(mesh, {1, y + 1, 0}), add_node(mesh, {1, y, 1})});
    }
    const CheckReport r = quick(mesh);
    EXPECT_TRUE(r.certified());
    EXPECT_EQ(words(found(r)), "pinched_node");
    EXPECT_EQ(r.find(DefectKind::pinched_node)->count, 1U);
    EXPECT_EQ(r.parts, std::uint64_t{cells});
    EXPECT_EQ(r.boundary.tunnels, 0);
}

// The same touch without common nodes breaks P3.
TEST(Topology, TouchWithoutCommonNodes) {
    for (const int d : {2, 3}) {
        for (int axes = 1; axes <= d; ++axes) {
            std::array<double, 3> shift{0, 0, 0};
            for (int k = 0; k < axes; ++k) shift[static_cast<std::size_t>(k)] = 1;
            const Mesh two = joined(box(d, {1, 1, 1}), mapped(box(d, {1, 1, 1}), {1, 1, 1}, shift));
            const CheckReport r = quick(two);
            EXPECT_FALSE(r.certified());
            EXPECT_FALSE(judge(two).complex);
            const bool facets = axes == 1;  // of which two would be one
            EXPECT_EQ(words(found(r)), std::string("boundary_contact coincident_nodes") + (facets ? " crack" : ""));
        }
    }
}

}  // namespace
}  // namespace barycert::testing
