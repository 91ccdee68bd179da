#include "tests/sample/grid/compare.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/text.hpp"
#include "tests/check/meshes.hpp"
#include "tests/locate/points.hpp"
#include "tests/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

std::vector<double> points_of(const Grid& grid) {
    std::vector<double> points;
    for (std::int64_t k = 0; k < grid.counts[2]; ++k) {
        for (std::int64_t j = 0; j < grid.counts[1]; ++j) {
            for (std::int64_t i = 0; i < grid.counts[0]; ++i) {
                points.push_back(grid.coordinate(0, i));
                points.push_back(grid.coordinate(1, j));
                if (grid.dimension == 3) points.push_back(grid.coordinate(2, k));
            }
        }
    }
    return points;
}

Resampled resampled(const Sampler& sampler, const Grid& grid, const SampleOptions& options) {
    Resampled out;
    Table& all = out.samples;
    const std::size_t columns = sampler.columns().size();
    const std::uint64_t layer = grid.dimension == 3 ? grid.layer_size() : static_cast<std::uint64_t>(grid.counts[0]);
    const bool distances = options.outside.kind == Outside::nearest || options.outside.kind == Outside::extrapolate;
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    const auto keep = [&](const TableView& block) -> Status {
        EXPECT_EQ(block.first_row, all.cells.size());
        EXPECT_FALSE(block.cells.empty());
        EXPECT_EQ(block.cells.size() % layer, 0U);
        EXPECT_EQ(block.features.size(), block.cells.size());
        EXPECT_EQ(block.values.size(), columns * block.cells.size());
        EXPECT_EQ(block.distances.size(), distances ? block.cells.size() : 0);
        append(all.cells, block.cells);
        append(all.features, block.features);
        append(all.values, block.values);
        append(all.distances, block.distances);
        ++out.blocks;
        return Done{};
    };
    const auto counts = resample(sampler, grid, options, keep);
    EXPECT_TRUE(counts) << counts.error().message();
    if (counts) out.counts = *counts;
    return out;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) same = same_bits(a[i], b[i]);
    return same;
}

void expect_same_rows(const Table& expected, const Table& found, const Grid& grid, const std::string& what) {
    const std::size_t rows = expected.cells.size();
    ASSERT_EQ(found.cells.size(), rows) << what;
    ASSERT_EQ(found.features.size(), rows) << what;
    ASSERT_EQ(found.values.size(), expected.values.size()) << what;
    ASSERT_EQ(found.distances.size(), expected.distances.size()) << what;
    if (rows == 0) return;
    const std::size_t columns = expected.values.size() / rows;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < rows; ++i) {
        bool same = found.cells[i] == expected.cells[i] && found.features[i] == expected.features[i];
        for (std::size_t c = columns * i; c < columns * (i + 1); ++c)
            same = same && same_bits(found.values[c], expected.values[c]);
        if (!expected.distances.empty()) same = same && same_bits(found.distances[i], expected.distances[i]);
        if (same || ++wrong > 3) continue;
        const auto n = static_cast<std::int64_t>(i), nx = grid.counts[0], ny = grid.counts[1];
        const double at[] = {grid.coordinate(0, n % nx), grid.coordinate(1, n / nx % ny),
                             grid.dimension == 3 ? grid.coordinate(2, n / nx / ny) : 0};
        std::string text;
        const auto tell = [&](const Table& s) {
            text += " cell " + std::to_string(s.cells[i]) + " " + std::string(name(s.features[i]));
            for (std::size_t c = columns * i; c < columns * (i + 1); ++c) text += " " + base::hexadecimal(s.values[c]);
            if (!s.distances.empty()) text += " distance " + base::hexadecimal(s.distances[i]);
        };
        tell(expected);
        text += "\nfound";
        tell(found);
        ADD_FAILURE() << what << ", point " << i << " " << text_of(at, grid.dimension) << "\nexpected" << text;
    }
    EXPECT_EQ(wrong, 0U) << what << ": of " << rows << " rows";
}

void expect_same_counts(const SampleCounts& expected, const SampleCounts& found, const std::string& what) {
    EXPECT_EQ(found.locations.interior, expected.locations.interior) << what;
    EXPECT_EQ(found.locations.face, expected.locations.face) << what;
    EXPECT_EQ(found.locations.edge, expected.locations.edge) << what;
    EXPECT_EQ(found.locations.vertex, expected.locations.vertex) << what;
    EXPECT_EQ(found.locations.outside, expected.locations.outside) << what;
    EXPECT_EQ(found.values.cases(), expected.values.cases()) << what;
    EXPECT_EQ(found.values.filter, expected.values.filter) << what;
    EXPECT_EQ(found.values.degenerate, expected.values.degenerate) << what;
    EXPECT_EQ(found.values.not_finite, expected.values.not_finite) << what;
    EXPECT_EQ(found.snapped, expected.snapped) << what;
    EXPECT_EQ(found.extrapolated, expected.extrapolated) << what;
    EXPECT_EQ(found.without_value, expected.without_value) << what;
    EXPECT_TRUE(same_bits(found.farthest, expected.farthest)) << what;
}

SampleCounts expect_law(const Sampler& sampler, const Grid& grid, const SampleOptions& options,
                        const std::string& what) {
    Table expected;
    const SampleCounts& counts = expected.counts;
    const Status status = sampler.sample(points_of(grid), options, expected);
    EXPECT_TRUE(status) << what << status.error().message();
    if (!status) return counts;
    const Resampled found = resampled(sampler, grid, options);
    expect_same_rows(expected, found.samples, grid, what);
    expect_same_counts(counts, found.counts, what);
    return counts;
}

SampleCounts expect_law(const Mesh& mesh, const Grid& grid, const std::string& what, const SampleOptions& options) {
    SampleCounts counts;
    for (const Prove prove : {Prove::at_once, Prove::never}) {
        const auto locator = Locator::build(mesh, {.prove = prove});
        EXPECT_TRUE(locator) << what;
        if (!locator) return counts;
        EXPECT_EQ(locator->method(), prove == Prove::never ? Method::candidates : Method::walk) << what;
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        EXPECT_TRUE(sampler) << what;
        if (!sampler) return counts;
        counts = expect_law(*sampler, grid, options, what + ", " + std::string(name(locator->method())));
    }
    return counts;
}

void expect_truth(const Mesh& mesh, const Grid& grid, const std::string& what) {
    for (const Prove prove : {Prove::at_once, Prove::never}) {
        const auto locator = Locator::build(mesh, {.prove = prove});
        ASSERT_TRUE(locator) << what;
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        ASSERT_TRUE(sampler) << what;
        const Resampled found = resampled(*sampler, grid);
        const std::vector<double> points = points_of(grid);
        expect_true_owners(mesh, points, found.samples, what);
        expect_true_values(mesh, points, found.samples, what);
    }
}

Grid over(int dimension, const std::array<std::int64_t, 3>& counts, const std::array<double, 3>& low,
          const std::array<double, 3>& high) {
    const auto grid = grid_over(dimension, counts, low, high);
    EXPECT_TRUE(grid) << grid.error().message();
    return grid ? *grid : Grid{.dimension = dimension};
}

void set_simple_fields(Mesh& mesh, base::Random& random) {
    mesh.point_fields = random_fields(mesh.point_count(), {1}, false, random);
    mesh.cell_fields = random_fields(mesh.cell_count(), {1}, false, random);
}

}  // namespace barycert::testing
