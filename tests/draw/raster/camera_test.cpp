#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "barycert/scene.hpp"
#include "core/base/random.hpp"
#include "tests/draw/raster/rational.hpp"

namespace barycert {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN(),
                 endless = std::numeric_limits<double>::infinity();

using Point4 = std::array<double, 4>;

Point4 operator*(const Matrix4& m, const Point4& p) {
    Point4 q{};
    for (std::size_t r = 0; r < 4; ++r) {
        for (std::size_t c = 0; c < 4; ++c) q[r] += m.m[4 * r + c] * p[c];
    }
    return q;
}

void expect_near(const Point4& a, const Point4& b) {
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(a[k], b[k], 1e-14);
}

TEST(Camera, LookAtPutsTheCentreInFront) {
    const Matrix4 m = look_at({1, 2, 3}, {1, 2, -4}, {0, 1, 0}).value();
    expect_near(m * Point4{1, 2, 3, 1}, {0, 0, 0, 1});
    expect_near(m * Point4{1, 2, -4, 1}, {0, 0, -7, 1});
    expect_near(m * Point4{2, 2, 3, 1}, {1, 0, 0, 1});  // to the right
    expect_near(m * Point4{1, 3, 3, 1}, {0, 1, 0, 1});  // up
    base::Random random(1);
    for (int k = 0; k < 200; ++k) {
        Vector3 eye, centre, up;
        for (Vector3* v : {&eye, &centre, &up}) {
            for (double& x : *v) x = random.uniform(-5, 5);
        }
        const Result<Matrix4> camera = look_at(eye, centre, up);
        ASSERT_TRUE(camera);
        const Point4 at = *camera * Point4{centre[0], centre[1], centre[2], 1};
        EXPECT_NEAR(at[0], 0, 1e-12);
        EXPECT_NEAR(at[1], 0, 1e-12);
        EXPECT_NEAR(-at[2], std::hypot(centre[0] - eye[0], centre[1] - eye[1], centre[2] - eye[2]), 1e-12);
        const Point4 above = *camera * Point4{eye[0] + up[0], eye[1] + up[1], eye[2] + up[2], 1};
        EXPECT_NEAR(above[0], 0, 1e-12);
        EXPECT_GT(above[1], 0);
    }
}

TEST(Camera, PerspectiveMapsTheFrustumToTheCube) {
    const double near = 0.5, far = 20, aspect = 1.5, tangent = std::tan(25 * std::acos(-1.0) / 180);
    const Matrix4 m = perspective(50, aspect, near, far).value();
    for (const double depth : {near, far}) {
        for (const double side : {-1.0, 1.0}) {
            const Point4 p = m * Point4{side * aspect * tangent * depth, -side * tangent * depth, -depth, 1};
            EXPECT_NEAR(p[3], depth, 1e-14);
            EXPECT_NEAR(p[0] / p[3], side, 1e-14);
            EXPECT_NEAR(p[1] / p[3], -side, 1e-14);
            EXPECT_NEAR(p[2] / p[3], depth == near ? -1 : 1, 1e-13);
        }
    }
}

TEST(Camera, OrthographicMapsTheBoxToTheCube) {
    const Matrix4 m = orthographic(-1, 3, 2, 5, 1, 9).value();
    expect_near(m * Point4{-1, 2, -1, 1}, {-1, -1, -1, 1});
    expect_near(m * Point4{3, 5, -9, 1}, {1, 1, 1, 1});
    expect_near(m * Point4{1, 3.5, -5, 1}, {0, 0, 0, 1});
}

TEST(Camera, RotationsTurnCounterClockwise) {
    expect_near(rotation({0, 0, 2}, 90).value() * Point4{1, 0, 0, 1}, {0, 1, 0, 1});
    expect_near(rotation({1, 0, 0}, 90).value() * Point4{0, 1, 0, 1}, {0, 0, 1, 1});
    expect_near(rotation({0, 1e-300, 0}, -270).value() * Point4{0, 0, 1, 1}, {1, 0, 0, 1});
    expect_near(translation({1, 2, 3}) * scaling({2, 2, 2}) * Point4{1, 1, 1, 1}, {3, 4, 5, 1});
}

TEST(Camera, WhatIsNoCameraIsAnError) {
    EXPECT_FALSE(look_at({1, 1, 1}, {1, 1, 1}, {0, 1, 0}));
    EXPECT_FALSE(look_at({0, 0, 0}, {0, 3, 0}, {0, 1, 0}));
    EXPECT_FALSE(look_at({0, 0, 0}, {0, 0, 1}, {0, 0, 0}));
    EXPECT_FALSE(look_at({no_number, 0, 0}, {0, 0, 1}, {0, 1, 0}));
    EXPECT_FALSE(look_at({0, 0, 0}, {0, 0, endless}, {0, 1, 0}));
    EXPECT_TRUE(look_at({0, 0, 0}, {0, 0, 1e-320}, {0, 1e300, 0}));
    for (const double fovy : {0.0, -10.0, 180.0, no_number}) EXPECT_FALSE(perspective(fovy, 1, 1, 2));
    for (const double aspect : {0.0, -1.0, endless, no_number}) EXPECT_FALSE(perspective(50, aspect, 1, 2));
    EXPECT_FALSE(perspective(50, 1, 0, 2));
    EXPECT_FALSE(perspective(50, 1, 2, 2));
    EXPECT_FALSE(perspective(50, 1, 2, 1));
    EXPECT_FALSE(perspective(50, 1, 1, endless));
    EXPECT_FALSE(perspective(50, 1e-320, 1, 2));  // overflows
    EXPECT_FALSE(orthographic(1, 1, 0, 1, 0, 1));
    EXPECT_FALSE(orthographic(0, 1, 0, no_number, 0, 1));
    EXPECT_FALSE(orthographic(0, 1e-320, 0, 1, 0, 1));
    EXPECT_FALSE(rotation({0, 0, 0}, 20));
    EXPECT_FALSE(rotation({0, 0, 1}, endless));
}

TEST(Viewport, IsCorrectlyRoundedAndWithinTheWindow) {
    base::Random random(7);
    for (int k = 0; k < 3000; ++k) {
        const RasterSize size{random.integer(1, 4000), random.integer(1, 4000)};
        const double w = random.scaled(0.5, 1, -1060, 1000);
        const double x = random.coin() ? w * random.uniform(-1, 1) : random.coin() ? w : -w;
        const double y = w * random.uniform(-1, 1) * std::ldexp(1.0, -random.integer(0, 60));
        const auto exact = [&](double c, int side) {
            return (Rational(c) + Rational(w)) * Rational(side) / (Rational(2) * Rational(w));
        };
        const std::array<double, 2> p = viewport(size, x, y, w);
        ASSERT_TRUE(is_nearest(p[0], exact(x, size.width)));
        ASSERT_TRUE(is_nearest(p[1], exact(y, size.height)));
        const std::array<double, 2> plain = viewport(size, x, y, w, Rounding::plain);
        for (const auto& q : {p, plain}) {
            ASSERT_TRUE(0 <= q[0] && q[0] <= size.width);
            ASSERT_TRUE(0 <= q[1] && q[1] <= size.height);
        }
        ASSERT_NEAR(plain[0], p[0], 1e-15 * size.width);
    }
}

TEST(Viewport, NeedsAPositiveDepth) {
    for (const double w : {0.0, -0.0, -1.0, no_number, endless}) {
        for (const Rounding rounding : {Rounding::plain, Rounding::correct}) {
            EXPECT_TRUE(std::isnan(viewport({4, 4}, 0.5, 0.5, w, rounding)[0]));
            EXPECT_TRUE(std::isnan(viewport({4, 4}, no_number, 0.5, 1, rounding)[1]));
        }
    }
}

}  // namespace
}  // namespace barycert
