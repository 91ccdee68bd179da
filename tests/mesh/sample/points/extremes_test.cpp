// Cells without volume or far smaller than the domain, and what else is extreme: the smallest case of each.

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <vector>

#include "barycert/grid.hpp"
#include "barycert/sampler.hpp"

namespace barycert {
namespace {

Mesh tetrahedron(double size) {
    Mesh mesh;
    mesh.points = {0, 0, 0, size, 0, 0, 0, size, 0, 0, 0, size};
    mesh.cells = {0, 1, 2, 3};
    return mesh;
}

TEST(SampleExtremes, ACellWithoutVolumeHasNoValue) {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    for (const std::vector<Mesh::Index>& cell : {std::vector<Mesh::Index>{0, 1, 2, 3}, {3, 1, 0, 2}}) {
        mesh.cells = cell;
        const Field field{"f", 1, {0, 1, 2, 3}};
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        const auto sampler = Sampler::build(*locator, {{&field}});
        for (const double z : {0.0, 0.1}) {
            Table rows;
            const SampleCounts& counts = rows.counts;
            rows.cells = {0};
            rows.features = {Feature::interior};
            ASSERT_TRUE(sampler->evaluate(std::vector<double>{0.25, 0.5, z}, {}, rows));
            EXPECT_TRUE(std::isnan(rows.values[0])) << z;
            EXPECT_EQ(counts.values.degenerate, 1U) << z;
        }
    }
}

TEST(SampleExtremes, TheNearestPointIsOnTheFaceWhateverTheSize) {
    for (int exponent = -300; exponent <= 300; exponent += 10) {
        const double size = std::ldexp(1, exponent);
        const Mesh mesh = tetrahedron(size);
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        const double point[] = {size / 4, size / 4, -size};
        const auto nearest = locator->nearest(point, std::numeric_limits<double>::infinity());
        EXPECT_EQ(nearest->nodes, (std::array<Mesh::Index, 3>{0, 1, 2})) << exponent;
        EXPECT_EQ(nearest->distance, size) << exponent;
    }
}

TEST(SampleExtremes, CellsFarSmallerThanTheDomainHaveFaces) {
    Mesh mesh = tetrahedron(0x1p-270);
    mesh.points.insert(mesh.points.end(), {1, 1, 1, 2, 1, 1, 1, 2, 1, 1, 1, 2});
    mesh.cells.insert(mesh.cells.end(), {4, 5, 6, 7});
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const double point[] = {0x1p-272, 0x1p-272, -0x1p-270};
    EXPECT_EQ(locator->nearest(point, 1)->distance, 0x1p-270);
}

TEST(SampleExtremes, VerticesAreFoundInEveryRoundingMode) {
    Mesh mesh;
    for (int i = 0; i < 500; ++i) {
        const double x = std::sin(i * 1.7), y = std::cos(i * 2.3), z = std::sin(i * 0.9), h = 0.01 + 0.001 * (i % 7);
        mesh.points.insert(mesh.points.end(), {x, y, z, x + h, y, z, x, y + h, z, x, y, z + h});
        for (Mesh::Index v = 0; v < 4; ++v) mesh.cells.push_back(4 * i + v);
    }
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    std::vector<Mesh::Index> cells(mesh.point_count());
    std::vector<Feature> features(mesh.point_count());
    for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        LocationCounts counts;
        const Status status = locator->locate(mesh.points, cells, features, &counts, 1);
        std::fesetround(FE_TONEAREST);
        ASSERT_TRUE(status);
        EXPECT_EQ(counts.outside, 0U) << mode;
    }
}

TEST(SampleExtremes, GridsThatAreNone) {
    EXPECT_FALSE(grid_spaced(3, {0x1p-100, 1, 1}, {-1, 0, 0}, {0.75 * 0x1p-52, 1, 1}));
    for (const int dimension : {-1, 0, 1, 4}) {
        EXPECT_FALSE(grid_over(dimension, {2, 2, 2}, {0, 0, 0}, {1, 1, 1})) << dimension;
        EXPECT_FALSE(grid_spaced(dimension, {1, 1, 1}, {0, 0, 0}, {1, 1, 1})) << dimension;
    }
    const Mesh mesh = tetrahedron(1);
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, {});
    const auto refused = [&](const Grid& grid) {
        return !resample(*sampler, grid, {}, [](const TableView&) -> Status { return Done{}; });
    };
    Grid grid = *grid_over(3, {40, 5, 5}, {0, 0, 0}, {1, 1, 1});
    EXPECT_FALSE(refused(grid));
    grid.spacing[0] = 0;
    EXPECT_TRUE(refused(grid));
}

}  // namespace
}  // namespace barycert
