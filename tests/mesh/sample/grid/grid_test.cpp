// Grids: what they hold, and what is refused.
#include "barycert/grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/limits.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/sample/grid/compare.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

TEST(Grids, OverABoxEndsOnIt) {
    base::Random random(1);
    for (int i = 0; i < 20000; ++i) {
        const double a = random.scaled(-1, 1, -60, 60), b = random.scaled(-1, 1, -60, 60);
        const double low = std::min(a, b), high = std::max(a, b);
        const auto n = static_cast<std::int64_t>(2 + random.below(2000));
        const Grid grid = over(2, {n, 1, 77}, {low, low, 5}, {high, high, 4});  // the third is not looked at
        EXPECT_EQ(grid.counts, (std::array<std::int64_t, 3>{n, 1, 1}));
        EXPECT_EQ(grid.point_count(), static_cast<std::uint64_t>(n));
        EXPECT_EQ(grid.coordinate(0, 0), low);
        EXPECT_EQ(grid.coordinate(0, n - 1), high);
        EXPECT_NEAR(grid.spacing[0], (high - low) / static_cast<double>(n - 1), 0x1p-50 * grid.spacing[0]);
        const auto k = static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(n - 1)));
        EXPECT_EQ(grid.coordinate(0, k), low + static_cast<double>(k) * grid.spacing[0]);
        EXPECT_LE(grid.coordinate(0, k), grid.coordinate(0, k + 1));
        EXPECT_LE(low, grid.coordinate(1, 0));  // one point: in the middle
        EXPECT_LE(grid.coordinate(1, 0), high);
        EXPECT_EQ(grid.coordinate(1, 0), low + (high - low) / 2);
    }
}

// Readers of a file know origin and spacing alone: where these can lead to the end they do.
TEST(Grids, InVtiEndWhereReadersEnd) {
    base::Random random(2);
    int reached = 0;
    constexpr int tried = 5000;
    for (int i = 0; i < tried; ++i) {
        const double a = random.integer(-99, 99) / 100.0, b = a + random.integer(1, 99) / 100.0;
        const auto n = static_cast<std::int64_t>(2 + random.below(200));
        const Grid grid = over(2, {n, 1, 1}, {a, 0, 0}, {b, 0, 0}), file = as_in_vti(grid);
        EXPECT_EQ(grid.coordinate(0, n - 1), b);
        const double last = file.origin[0] + static_cast<double>(n - 1) * file.spacing[0];
        EXPECT_EQ(file.coordinate(0, n - 1), last);
        EXPECT_LE(last, b);
        EXPECT_NEAR(last, b, 0x1p-51 * std::max(std::abs(a), std::abs(b)));
        reached += last == b ? 1 : 0;
        if (last == b) continue;
        // No double near the quotient leads there.
        double spacing = (b - a) / static_cast<double>(n - 1) * (1 - 0x1p-48);
        for (int k = 0; k < 64; ++k, spacing = std::nextafter(spacing, infinity))
            EXPECT_NE(a + static_cast<double>(n - 1) * spacing, b) << a << " " << b << " " << n;
    }
    EXPECT_GT(reached, tried * 9 / 10);
    EXPECT_EQ(as_in_vti(over(2, {50, 1, 1}, {0, 0, 0}, {1, 0, 0})).coordinate(0, 49), 1);
}

TEST(Grids, SpacedGoAsFarAsTheyCan) {
    const auto spaced = [](double step, double low, double high) {
        return grid_spaced(2, {step, 1, 0}, {low, 0, 0}, {high, 0, 0});
    };
    struct {
        double step, low, high;
        std::int64_t count;
    } const cases[] = {{0.1, 0, 1, 11},
                       {0.1, 0, 0.3, 3},
                       {0.1, 0, 0.7, 7},
                       {0.5, 0, 1.25, 3},
                       {2, 0, 1, 1},
                       {1, 3, 3, 1},
                       {0.25, -1, 1, 9},
                       {1, 0, 3 - 0x1p-51, 3},
                       {0x1p-1074, 0, 0x1p-1072, 5},
                       {1, 1e15, 1e15 + 7, 8},
                       {1e307, 0, 1e308, 11},
                       // Quotients that are rounded to below 58, and to 44.
                       {0.7, 0.1, 0.1 + 58 * 0.7, 59},
                       {0.722, 0.1, 31.868, 44}};
    for (const auto& c : cases) {
        const auto grid = spaced(c.step, c.low, c.high);
        ASSERT_TRUE(grid);
        EXPECT_EQ(grid->spacing[0], c.step);
        EXPECT_EQ(grid->coordinate(0, 0), c.low);
        EXPECT_LE(grid->last[0], c.high);
        EXPECT_EQ(grid->coordinate(0, grid->counts[0] - 1), grid->last[0]);
        // 3 * 0.1 > 0.3 and 7 * 0.1 > 0.7 in double.
        EXPECT_EQ(grid->counts[0], c.count) << c.step << " " << c.low << " " << c.high;
        EXPECT_EQ(grid->counts[1], 1);
        EXPECT_EQ(grid->counts[2], 1);
    }
    base::Random random(2);
    for (int i = 0; i < 20000; ++i) {
        const double step = random.scaled(0.5, 1, -20, 20), low = random.scaled(-1, 1, -20, 20);
        const double high = low + step * random.uniform(0, 3000);
        const auto grid = spaced(step, low, high);
        ASSERT_TRUE(grid);
        EXPECT_LE(grid->last[0], high);
        EXPECT_GT(low + static_cast<double>(grid->counts[0]) * step, high);  // none more fits
        EXPECT_EQ(grid->last[0], low + static_cast<double>(grid->counts[0] - 1) * step);
    }
}

TEST(Grids, Refused) {
    const auto counts_refused = [](std::int64_t x, std::int64_t y, std::int64_t z) {
        const auto grid = grid_over(3, {x, y, z}, {0, 0, 0}, {1, 1, 1});
        return grid ? std::string() : grid.error().message();
    };
    constexpr std::int64_t n_most = Grid::max_on_axis;
    const std::string max = std::to_string(n_most);
    EXPECT_EQ(counts_refused(0, 1, 1), "points of the grid along x: expected 1 to " + max + ", found 0");
    EXPECT_EQ(counts_refused(1, -5, 1), "points of the grid along y: expected 1 to " + max + ", found -5");
    EXPECT_NE(counts_refused(1, 1, n_most + 1), "");
    EXPECT_NE(counts_refused(std::numeric_limits<std::int64_t>::max(), 1, 1), "");
    EXPECT_NE(counts_refused(std::numeric_limits<std::int64_t>::min(), 1, 1), "");
    EXPECT_EQ(counts_refused(n_most, 1, 1), "");
    EXPECT_EQ(counts_refused(n_most, n_most, 1), "");
    EXPECT_NE(counts_refused(n_most, n_most, 2), "");  // above 2^62
    EXPECT_NE(counts_refused(n_most, n_most, n_most), "");

    const auto bounds_refused = [](std::int64_t n, double low, double high) {
        const bool over = !grid_over(2, {1, n, 1}, {0, low, 0}, {0, high, 0});
        const bool spaced = !grid_spaced(2, {1, 1e306, 1}, {0, low, 0}, {0, high, 0});
        return std::pair(over, spaced);
    };
    const std::pair both(true, true), none(false, false), over_alone(true, false);
    for (const std::int64_t n : {1, 2, 100}) {
        for (const double bad : {infinity, -infinity, std::nan("")}) {
            EXPECT_EQ(bounds_refused(n, bad, 1), both);
            EXPECT_EQ(bounds_refused(n, 0, bad), both);
            EXPECT_EQ(bounds_refused(n, bad, bad), both);
        }
        EXPECT_EQ(bounds_refused(n, 1, 0), both);
        EXPECT_EQ(bounds_refused(n, -max_double, max_double), both);  // the difference overflows
        EXPECT_EQ(bounds_refused(n, 2, 2), n == 1 ? none : over_alone);
        EXPECT_EQ(bounds_refused(n, 2, std::nextafter(2, 3)), n <= 2 ? none : over_alone);  // points fall together
        EXPECT_EQ(bounds_refused(n, 0, max_double), none);
    }
    EXPECT_TRUE(!grid_over(2, {3, 1, 1}, {0, 0, 0}, {5e-324, 0, 0}));  // a spacing of zero
    // Points that fall together.
    EXPECT_FALSE(grid_over(2, {5, 1, 1}, {0, 0, 0}, {1.5e-323, 0, 0}));
    EXPECT_TRUE(grid_over(2, {4, 1, 1}, {0, 0, 0}, {1.5e-323, 0, 0}));
    EXPECT_FALSE(grid_over(2, {4, 1, 1}, {1, 0, 0}, {1 + 0x1p-51, 0, 0}));
    EXPECT_TRUE(grid_over(2, {3, 1, 1}, {1, 0, 0}, {1 + 0x1p-51, 0, 0}));
    EXPECT_FALSE(grid_spaced(2, {0x1p-54, 1, 0}, {1, 0, 0}, {2, 0, 0}));
    for (const double step : {0.0, -0.0, -1.0, infinity, -infinity, std::nan("")})
        EXPECT_FALSE(grid_spaced(3, {1, 1, step}, {0, 0, 0}, {1, 1, 1})) << step;
    for (const int d : {-1, 0, 1, 4}) {
        EXPECT_FALSE(grid_over(d, {2, 2, 2}, {0, 0, 0}, {1, 1, 1})) << d;
        EXPECT_FALSE(grid_spaced(d, {1, 1, 1}, {0, 0, 0}, {1, 1, 1})) << d;
    }
    EXPECT_FALSE(grid_spaced(3, {1e-9, 1, 1}, {0, 0, 0}, {3, 1, 1}));
}

TEST(Grids, BoundsOfCells) {
    Mesh mesh = mapped(box(3, {2, 3, 4}), {1, -1, 0.5}, {0, 0, 1});
    add_node(mesh, {100, 100, 100});  // of no cell
    const Bounds3 bounds = bounds_of_cells(mesh);
    EXPECT_EQ(bounds.low, (std::array<double, 3>{0, -3, 1}));
    EXPECT_EQ(bounds.high, (std::array<double, 3>{2, 0, 3}));
    mesh.cells.clear();
    EXPECT_EQ(bounds_of_cells(mesh).low, (std::array<double, 3>{0, 0, 0}));
    EXPECT_EQ(bounds_of_cells(mesh).high, (std::array<double, 3>{0, 0, 0}));
    const Bounds3 flat = bounds_of_cells(box(2, {2, 3, 0}));
    EXPECT_EQ(flat.high, (std::array<double, 3>{2, 3, 0}));
}

// Made by hand: refused with an error, or sampled rightly.
TEST(Grids, MadeByHand) {
    for (const int d : {2, 3}) {
        base::Random random(3);
        Mesh mesh = box(d, {2, 2, 2});
        set_simple_fields(mesh, random);
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        const Grid good = over(d, {5, 4, d == 3 ? 3 : 1}, {0, 0, 0}, {2, 2, 2});
        const auto refused = [&](const std::function<void(Grid&)>& change) {
            Grid grid = good;
            change(grid);
            std::size_t calls = 0;
            const auto sink = [&](const TableView&) -> Status {
                ++calls;
                return Done{};
            };
            const auto counts = resample(*sampler, grid, {}, sink);
            return !counts && calls == 0 && !counts.error().message().empty();
        };
        EXPECT_FALSE(refused([](Grid&) {}));
        for (const int bad : {0, 1, 5 - d, 4, -3}) EXPECT_TRUE(refused([&](Grid& g) { g.dimension = bad; })) << bad;
        for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
            for (const std::int64_t bad : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1} << 40})
                EXPECT_TRUE(refused([&](Grid& g) { g.counts[k] = bad; })) << bad;
            for (const double bad : {infinity, -infinity, std::nan("")}) {
                EXPECT_TRUE(refused([&](Grid& g) { g.origin[k] = bad; })) << bad;
                EXPECT_TRUE(refused([&](Grid& g) { g.last[k] = bad; })) << bad;
                EXPECT_TRUE(refused([&](Grid& g) { g.spacing[k] = bad; })) << bad;
            }
            EXPECT_TRUE(refused([&](Grid& g) { g.spacing[k] = -1; }));
            EXPECT_TRUE(refused([&](Grid& g) { g.spacing[k] = 1e308; }) || good.counts[k] < 3);
            EXPECT_TRUE(refused([&](Grid& g) { g.last[k] = -1; }));
            EXPECT_TRUE(refused([&](Grid& g) { g.last[k] = g.origin[k]; }));
        }
        EXPECT_TRUE(refused([&](Grid& g) { g.counts[0] = g.counts[1] = 2147483646; }) || d == 2);
        // The last point anywhere beyond the others.
        for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
            for (const double by : {0x1p-52, -0x1p-50, 0x1p-9, 0x1p-8, 0x1p-7, 0.01, -0.3, 0.5, 5.0}) {
                Grid grid = good;
                grid.last[k] += by;
                expect_law(mesh, grid, "last one moved by " + std::to_string(by));
                grid.spacing[k] *= 0.9;
                expect_law(mesh, grid, "spacing too small, last one moved by " + std::to_string(by));
            }
            Grid grid = good;
            grid.counts[k] = 1;
            for (const double spacing : {0.0, 5e-324, 1.0, max_double}) {
                grid.spacing[k] = spacing;
                expect_law(mesh, grid, "a spacing of one point");
            }
            EXPECT_TRUE(refused([&](Grid& g) { g.spacing[k] = 0; }));  // all but the last one at one place
        }
    }
}

// The dimension is the mesh's.
TEST(Grids, OfAnotherDimension) {
    for (const int d : {2, 3}) {
        Mesh mesh = box(d, {1, 1, 1});
        base::Random random(4);
        set_simple_fields(mesh, random);
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        const auto status = resample(*sampler, over(5 - d, {2, 2, 2}, {0, 0, 0}, {1, 1, 1}), {},
                                     [](const TableView&) -> Status { return Done{}; });
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().message(), "dimension of the grid: expected " + std::to_string(d) +
                                                ", that of the mesh, found " + std::to_string(5 - d));
    }
}

}  // namespace
}  // namespace barycert::testing
