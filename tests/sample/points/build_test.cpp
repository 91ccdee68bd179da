// The short way: a sampler from a mesh and names of fields.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "barycert/grid.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

Mesh two_triangles() {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 1, 1, 0, 1};
    mesh.cells = {0, 1, 2, 0, 2, 3};
    mesh.point_fields = {{"T", 1, {0, 1, 3, 2}}, {"v", 2, {0, 0, 1, 0, 1, 1, 0, 1}}};
    mesh.cell_fields = {{"region", 1, {7, 8}}};
    return mesh;
}

TEST(SamplerBuild, ProvesAndNamesFields) {
    const Mesh mesh = two_triangles();
    const auto all = Sampler::build(mesh);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->columns(), (std::vector<std::string>{"T", "v.0", "v.1", "region"}));
    EXPECT_EQ(all->locator().method(), Method::walk);
    EXPECT_EQ(Sampler::build(mesh, {}, {.prove = Prove::never})->locator().method(), Method::candidates);
    const auto some = Sampler::build(mesh, {"cell:region", "point:T"});
    ASSERT_TRUE(some);
    EXPECT_EQ(some->columns(), (std::vector<std::string>{"T", "region"})) << "fields of nodes come first";
    const auto none = Sampler::build(mesh, {"pressure"});
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message().find("pressure"), std::string::npos);
    EXPECT_FALSE(Sampler::build(mesh, {"T", "T"}));
    Mesh bad = mesh;
    bad.cells[0] = 9;
    EXPECT_FALSE(Sampler::build(bad));
}

TEST(SamplerBuild, RowsAreThoseOfALocatorOfOnesOwn) {
    Mesh mesh = read_mesh(BARYCERT_DATA_DIR "/meshes/cube-hole").value();
    std::vector<double> points(mesh.points);
    points.insert(points.end(), {5, 5, 5, 0.1, 0.2, 0.3});
    Sampler built = Sampler::build(mesh).value();
    const Sampler sampler = std::move(built);  // with the locator that it owns
    const Table rows = sampler.sample(points).value();
    const Locator locator = Locator::build(mesh, {.prove = Prove::never}).value();
    const Table expected = Sampler::build(locator, all_fields(mesh))->sample(points).value();
    EXPECT_TRUE(same(rows, expected));
    EXPECT_EQ(rows.columns, expected.columns);
    EXPECT_EQ(rows.counts.locations.points(), points.size() / 3);
    EXPECT_EQ(rows.counts.locations.outside, expected.counts.locations.outside);
    const Table located = locator.locate(points).value();
    EXPECT_EQ(located.cells, rows.cells);
    EXPECT_EQ(located.features, rows.features);
}

TEST(SamplerBuild, GridAsATable) {
    const Mesh mesh = two_triangles();
    const Sampler sampler = Sampler::build(mesh, {"T"}).value();
    const Grid grid = grid_over(2, {3, 4, 1}, {-1, 0, 0}, {1, 1, 0}).value();
    const Table rows = resample(sampler, grid).value();
    std::vector<double> points;
    for (std::int64_t j = 0; j < 4; ++j) {
        for (std::int64_t i = 0; i < 3; ++i) {
            points.push_back(grid.coordinate(0, i));
            points.push_back(grid.coordinate(1, j));
        }
    }
    EXPECT_TRUE(same(rows, sampler.sample(points).value()));
    EXPECT_EQ(rows.counts.locations.outside, 4U);
}

}  // namespace
}  // namespace barycert::testing
