// Cells that are no partition, and cells that are hardly cells.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/sample/grid/compare.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

Mesh one_cell(int d, const std::vector<double>& points) {
    Mesh mesh;
    mesh.dimension = d;
    mesh.points = points;
    for (int i = 0; i <= d; ++i) mesh.cells.push_back(i);
    return mesh;
}

/// Random nodes of a lattice, cells of any of them.
Mesh soup(int d, int side, std::size_t cells, base::Random& random) {
    Mesh mesh;
    mesh.dimension = d;
    for (int i = 0; i < 40 * d; ++i) mesh.points.push_back(random.integer(0, side));
    for (std::size_t i = 0; i < cells * mesh.corners(); ++i)
        mesh.cells.push_back(static_cast<Mesh::Index>(random.below(40)));
    return mesh;
}

TEST(ResampleCells, Soups) {
    for (const int d : {2, 3}) {
        for (std::uint64_t seed = 0; seed < 12; ++seed) {
            base::Random random(seed);
            Mesh mesh = soup(d, 4, 3 + seed * seed, random);
            set_simple_fields(mesh, random);
            for (const std::int64_t n : {5, 9, 8, 33}) {
                const Grid grid = over(d, {n, 9, d == 3 ? 5 : 1}, {0, 0, 0}, {4, 4, 4});
                const SampleCounts counts = expect_law(mesh, grid, "soup " + std::to_string(seed));
                if (seed == 3) {
                    EXPECT_GT(counts.locations.inside(), 0U);
                    expect_truth(mesh, grid, "soup");
                }
            }
            for (const NamedGrid& g : awkward_grids(mesh, 300, random))
                expect_law(mesh, g.grid, "soup " + std::to_string(seed) + ", " + g.name);
        }
    }
}

// The lower one of two has each point, whichever comes first in the order of the locator.
TEST(ResampleCells, DuplicatesAndCopies) {
    for (const int d : {2, 3}) {
        base::Random random(1);
        const Mesh once = box(d, {3, 2, 2});
        Mesh mesh = once;
        mesh.cells.insert(mesh.cells.end(), once.cells.begin(), once.cells.end());  // the same nodes
        mesh = joined(mesh, once);                                                  // other nodes, the same place
        mesh = joined(mesh, mapped(once, {1, 1, 1}, {0.25, 0.125, 0.5}));
        mesh = joined(mesh, mapped(once, {1, 1, 1}, {0x1p-50, 0, 0}));
        for (int i = 0; i < 6; ++i) {
            mesh = renumbered(mesh, random);
            flip_some(mesh, random);
            set_simple_fields(mesh, random);
            for (const NamedGrid& g : awkward_grids(mesh, 800, random)) expect_law(mesh, g.grid, "copies, " + g.name);
        }
    }
}

TEST(ResampleCells, Nested) {
    for (const int d : {2, 3}) {
        base::Random random(2);
        Mesh mesh = d == 2 ? one_cell(2, {0, 0, 8, 0, 0, 8}) : one_cell(3, {0, 0, 0, 8, 0, 0, 0, 8, 0, 0, 0, 8});
        const Mesh max = mesh;
        for (int i = 1; i < 30; ++i) {
            const double by = std::ldexp(1.0, -i / 4), to = i % 4 * 0.25;
            mesh = joined(mesh, mapped(max, {by, by, by}, {to, to, to}));
        }
        for (int i = 0; i < 4; ++i) {
            mesh = renumbered(mesh, random);
            flip_some(mesh, random);
            set_simple_fields(mesh, random);
            expect_truth(mesh, over(d, {9, 9, d == 3 ? 9 : 1}, {0, 0, 0}, {8, 8, 8}), "nested");
            for (const NamedGrid& g : awkward_grids(mesh, 1500, random)) expect_law(mesh, g.grid, "nested, " + g.name);
        }
    }
}

// A height from 1e-5 of the width down to what is lost in rounding, across and askew.
TEST(ResampleCells, Slivers) {
    for (const int d : {2, 3}) {
        base::Random random(3);
        for (const double height : {1e-3, 1e-5, 1e-6, 1e-7, 1e-9, 1e-12, 1e-15, 1e-16, 1e-30}) {
            for (int i = 0; i < 6; ++i) {
                std::vector<double> at;
                for (int n = 0; n <= d; ++n) {
                    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1),
                                 off = height * random.uniform(-1, 1);
                    // Near the plane z = x / 2 + y (the line y = x / 2), or near an axis' plane.
                    const double z = i % 3 == 0 ? 0 : i % 3 == 1 ? 0.5 : d == 3 ? x / 2 + y : x / 2;
                    if (d == 3) at.insert(at.end(), {x, y, z + off});
                    if (d == 2) at.insert(at.end(), {x, z + off});
                }
                Mesh mesh = one_cell(d, at);
                set_simple_fields(mesh, random);
                const std::string what = "height " + std::to_string(std::ilogb(height)) + " " + std::to_string(i);
                for (const NamedGrid& g : awkward_grids(mesh, 2000, random)) expect_law(mesh, g.grid, what + g.name);
            }
        }
    }
}

TEST(ResampleCells, DegenerateOnesOwnNothing) {
    for (const int d : {2, 3}) {
        base::Random random(4);
        Mesh mesh = box(d, {2, 2, 2});
        for (int i = 0; i < 200; ++i) {  // in a plane or line of the lattice, askew, or a point
            const std::vector<double> a = node_at(mesh, static_cast<Mesh::Index>(random.below(9)));
            const auto low = static_cast<Mesh::Index>(random.below(9)),
                       step = static_cast<Mesh::Index>(random.below(3));
            for (int n = 0; n <= d; ++n) mesh.cells.push_back(std::min<Mesh::Index>(low + n * step, 8));
        }
        mesh = renumbered(mesh, random);
        set_simple_fields(mesh, random);
        const Grid grid = over(d, {9, 5, d == 3 ? 5 : 1}, {0, 0, 0}, {2, 2, 2});
        EXPECT_EQ(expect_law(mesh, grid, "degenerate").locations.outside, 0U);
        expect_truth(mesh, grid, "degenerate");
        for (const NamedGrid& g : awkward_grids(mesh, 500, random)) expect_law(mesh, g.grid, "degenerate, " + g.name);
        // Nothing else: everything is outside.
        Mesh flat = one_cell(d, std::vector<double>(static_cast<std::size_t>(d * (d + 1)), 0.5));
        set_simple_fields(flat, random);
        EXPECT_EQ(expect_law(flat, grid, "flat").locations.inside(), 0U);
    }
}

// One cell about a grid whose rows are longer than any vector: inner points have no test at all.
TEST(ResampleCells, ThousandsOfPointsInACell) {
    for (const int d : {2, 3}) {
        base::Random random(5);
        Mesh mesh = d == 2 ? one_cell(2, {-3, -5.5, 7.25, -1, 0.3, 9})
                           : one_cell(3, {-3, -5.5, -4, 7.25, -1, -5, 0.3, 9, -2, 0.1, 0.2, 11});
        set_simple_fields(mesh, random);
        for (const std::int64_t n : {7, 8, 9, 15, 16, 17, 63, 64, 65, 1001}) {
            const Grid grid = over(d, {n, d == 3 ? 40 : 300, d == 3 ? 17 : 1}, {-3, -5.5, -5}, {7.25, 9, 11});
            const SampleCounts counts = expect_law(mesh, grid, "one cell, " + std::to_string(n));
            EXPECT_GT(counts.locations.interior, 0U);
        }
    }
}

}  // namespace
}  // namespace barycert::testing
