// Which cells are curved, and what is rounding.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "curved_mesh.hpp"
#include "mesh/pulling.hpp"

namespace barycert::testing {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

void expect_curved(const CurvedCells& found, std::uint64_t cells, double deviation) {
    EXPECT_EQ(found.cells, cells);
    EXPECT_NEAR(found.max_deviation, deviation, 1e-12 * deviation);
}

void expect_straight(const CurvedCells& found) {
    EXPECT_EQ(found.cells, 0U);
    EXPECT_EQ(found.max_deviation, 0);
    EXPECT_EQ(found.rounded_cells, 0U);
    EXPECT_EQ(found.max_rounded, 0);
    EXPECT_EQ(message(found), "");
}

/// Each coordinate as a file has it that was written in that format of printf.
Mesh printed(Mesh mesh, const char* format) {
    for (double& x : mesh.points) {
        char text[64];
        std::snprintf(text, sizeof text, format, x);
        x = std::strtod(text, nullptr);
    }
    return mesh;
}

/// A ball that is moved, turned and scaled: no coordinate is a round number, and each is rounded a few times.
Mesh turned(Mesh mesh, double unit = 1) {
    const double scale = unit * std::sqrt(0.1);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t i = 0; i < mesh.points.size(); i += d) {
        double& x = mesh.points[i];
        double& y = mesh.points[i + 1];
        const double old = x;
        x = scale * (0.8 * old - 0.6 * y + 0.3);
        y = scale * (0.6 * old + 0.8 * y + 0.7);
        if (d == 3) mesh.points[i + 2] *= 1.1 * scale;
    }
    return mesh;
}

TEST(Curved, BallWhoseOuterNodesLieOnTheSphere) {
    for (const int d : {2, 3}) {
        std::vector<std::uint8_t> each{7};
        expect_straight(curved_cells(straight_ball(d), &each));
        EXPECT_TRUE(each.empty());
        Mesh mesh = curved_ball(d);
        expect_curved(curved_cells(mesh, &each), 1U << d, deviation_of_ball);
        EXPECT_EQ(each, std::vector<std::uint8_t>(1U << d, d == 2 ? 0b10 : 0b110010));  // edges 12; 12, 13 and 23
        // One node alone: of the cells around its edge.
        mesh = straight_ball(d);
        mesh.points.back() += 0.25;
        const CurvedCells one = curved_cells(mesh, &each);
        EXPECT_EQ(one.cells, d == 2 ? 1U : 2U);
        EXPECT_NEAR(one.max_deviation, 0.25 / std::sqrt(2.0), 1e-15);
        EXPECT_EQ(std::count(each.begin(), each.end(), 0), (1 << d) - (d == 2 ? 1 : 2));
        EXPECT_EQ(each.back(), d == 2 ? 0b10 : 0b100000);
    }
}

TEST(Curved, LinearMeshesHaveNone) {
    Mesh mesh = curved_ball(3);
    mesh.mid_nodes.clear();
    expect_straight(curved_cells(mesh));
    expect_straight(curved_cells(Mesh()));
}

/// The corners alone, with middles computed anew from where they are.
Mesh with_middles(Mesh mesh) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    mesh.points.resize(d * (2 * d + 1));
    mesh.mid_nodes.clear();
    return second_order(std::move(mesh));
}

void expect_rounded(const CurvedCells& found, double most) {
    EXPECT_EQ(found.cells, 0U);
    EXPECT_EQ(found.max_deviation, 0);
    EXPECT_GT(found.rounded_cells, 0U);
    EXPECT_GT(found.max_rounded, 0);
    EXPECT_LT(found.max_rounded, most);
    EXPECT_NE(message(found).find("by rounding; sides were taken as straight"), std::string::npos);
}

TEST(Curved, MiddlesThatWereComputedAreMiddlesAndCounted) {
    for (const int d : {2, 3}) {
        for (const double unit : {1.0, 1e-3, 1e6, 1e300, 1e-300}) {
            const Mesh mesh = with_middles(turned(straight_ball(d), unit));
            expect_rounded(curved_cells(mesh), 2e-16);
            // Not so where each node is to be as it is.
            const CurvedCells exact = curved_cells(mesh, nullptr, true);
            EXPECT_EQ(exact.cells, curved_cells(mesh).rounded_cells);
            EXPECT_EQ(exact.max_deviation, curved_cells(mesh).max_rounded);
            EXPECT_EQ(exact.rounded_cells, 0U);
        }
    }
}

TEST(Curved, MiddlesThatWereRoundedToTheDigitsOfTheirTextAreMiddles) {
    for (const int d : {2, 3}) {
        for (const char* const format : {"%.6g", "%.6f", "%.9g", "%.12e"})
            expect_rounded(curved_cells(printed(with_middles(printed(turned(straight_ball(d)), format)), format)),
                           1e-5);
        Mesh single = turned(straight_ball(d));
        for (double& x : single.points) x = static_cast<float>(x);
        single = with_middles(single);
        for (double& x : single.points) x = static_cast<float>(x);
        expect_rounded(curved_cells(single), 1e-6);
    }
}

// Where corners were rounded after the middles were computed, nodes are up to a unit off: they count as they are.
TEST(Curved, EverythingElseIsACurve) {
    for (const int d : {2, 3}) {
        const Mesh mesh = turned(straight_ball(d));
        const CurvedCells moved = curved_cells(mesh);
        EXPECT_GT(moved.cells, 0U);
        EXPECT_LT(moved.max_deviation, 1e-15);
        // Curves stay curved with few digits, and a small one with all digits is one.
        const CurvedCells curved = curved_cells(printed(turned(curved_ball(d)), "%.6g"));
        EXPECT_EQ(curved.cells, 1U << d);
        EXPECT_NEAR(curved.max_deviation, deviation_of_ball, 1e-5);
        for (const double part : {1e-9, 1e-11, 2e-12}) {
            const CurvedCells slight = curved_cells(curved_ball(d, part));
            EXPECT_EQ(slight.cells, 1U << d);
            EXPECT_NEAR(slight.max_deviation, part * deviation_of_ball, 1e-15);
        }
    }
}

// The left side of the triangle is x = 4e-6 y (1 - y): one unit of six places is no rounding of 0.
TEST(Curved, AUnitOffIsACurve) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 0, 1, 0.5, 0, 0.600001, 0.600001, 0.000001, 0.5};
    mesh.cells = {0, 1, 2};
    mesh.mid_nodes = {3, 4, 5};
    std::vector<std::uint8_t> each;
    expect_curved(curved_cells(mesh, &each), 1, 0.1 * (1 + 1e-5));
    EXPECT_EQ(each, std::vector<std::uint8_t>{0b110});
}

/// As a file of several types has it.
Mesh among_shapes(const Mesh& mesh) {
    Mesh out = mesh;
    out.mid_nodes.clear();
    out.cells.clear();
    const std::size_t mids = mesh::edges_of(mesh.dimension).size();
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto corners = mesh.corners_of(cell);
        out.shapes.types.push_back(mesh.dimension == 2 ? 22 : 24);
        out.shapes.nodes.insert(out.shapes.nodes.end(), corners.begin(), corners.end());
        const auto* const mid = &mesh.mid_nodes[mids * cell];
        out.shapes.nodes.insert(out.shapes.nodes.end(), mid, mid + mids);
        out.shapes.ends.push_back(static_cast<std::int64_t>(out.shapes.nodes.size()));
    }
    EXPECT_FALSE(mesh::cut_into_simplices(out));
    return out;
}

TEST(Curved, CellsAmongOtherShapesAreMeasuredLikewise) {
    for (const int d : {2, 3}) {
        for (const Mesh& mesh : {curved_ball(d), turned(curved_ball(d)), with_middles(turned(straight_ball(d)))}) {
            std::vector<std::uint8_t> each;
            const CurvedCells own = curved_cells(mesh), found = curved_cells(among_shapes(mesh), &each);
            EXPECT_EQ(found.cells, own.cells);
            EXPECT_EQ(found.max_deviation, own.max_deviation);
            EXPECT_EQ(found.rounded_cells, own.rounded_cells);
            EXPECT_EQ(each.empty(), own.cells == 0);
        }
        // They are where the file has them, rounded or not.
        CurvedCells rounded = curved_cells(among_shapes(with_middles(turned(straight_ball(d)))));
        rounded.mapped = true;
        EXPECT_NE(message(rounded).find("by rounding; they are taken as they are"), std::string::npos);
    }
}

TEST(Curved, CellsTakenByTheirCornersAreTold) {
    Mesh mesh = straight_ball(3);
    mesh.by_corners = 2;
    EXPECT_EQ(message(curved_cells(mesh)),
              "2 cells of a higher order are taken by their corners: nodes and values amid "
              "edges and sides are left out");
}

// Coordinates of one digit, whose unit is a tenth: no deviation of that size is put down to rounding.
TEST(Curved, FewDigitsHideNoCurve) {
    Mesh mesh = straight_ball(2);
    mesh.points[mesh.points.size() - 2] += 0.1;
    expect_curved(curved_cells(mesh), 1, 0.1 / std::sqrt(2.0));
    expect_curved(curved_cells(printed(curved_ball(3, 0.05), "%.2f")), 8, 0.01);
    // One digit a coordinate is no digit of 1000.
    Mesh big;
    big.dimension = 2;
    big.points = {0, 0, 1000, 0, 0, 1000, 500, -0.9, 500, 500, 0, 500};
    big.cells = {0, 1, 2};
    big.mid_nodes = {3, 4, 5};
    expect_curved(curved_cells(big), 1, 0.0009);
}

// A node far away makes the rest no straighter.
TEST(Curved, MeasuredWhereItIs) {
    for (const double far : {1e6, 1e15, 1e300}) {
        Mesh mesh = curved_ball(3, 1e-6);
        mesh.points.insert(mesh.points.end(), {far, far, far});
        EXPECT_EQ(curved_cells(mesh).cells, 8U) << far;
    }
}

TEST(Curved, ScalingByPowersOfTwoChangesNothing) {
    for (const double scale : {0x1p-1000, 0x1p-30, 0x1p+700, 0x1p+1023}) {
        for (const Mesh& unscaled : {turned(curved_ball(3)), turned(straight_ball(3))}) {
            Mesh mesh = unscaled;
            for (double& x : mesh.points) x *= scale / 2;
            EXPECT_EQ(curved_cells(mesh).cells, curved_cells(unscaled).cells) << scale;
            EXPECT_EQ(curved_cells(mesh).max_deviation, curved_cells(unscaled).max_deviation) << scale;
        }
    }
}

TEST(Curved, SubnormalNumbers) {
    const double unit = std::numeric_limits<double>::denorm_min();
    Mesh mesh = straight_ball(2);
    for (double& x : mesh.points) x *= 3 * unit;  // a middle of 1.5 units is one or two
    EXPECT_EQ(curved_cells(mesh).cells, 0U);
    EXPECT_EQ(curved_cells(mesh).rounded_cells, 4U);
    mesh = straight_ball(2);
    for (double& x : mesh.points) x *= 8 * unit;
    expect_straight(curved_cells(mesh));
    mesh.points.back() += unit;
    EXPECT_EQ(curved_cells(mesh).cells, 1U);
}

TEST(Curved, BrokenMeshesAreMeasuredAsFarAsTheyCanBe) {
    Mesh mesh = curved_ball(3);
    mesh.cells[1] = 1000;
    mesh.mid_nodes[9] = -1;
    EXPECT_EQ(curved_cells(mesh).cells, 8U);
    mesh = straight_ball(3);
    for (const double x : {inf, -inf, std::numeric_limits<double>::quiet_NaN()}) {
        mesh.points[0] = mesh.points.back() = x;
        expect_straight(curved_cells(mesh));
    }
    mesh = curved_ball(3);
    mesh.mid_nodes.pop_back();
    expect_straight(curved_cells(mesh));
    // An edge without length has no middle but its ends.
    mesh = straight_ball(3);
    for (std::size_t k = 0; k < 3; ++k) mesh.points[3 + k] = mesh.points[k];
    EXPECT_EQ(curved_cells(mesh).max_deviation, inf);
    EXPECT_NE(message(curved_cells(mesh)).find("off edges of length 0"), std::string::npos);
}

TEST(Curved, Words) {
    const CurvedCells found = curved_cells(curved_ball(3));
    EXPECT_EQ(message(found),
              "8 cells are curved: mid-edge nodes lie up to 0.21 of the edge off its middle; sides were taken "
              "as straight");
    EXPECT_TRUE(measure_curved(curved_ball(3), "ball.vtu", Curved::straight));
    EXPECT_TRUE(measure_curved(straight_ball(3), "ball.vtu", Curved::refuse));
    const auto refused = measure_curved(curved_ball(3), "ball.vtu", Curved::refuse);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().file, "ball.vtu");
    EXPECT_NE(refused.error().found.find("8 cells are curved"), std::string::npos);
    EXPECT_NE(refused.error().remedy.find("straight"), std::string::npos);
}

}  // namespace
}  // namespace barycert::testing
