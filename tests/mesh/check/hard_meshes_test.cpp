// Cases that once went wrong: rounding twice, counts that depend on the origin, underflow in shapes, time.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "mesh/check/stages.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/signs.hpp"
#include "tests/sanitized.hpp"

namespace barycert::testing {
namespace {

Mesh flat(std::vector<double> points, std::vector<Mesh::Index> cells) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = std::move(points);
    mesh.cells = std::move(cells);
    return mesh;
}

// The scaled volume is subnormal, is rounded there, and scaled back: rounded twice.
TEST(HardMeshes, VolumeOfAnAnisotropicCell) {
    const Mesh mesh = flat({0, 0, 1.1e200, 0, 0, 1.3e-110}, {0, 1, 2});
    const CheckReport r = quick(mesh);
    EXPECT_EQ(r.measures.volume[0], exact_volume(mesh, 0));
    EXPECT_EQ(r.measures.volume[0], r.volume.cells);
}

// Three triangles around a triangular hole: the number of cavities depends on where the origin is.
TEST(HardMeshes, CavitiesOfAPinchedBoundary) {
    const Mesh mesh = flat({0, 0, 4, 0, 0, 4, 2, 0, 2, 2, 0, 2}, {0, 3, 5, 1, 4, 3, 2, 5, 4});
    for (const double x : {0.0, 10.0, -10.0}) {
        for (const double y : {0.0, 10.0}) {
            const CheckReport r = quick(mapped(mesh, {1, 1, 1}, {x, y, 0}));
            EXPECT_EQ(r.boundary.cavities, quick(mesh).boundary.cavities) << x << " " << y;
        }
    }
}

// Parts that touch in a node do not hide what can be counted; along an edge they do.
TEST(HardMeshes, TunnelsAndCavitiesWherePinched) {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 0, -1};
    mesh.cells = {0, 1, 2, 3, 0, 4, 6, 5};
    const CheckReport node = quick(mesh);
    EXPECT_FALSE(node.boundary.manifold);
    EXPECT_EQ(node.boundary.tunnels, 0);
    EXPECT_EQ(node.boundary.cavities, 0U);
    mesh.cells = {0, 1, 2, 3, 0, 1, 5, 6};  // both have the edge 0 1
    const CheckReport edge = quick(mesh);
    EXPECT_TRUE(edge.certified());
    EXPECT_FALSE(edge.boundary.tunnels);
    EXPECT_FALSE(edge.boundary.cavities);
}

// "It is the mesh that was checked, and P1 to P5 of check.hpp hold."
TEST(HardMeshes, CoversAfterNeighboursWereSpoilt) {
    Mesh mesh = box(3, {1, 1, 1});
    const Certificate c = quick(mesh).certificate;
    mesh.neighbours.assign(mesh.cells.size(), 0);
    EXPECT_FALSE(c.covers(mesh));
}

TEST(HardMeshes, ShapeOfNeedles) {
    for (const double t : {1e-90, 1e-120, 1e-160, 1e-200}) {
        Mesh mesh;
        mesh.points = {0, 0, 0, t, 0, 0, 0, t, 0, 0, 0, 1};
        mesh.cells = {0, 1, 2, 3};
        const CellMeasures m = quick(mesh).measures;
        EXPECT_NEAR(m.radius_edge[0] / (0.5 / t), 1, 1e-12) << t;
        EXPECT_NEAR(m.min_angle[0], 45, 1e-12) << t;
        EXPECT_NEAR(m.max_angle[0], 90, 1e-12) << t;
    }
    const CellMeasures m = quick(flat({0, 0, 1.1e200, 0, 0, 1.3e-110}, {0, 1, 2})).measures;
    EXPECT_FALSE(std::isnan(m.radius_edge[0]));
    // Corner cells at the end of the range are as good as any.
    for (const double t : {0x1p-1074, 0x1p1022}) {
        Mesh mesh;
        mesh.points = {0, 0, 0, t, 0, 0, 0, t, 0, 0, 0, t};
        mesh.cells = {0, 1, 2, 3};
        EXPECT_NEAR(quick(mesh).measures.min_angle[0], std::atan(std::sqrt(2)) * 180 / 3.141592653589793, 1e-12) << t;
    }
}

// Time and memory of find_nested_parts grow with pieces times cells.
TEST(HardMeshes, TimeOfCellsOneInAnother) {
    const auto nest = [](int n) {
        Mesh mesh;
        for (int i = 0; i < n; ++i) {
            const double s = 1 + i * 1e-3;
            for (const int x : {0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 0, 0}) mesh.points.push_back(x == 0 ? -s : 4 * s);
            for (int k = 0; k < 4; ++k) mesh.cells.push_back(4 * i + k);
        }
        return mesh;
    };
    const auto start = std::chrono::steady_clock::now();
    const CheckReport report = quick(nest(3000));
    // It took minutes; now some seconds.
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 30 * testing::slowdown);
    ASSERT_NE(report.find(DefectKind::nested_part), nullptr);
    EXPECT_EQ(report.find(DefectKind::nested_part)->count, check::pair_limit);
    EXPECT_TRUE(report.find(DefectKind::nested_part)->at_least);
}

// An odd number of indices: the last one stands alone in the fingerprint.
TEST(HardMeshes, CoversSeesTheLastIndexOfASingleTriangle) {
    Mesh mesh = flat({0, 0, 1, 0, 0, 1, 1, 1}, {0, 1, 2});
    const Certificate c = quick(mesh).certificate;
    EXPECT_TRUE(c.covers(mesh));
    mesh.cells[2] = 3;
    EXPECT_FALSE(c.covers(mesh));
}

}  // namespace
}  // namespace barycert::testing
