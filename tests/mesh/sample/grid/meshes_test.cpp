// The law of grid.hpp on meshes that are proper, at all places and scales.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/sample/grid/compare.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

const std::vector<std::string> own_stems{"bracket",         "cube-hole",   "cube-hole-o2", "flange", "lattice-box",
                                         "lattice-eighths", "needle-slit", "plate",        "torus"};

/// On every grid that is awkward for the mesh.
void expect_law_on_grids(const Mesh& mesh, std::int64_t points, base::Random& random, const std::string& what) {
    const auto walks = Locator::build(mesh), asks = Locator::build(mesh, {.prove = Prove::never});
    ASSERT_TRUE(walks && asks) << what;
    const auto one = Sampler::build(*walks, all_fields(mesh)), other = Sampler::build(*asks, all_fields(mesh));
    ASSERT_TRUE(one && other) << what;
    const auto grids = awkward_grids(mesh, points, random);
    EXPECT_GT(grids.size(), 3U) << what;
    for (const NamedGrid& g : grids) {
        expect_law(*one, g.grid, {}, what + ", " + g.name + ", certified");
        expect_law(*other, g.grid, {}, what + ", " + g.name);
    }
}

// One field of one component, as most meshes have: the loop without branches is for this alone.
TEST(ResampleMeshes, OwnMeshesOneField) {
    for (const std::string& stem : own_stems) {
        base::Random random(base::hash64(stem));
        Mesh mesh = own_mesh(stem);
        mesh.point_fields = random_fields(mesh.point_count(), {1}, false, random);
        expect_law_on_grids(mesh, 5000, random, stem);
    }
}

TEST(ResampleMeshes, OwnMeshesAndTheirFields) {
    for (const std::string& stem : own_stems) {
        base::Random random(base::hash64(stem) + 1);
        const Mesh mesh = own_mesh(stem);
        ASSERT_FALSE(mesh.point_fields.empty());
        expect_law_on_grids(mesh, 1000, random, stem);
    }
}

TEST(ResampleMeshes, BoxesHaveTheGridOnFacesEdgesAndVertices) {
    for (const int d : {2, 3}) {
        base::Random random(7);
        Mesh mesh = renumbered(box(d, {4, 3, 2}), random);
        flip_some(mesh, random);
        set_simple_fields(mesh, random);
        for (const std::int64_t n : {1, 2, 4, 5}) {
            const Grid grid = over(d, {4 * n + 1, 3 * n + 1, d == 3 ? 2 * n + 1 : 1}, {0, 0, 0}, {4, 3, 2});
            const SampleCounts counts = expect_law(mesh, grid, "box");
            EXPECT_EQ(counts.locations.outside, 0U);
            EXPECT_GT(counts.locations.vertex, 0U);
            EXPECT_EQ(counts.locations.edge > 0, n > 1);
            expect_truth(mesh, grid, "box");
        }
    }
}

TEST(ResampleMeshes, TheOracleAgrees) {
    for (const char* stem : {"cube-hole", "cube-hole-o2", "lattice-eighths", "needle-slit", "plate"}) {
        base::Random random(base::hash64(stem) + 2);
        Mesh mesh = own_mesh(stem);
        mesh.point_fields = random_fields(mesh.point_count(), {1}, false, random);
        for (const NamedGrid& g : awkward_grids(mesh, 60, random)) expect_truth(mesh, g.grid, stem + (" " + g.name));
    }
}

TEST(ResampleMeshes, FarFromTheOrigin) {
    for (const char* stem : {"cube-hole", "lattice-eighths", "needle-slit", "plate"}) {
        for (const double by : {1e6, -1e6, 1e12, -3e15}) {
            base::Random random(base::hash64(stem) + 3);
            Mesh mesh = mapped(own_mesh(stem), {1, 1, 1}, {by, -by, by});
            set_simple_fields(mesh, random);
            expect_law_on_grids(mesh, 600, random, stem + std::string(" moved by ") + std::to_string(by));
        }
    }
}

TEST(ResampleMeshes, AnyScale) {
    for (const char* stem : {"cube-hole", "lattice-eighths", "plate"}) {
        for (const double by : {1e150, 1e-150, 1e300, 1e-300, 0x1p-1060, 0x1p-200, 0x1p-60, 0x1p90, 1e-90}) {
            base::Random random(base::hash64(stem) + 4);
            Mesh mesh = mapped(own_mesh(stem), {by, by, by}, {0, 0, 0});
            set_simple_fields(mesh, random);
            expect_law_on_grids(mesh, 120, random, stem + std::string(" times 2^") + std::to_string(std::ilogb(by)));
        }
    }
}

// Each axis another scale, and a grid of which an axis is out of the ranges.
TEST(ResampleMeshes, ScalesThatDiffer) {
    const double scales[] = {1, 0x1p-40, 0x1p-210, 0x1p-310, 0x1p180, 0x1p310};
    for (const int d : {2, 3}) {
        base::Random random(8);
        for (int i = 0; i < 20; ++i) {
            const auto any = [&] { return scales[random.below(6)]; };
            const double x = any(), y = any(), z = any();
            Mesh mesh = mapped(renumbered(box(d, {3, 2, 2}), random), {x, y, z}, {0, -y, 0});
            set_simple_fields(mesh, random);
            expect_law_on_grids(mesh, 200, random, "scales " + std::to_string(i));
        }
    }
}

// A grid that is vast beside the mesh, or that has the mesh between two of its points.
TEST(ResampleMeshes, GridsFarLarger) {
    for (const int d : {2, 3}) {
        base::Random random(9);
        Mesh mesh = renumbered(box(d, {2, 2, 2}), random);
        set_simple_fields(mesh, random);
        for (const double extent : {1e3, 1e9, 1e15, 1e17, 1e200, 8e307}) {
            for (const std::int64_t n : {3, 4, 65}) {
                const Grid grid =
                    over(d, {n, n - 1, d == 3 ? n - 2 : 1}, {-extent, -extent, -extent}, {extent, extent, extent});
                expect_law(mesh, grid, "extent " + std::to_string(extent));
            }
        }
    }
}

TEST(ResampleMeshes, NoCells) {
    for (const int d : {2, 3}) {
        Mesh mesh;
        mesh.dimension = d;
        mesh.points.assign(static_cast<std::size_t>(3 * d), 1.0);
        base::Random random(10);
        set_simple_fields(mesh, random);
        const SampleCounts counts = expect_law(mesh, over(d, {3, 4, d == 3 ? 2 : 1}, {0, 0, 0}, {2, 2, 2}), "no cells");
        EXPECT_EQ(counts.locations.outside, d == 3 ? 24U : 12U);
    }
}

}  // namespace
}  // namespace barycert::testing
