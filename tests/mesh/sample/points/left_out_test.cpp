// E1, D1: points that are known to be outside before any cell is asked get the same rows as all others outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "mesh/locate/locator_data.hpp"
#include "tests/limits.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

std::vector<std::uint64_t> bits_of(const std::vector<double>& values) {
    std::vector<std::uint64_t> bits;
    for (const double x : values) bits.push_back(std::isnan(x) ? 1 : std::bit_cast<std::uint64_t>(x));
    return bits;
}

/// Points of the box of the mesh, and some beyond.
std::vector<double> points_in_box(const Mesh& mesh, std::size_t count, base::Random& random) {
    std::vector<double> points;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::vector<double> low(mesh.points.begin(), mesh.points.begin() + mesh.dimension), high = low;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        low[i % d] = std::min(low[i % d], mesh.points[i]);
        high[i % d] = std::max(high[i % d], mesh.points[i]);
    }
    for (std::size_t i = 0; i < d * count; ++i)
        points.push_back(low[i % d] + (high[i % d] - low[i % d]) * random.uniform(-0.01, 1.01));
    return points;
}

TEST(SampleLeftOut, E1D1SameRowsAsByFewPoints) {
    for (const char* stem : {"bracket", "plate"}) {
        base::Random random(31);
        Mesh mesh = own_mesh(stem);
        mesh.point_fields = random_fields(mesh.point_count(), {1, 2}, false, random);
        mesh.cell_fields = random_fields(mesh.cell_count(), {1}, false, random);
        const auto d = static_cast<std::size_t>(mesh.dimension);
        const std::vector<double> points = points_in_box(mesh, 24000, random);
        for (const Prove prove : {Prove::at_once, Prove::never}) {
            // Few points at once, so that nothing is prepared; then many.
            const Sampler few = Sampler::build(mesh, {}, {.prove = prove}).value();
            const Sampler many = Sampler::build(mesh, {}, {.prove = prove}).value();
            for (const Outside kind : {Outside::nan, Outside::fill, Outside::nearest, Outside::extrapolate}) {
                SampleOptions options;
                options.outside = {.kind = kind, .fill = 42.5, .limit = kind == Outside::nearest ? 0.2 : infinity};
                options.threads = 2;
                // The nearest point takes long: of fewer points, when all is prepared.
                const bool dear = kind == Outside::nearest || kind == Outside::extrapolate;
                const std::vector<double> asked(
                    points.begin(), dear ? points.begin() + static_cast<std::ptrdiff_t>(300 * d) : points.end());
                const std::size_t count = asked.size() / d, part = 20;
                const Table rows = many.sample(asked, options).value();
                SampleCounts counts;
                for (std::size_t i = 0; i < count; i += part) {
                    const Table some = few.sample(std::span(asked).subspan(d * i, d * part), options).value();
                    counts.add(some.counts);
                    for (std::size_t r = 0; r < part; ++r) {
                        ASSERT_EQ(rows.cells[i + r], some.cells[r]) << stem << i + r;
                        ASSERT_EQ(rows.features[i + r], some.features[r]) << stem << i + r;
                    }
                    const std::size_t columns = rows.columns.size();
                    const std::vector<double> theirs(
                        rows.values.begin() + static_cast<std::ptrdiff_t>(columns * i),
                        rows.values.begin() + static_cast<std::ptrdiff_t>(columns * (i + part)));
                    ASSERT_EQ(bits_of(theirs), bits_of(some.values)) << stem << i;
                    if (!dear) continue;
                    const std::vector<double> distances(rows.distances.begin() + static_cast<std::ptrdiff_t>(i),
                                                        rows.distances.begin() + static_cast<std::ptrdiff_t>(i + part));
                    ASSERT_EQ(bits_of(distances), bits_of(some.distances)) << stem << i;
                }
                EXPECT_EQ(rows.counts.locations.interior, counts.locations.interior) << stem;
                EXPECT_EQ(rows.counts.locations.outside, counts.locations.outside) << stem;
                EXPECT_EQ(rows.counts.locations.points(), count) << stem;
                EXPECT_GT(rows.counts.locations.outside, count / 20) << stem;
                EXPECT_EQ(rows.counts.snapped, counts.snapped) << stem;
                EXPECT_EQ(rows.counts.extrapolated, counts.extrapolated) << stem;
                EXPECT_EQ(rows.counts.without_value, counts.without_value) << stem;
                EXPECT_EQ(rows.counts.farthest, counts.farthest) << stem;
            }
            EXPECT_EQ(locate::LocatorData::of(few.locator()).parts.occupancy(), nullptr) << stem;
            EXPECT_NE(locate::LocatorData::of(many.locator()).parts.occupancy(), nullptr) << stem;
            // The first one outside, in the order of the caller.
            SampleOptions options;
            options.outside.kind = Outside::error;
            const Table rows = many.sample(points).value();
            const auto first = std::find(rows.cells.begin(), rows.cells.end(), -1) - rows.cells.begin();
            const auto refused = many.sample(points, options);
            ASSERT_FALSE(refused);
            EXPECT_NE(refused.error().message().find("point " + std::to_string(first) + " is outside"),
                      std::string::npos)
                << refused.error().message();
        }
    }
}

// A coordinate that is not finite is named, wherever it stands.
TEST(SampleLeftOut, CoordinatesThatAreNotFinite) {
    base::Random random(32);
    Mesh mesh = own_mesh("bracket");
    mesh.point_fields = random_fields(mesh.point_count(), {1}, false, random);
    const Sampler sampler = Sampler::build(mesh).value();
    std::vector<double> points = points_in_box(mesh, 20001, random);
    for (const double bad : {infinity, -infinity, std::nan("")}) {
        for (const std::size_t at : {std::size_t{0}, std::size_t{31415}, points.size() - 1}) {
            std::vector<double> some = points;
            some[at] = bad;
            for (const int threads : {1, 3}) {
                SampleOptions options;
                options.threads = threads;
                const auto rows = sampler.sample(some, options);
                ASSERT_FALSE(rows) << at;
                EXPECT_NE(rows.error().message().find("of point " + std::to_string(at / 3)), std::string::npos)
                    << rows.error().message();
                EXPECT_FALSE(sampler.locator().locate(some, threads)) << at;
            }
        }
    }
    EXPECT_TRUE(sampler.sample(points));
}

}  // namespace
}  // namespace barycert::testing
