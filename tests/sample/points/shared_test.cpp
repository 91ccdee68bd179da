// V2: where cells meet, each of them gives the same bits.
#include <gtest/gtest.h>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/check/meshes.hpp"
#include "tests/locate/points.hpp"
#include "tests/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

/// The point of each row.
std::vector<std::size_t> point_of_rows(const Table& rows) {
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i + 1 < rows.point_begin.size(); ++i)
        points.insert(points.end(), rows.point_begin[i + 1] - rows.point_begin[i], i);
    return points;
}

TEST(SampleShared, V2SameBitsFromEverySide) {
    for (const char* stem : {"lattice-eighths", "lattice-box", "cube-hole-o2", "plate", "torus"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/") + stem).value();
        flip_some(mesh, random);
        if (!mesh.mid_nodes.empty()) mesh = read_tetgen(BARYCERT_DATA_DIR "/meshes/cube-hole-o2").value();
        mesh.point_fields = random_fields(mesh.point_count(), {1, 4}, true, random);
        mesh.cell_fields.clear();
        const std::vector<double> points = awkward_points(mesh, 120, random);
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        const Table located = *locator->locate_all(points);
        const std::vector<std::size_t> point_of = point_of_rows(located);
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        Table samples = located;
        const SampleCounts& counts = samples.counts;
        ASSERT_TRUE(sampler->evaluate(samples.points, {}, samples));
        EXPECT_EQ(samples.cells, located.cells);
        EXPECT_EQ(samples.features, located.features);
        EXPECT_EQ(samples.points, located.points);
        expect_true_values(mesh, samples.points, samples, stem);
        std::size_t shared = 0;
        for (std::size_t j = 1; j < point_of.size(); ++j) {
            if (point_of[j] != point_of[j - 1]) continue;
            ++shared;
            for (std::size_t c = 0; c < 5; ++c)
                ASSERT_TRUE(same(samples.values[5 * j + c], samples.values[5 * (j - 1) + c])) << stem << ", row " << j;
        }
        EXPECT_GT(shared, 100U) << stem;
        EXPECT_EQ(counts.locations.points(), point_of.size());
        EXPECT_EQ(counts.values.cases(), counts.locations.inside());
    }
}

// At a node the value is the node's.
TEST(SampleShared, V1AtNodes) {
    for (const char* stem : {"cube-hole", "cube-hole-o2", "plate"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/") + stem).value();
        const auto locator = Locator::build(mesh);
        const auto sampler = Sampler::build(*locator, {{&mesh.point_fields[1], false}});
        Table samples;
        const SampleCounts& counts = samples.counts;
        ASSERT_TRUE(sampler->sample(mesh.points, {}, samples));
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
