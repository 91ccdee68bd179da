// The oracle on triangles in a window with depths, against ray casting by elimination in GMP's rationals; and ray
// casting as the eye sees it, by CGAL's geometry, against the oracle and the exact core alike.
#include <CGAL/Cartesian.h>
#include <CGAL/Gmpq.h>
#include <CGAL/intersections.h>

#include <map>
#include <variant>

#include "audit/exact/cgal_variant.hpp"
#include "barycert/perspective.hpp"
#include "tests/audit/exact/checks.hpp"

namespace barycert::exact {
namespace {

using namespace testing_cases;

TEST(PerspectiveOracle, EqualsTheSecondPath) {
    for (const Kind kind : all_kinds) {
        std::map<Region, int> regions;
        const int count = kind == Kind::bit_patterns ? 400 : 2000;
        for (int k = 0; k < count; ++k) {
            base::Random r = base::Random::stream(3, base::hash64("perspective") + base::hash64(name(kind)),
                                                  static_cast<std::uint64_t>(k));
            ++regions[check(random_perspective_case(r, kind)).region];
            ASSERT_FALSE(HasFailure()) << name(kind) << ", case " << k;
        }
        EXPECT_GT(regions[Region::degenerate], 0) << name(kind);
        EXPECT_GT(regions[Region::boundary], 0) << name(kind);
        EXPECT_GT(regions[Region::outside], 0) << name(kind);
        EXPECT_GT(regions[Region::interior], 0) << name(kind);
    }
}

TEST(PerspectiveOracle, BothWidthsAreMet) {
    int narrow = 0, wide = 0;
    for (std::uint64_t k = 0; k < 200; ++k) {
        base::Random r = base::Random::stream(3, base::hash64("widths"), k);
        const Case c = random_perspective_case(r, k % 2 == 0 ? Kind::ordinary : Kind::mixed);
        ++(ask_oracle(c).narrow ? narrow : wide);
    }
    EXPECT_GT(narrow, 50);
    EXPECT_GT(wide, 50);
}

Case half_way() {
    Case c{.simplex = Simplex::triangle};
    c.perspective = true;
    c.vertices = {0, 0, 1, 8, 0, 3, 0, 8, 2};
    c.point = {4, 0, 0};
    c.values = {0, 1, 5, 0};
    return c;
}

// The middle of an edge with depths 1 and 3 is a quarter of the way.
TEST(PerspectiveOracle, ByHand) {
    const OracleAnswer a = ask_oracle(half_way());
    EXPECT_EQ(a.feature, Feature::edge);
    EXPECT_EQ(a.support, 0b011);
    EXPECT_EQ(a.weights[0], 0.75);
    EXPECT_EQ(a.weights[1], 0.25);
    EXPECT_EQ(a.value, 0.25);
    // 1/Z = 1 (1 - t) + t/3 on the line of that edge is zero at t = 3/2, x = 12, and negative beyond.
    Case c = half_way();
    c.point = {12, 0, 0};
    EXPECT_EQ(ask_oracle(c).region, Region::degenerate);
    EXPECT_EQ(affine_dimension(c), 2);
    c.point = {16, 0, 0};  // alpha = (-1, 2, 0), 1/Z = -1/3
    const OracleAnswer behind = ask_oracle(c);
    EXPECT_EQ(behind.region, Region::outside);
    EXPECT_EQ(behind.weights[0], 3);
    EXPECT_EQ(behind.weights[1], -2);
    c.vertices = {0, 0, 1, 8, 0, 3, 4, 0, 2};
    EXPECT_EQ(ask_oracle(c).region, Region::degenerate);
    EXPECT_EQ(affine_dimension(c), 1);
}

TEST(PerspectiveIdentity, HoldsWhereverThereAreWeights) {
    for (const Kind kind : all_kinds) {
        int holds = 0;
        for (int k = 0; k < (kind == Kind::bit_patterns ? 60 : 600); ++k) {
            base::Random r =
                base::Random::stream(3, base::hash64("ray") + base::hash64(name(kind)), static_cast<std::uint64_t>(k));
            const Case c = random_perspective_case(r, kind);
            const IdentityVerdict found = perspective_is_ray_casting(c);
            const bool proper = ask_oracle(c).region != Region::degenerate;
            ASSERT_EQ(found, proper ? IdentityVerdict::holds : IdentityVerdict::undefined) << describe(c);
            holds += proper ? 1 : 0;
        }
        EXPECT_GT(holds, 30) << name(kind);
    }
}

using Geometry = CGAL::Cartesian<CGAL::Gmpq>;
using EyePoint = Geometry::Point_3;

double to_nearest(const CGAL::Gmpq& x) {
    return second_path::nearest(second_path::Q(mpq_class(x.mpq())));
}

/// A triangle in space whose vertices (X, Y, W) project to doubles: W is a power of two, X and Y are any.
struct EyeCase {
    Case window;
    std::vector<EyePoint> eye;
};

EyeCase eye_case(base::Random& r) {
    EyeCase e;
    e.window.simplex = Simplex::triangle;
    e.window.perspective = true;
    for (int i = 0; i < 3; ++i) {
        const double w = std::ldexp(1, r.integer(-3, 10));
        const double x = r.uniform(-100, 100);
        const double y = r.uniform(-100, 100);
        e.eye.emplace_back(CGAL::Gmpq(x), CGAL::Gmpq(y), CGAL::Gmpq(w));
        e.window.vertex(i, 0) = x / w;
        e.window.vertex(i, 1) = y / w;
        e.window.depth(i) = w;
        e.window.values[static_cast<std::size_t>(i)] = r.uniform(-1, 1);
    }
    for (std::size_t k = 0; k < 2; ++k) {
        const double share = r.unit();
        e.window.point[k] = share * e.window.vertices[k] + (1 - share) * e.window.vertices[3 + k];
    }
    return e;
}

// The original triangle is met by the ray of a pixel in CGAL's geometry; weights by the volumes of tetrahedra with the
// eye. The answers of oracle and core have the same bits as what is met there, rounded.
TEST(PerspectiveRay, MeetsTheOriginalTriangleWhereTheWindowSays) {
    const EyePoint eye(0, 0, 0);
    int inside = 0;
    for (std::uint64_t k = 0; k < 3000; ++k) {
        base::Random r = base::Random::stream(3, base::hash64("eye"), k);
        const EyeCase e = eye_case(r);
        const Case& c = e.window;
        SCOPED_TRACE(describe(c));
        const auto &a = e.eye[0], &b = e.eye[1], &d = e.eye[2];
        const Geometry::Line_3 ray(eye, EyePoint(CGAL::Gmpq(c.point[0]), CGAL::Gmpq(c.point[1]), 1));
        const auto met = CGAL::intersection(ray, Geometry::Plane_3(a, b, d));
        const EyePoint* const at = met ? exact::met_as<EyePoint>(*met) : nullptr;
        const CGAL::Gmpq whole = CGAL::volume(eye, a, b, d);
        if (at == nullptr || whole == 0) continue;
        const CGAL::Gmpq weights[3] = {CGAL::volume(eye, *at, b, d) / whole, CGAL::volume(eye, a, *at, d) / whole,
                                       CGAL::volume(eye, a, b, *at) / whole};
        CGAL::Gmpq value(0);
        for (std::size_t i = 0; i < 3; ++i) value += weights[i] * CGAL::Gmpq(c.values[i]);
        const OracleAnswer answer = ask_oracle(c);
        const auto core = perspective_weights(c.vertices.data(), c.point.data());
        ASSERT_TRUE(core);
        for (std::size_t i = 0; i < 3; ++i) {
            expect_same_bits(answer.weights[i], to_nearest(weights[i]), "oracle's weight");
            expect_same_bits(core->weights[i], to_nearest(weights[i]), "core's weight");
        }
        expect_same_bits(answer.value, to_nearest(value), "oracle's value");
        expect_same_bits(perspective_value(c.vertices.data(), c.point.data(), c.values.data())->value,
                         to_nearest(value), "core's value");
        expect_same_bits(perspective_depth(c.vertices.data(), c.point.data())->value, to_nearest(at->z()), "depth");
        inside += answer.region == Region::interior ? 1 : 0;
        ASSERT_FALSE(HasFailure());
    }
    EXPECT_GT(inside, 300);
}

/// |sum W_i w_i (v_i - p) / sum W_i w_i|, rounded once.
double expected_residual(const Case& c, const std::array<double, 3>& weights) {
    second_path::Q depth(0), x(0), y(0);
    for (int i = 0; i < 3; ++i) {
        const second_path::Q share = second_path::Q(weights[static_cast<std::size_t>(i)]) * second_path::Q(c.depth(i));
        depth += share;
        x += share * (second_path::Q(c.vertex(i, 0)) - second_path::Q(c.point[0]));
        y += share * (second_path::Q(c.vertex(i, 1)) - second_path::Q(c.point[1]));
    }
    const second_path::Q square = (x * x + y * y) / (depth * depth);
    return second_path::nearest_root(square);
}

TEST(PerspectiveResidual, IsTheDistanceInTheWindow) {
    for (std::uint64_t k = 0; k < 500; ++k) {
        base::Random r = base::Random::stream(3, base::hash64("residual"), k);
        const Case c = random_perspective_case(r, k % 2 == 0 ? Kind::ordinary : Kind::lattice);
        std::array<double, 3> w{};
        for (double& x : w) x = r.uniform(0, 1);
        expect_same_bits(reproduction_residual(c, w), expected_residual(c, w), "residual");
    }
    const Case c = half_way();
    EXPECT_EQ(reproduction_residual(c, std::array{0.75, 0.25, 0.0}), 0);
    EXPECT_EQ(reproduction_residual(c, std::array{0.5, 0.5, 0.0}), 2);  // the affine shortcut: 6 in place of 4
    EXPECT_TRUE(std::isinf(reproduction_residual(c, std::array{3.0, -1.0, 0.0})));
}

}  // namespace
}  // namespace barycert::exact
