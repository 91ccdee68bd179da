// Everything at once, at random: meshes, scales, fields, values, grids, options. The same rounds every time; with
// BARYCERT_FUZZ_ROUNDS set, that many, and BARYCERT_FUZZ_FIRST the first of them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "barycert/environment.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/sample/grid/compare.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

template <class T>
T one_of(std::initializer_list<T> all, base::Random& random) {
    return all.begin()[random.below(all.size())];
}

Mesh random_cells(int d, base::Random& random) {
    Mesh mesh;
    mesh.dimension = d;
    const bool lattice = random.coin();
    const int flat = random.integer(0, 40), side = random.integer(1, 6);
    for (int i = 0; i < 30 * d; ++i) {
        double x = lattice ? random.integer(0, side) : random.uniform(0, 4);
        // Flat askew: the last coordinate is nearly half of the first.
        if (!lattice && flat > 10 && i % d == d - 1)
            x = mesh.points[static_cast<std::size_t>(i - d + 1)] / 2 + std::ldexp(x, -flat);
        mesh.points.push_back(x);
    }
    const std::uint64_t cells = 1 + random.below(one_of<std::uint64_t>({2, 10, 60}, random));
    for (std::size_t i = 0; i < cells * mesh.corners(); ++i)
        mesh.cells.push_back(static_cast<Mesh::Index>(random.below(30)));
    return mesh;
}

/// Nodes of a box that move, little or so far that cells fold over.
Mesh shaken_box(int d, base::Random& random) {
    Mesh mesh = box(d, {random.integer(1, 4), random.integer(1, 3), random.integer(1, 3)});
    const double by = one_of({0.0, 0x1p-52, 1e-6, 0.1, 0.6}, random);
    for (double& x : mesh.points) x += by * random.uniform(-1, 1);
    return mesh;
}

/// Read once.
const Mesh& any_own_mesh(base::Random& random) {
    static const std::vector<Mesh> meshes{own_mesh("cube-hole"), own_mesh("needle-slit"), own_mesh("plate"),
                                          own_mesh("lattice-box"), own_mesh("cube-hole-o2")};
    return meshes[random.below(meshes.size())];
}

Mesh any_mesh(base::Random& random) {
    const int d = random.integer(2, 3);
    const std::uint64_t kind = random.below(8);
    Mesh mesh = kind == 0 ? any_own_mesh(random) : kind < 4 ? random_cells(d, random) : shaken_box(d, random);
    if (!mesh.mid_nodes.empty()) return mesh;
    if (kind == 7) mesh = joined(mesh, mapped(mesh, {1, 1, 1}, {one_of({0.0, 0x1p-51, 0.5}, random), 0, 0}));
    if (random.coin()) mesh = renumbered(mesh, random);
    if (random.coin()) flip_some(mesh, random);
    if (random.coin()) {
        std::array<double, 3> factor{1, 1, 1}, shift{};
        const bool all = random.coin();
        for (std::size_t k = 0; k < 3; ++k) {
            factor[k] = one_of({1.0, 0.1, 1e6, 0x1p-60, 1e-150, 1e150, 1e300, 1e-300, 0x1p-1060}, random);
            if (all) factor[k] = factor[0];
            shift[k] = factor[k] * one_of({0.0, 0.3, -1e3, 1e6, 1e12}, random);
            if (!std::isfinite(4 * factor[k] + shift[k])) shift[k] = 0;
        }
        mesh = mapped(mesh, factor, shift);
    }
    return mesh;
}

void any_fields(Mesh& mesh, base::Random& random) {
    const auto components = [&] {
        return one_of<std::vector<int>>({{}, {1}, {1}, {1}, {2}, {3}, {4}, {5}, {9}, {1, 3}, {2, 1, 6}}, random);
    };
    const std::vector<int> of_nodes = components(), of_cells = random.coin() ? components() : std::vector<int>{};
    mesh.point_fields = random_fields(mesh.point_count(), of_nodes, random.below(4) == 0, random);
    mesh.cell_fields = random_fields(mesh.cell_count(), of_cells, random.coin(), random);
    const std::uint64_t kind = random.below(8);
    for (Field& field : mesh.point_fields) {
        const double x = one_of({0.0, -0.0, 1.0, 5e-324, 1e300, -1e-300}, random);
        for (double& value : field.data) {
            if (kind == 0) value = x;
            if (kind == 1) value *= x;
            if (kind == 2) value = 1 + 0x1p-51 * random.integer(-2, 2);
            if (kind == 3 && random.below(20) == 0) value = random.coin() ? std::nan("") : -INFINITY;
            if (kind == 4) value = random.integer(-2, 2);
        }
    }
}

/// Ends at nodes, near them, or anywhere around; now and then a last point that is not where the spacing has it.
Grid any_grid(const Mesh& mesh, base::Random& random) {
    if (random.below(3) == 0) {
        const auto grids = awkward_grids(mesh, 200, random);
        if (!grids.empty()) return grids[random.below(grids.size())].grid;
    }
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const Bounds3 bounds = bounds_of_cells(mesh);
    Grid grid;
    grid.dimension = mesh.dimension;
    for (std::size_t k = 0; k < d; ++k) {
        const auto end = [&] {
            const auto node = static_cast<std::size_t>(mesh.cells[random.below(mesh.cells.size())]);
            const double x = mesh.points[d * node + k], extent = bounds.high[k] - bounds.low[k];
            const double by = one_of({0.0, 0.0, 0x1p-50, 0x1p-20, 0.1, 1.0}, random) * random.uniform(-1, 1);
            return random.below(3) == 0 ? bounds.low[k] + extent * random.uniform(-0.2, 1.2) : x + by * extent;
        };
        const double a = end(), b = end();
        const double low = std::min(a, b), high = std::max(a, b);
        grid.counts[k] = std::min<std::int64_t>(
            1 + static_cast<std::int64_t>(random.below(one_of<std::uint64_t>({3, 9, 18, 40}, random))),
            low < high ? 100 : 1);
        grid.origin[k] = low;
        grid.spacing[k] = grid.counts[k] > 1 ? (high - low) / static_cast<double>(grid.counts[k] - 1) : 0;
        grid.last[k] = high;
        if (random.below(6) == 0) grid.spacing[k] *= one_of({0.3, 0.99, 1 - 0x1p-20, 1 - 0x1p-50}, random);
        // Rounded up among subnormal numbers, or to nothing: no grid.
        if (grid.counts[k] > 1 && !(grid.spacing[k] > 0 && grid.coordinate(k, grid.counts[k] - 2) <= high)) {
            grid.counts[k] = 1;
            grid.spacing[k] = 0;
        }
    }
    return grid;
}

SampleOptions any_options(std::uint64_t points, base::Random& random) {
    SampleOptions options;
    options.rounding = random.below(6) == 0 ? Rounding::plain : Rounding::correct;
    options.threads = random.integer(0, 3);
    if (random.below(3) == 0) {
        options.outside.kind = one_of({Outside::fill, Outside::nearest, Outside::extrapolate}, random);
        options.outside.fill = 0.25;
        // These are slow: not for many points.
        if (points > 300 && options.outside.kind != Outside::fill) options.outside.kind = Outside::nan;
        if (random.coin()) options.outside.limit = 0.1;
    }
    return options;
}

std::uint64_t number_in(const char* variable, std::uint64_t otherwise) {
    const char* const text = std::getenv(variable);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(ResampleFuzz, AnythingGoes) {
    const std::uint64_t first = number_in("BARYCERT_FUZZ_FIRST", 0), rounds = number_in("BARYCERT_FUZZ_ROUNDS", 3000);
    const std::vector<std::string> targets = simd_targets();
    std::uint64_t interior = 0, boundary = 0, outside = 0, certified = 0;
    for (std::uint64_t round = first; round < first + rounds && !HasFailure(); ++round) {
        base::Random random = base::Random::stream(20, 5, round);
        Mesh mesh = any_mesh(random);
        any_fields(mesh, random);
        const std::string what = "round " + std::to_string(round);
        const auto locator =
            random.below(3) != 0 ? Locator::build(mesh) : Locator::build(mesh, {.prove = Prove::never});
        ASSERT_TRUE(locator) << what << locator.error().message();
        certified += locator->certified() ? 1 : 0;
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        ASSERT_TRUE(sampler) << what;
        use_simd_target(targets[random.below(targets.size())]);
        for (int i = 0; i < 3; ++i) {
            const Grid grid = any_grid(mesh, random);
            const SampleOptions options = any_options(grid.point_count(), random);
            const SampleCounts counts = expect_law(*sampler, grid, options, what + " grid " + std::to_string(i));
            interior += counts.locations.interior;
            boundary += counts.locations.inside() - counts.locations.interior;
            outside += counts.locations.outside;
            if (random.below(8) == 0 && grid.point_count() < 500 && options.rounding == Rounding::correct &&
                mesh.cell_count() < 100 && options.outside.kind == Outside::nan)
                expect_truth(mesh, grid, what);
        }
        use_simd_target("");
    }
    if (rounds < 1000) return;
    // The rounds are worth something.
    EXPECT_GT(interior, 100 * rounds);
    EXPECT_GT(boundary, 5 * rounds);
    EXPECT_GT(outside, 100 * rounds);
    EXPECT_GT(certified, rounds / 10);
}

}  // namespace
}  // namespace barycert::testing
