// Signs, and what inverse.hpp gives, do not depend on the floating-point environment: rounding modes, flush-to-zero,
// subnormals taken for zero.

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <functional>
#ifdef __x86_64__
#include <immintrin.h>
#endif

#include "barycert/weights.hpp"
#include "core/base/random.hpp"
#include "judge.hpp"

namespace barycert::laws {
namespace {

/// Runs `work` in every environment, with the environment's name.
void in_every_environment(const std::function<void(const char*)>& work) {
    const std::array<std::pair<int, const char*>, 4> modes{
        {{FE_TONEAREST, "to nearest"}, {FE_UPWARD, "upward"}, {FE_DOWNWARD, "downward"}, {FE_TOWARDZERO, "to zero"}}};
    for (const auto& [mode, name] : modes) {
        std::fesetround(mode);
        work(name);
    }
    std::fesetround(FE_TONEAREST);
#ifdef __x86_64__
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | 0x8000);
    work("flush to zero");
    _mm_setcsr(before | 0x0040);
    work("subnormals are zero");
    _mm_setcsr(before | 0x8040);
    work("flush to zero, subnormals are zero");
    _mm_setcsr(before);
#endif
}

/// Zeros, subnormals, small integers and powers of two from end to end of the range.
double any_number(base::Random& random) {
    switch (random.below(4)) {
        case 0:
            return 0;
        case 1:
            return random.integer(-9, 9) * 0x1p-1074;
        case 2:
            return random.integer(-4, 4);
        default: {
            const int mantissa = random.integer(-3, 3);
            return std::ldexp(mantissa, random.integer(-1074, 900));
        }
    }
}

// Found with subnormals taken for zero: a subnormal beside ordinary numbers must not count as zero.
TEST(Environment, ASubnormalBesideOrdinaryNumbers) {
    const double vertices[12] = {0x1p+0,   -0x1p-1074, 0x1p-1074, 0x1p+1, 0x1.8p+247, -0x1p+1,
                                 0x1.8p+1, -0x1p-433,  -0x1p+728, 0x0p+0, 0x1p-1071,  -0x1p-1071};
    const double point[3] = {-0x1.8p+1, 0, 0};
    Case c;
    std::copy_n(vertices, 12, c.vertices.begin());
    std::copy_n(point, 3, c.point.begin());
    const std::string expected = verdict(ask_oracle(c)).text(4);
    in_every_environment([&](const char* environment) {
        Verdict v = verdict(weight_signs(Simplex::tetrahedron, vertices, point), 4);
        v.orientation = 0;  // the oracle does not tell
        EXPECT_EQ(v.text(4), expected) << environment;
    });
}

TEST(Environment, SignsOfMixedNumbers) {
    for (const Simplex s : all_simplices) {
        base::Random random = base::Random::stream(5, static_cast<std::uint64_t>(s), 0);
        int failures = 0;
        for (int i = 0; i < 5000 && failures < 3; ++i) {
            Case c;
            c.simplex = s;
            for (double& x : c.vertices) x = any_number(random);
            for (double& x : c.point) x = any_number(random);
            const std::string expected = verdict(ask_oracle(c)).text(vertex_count(s));
            in_every_environment([&](const char* environment) {
                Verdict v = verdict(weight_signs(s, c.vertices.data(), c.point.data()), vertex_count(s));
                v.orientation = 0;
                if (v.text(vertex_count(s)) == expected) return;
                ++failures;
                std::string numbers;
                for (const double x : c.vertices) numbers += " " + hexadecimal(x);
                numbers += " point";
                for (const double x : c.point) numbers += " " + hexadecimal(x);
                ADD_FAILURE() << environment << ": " << name(s) << numbers << "\n  oracle " << expected
                              << "\n  barycert " << v.text(vertex_count(s));
            });
        }
    }
}

TEST(Environment, SignsOfEveryFamily) {
    for (const Subject& s : all_subjects()) {
        Block block;
        block.fill(s, 3, 0, 500);
        std::vector<WeightSigns> expected(500), out(500);
        ASSERT_TRUE(weight_signs(block.arrays, expected));
        in_every_environment([&](const char* environment) {
            const bool fine = weight_signs(block.arrays, out).has_value();
            EXPECT_TRUE(fine && out == expected) << s.title() << ", " << environment;
        });
    }
}

TEST(Environment, Orientations) {
    base::Random random(11);
    for (int i = 0; i < 5000 && !HasFailure(); ++i) {
        double p[4][3];
        for (auto& q : p) {
            for (double& x : q) x = any_number(random);
        }
        const Sign flat = orient2d(p[0], p[1], p[2]), solid = orient3d(p[0], p[1], p[2], p[3]);
        in_every_environment([&](const char* environment) {
            EXPECT_TRUE(orient2d(p[0], p[1], p[2]) == flat) << environment << ", case " << i;
            EXPECT_TRUE(orient3d(p[0], p[1], p[2], p[3]) == solid) << environment << ", case " << i;
        });
    }
}

TEST(Environment, PointsOfValuesAndFromWeights) {
    base::Random random(12);
    for (int i = 0; i < 5000 && !HasFailure(); ++i) {
        double x[12], w[4], expected[3], point[3];
        for (double& y : x) y = any_number(random);
        for (double& y : w) y = any_number(random);
        const std::span<const double> a(x, 3), b(x + 3, 3);
        double on_segment[3];
        const double t = point_of_value(a, b, w[0], w[1], w[2], on_segment)->t;
        ASSERT_TRUE(point_from_weights(Simplex::tetrahedron, x, w, expected));
        in_every_environment([&](const char* environment) {
            const bool fine = point_from_weights(Simplex::tetrahedron, x, w, point).has_value();
            bool alike = fine && same(parameter_of_value(w[0], w[1], w[2])->t, t);
            for (int k = 0; k < 3; ++k) alike = alike && same(point[k], expected[k]);
            double again[3];
            alike = alike && point_of_value(a, b, w[0], w[1], w[2], again).has_value();
            for (int k = 0; k < 3; ++k) alike = alike && same(again[k], on_segment[k]);
            EXPECT_TRUE(alike) << environment << ", case " << i;
        });
    }
}

}  // namespace
}  // namespace barycert::laws
