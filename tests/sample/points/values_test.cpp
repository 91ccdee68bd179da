// V1: every value is the oracle's.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

void expect_right(const Mesh& mesh, const std::vector<double>& points, const std::string& what) {
    for (const bool certified : {true, false}) {
        const auto locator = certified ? Locator::build(mesh) : Locator::build(mesh, {.prove = Prove::never});
        ASSERT_TRUE(locator) << what;
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        ASSERT_TRUE(sampler) << what << sampler.error().message();
        Table samples;
        const SampleCounts& counts = samples.counts;
        const Status status = sampler->sample(points, {}, samples);
        ASSERT_TRUE(status) << what << status.error().message();
        expect_true_owners(mesh, points, samples, what);
        const std::size_t inside = expect_true_values(mesh, points, samples, what);
        EXPECT_GT(inside, 0U) << what;
        EXPECT_EQ(counts.locations.points(), samples.cells.size()) << what;
        EXPECT_EQ(counts.locations.inside(), inside) << what;
        EXPECT_EQ(counts.values.cases(), mesh.point_fields.empty() ? 0 : inside) << what;
        EXPECT_EQ(counts.without_value, samples.cells.size() - inside) << what;
        EXPECT_TRUE(samples.distances.empty());
        const std::size_t columns = sampler->columns().size();
        for (std::size_t i = 0; i < samples.cells.size(); ++i) {
            for (std::size_t c = 0; samples.cells[i] < 0 && c < columns; ++c)
                ASSERT_TRUE(std::isnan(samples.values[columns * i + c])) << what;
        }
    }
}

TEST(SampleValues, V1OwnMeshesAndTheirFields) {
    for (const char* stem :
         {"bracket", "cube-hole", "cube-hole-o2", "lattice-box", "lattice-eighths", "needle-slit", "plate", "torus"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_mesh(stem);
        ASSERT_FALSE(mesh.point_fields.empty());
        expect_right(mesh, awkward_points(mesh, 60, random), stem);
    }
}

// Records of values hold one and then four: every number of components around that, in one field and in several.
TEST(SampleValues, V1AnyNumberOfComponents) {
    for (const char* stem : {"cube-hole", "cube-hole-o2", "plate"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = own_mesh(stem);
        const std::vector<double> points = awkward_points(mesh, 3, random);
        for (const std::vector<int>& of_nodes :
             {std::vector<int>{1}, {2}, {3}, {4}, {5}, {6}, {8}, {9}, {1, 1}, {3, 1, 5}, {9, 4, 2, 1}, {17}, {}}) {
            for (const std::vector<int>& of_cells : {std::vector<int>{}, {1}, {2, 9}}) {
                if (of_nodes.empty() && of_cells.empty()) continue;
                mesh.point_fields = random_fields(mesh.point_count(), of_nodes, random.coin(), random);
                mesh.cell_fields = random_fields(mesh.cell_count(), of_cells, random.coin(), random);
                expect_right(mesh, points, stem);
            }
        }
    }
}

TEST(SampleValues, V1AwkwardValues) {
    for (const char* stem : {"lattice-eighths", "cube-hole-o2", "plate"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = own_mesh(stem);
        mesh.point_fields = random_fields(mesh.point_count(), {3, 2}, true, random);
        expect_right(mesh, awkward_points(mesh, 60, random), stem);
    }
}

// Component by component: one that is not finite leaves the others alone.
TEST(SampleValues, V1ValuesThatAreNotFinite) {
    for (const char* stem : {"lattice-eighths", "cube-hole-o2", "plate"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = own_mesh(stem);
        mesh.point_fields = random_fields(mesh.point_count(), {3, 2}, false, random);
        mesh.cell_fields = random_fields(mesh.cell_count(), {2}, false, random);
        for (Field* field : {&mesh.point_fields[0], &mesh.point_fields[1], &mesh.cell_fields[0]}) {
            for (double& x : field->data) {
                if (random.below(12) != 0) continue;
                const double inf = std::numeric_limits<double>::infinity();
                x = random.coin() ? std::numeric_limits<double>::quiet_NaN() : random.coin() ? inf : -inf;
            }
        }
        const std::vector<double> points = awkward_points(mesh, 60, random);
        expect_right(mesh, points, stem);
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        const auto sampler = Sampler::build(*locator, all_fields(mesh));
        Table samples;
        const SampleCounts& counts = samples.counts;
        ASSERT_TRUE(sampler->sample(points, {}, samples));
        std::size_t with = 0;  // points of which a component was not finite
        const std::size_t d = static_cast<std::size_t>(mesh.dimension);
        for (std::size_t i = 0; i < samples.cells.size(); ++i) {
            bool finite = true;
            for (std::size_t c = 0; c < 5 && samples.cells[i] >= 0; ++c)
                finite &= !std::isnan(true_value(mesh, mesh.point_fields[c < 3 ? 0 : 1], c < 3 ? c : c - 3,
                                                 samples.cells[i], &points[d * i]));
            with += finite ? 0 : 1;
        }
        EXPECT_GT(with, 0U);
        EXPECT_EQ(counts.values.not_finite, with) << stem;
    }
}

TEST(SampleValues, V1AnyMagnitude) {
    for (const int d : {2, 3}) {
        for (const double factor : {1e-300, 1e300, 5e-324, 0x1p-1040, 1e6}) {
            base::Random random(3);
            Mesh mesh = mapped(box(d, {3, 3, 2}), {factor, factor, factor}, {0, -factor, 0});
            flip_some(mesh, random);
            mesh.point_fields = random_fields(mesh.point_count(), {1, 5}, true, random);
            expect_right(mesh, awkward_points(mesh, 30, random), "factor " + std::to_string(std::ilogb(factor)));
        }
        base::Random random(4);
        Mesh mesh = box(d, {2, 2, 2});
        constexpr double max = std::numeric_limits<double>::max();
        for (double& x : mesh.points) x = x == 0 ? -max : x == 1 ? 0.1 : max;
        mesh.point_fields = random_fields(mesh.point_count(), {2}, true, random);
        expect_right(mesh, awkward_points(mesh, 40, random), "all of the doubles");
    }
}

// Cells that overlap, flat ones, nodes that no cell uses with values that are not to be seen.
TEST(SampleValues, V1Soups) {
    for (const int d : {2, 3}) {
        base::Random random(5);
        Mesh mesh;
        mesh.dimension = d;
        for (int i = 0; i < 40 * d; ++i) mesh.points.push_back(random.integer(0, 4));
        for (int i = 0; i < 100 * (d + 1); ++i) mesh.cells.push_back(static_cast<Mesh::Index>(random.below(30)));
        mesh.point_fields = random_fields(mesh.point_count(), {3, 4}, true, random);
        for (std::size_t i = 30 * 3; i < mesh.point_fields[0].data.size(); ++i)
            mesh.point_fields[0].data[i] = std::numeric_limits<double>::quiet_NaN();
        mesh.cell_fields = random_fields(mesh.cell_count(), {1}, true, random);
        expect_right(mesh, awkward_points(mesh, 60, random), "soup");
    }
}

TEST(SampleValues, ColumnsHaveNames) {
    base::Random random(6);
    Mesh mesh = box(2, {1, 1, 1});
    mesh.point_fields = random_fields(mesh.point_count(), {1, 3}, false, random);
    mesh.cell_fields = random_fields(mesh.cell_count(), {2, 1}, false, random);
    mesh.cell_fields[0].name = "c", mesh.cell_fields[1].name = "e";
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    EXPECT_EQ(sampler->columns(), (std::vector<std::string>{"f0", "f1.0", "f1.1", "f1.2", "c.0", "c.1", "e"}));
}

}  // namespace
}  // namespace barycert::testing
