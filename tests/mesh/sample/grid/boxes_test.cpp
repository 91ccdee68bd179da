// Cells against the number of points in their boxes: few of them are all looked at, many row by row.
#include <gtest/gtest.h>

#include <cmath>

#include "barycert/environment.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/sample/grid/compare.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

/// The choice at start is restored, however a test ends.
struct Restored {
    ~Restored() { use_simd_target(""); }
};

/// The law with a field of so many components at nodes and none at cells, on every target, with both roundings.
void expect_law_everywhere(Mesh mesh, int components, const Grid& grid, const std::string& what, base::Random& random) {
    const Restored restored;
    mesh.point_fields = random_fields(mesh.point_count(), {components}, false, random);
    mesh.cell_fields.clear();
    if (random.coin()) {  // ties, and values so near to them that integers must decide
        for (double& x : mesh.point_fields[0].data) x = 1 + 0x1p-51 * random.integer(0, 3);
    }
    const auto locator = Locator::build(mesh), asks = Locator::build(mesh, {.prove = Prove::never});
    const auto walks = Sampler::build(*locator, all_fields(mesh)), other = Sampler::build(*asks, all_fields(mesh));
    for (const std::string& target : simd_targets()) {
        ASSERT_TRUE(use_simd_target(target));
        for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
            const SampleOptions options{.rounding = rounding, .outside = {}, .threads = 1};
            expect_law(*walks, grid, options, what + ", " + target);
            expect_law(*other, grid, options, what + ", any cells, " + target);
        }
    }
}

/// A box of cells askew, each with about `points` points of a grid of spacing 1 along each axis.
Mesh askew_box(int d, const std::array<double, 3>& points, double shift, base::Random& random) {
    Mesh mesh = mapped(box(d, {2, 2, 2}), points, {shift, shift, shift});
    for (double& x : mesh.points) x += random.uniform(-0.2, 0.2);
    return renumbered(mesh, random);
}

// From less than one point along an axis to more than are looked at one by one, of which there may be 8.
TEST(ResampleBoxes, FewAndManyPoints) {
    for (const int d : {2, 3}) {
        base::Random random(static_cast<std::uint64_t>(d));
        for (int round = 0; round < 60; ++round) {
            std::array<double, 3> points{};
            for (double& n : points) n = random.integer(1, 20) * 0.5;
            const Mesh mesh = askew_box(d, points, round % 3 == 0 ? 1e6 : 0.25, random);
            const Bounds3 bounds = bounds_of_cells(mesh);
            std::array<std::int64_t, 3> counts{1, 1, 1};
            std::array<double, 3> low = bounds.low, high = bounds.high;
            for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
                counts[k] = std::max<std::int64_t>(2, std::llround(2 * points[k]) + 1);
                if (round % 2 == 0) low[k] += 0.1;  // no point on the box of the mesh
            }
            expect_law_everywhere(mesh, round % 5 == 4 ? 3 : 1, over(d, counts, low, high),
                                  "round " + std::to_string(round), random);
        }
    }
}

// Every node of the mesh, and the middle of every edge, is a point: each lies on facets of all cells that hold it.
TEST(ResampleBoxes, Lattices) {
    for (const int d : {2, 3}) {
        base::Random random(3);
        for (const std::int64_t n : {1, 2, 6, 7, 8, 9}) {
            const Mesh mesh = renumbered(box(d, {3, 2, 2}), random);
            const Grid grid = over(d, {3 * n + 1, 2 * n + 1, d == 3 ? 2 * n + 1 : 1}, {0, 0, 0}, {3, 2, 2});
            for (const int components : {1, 2})
                expect_law_everywhere(mesh, components, grid, std::to_string(n) + " points an edge", random);
        }
    }
}

// So near to a facet that single precision cannot tell on which side, and double precision can, and nearer.
TEST(ResampleBoxes, NearFacets) {
    for (const int d : {2, 3}) {
        base::Random random(4);
        for (const int bits : {16, 20, 22, 23, 24, 26, 30, 40, 48, 50, 52}) {
            Mesh mesh = box(d, {3, 3, 3});
            for (double& x : mesh.points) x += std::ldexp(random.integer(-3, 3), -bits);
            mesh = renumbered(mesh, random);
            const Grid grid = over(d, {13, 13, d == 3 ? 13 : 1}, {0, 0, 0}, {3, 3, 3});
            expect_law_everywhere(mesh, 1, grid, std::to_string(bits) + " bits", random);
            mesh.point_fields = random_fields(mesh.point_count(), {1}, false, random);
            expect_truth(mesh, over(d, {7, 7, d == 3 ? 4 : 1}, {0, 0, 0}, {3, 3, 3}), "near facets");
        }
    }
}

// One cell with all of the grid, others with a point of it or none, all at once.
TEST(ResampleBoxes, LargeAmongSmall) {
    for (const int d : {2, 3}) {
        base::Random random(5);
        Mesh mesh = mapped(box(d, {4, 4, 4}), {0.3, 0.3, 0.3}, {8, 8, 8});
        mesh = joined(mesh, mapped(box(d, {1, 1, 1}), {40, 40, 40}, {-4, -4, -4}));
        mesh = joined(mesh, mapped(box(d, {5, 5, 5}), {1, 1, 1}, {9.5, 9.5, 9.5}));
        mesh = renumbered(mesh, random);
        for (const int components : {1, 2})
            expect_law_everywhere(mesh, components, over(d, {21, 20, d == 3 ? 19 : 1}, {0, 0, 0}, {20, 20, 20}),
                                  "large among small", random);
    }
}

// More cells than one part of the list has, more points than one slab.
TEST(ResampleBoxes, PartsAndSlabs) {
    base::Random random(6);
    for (const int d : {2, 3}) {
        Mesh mesh = renumbered(box(d, d == 3 ? std::array{18, 19, 20} : std::array{140, 150, 1}), random);
        mesh.point_fields = random_fields(mesh.point_count(), {100}, false, random);
        ASSERT_GT(mesh.cell_count(), 40000U);
        const Locator locator = Locator::build(mesh).value();
        const Sampler sampler = Sampler::build(locator, all_fields(mesh)).value();
        const Bounds3 bounds = bounds_of_cells(mesh);
        const Grid grid =
            over(d, d == 3 ? std::array<std::int64_t, 3>{37, 40, 101} : std::array<std::int64_t, 3>{301, 500, 1},
                 bounds.low, bounds.high);
        Table expected;
        ASSERT_TRUE(sampler.sample(points_of(grid), {}, expected));
        for (const int threads : {1, 2, 3}) {
            SampleOptions options;
            options.threads = threads;
            const Resampled found = resampled(sampler, grid, options);
            EXPECT_GT(found.blocks, 1U);
            expect_same_rows(expected, found.samples, grid, std::to_string(threads) + " threads");
            expect_same_counts(expected.counts, found.counts, std::to_string(threads) + " threads");
        }
    }
}

}  // namespace
}  // namespace barycert::testing
