// Coordinates of any magnitude, domains of any shape, cells of very different sizes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/limits.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/locate/ways.hpp"

namespace barycert::testing {
namespace {

std::string text_of(const std::array<double, 3>& x) {
    return testing::text_of(x.data(), 3);
}

TEST(LocateRanges, L1L2AnyMagnitude) {
    for (const int d : {2, 3}) {
        const Mesh lattice = box(d, {4, 4, 3});
        for (const std::array<double, 3> factor : {std::array<double, 3>{1e300, 1e300, 1e300},
                                                   {1e-300, 1e-300, 1e-300},
                                                   {4e307, 4e307, 4e307},
                                                   {5e-324, 5e-324, 5e-324},
                                                   {1e-320, 1e-320, 1e-320},
                                                   {1e300, 1e-300, 1},
                                                   {5e-324, 4e307, 1},
                                                   {1e-9, 1, 1e9},
                                                   {0x1p-1022, 1, 0x1p1000}}) {
            base::Random random(7);
            const Mesh mesh = mapped(lattice, factor, {});
            expect_right(mesh, awkward_points(mesh, 30, random), random, "factor " + text_of(factor));
        }
    }
}

// From the lowest double to the max_double: differences of coordinates overflow.
TEST(LocateRanges, L1L2AllOfTheDoubles) {
    for (const int d : {2, 3}) {
        base::Random random(8);
        Mesh mesh = box(d, {2, 2, 2});
        for (double& x : mesh.points) x = x == 0 ? -max_double : x == 1 ? 0 : max_double;
        expect_right(mesh, awkward_points(mesh, 60, random), random, "all of the doubles");
        Mesh one = box(d, {1, 1, 1});
        for (double& x : one.points) x = x == 0 ? -max_double : max_double;
        expect_right(one, awkward_points(one, 60, random), random, "one cube of all doubles");
    }
}

TEST(LocateRanges, L1L2FarFromTheOrigin) {
    for (const int d : {2, 3}) {
        const Mesh lattice = mapped(box(d, {4, 3, 3}), {0.1, 0.1, 0.1}, {});
        for (const std::array<double, 3> shift : {std::array<double, 3>{1e6, 1e6, 1e6},
                                                  {1e6, -3e9, 7e12},
                                                  {0, 1e14, 0},
                                                  {1e15, 1e15, 1e15},
                                                  {1e300, 0, 0}}) {
            base::Random random(9);
            // At 1e15 nodes fall together, and cells are flat or folded.
            const Mesh mesh = mapped(lattice, {1, 1, 1}, shift);
            expect_right(mesh, awkward_points(mesh, 30, random), random, "shift " + text_of(shift));
        }
    }
}

// Boxes of few ulps: most coordinates are nodes, and bins are as small as coordinates go.
TEST(LocateRanges, L1L2AFewUlpsWide) {
    for (const int d : {2, 3}) {
        for (const double at : {1.0, 0.1, -1e300, 1e-310, 0x1p-1022}) {
            base::Random random(10);
            Mesh mesh = box(d, {3, 3, 3});
            for (double& x : mesh.points) {
                const int steps = static_cast<int>(x);
                x = at;
                for (int i = 0; i < steps; ++i) x = std::nextafter(x, max_double);
            }
            EXPECT_TRUE(
                expect_right(mesh, awkward_points(mesh, 30, random), random, "ulps from " + std::to_string(at)));
        }
    }
}

// All points nearly in a plane, or on a line.
TEST(LocateRanges, L1L2ThinDomains) {
    for (const int d : {2, 3}) {
        for (const double thin : {1e-8, 1e-16, 1e-200, 5e-324}) {
            for (const double shift : {0.0, 1.0}) {
                base::Random random(11);
                const Mesh plane = mapped(box(d, {5, 5, 1}), {1, d == 2 ? thin : 1, thin}, {0.1, shift, shift});
                expect_right(plane, awkward_points(plane, 25, random), random, "plane " + std::to_string(thin));
                const Mesh line = mapped(box(d, {30, 1, 1}), {1, thin, thin}, {0.1, shift, shift});
                expect_right(line, awkward_points(line, 25, random), random, "line " + std::to_string(thin));
                // Askew: x + y into the thin axis.
                Mesh askew = plane;
                const auto n = static_cast<std::size_t>(d);
                for (std::size_t i = 0; i < askew.points.size(); i += n) askew.points[i + n - 1] += askew.points[i];
                expect_right(askew, awkward_points(askew, 25, random), random, "askew " + std::to_string(thin));
            }
        }
    }
}

// Cells of 1e-9 of the domain and less in one corner: there all share a bin.
TEST(LocateRanges, L1L2Graded) {
    for (const int d : {2, 3}) {
        for (const double steepness : {8.0, 20.0, 100.0}) {
            base::Random random(12);
            Mesh mesh = box(d, {12, 12, d == 2 ? 0 : 6});
            std::vector<double> corner;
            for (double& x : mesh.points) x = x == 0 ? 0 : std::exp2(steepness * (x / 12 - 1));
            std::vector<double> points = awkward_points(mesh, 20, random);
            const double low = std::exp2(steepness * (2.0 / 12 - 1));
            for (int i = 0; i < 100 * d; ++i) points.push_back(random.uniform(-0.1 * low, low));
            EXPECT_TRUE(expect_right(mesh, points, random, "graded " + std::to_string(steepness)));
        }
    }
}

// Far outside, on the box but outside the mesh, and at the max_double doubles, whatever the mesh.
TEST(LocateRanges, L1PointsOutside) {
    for (const int d : {2, 3}) {
        base::Random random(13);
        std::vector<bool> keep(static_cast<std::size_t>(d == 2 ? 18 : 162), true);
        for (std::size_t c = 0; c < 6; ++c) keep[c] = false;
        const Mesh mesh = only(box(d, {3, 3, 3}), keep);
        std::vector<double> points;
        for (int i = 0; i < 200 * d; ++i) {
            static constexpr double some[]{max_double, -max_double,          0,   3, 1.5, 5e-324,
                                           -5e-324,    0x1.8000000000001p+1, 0.25};
            points.push_back(some[random.below(std::size(some))]);
        }
        EXPECT_TRUE(expect_right(mesh, points, random, "outside"));
    }
}

}  // namespace
}  // namespace barycert::testing
