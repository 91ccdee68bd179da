// Shape measures: of cells whose shape is known by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

struct Shape {
    double radius_edge, aspect, min, max;  ///< angles in degrees
};

Mesh cell(int d, const std::vector<double>& points) {
    Mesh mesh;
    mesh.dimension = d;
    mesh.points = points;
    for (int i = 0; i <= d; ++i) mesh.cells.push_back(i);
    return mesh;
}

void expect_near(double value, double wanted) {
    EXPECT_NEAR(value, wanted, 1e-13 * std::fabs(wanted));
}

void expect_shape(int d, std::vector<double> points, const Shape& wanted, bool scale = true) {
    // With the last two the volume of a tetrahedron, the area of a triangle, is a subnormal number.
    for (const double factor : {1.0, 1e300, 1e-290, 3e7, 0x1p-354, 0x1p-531}) {
        if (!scale && factor != 1) continue;
        const Mesh mesh = mapped(cell(d, points), {factor, factor, factor}, {0, 0, 0});
        std::vector<Mesh::Index> order = mesh.cells;
        do {  // whichever corner comes first
            Mesh other = mesh;
            other.cells = order;
            const CellMeasures m = quick(other).measures;
            expect_near(m.radius_edge[0], wanted.radius_edge);
            expect_near(m.aspect[0], wanted.aspect);
            expect_near(m.min_angle[0], wanted.min);
            expect_near(m.max_angle[0], wanted.max);
        } while (std::next_permutation(order.begin(), order.end()));
    }
}

TEST(Shape, Regular) {
    const double root3 = std::sqrt(3.0), angle = std::acos(1.0 / 3) * degrees;
    expect_shape(2, {0, 0, 2, 0, 1, root3}, {1 / root3, 1, 60, 60});
    expect_shape(3, {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1}, {std::sqrt(6.0) / 4, 1, angle, angle});
    EXPECT_NEAR(angle, 70.53, 0.005);
}

TEST(Shape, RightCorner) {
    const double root2 = std::sqrt(2.0), root3 = std::sqrt(3.0);
    // Inradius of the triangle: 1 - 1 / sqrt 2; of the tetrahedron: 1 / (3 + sqrt 3).
    expect_shape(2, {0, 0, 1, 0, 0, 1}, {root2 / 2, root2 / (2 * root3 * (1 - root2 / 2)), 45, 90});
    expect_shape(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
                 {root3 / 2, root2 * (3 + root3) / (2 * std::sqrt(6.0)), std::atan(root2) * degrees, 90});
}

// Flat ones: four corners of a square, two of them lifted by h. Two angles near 180 degrees, four near 0.
TEST(Shape, Slivers) {
    for (const double h : {1e-2, 1e-5, 1e-9, 1e-12, 1e-30, 1e-100}) {
        const double s = std::sqrt(1 + h * h);
        const Mesh mesh = cell(3, {1, 0, 0, -1, 0, 0, 0, 1, h, 0, -1, h});
        const CellMeasures m = quick(mesh).measures;
        // Edges of length 2 along x and y, at distance h; the faces at each meet at the angle 2 atan(1 / h).
        EXPECT_NEAR(m.max_angle[0], 2 * std::atan(1 / h) * degrees, 1e-11);
        // Normals of the faces at the edge from (1, 0, 0) to (0, 1, h): (0, h, -1) and (h, 0, 1) up to signs.
        expect_near(m.min_angle[0] / (std::atan2(h * std::sqrt(2 + h * h), 1) * degrees), 1);
        EXPECT_NEAR(m.aspect[0] / (2 / (2 * std::sqrt(6.0) * (h / (2 * s)))), 1, 1e-12);
        // The centre is at (0, 0, h / 2), the shortest edge sqrt(2 + h * h).
        EXPECT_NEAR(m.radius_edge[0] / (std::sqrt(1 + h * h / 4) / std::sqrt(2 + h * h)), 1, 1e-12);
    }
}

TEST(Shape, NeedlesOfTriangles) {
    for (const double h : {1e-2, 1e-5, 1e-9, 1e-15, 1e-40, 1e-100}) {
        const CellMeasures m = quick(cell(2, {0, 0, 2, 0, 1, h})).measures;
        expect_near(m.min_angle[0], std::atan(h) * degrees);
        EXPECT_NEAR(m.max_angle[0], 180 - 2 * std::atan(h) * degrees, 1e-12);
        const double side = std::sqrt(1 + h * h), radius = (1 + h * h) / (2 * h);
        expect_near(m.radius_edge[0], radius / side);
        expect_near(m.aspect[0], 2 / (2 * std::sqrt(3.0) * (h / (1 + side))));
    }
}

TEST(Shape, Degenerate) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const auto& points : {std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0},
                               std::vector<double>{0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3}, std::vector<double>(12, 0.1)}) {
        const CellMeasures m = quick(cell(3, points)).measures;
        EXPECT_EQ(m.orientation[0], 0);
        EXPECT_EQ(m.volume[0], 0);
        EXPECT_EQ(m.radius_edge[0], infinity);
        EXPECT_EQ(m.aspect[0], infinity);
        EXPECT_EQ(m.condition[0], infinity);
    }
    Mesh nowhere = cell(3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, std::nan("")});
    const CellMeasures m = quick(nowhere).measures;
    for (const double x : {m.volume[0], m.condition[0], m.radius_edge[0], m.aspect[0], m.min_angle[0], m.max_angle[0]})
        EXPECT_TRUE(std::isnan(x));
}

TEST(Shape, Distribution) {
    const double nan = std::nan("");
    const Distribution d = distribution({nan, 3, 1, nan, 2, 9});
    EXPECT_EQ(d.min, 1);
    EXPECT_EQ(d.median, 2);
    EXPECT_EQ(d.max, 9);
    EXPECT_EQ(d.min_cell, 2);
    EXPECT_EQ(d.max_cell, 5);
    EXPECT_EQ(distribution({nan}).min_cell, -1);
    EXPECT_EQ(distribution({}).max_cell, -1);
}

}  // namespace
}  // namespace barycert::testing
