// Meshes that are none: cells that overlap, lie in each other, are flat, or are there twice; and many small complexes.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/locate/ways.hpp"

namespace barycert::testing {
namespace {

constexpr Ways quick_ways{.targets = false, .threads = false};

/// Every lattice point and half of one around a mesh on a small lattice.
std::vector<double> half_lattice(int d, int from, int to) {
    std::vector<double> points;
    for (int x = 2 * from; x <= 2 * to; ++x) {
        for (int y = 2 * from; y <= 2 * to; ++y) {
            for (int z = 2 * from; z <= (d == 2 ? 2 * from : 2 * to); ++z) {
                points.insert(points.end(), {0.5 * x, 0.5 * y});
                if (d == 3) points.push_back(0.5 * z);
            }
        }
    }
    return points;
}

TEST(LocateSoups, L1L2L3SmallSoups) {
    for (const int d : {2, 3}) {
        for (std::uint64_t n = 0; n < 250 && !::testing::Test::HasFailure(); ++n) {
            base::Random random = base::Random::stream(1, n, static_cast<std::uint64_t>(d));
            const Mesh mesh = random_soup(d, random);
            std::vector<double> points = half_lattice(d, -1, d == 2 ? 5 : 2);
            const std::vector<double> more = awkward_points(mesh, 6, random);
            points.insert(points.end(), more.begin(), more.end());
            expect_right(mesh, points, random, "soup " + std::to_string(n), quick_ways);
        }
    }
}

// Small complexes whose parts touch in vertices and edges: the owner of a point may be in another part.
TEST(LocateSoups, L1L2SmallComplexes) {
    int certified = 0;
    for (const int d : {2, 3}) {
        for (std::uint64_t n = 0; n < 250 && !::testing::Test::HasFailure(); ++n) {
            base::Random random = base::Random::stream(2, n, static_cast<std::uint64_t>(d));
            Mesh mesh = n % 2 == 0 ? grown_complex(d, random) : damaged_box(d, random);
            if (random.coin()) flip_some(mesh, random);
            certified +=
                expect_right(mesh, awkward_points(mesh, 15, random), random, "complex " + std::to_string(n), quick_ways)
                    ? 1
                    : 0;
        }
    }
    EXPECT_GT(certified, 200);
}

// Hundreds of cells over each other.
TEST(LocateSoups, L1L2L3DenseSoups) {
    for (const int d : {2, 3}) {
        for (const bool lattice : {false, true}) {
            base::Random random(static_cast<std::uint64_t>(3 + d));
            Mesh mesh;
            mesh.dimension = d;
            for (int i = 0; i < 60 * d; ++i)
                mesh.points.push_back(lattice ? random.integer(0, 5) : random.uniform(-1, 1));
            for (int i = 0; i < 400 * (d + 1); ++i)
                mesh.cells.push_back(static_cast<Mesh::Index>(random.below(mesh.point_count())));
            for (int i = 0; i < 10 * (d + 1); ++i) mesh.cells.push_back(mesh.cells[static_cast<std::size_t>(i)]);
            expect_right(mesh, awkward_points(mesh, 60, random), random, "dense soup");
        }
    }
}

// One cell in the other, each a little smaller, in this order and the opposite one.
TEST(LocateSoups, L1L2NestedCells) {
    for (const int d : {2, 3}) {
        for (const bool outermost_first : {true, false}) {
            base::Random random(4);
            Mesh one = only(box(d, {1, 1, 1}), d == 2 ? std::vector<bool>{true, false}
                                                      : std::vector<bool>{true, false, false, false, false, false});
            Mesh mesh = mapped(one, {1, 1, 1}, {});
            mesh.cells.clear();
            mesh.points.clear();
            for (int i = 0; i < 60; ++i) {
                const double size = std::ldexp(1.0, outermost_first ? -i : i - 59);
                mesh = joined(mesh, mapped(one, {size, size, size}, {}));
            }
            expect_right(mesh, awkward_points(mesh, 60, random), random, "nested cells");
        }
    }
}

// A proper mesh with every cell twice, with flat cells between, and with nodes that no cell uses far away.
TEST(LocateSoups, L1L2L3CellsTwiceFlatOnesAndLonelyNodes) {
    for (const int d : {2, 3}) {
        base::Random random(5);
        const Mesh good = box(d, {3, 3, 2});
        Mesh twice = good;
        twice.cells.insert(twice.cells.end(), good.cells.begin(), good.cells.end());
        expect_right(twice, awkward_points(twice, 40, random), random, "twice");
        Mesh flat = good;
        flat.cells.clear();
        for (std::size_t c = 0; c < good.cell_count(); ++c) {
            const auto first = good.cells.begin() + static_cast<std::ptrdiff_t>(c * good.corners());
            std::vector<Mesh::Index> cell(first, first + d + 1);
            std::vector<Mesh::Index> repeated = cell;
            repeated[random.below(good.corners())] = cell[random.below(good.corners())];
            if (random.coin()) flat.cells.insert(flat.cells.end(), repeated.begin(), repeated.end());
            flat.cells.insert(flat.cells.end(), cell.begin(), cell.end());
        }
        // A square is flat with four nodes, a segment with three.
        const std::vector<Mesh::Index> lower =
            d == 2 ? std::vector<Mesh::Index>{0, 1, 2} : std::vector<Mesh::Index>{0, 1, 4, 5};
        flat.cells.insert(flat.cells.begin(), lower.begin(), lower.end());
        expect_right(flat, awkward_points(flat, 40, random), random, "flat cells");
        Mesh lonely = good;
        const std::vector<double> far(static_cast<std::size_t>(d), 1e300), low(static_cast<std::size_t>(d), -1.7e308);
        add_node(lonely, far);
        add_node(lonely, low);
        add_node(lonely, std::vector<double>(static_cast<std::size_t>(d), 1.0));
        EXPECT_EQ(expect_right(lonely, awkward_points(lonely, 40, random), random, "lonely nodes"), true);
    }
}

TEST(LocateSoups, L1L3NoCellOneCellOnlyFlatCells) {
    for (const int d : {2, 3}) {
        base::Random random(6);
        Mesh none;
        none.dimension = d;
        expect_right(none, {0, 0, 0, 1, 1, 1}, random, "nothing");
        expect_right(none, {}, random, "nothing, no point");
        add_node(none, std::vector<double>(static_cast<std::size_t>(d), 0.0));
        expect_right(none, {0, 0, 0, 1, 1, 1}, random, "a node");
        std::vector<bool> first(static_cast<std::size_t>(d == 2 ? 2 : 6), false);
        first[0] = true;
        const Mesh one = only(box(d, {1, 1, 1}), first);
        expect_right(one, awkward_points(one, 100, random), random, "one cell");
        expect_right(one, {}, random, "one cell, no point");
        Mesh flat = box(d, {2, 2, 2});
        for (std::size_t i = 0; i < flat.points.size(); i += static_cast<std::size_t>(d)) flat.points[i] = 3;
        expect_right(flat, awkward_points(flat, 30, random), random, "flat cells only");
        Mesh node = flat;
        for (double& x : node.points) x = 0.1;
        expect_right(node, awkward_points(node, 10, random), random, "all nodes in one place");
    }
}

}  // namespace
}  // namespace barycert::testing
