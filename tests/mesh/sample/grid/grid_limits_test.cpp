// Grids at the limits: spacings near none, the most points, structs that grid_over would not make.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>

#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/sample/grid/compare.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

Status nothing(const TableView&) {
    return Done{};
}

// The quotient overflows, or is so large that one less is the same number: a loop without end.
TEST(GridLimits, SpacingFarTooSmallIsRefused) {
    const double cases[][2] = {{1e-320, 1}, {1e-300, 1e300}, {4.469471594187112e-19, 0.9507137288057418}};
    for (const auto& [spacing, high] : cases) {
        EXPECT_EXIT(
            {
                alarm(10);
                // Without what std::exit ends: threads of TBB that earlier tests have started are not in this process.
                std::_Exit(grid_spaced(2, {spacing, 1, 1}, {0, 0, 0}, {high, 1, 1}) ? 1 : 0);
            },
            ::testing::ExitedWithCode(0), "")
            << spacing << " up to " << high;
    }
}

// The spacing, 0.6 of the least double, is rounded to that: the last point but one is beyond the last one.
TEST(GridLimits, PointsAscendAmongSubnormalNumbers) {
    const auto grid = grid_over(2, {6, 1, 1}, {0, 0, 0}, {3 * 5e-324, 1, 1});
    for (std::int64_t i = 1; grid && i < 6; ++i) EXPECT_LE(grid->coordinate(0, i - 1), grid->coordinate(0, i)) << i;
}

// As many points as grid_over accepts do not make a grid that is none to resample.
TEST(GridLimits, TheMostPointsOnAnAxis) {
    const Mesh mesh = box(3, {1, 1, 1});
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, {});
    const auto grid = grid_over(3, {Grid::max_on_axis, 2, 1}, {5, 5, 5}, {6, 6, 6});
    ASSERT_TRUE(grid);
    const auto status = resample(*sampler, *grid, {}, nothing);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().what, "points of one layer of the grid");
}

/// Refused, or the rows of sample.
void expect_refused_or_right(const Mesh& mesh, const Grid& grid) {
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    const auto counts = resample(*sampler, grid, {}, nothing);
    if (!counts) return;
    EXPECT_EQ(counts->locations.points(), grid.point_count());
    expect_law(*sampler, grid, {}, "made by hand");
}

// Several points at one place: raster_of would take their places to be 2^-16 of the mesh apart.
TEST(GridLimits, SpacingOfZero) {
    Mesh mesh = mapped(box(2, {1, 1, 0}), {1, 1, 1}, {-1, 0, 0});
    base::Random random(1);
    set_simple_fields(mesh, random);
    const Grid grid{.dimension = 2, .counts = {5, 1, 1}, .origin = {0, 0.25, 0}, .spacing = {}, .last = {0, 0.25, 0}};
    expect_refused_or_right(mesh, grid);
}

// In 2D there is one layer.
TEST(GridLimits, LayersIn2D) {
    Mesh mesh = box(2, {1, 1, 0});
    base::Random random(1);
    set_simple_fields(mesh, random);
    Grid grid = over(2, {4, 4, 1}, {0, 0, 0}, {1, 1, 1});
    grid.counts[2] = 3;
    expect_refused_or_right(mesh, grid);
}

}  // namespace
}  // namespace barycert::testing
