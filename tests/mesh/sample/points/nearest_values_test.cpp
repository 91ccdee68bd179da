// N3: a value at the nearest point is one of the chosen cell's, however far the point.
#include <gtest/gtest.h>

#include <algorithm>
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
#include "core/base/text.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

constexpr double max = std::numeric_limits<double>::max();

std::vector<double> far_points(int d, double size, base::Random& random) {
    std::vector<double> points;
    for (const double away : {1.5, 1e3, 1e9, 1e14, 1e16, 1e18, 1e50, 1e200, 1e300, max}) {
        for (int i = 0; i < 40; ++i) {
            for (int k = 0; k < d; ++k) {
                const double share = i % 4 == 0 ? static_cast<double>(random.below(3)) - 1 : random.uniform(-1, 1);
                const double x = size * random.unit() + share * away * size;
                points.push_back(std::isfinite(x) ? x : share < 0 ? -max : max);
            }
        }
    }
    return points;
}

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

/// The range of component c on the closed cell: between the nodal values, or between the coefficients of the quadratic
/// in Bernstein's form, which on an edge from a to b with m in its middle are a, b and 2 m - (a + b) / 2.
Range range_in(const Mesh& mesh, const Field& field, std::size_t c, Mesh::Index cell) {
    const auto n = static_cast<std::size_t>(field.components);
    const auto at = [&](Mesh::Index node) { return field.data[n * static_cast<std::size_t>(node) + c]; };
    const Mesh::Index* const corner = &mesh.cells[mesh.corners() * static_cast<std::size_t>(cell)];
    Range range;
    for (std::size_t i = 0; i < mesh.corners(); ++i) range.add(at(corner[i]));
    if (mesh.mid_nodes.empty()) return range;
    static constexpr std::size_t edges[6][2]{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    const std::size_t count = mesh.dimension == 2 ? 3 : 6;
    for (std::size_t e = 0; e < count; ++e) {
        const double m = at(mesh.mid_nodes[count * static_cast<std::size_t>(cell) + e]);
        const double b = 2 * m - (at(corner[edges[e][0]]) + at(corner[edges[e][1]])) / 2;
        range.add(b - 0x1p-50 * std::abs(b) - 0x1p-50);  // for its own rounding; nodal values are about 1
        range.add(b + 0x1p-50 * std::abs(b) + 0x1p-50);
    }
    return range;
}

void expect_in_range(Mesh mesh, double size, const std::string& what) {
    base::Random random(base::hash64(what));
    mesh.point_fields = {{"T", 3, {}}};
    for (std::size_t i = 0; i < 3 * mesh.point_count(); ++i)
        mesh.point_fields[0].data.push_back(random.uniform(-0.5, 1.9));
    const std::vector<double> points = far_points(mesh.dimension, size, random);
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    const auto sampler = Sampler::build(*locator, {{&mesh.point_fields[0], false}});
    ASSERT_TRUE(sampler) << what;
    for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
        Table samples;
        const SampleCounts& counts = samples.counts;
        ASSERT_TRUE(sampler->sample(points, {.rounding = rounding, .outside = {.kind = Outside::nearest}}, samples));
        EXPECT_GT(counts.snapped, 300U) << what;
        const auto d = static_cast<std::size_t>(mesh.dimension);
        for (std::size_t i = 0; i < samples.cells.size(); ++i) {
            if (samples.cells[i] >= 0) continue;
            const Nearest nearest = *locator->nearest(&points[d * i], std::numeric_limits<double>::infinity());
            for (std::size_t c = 0; c < 3; ++c) {
                const Range range = range_in(mesh, mesh.point_fields[0], c, nearest.cell);
                const double found = samples.values[3 * i + c];
                ASSERT_TRUE(range.low <= found && found <= range.high)
                    << what << " at " << text_of(&points[d * i], mesh.dimension) << ": " << found << " is not in ["
                    << range.low << ", " << range.high << "]";
            }
        }
    }
}

TEST(SampleNearest, N3ValuesOfTheCellFromAnywhere) {
    for (const int d : {2, 3}) {
        for (const double size : {1.0, 1e-300, 0x1p-1060, 1e300}) {
            Mesh mesh = mapped(box(d, {3, 3, 2}), {size, size, size}, {});
            expect_in_range(mesh, size, "lattice " + base::hexadecimal(size));
            base::Random random(5);
            for (double& x : mesh.points) x += size * random.uniform(-0.2, 0.2);
            expect_in_range(mesh, size, "askew " + base::hexadecimal(size));
        }
    }
}

TEST(SampleNearest, N3OnOwnMeshes) {
    for (const char* stem : {"cube-hole", "bracket", "needle-slit", "plate", "torus"})
        expect_in_range(read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/") + stem).value(), 1, stem);
}

TEST(SampleNearest, N3OnSecondOrderCells) {
    Mesh mesh = read_tetgen(std::string(BARYCERT_DATA_DIR "/meshes/cube-hole-o2")).value();
    expect_in_range(mesh, 1, "cube-hole-o2");
    for (double& x : mesh.points) x *= 1e-300;
    expect_in_range(mesh, 1e-300, "cube-hole-o2 small");
}

}  // namespace
}  // namespace barycert::testing
