// Purpose of maps: points are located once, the map is saved and read again, and rows have the same bits (law D1 of
// sampler.hpp).
#include <cstring>

#include "barycert/locator.hpp"
#include "barycert/sampler.hpp"
#include "tests/io/map/maps.hpp"

namespace barycert::testing {
namespace {

/// Points in and around the mesh, every third one on a node, an edge or a face.
std::vector<double> points_for(const Mesh& mesh, std::size_t count) {
    base::Random random(14);
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    std::vector<double> points;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t cell = random.below(mesh.cell_count());
        const std::size_t a = random.below(mesh.corners()), b = random.below(mesh.corners());
        for (std::size_t axis = 0; axis < dimension; ++axis) {
            const auto at = [&](std::size_t corner) {
                return mesh
                    .points[dimension * static_cast<std::size_t>(mesh.cells[cell * mesh.corners() + corner]) + axis];
            };
            const double noise = random.uniform(-0.05, 0.05);
            points.push_back(0.5 * at(a) + 0.5 * at(b) + (i % 3 == 0 ? 0 : noise));
        }
    }
    return points;
}

Table with_points(Table rows, const std::vector<double>& points) {
    rows.points = points;
    return rows;
}

TEST(MapUse, RowsFromASavedMapHaveTheSameBits) {
    for (const char* name : {"cube-hole", "plate"}) {
        SCOPED_TRACE(name);
        const TemporaryFolder folder;
        Mesh mesh = read_tetgen(std::string(BARYCERT_DATA_DIR) + "/meshes/" + name).value();
        mesh.point_fields = {{"f", 1, {}}};
        base::Random random(15);
        for (std::size_t i = 0; i < mesh.point_count(); ++i) {
            mesh.point_fields[0].data.push_back(random.uniform(-1, 1));
        }
        const Locator locator = Locator::build(mesh, {.prove = Prove::never}).value();
        const Sampler sampler = Sampler::build(locator, {{&mesh.point_fields[0], false}}).value();
        const std::vector<double> points = points_for(mesh, 20000);
        Table direct;
        const SampleCounts& counts = direct.counts;
        ASSERT_TRUE(sampler.sample(points, {}, direct));
        EXPECT_GT(counts.locations.outside, 100U);
        EXPECT_GT(counts.locations.vertex, 100U);
        ASSERT_TRUE(write_map(folder / "map", mesh, false, with_points(direct, points)));

        Result<MapReader> reader = MapReader::open(folder / "map", mesh);
        ASSERT_TRUE(reader) << reader.error().message();
        Table block;
        std::vector<double> values;
        while (reader->read(3000, block).value() != 0) {
            ASSERT_TRUE(sampler.evaluate(block.points, {}, block));
            values.insert(values.end(), block.values.begin(), block.values.end());
        }
        ASSERT_EQ(values.size(), direct.values.size());
        EXPECT_EQ(std::memcmp(values.data(), direct.values.data(), 8 * values.size()), 0);  // NaN too
    }
}

TEST(MapUse, EveryCellThatHoldsAPoint) {
    const TemporaryFolder folder;
    const Mesh mesh = read_tetgen(std::string(BARYCERT_DATA_DIR) + "/meshes/cube-hole").value();
    const Locator locator = Locator::build(mesh, {.prove = Prove::never}).value();
    const std::vector<double> points = points_for(mesh, 3000);
    const Table rows = locator.locate_all(points).value();
    ASSERT_GT(rows.cells.size(), 3000U);  // points that several cells hold
    ASSERT_TRUE(write_map(folder / "map", mesh, true, rows));
    EXPECT_TRUE(MapReader::open(folder / "map", mesh).value().all());
    EXPECT_TRUE(same(read_map(folder / "map", mesh).value(), rows));
}

}  // namespace
}  // namespace barycert::testing
