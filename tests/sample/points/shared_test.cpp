// V2: where cells meet, each of them gives the same bits.
#include <gtest/gtest.h>

#include "barycert/io.hpp"
#include "check/meshes.hpp"
#include "locate/points.hpp"
#include "sample/points/rows.hpp"

namespace barycert::testing {
namespace {

struct AllRows {
    std::vector<double> points;
    std::vector<std::size_t> point_of;  ///< by row
    AllLocations locations;
};

/// A row for each point and each cell that holds it.
AllRows all_rows(const Locator& locator, const std::vector<double>& points) {
    AllRows rows;
    rows.locations = *locator.locate_all(points);
    const auto d = static_cast<std::size_t>(locator.mesh().dimension);
    for (std::size_t i = 0; i + 1 < rows.locations.begin.size(); ++i) {
        for (std::size_t j = rows.locations.begin[i]; j < rows.locations.begin[i + 1]; ++j) {
            rows.point_of.push_back(i);
            for (std::size_t k = 0; k < d; ++k) rows.points.push_back(points[d * i + k]);
        }
    }
    return rows;
}

TEST(SampleShared, V2_SameBitsFromEverySide) {
    for (const char* stem : {"lattice-eighths", "lattice-box", "cube-hole-o2", "plate", "torus"}) {
        Random random(hash64(stem));
        Mesh mesh = read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/") + stem).value();
        flip_some(mesh, random);
        if (!mesh.mid_nodes.empty()) mesh = read_tetgen(BARYCERT_DATA_DIR "/meshes/cube-hole-o2").value();
        mesh.point_fields = random_fields(mesh.point_count(), {1, 4}, true, random);
        mesh.cell_fields.clear();
        const std::vector<double> points = awkward_points(mesh, 120, random);
        const auto locator = Locator::build(mesh);
        const AllRows rows = all_rows(*locator, points);
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        Samples samples;
        SampleCounts counts;
        ASSERT_TRUE(sampler->evaluate(rows.points, rows.locations.cells, rows.locations.features, {}, samples, counts));
        EXPECT_EQ(samples.cells, rows.locations.cells);
        EXPECT_EQ(samples.features, rows.locations.features);
        expect_true_values(mesh, rows.points, samples, stem);
        std::size_t shared = 0;
        for (std::size_t j = 1; j < rows.point_of.size(); ++j) {
            if (rows.point_of[j] != rows.point_of[j - 1]) continue;
            ++shared;
            for (std::size_t c = 0; c < 5; ++c)
                ASSERT_TRUE(same(samples.values[5 * j + c], samples.values[5 * (j - 1) + c])) << stem << ", row " << j;
        }
        EXPECT_GT(shared, 100U) << stem;
        EXPECT_EQ(counts.locations.points(), rows.point_of.size());
        EXPECT_EQ(counts.values.cases(), rows.point_of.size());
    }
}

// At a node the value is the node's.
TEST(SampleShared, V1_AtNodes) {
    for (const char* stem : {"cube-hole", "cube-hole-o2", "plate"}) {
        Random random(hash64(stem));
        Mesh mesh = read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/") + stem).value();
        const auto locator = Locator::build(mesh, quick(mesh).certificate);
        const auto sampler = Sampler::build(*locator, {{&mesh.point_fields[1], false}});
        Samples samples;
        SampleCounts counts;
        ASSERT_TRUE(sampler->sample(mesh.points, {}, samples, counts));
        std::size_t vertices = 0;
        for (std::size_t i = 0; i < mesh.point_count(); ++i) {
            if (samples.features[i] != Feature::vertex) continue;
            ++vertices;
            ASSERT_EQ(samples.values[i], mesh.point_fields[1].data[i]) << stem;
        }
        EXPECT_EQ(counts.locations.vertex, vertices);
        EXPECT_GT(vertices, 200U) << stem;
    }
}

}  // namespace
}  // namespace barycert::testing
