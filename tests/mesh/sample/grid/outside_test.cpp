// Points outside, by every policy; what ends a call early.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/limits.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/sample/grid/compare.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

Grid beyond(const Mesh& mesh, std::int64_t n) {
    const Bounds3 box = bounds_of_cells(mesh);
    std::array<double, 3> low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = box.low[k] - 0.3 * (box.high[k] - box.low[k]);
        high[k] = box.high[k] + 0.6 * (box.high[k] - box.low[k]);
    }
    return over(mesh.dimension, {n + 2, n, mesh.dimension == 3 ? n + 1 : 1}, low, high);
}

TEST(ResampleOutside, EveryPolicy) {
    for (const char* stem : {"cube-hole", "cube-hole-o2", "plate", "lattice-eighths"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = own_mesh(stem);
        mesh.point_fields = random_fields(mesh.point_count(), {1, 3}, false, random);
        mesh.cell_fields = random_fields(mesh.cell_count(), {2}, false, random);
        const Grid grid = beyond(mesh, mesh.dimension == 3 ? 7 : 15);
        for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
            for (const double number : {0.0, -0.0, 7.5, infinity, std::nan("")}) {
                const SampleOptions options{.rounding = rounding, .outside = {.kind = Outside::fill, .fill = number}};
                const SampleCounts counts = expect_law(mesh, grid, stem + std::string(", fill"), options);
                EXPECT_GT(counts.without_value, 0U);
            }
            for (const double limit : {infinity, 0.4, 0.05, 0.0}) {
                const SampleOptions options{.rounding = rounding,
                                            .outside = {.kind = Outside::nearest, .limit = limit}};
                const SampleCounts counts = expect_law(mesh, grid, stem + std::string(", nearest"), options);
                EXPECT_EQ(counts.snapped > 0, limit > 0.01) << limit;
                EXPECT_EQ(counts.without_value > 0, limit < infinity) << limit;
            }
            const SampleOptions options{.rounding = rounding, .outside = {.kind = Outside::extrapolate}};
            EXPECT_GT(expect_law(mesh, grid, stem + std::string(", extrapolate"), options).extrapolated, 0U);
        }
        // No fields, or those of cells alone.
        for (const Outside kind : {Outside::nan, Outside::nearest, Outside::extrapolate}) {
            mesh.point_fields.clear();
            expect_law(mesh, grid, stem + std::string(", cell fields"), {.outside = {.kind = kind}});
            Mesh bare = mesh;
            bare.cell_fields.clear();
            expect_law(bare, grid, stem + std::string(", no fields"), {.outside = {.kind = kind}});
        }
    }
}

TEST(ResampleOutside, ErrorNamesTheFirstPoint) {
    for (const int d : {2, 3}) {
        base::Random random(1);
        // A hole in the middle, so that the first point outside is not the first point.
        Mesh mesh = box(d, {4, 4, 4});
        std::vector<bool> keep(mesh.cell_count());
        for (std::size_t c = 0; c < keep.size(); ++c) {
            const std::vector<double> at =
                in_cell(mesh, c, std::vector<double>(static_cast<std::size_t>(d) + 1, 1.0 / (d + 1)));
            bool middle = true;
            for (const double x : at) middle = middle && x > 1 && x < 3;
            keep[c] = !middle;
        }
        mesh = only(mesh, keep);
        set_simple_fields(mesh, random);
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        const Grid grid = over(d, {17, 17, d == 3 ? 17 : 1}, {0, 0, 0}, {4, 4, 4});
        const std::size_t first = d == 3 ? (5 * 17 + 5) * 17 + 5 : 5 * 17 + 5;
        for (const int threads : {1, 2, 8}) {
            const SampleOptions options{.outside = {.kind = Outside::error}, .threads = threads};
            std::size_t points = 0;
            const auto sink = [&](const TableView& block) -> Status {
                points += block.cells.size();
                return Done{};
            };
            const auto status = resample(*sampler, grid, options, sink);
            ASSERT_FALSE(status);
            EXPECT_EQ(status.error().message(), "point " + std::to_string(first) +
                                                    " of the grid is outside the mesh; choose what points outside get: "
                                                    "nan, fill, nearest or extrapolate");
            EXPECT_LE(points, first);
            Table rows;
            EXPECT_FALSE(sampler->sample(points_of(grid), options, rows));
        }
        // None outside: no error.
        expect_law(mesh, over(d, {17, 5, d == 3 ? 4 : 1}, {0, 0, 0}, {4, 1, 1}), "all inside",
                   {.outside = {.kind = Outside::error}});
    }
}

TEST(ResampleOutside, CountsAddToWhatIsThere) {
    base::Random random(2);
    Mesh mesh = box(3, {2, 2, 2});
    set_simple_fields(mesh, random);
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    const Grid grid = over(3, {5, 5, 5}, {0, 0, 0}, {2.5, 2, 2});
    const auto sink = [](const TableView&) -> Status { return Done{}; };
    for (std::uint64_t i = 1; i < 4; ++i) {
        const auto counts = resample(*sampler, grid, {}, sink);
        ASSERT_TRUE(counts) << i;
        EXPECT_EQ(counts->locations.points(), 125U) << "call " << i;
        EXPECT_EQ(counts->locations.outside, 25U);
        EXPECT_EQ(counts->without_value, 25U);
        EXPECT_EQ(counts->values.cases(), 100U);
    }
}

}  // namespace
}  // namespace barycert::testing
