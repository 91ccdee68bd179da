// D1: the same bytes from any number of threads, any SIMD target, any slabs.
#include <gtest/gtest.h>

#include <cfenv>

#include "barycert/environment.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/sample/grid/compare.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

SampleOptions on_threads(int threads, Rounding rounding = Rounding::correct) {
    SampleOptions options;
    options.rounding = rounding;
    options.threads = threads;
    return options;
}

/// The choice at start is restored, however a test ends.
struct Restored {
    ~Restored() { use_simd_target(""); }
};

TEST(ResampleOrder, ThreadsAndTargets) {
    const Restored restored;
    ASSERT_FALSE(simd_targets().empty());
    for (const char* stem : {"lattice-eighths", "cube-hole", "cube-hole-o2", "needle-slit", "plate"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = own_mesh(stem);
        for (const std::vector<int>& components : {std::vector<int>{1}, {5, 1}}) {
            mesh.point_fields = random_fields(mesh.point_count(), components, components.size() > 1, random);
            mesh.cell_fields =
                random_fields(mesh.cell_count(), std::vector<int>(components.size() - 1, 1), false, random);
            for (const bool certified : {true, false}) {
                const auto locator = certified ? Locator::build(mesh) : Locator::build(mesh, {.prove = Prove::never});
                const auto sampler = Sampler::build(*locator, all_fields(mesh));
                for (const NamedGrid& g : awkward_grids(mesh, 700, random)) {
                    use_simd_target("");
                    const SampleCounts counts = expect_law(*sampler, g.grid, on_threads(1), stem + (", " + g.name));
                    const Resampled first = resampled(*sampler, g.grid, on_threads(1));
                    for (const std::string& target : simd_targets()) {
                        ASSERT_TRUE(use_simd_target(target));
                        const Resampled other = resampled(*sampler, g.grid, on_threads(target == "AVX2" ? 2 : 8));
                        const std::string what = stem + (", " + g.name + ", " + target);
                        expect_same_rows(first.samples, other.samples, g.grid, what);
                        expect_same_counts(counts, other.counts, what);
                        EXPECT_TRUE(first.counts.values == other.counts.values) << what;
                    }
                }
            }
        }
    }
}

/// The law on a grid that takes several slabs, of at most 2^26 / (16 + 8 columns) points each, or one layer.
void expect_slabs(const Mesh& mesh, const Grid& grid, std::size_t slabs) {
    const auto locator = Locator::build(mesh);
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    Table expected;
    const SampleCounts& counts = expected.counts;
    ASSERT_TRUE(sampler->sample(points_of(grid), {}, expected));
    for (const int threads : {1, 2}) {
        const Resampled found = resampled(*sampler, grid, on_threads(threads));
        EXPECT_EQ(found.blocks, slabs);
        expect_same_rows(expected, found.samples, grid, "slabs");
        expect_same_counts(counts, found.counts, "slabs");
    }
}

Mesh wide_mesh(int d, const std::vector<int>& of_nodes, const std::vector<int>& of_cells, bool certified) {
    base::Random random(static_cast<std::uint64_t>(d));
    Mesh mesh = mapped(box(d, {3, 3, 3}), {1, 1.5, 1.5}, {0, 0, 0});
    if (!certified) mesh = joined(mesh, mapped(mesh, {1, 1, 1}, {0.25, 0.25, 0.25}));
    mesh = renumbered(mesh, random);
    mesh.point_fields = random_fields(mesh.point_count(), of_nodes, false, random);
    mesh.cell_fields = random_fields(mesh.cell_count(), of_cells, false, random);
    return mesh;
}

// 1005 columns: 8330 points a slab. Slabs of some layers with fewer in the last one, and of one larger layer.
TEST(ResampleOrder, SlabsOfManyColumns) {
    for (const int d : {2, 3}) {
        const Mesh mesh = wide_mesh(d, {5}, {1000}, d == 3);
        expect_slabs(mesh, over(d, {d == 3 ? 30 : 600, 20, d == 3 ? 20 : 1}, {-0.1, 0, 0}, {3, 4.5, 4.5}), 2);
        expect_slabs(mesh, over(d, {d == 3 ? 61 : 8500, d == 3 ? 140 : 2, d == 3 ? 2 : 1}, {0, 0, 0}, {3, 4.5, 4.5}),
                     2);
    }
}

// One column, the usual case: 2796202 points a slab.
TEST(ResampleOrder, SlabsOfOneColumn) {
    for (const int d : {2, 3}) {
        const Grid grid =
            over(d, {d == 3 ? 801 : 1000001, d == 3 ? 1001 : 3, d == 3 ? 4 : 1}, {0, 0, 0}, {3, 4.5, 4.5});
        expect_slabs(wide_mesh(d, {1}, {}, d == 3), grid, 2);
        expect_slabs(wide_mesh(d, {1}, {}, d == 2), grid, 2);
    }
}

TEST(ResampleOrder, TheSinkStopsIt) {
    base::Random random(3);
    Mesh mesh = box(3, {2, 2, 2});
    mesh.cell_fields = random_fields(mesh.cell_count(), {2000}, false, random);
    mesh.point_fields = random_fields(mesh.point_count(), {1}, false, random);
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    const Grid grid = over(3, {70, 60, 9}, {0, 0, 0}, {2, 2, 2});
    for (const int threads : {1, 2, 8}) {
        for (const int stop : {1, 4, 9}) {
            int calls = 0;
            const auto sink = [&](const TableView&) -> Status {
                if (++calls == stop) return Error{.code = "file.unwritable", .what = "the disk is full"};
                return Done{};
            };
            const auto status = resample(*sampler, grid, on_threads(threads), sink);
            ASSERT_FALSE(status);
            EXPECT_EQ(status.error().message(), "the disk is full");
            EXPECT_EQ(calls, stop);
        }
    }
}

// In another rounding mode of the caller's: the same rows, of the same points.
TEST(ResampleOrder, RoundingModes) {
    for (const char* stem : {"lattice-eighths", "needle-slit", "plate"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = own_mesh(stem);
        set_simple_fields(mesh, random);
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        for (const NamedGrid& g : awkward_grids(mesh, 500, random)) {
            const Resampled nearest = resampled(*sampler, g.grid, on_threads(1));
            const std::vector<double> points = points_of(g.grid);
            for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
                std::size_t wrong = 0;
                const auto sink = [&](const TableView& block) -> Status {
                    for (std::size_t i = 0; i < block.cells.size(); ++i) {
                        const std::size_t at = block.first_row + i;
                        wrong += block.cells[i] != nearest.samples.cells[at] ||
                                         block.features[i] != nearest.samples.features[at]
                                     ? 1
                                     : 0;
                    }
                    return Done{};
                };
                ASSERT_EQ(std::fesetround(mode), 0);
                const bool same = points_of(g.grid) == points;
                const bool done = resample(*sampler, g.grid, on_threads(1), sink).has_value();
                const int mode_after = std::fegetround();
                std::fesetround(FE_TONEAREST);
                EXPECT_TRUE(same);
                EXPECT_TRUE(done);
                EXPECT_EQ(mode_after, mode);
                EXPECT_EQ(wrong, 0U) << stem << ", " << g.name << ", mode " << mode;
            }
        }
    }
}

}  // namespace
}  // namespace barycert::testing
