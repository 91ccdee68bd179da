// On well-shaped tetrahedra every kernel that means to be right is right, up to rounding.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "barycert/kernels.hpp"
#include "core/base/random.hpp"
#include "tests/audit/kernels/exact_weights.hpp"

namespace barycert {
namespace {

constexpr double u = 0x1p-53;

/// Vertices in [-1,1]^3, a point in [-2,2]^3.
Case random_case(std::uint64_t seed) {
    base::Random random(seed);
    Case c;
    for (double& x : c.vertices) x = random.uniform(-1, 1);
    for (double& x : c.point) x = random.uniform(-2, 2);
    return c;
}

/// Six times the volume, good enough for a precondition.
double size(const Case& c) {
    double e[3][3];
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) e[i][j] = c.vertex(i + 1, j) - c.vertex(0, j);
    }
    return std::fabs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                     e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                     e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]));
}

/// A bound of |w_i - right_i| with D = size(c) >= 1/8.
///
/// Determinants: factors are at most 3 in size (coordinates and differences), so the sum of the absolute products is at
/// most 4*6*27 = 648 (four determinants in the homogeneous form), each with at most 12 roundings: an absolute error
/// below 2^13 u, over D and times (1+|w|) for the divisor's error, doubled for D's own rounding. A weight as what is
/// left of 1 adds up three such errors: 2^16 u (1 + max|w|) / D. LU and inverse: n^3 times growth 8 is 2^9, and the
/// inverse's entries are cofactors below 24 over D; that is within the same bound.
/// Auxiliary lines divide by extents of the section, of which each may be as short as 1/16 of the height where
/// all weights are at least 1/16: three divisions, each amplifying by at most 64 M^2/D with M = 2: (256/D)^3 u more.
double bound(const Kernel& k, double d, double max_weight) {
    const double plain = 0x1p16 * u * (1 + max_weight) / d;
    const double amplified = k.name == "tetrahedron.trilinear" ? std::pow(256 / d, 3) * u : 0;
    return plain + amplified;
}

RC_GTEST_PROP(Agreement, KernelsMatchTheExactWeights, ()) {
    const Case c = random_case(*rc::gen::arbitrary<std::uint64_t>());
    const double d = size(c);
    RC_PRE(d >= 0.125);
    const testing::ExactWeights exact = testing::exact_weights(c);
    double max = 0, min = 1;
    for (const mpq_class& w : exact.weights) {
        max = std::max(max, std::fabs(w.get_d()));
        min = std::min(min, w.get_d());
    }
    for (const Kernel& k : kernels_matching("tetrahedron.*")) {
        if (k.name.find("float32") != std::string::npos) continue;
        if (k.name == "tetrahedron.unsigned-volume" && min < 0) continue;
        if (k.name == "tetrahedron.trilinear" && min < 0.0625) continue;
        double w[4];
        RC_ASSERT(k.weights(c.vertices.data(), c.point.data(), w) == 0);
        for (std::size_t i = 0; i < 4; ++i) {
            const double error = std::fabs(mpq_class(mpq_class(w[i]) - exact.weights[i]).get_d());
            if (!(error <= bound(k, d, max))) RC_FAIL(k.name + " is off by " + std::to_string(error));
        }
    }
}

/// Scaling by a power of two changes no bit while nothing leaves the range, but for the systems with a row of ones,
/// whose pivots are compared with it.
RC_GTEST_PROP(Agreement, PowersOfTwoChangeNoBit, ()) {
    const Case c = random_case(*rc::gen::arbitrary<std::uint64_t>());
    const double scale = std::ldexp(1.0, *rc::gen::inRange(-20, 21));
    Case scaled = c;
    for (double& x : scaled.vertices) x *= scale;
    for (double& x : scaled.point) x *= scale;
    for (const Kernel& k : kernels_matching("tetrahedron.*")) {
        if (k.name.find("-lu") != std::string::npos) continue;
        double w[4], z[4];
        RC_ASSERT(k.weights(c.vertices.data(), c.point.data(), w) == 0);
        RC_ASSERT(k.weights(scaled.vertices.data(), scaled.point.data(), z) == 0);
        for (int i = 0; i < 4; ++i) {
            if (!(w[i] == z[i])) RC_FAIL(k.name);
        }
    }
}

}  // namespace
}  // namespace barycert
