// Each kernel is wrong on a named case, as its `fails` says.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "barycert/kernels.hpp"
#include "core/base/random.hpp"
#include "tests/audit/kernels/breaking_cases.hpp"
#include "tests/audit/kernels/exact_weights.hpp"

namespace barycert {
namespace {

using testing::breaking_cases;
using testing::BreakingCase;
using testing::exact_weights;

const Kernel* find(const std::string& name) {
    for (const Kernel& k : catalogue()) {
        if (k.name == name) return &k;
    }
    return nullptr;
}

TEST(Breaking, EachKernelMisjudgesItsCase) {
    for (const BreakingCase& b : breaking_cases) {
        EXPECT_NE(b.claimed, b.exact);
        for (const char* const kernel : b.kernels) {
            const Kernel* const k = find(kernel);
            if (k == nullptr) continue;  // a contracted variant on a machine without FMA; the next test sees the rest
            const Case c{k->simplex, b.vertices, b.point, {}, k->perspective};
            double w[4];
            const int status = k->weights(c.vertices.data(), c.point.data(), w);
            const Region claimed = claimed_region(*k, status, {w, static_cast<std::size_t>(vertex_count(k->simplex))});
            EXPECT_EQ(name(exact_weights(c).region), name(b.exact)) << kernel << ", " << b.what;
            EXPECT_EQ(name(claimed), name(b.claimed)) << kernel << ", " << b.what;
        }
    }
}

TEST(Breaking, EveryKernelHasACase) {
    std::set<std::string> covered;
    for (const BreakingCase& b : breaking_cases) covered.insert(b.kernels.begin(), b.kernels.end());
    for (const Kernel& k : catalogue()) EXPECT_NE(covered.count(k.name) != 0, k.certifies) << k.name;
}

TEST(Breaking, IncrementLosesTheValueAtB) {
    const double a_to_b[6] = {0, 0, 0, 4, 0, 0}, b[3] = {4, 0, 0}, values[2] = {0x1p60, 1};
    for (const char* formula : {"segment.signed-length-x", "segment.dominant-axis"}) {
        const Kernel& blend = *find(formula);
        const Kernel& increment = *find(std::string(formula) + ".increment");
        double w[2];
        ASSERT_EQ(blend.weights(a_to_b, b, w), 0);
        EXPECT_EQ(blend.value(w, values), 1.0);
        EXPECT_EQ(increment.value(w, values), 0.0);
    }
}

/// Depths 1 and 3 at the ends of an edge: its middle is a quarter of the way. The shortcuts take it for half.
TEST(Breaking, PerspectiveShortcutsMissTheMiddle) {
    const double vertices[9] = {0, 0, 1, 8, 0, 3, 0, 8, 2}, middle[2] = {4, 0}, values[3] = {0, 64, 0};
    const auto value = [&](const char* name) {
        const Kernel& k = *find(std::string("triangle.perspective-") + name);
        double w[3];
        EXPECT_EQ(k.weights(vertices, middle, w), 0);
        const double v = k.interpolate != nullptr ? k.interpolate(vertices, middle, values) : k.value(w, values);
        EXPECT_NEAR(w[1] * 64, v, 1e-4) << name;
        return v;
    };
    for (const char* right : {"textbook", "varying", "exact"}) EXPECT_NEAR(value(right), 16, 1e-12) << right;
    EXPECT_NEAR(value("varying.float32"), 16, 1e-4);
    EXPECT_EQ(value("affine"), 32);
    EXPECT_NEAR(value("projected-z"), 32, 0.05);
}

/// One row of pixels of a wide triangle: every step rounds, so that the error at the far end is that of many.
TEST(Breaking, IncrementsDrift) {
    const auto error = [](const char* name, int size) {
        const auto s = static_cast<double>(size);
        const double vertices[6] = {0, 0, s, 0.1, 0.3, s}, point[2] = {s / 2 + 0.5, s / 4 + 0.5};
        const double values[3] = {1, 1.3, 1.9};
        const Kernel& k = *find(name);
        const double right = find("triangle.exact")->interpolate(vertices, point, values);
        return std::fabs(k.interpolate(vertices, point, values) - right) / 0x1p-52;
    };
    EXPECT_LT(error("triangle.scanline-increments", 8), 8);
    EXPECT_GT(error("triangle.scanline-increments", 4096), 100);
    EXPECT_GT(error("triangle.scanline-increments.float32", 4096), 0x1p29 * 100);
}

/// More steps than a kernel may take are jumped: it comes to an end, and near the right value.
TEST(Breaking, IncrementsComeToAnEnd) {
    const double vertices[6] = {0, 0, 0x1p60, 0, 0, 0x1p60}, point[2] = {0x1p58, 0x1p58};
    double w[3];
    ASSERT_EQ(find("triangle.scanline-increments")->weights(vertices, point, w), 0);
    EXPECT_EQ(w[0], 0.5);
    EXPECT_EQ(w[1], 0.25);
    EXPECT_EQ(w[2], 0.25);
}

TEST(Breaking, BlendChangesAConstant) {
    const double w[2] = {3.0 / 7, 4.0 / 7}, values[2] = {0.9, 0.9};
    EXPECT_NE(find("segment.signed-length-x")->value(w, values), 0.9);
    EXPECT_EQ(find("segment.signed-length-x.increment")->value(w, values), 0.9);
}

/// In a cell 2^-40 flat weights are wrong by whole units, yet their sum is 1 up to their own rounding.
TEST(Breaking, OneMinusSumHidesTheError) {
    const Kernel& k = *find("tetrahedron.one-minus-sum");
    int hidden = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
        base::Random random = base::Random::stream(1, 1, i);
        Case c;
        for (double& x : c.vertices) x = random.uniform(-1, 1);
        for (double& x : c.point) x = random.uniform(-1, 1);
        for (int axis = 0; axis < 3; ++axis) {
            c.vertex(3, axis) =
                (c.vertex(0, axis) + c.vertex(1, axis) + c.vertex(2, axis)) / 3 + random.unit() * 0x1p-40;
        }
        double w[4];
        if (k.weights(c.vertices.data(), c.point.data(), w) != 0) continue;
        const double size = std::max({std::fabs(w[0]), std::fabs(w[1]), std::fabs(w[2]), std::fabs(w[3])});
        const mpq_class sum = mpq_class(w[0]) + mpq_class(w[1]) + mpq_class(w[2]) + mpq_class(w[3]);
        const bool closed = abs(sum - 1) <= mpq_class(size * 0x1p-50);  // three subtractions of at most 2 size each
        const bool wrong = abs(mpq_class(w[3]) - exact_weights(c).weights[3]) > 1;
        hidden += closed && wrong ? 1 : 0;
    }
    EXPECT_GT(hidden, 90);
}

/// Relative to a point 2^30 away the vertices coincide to 23 bits: no digit of any weight is right.
TEST(Breaking, FarPointsLoseEveryDigitOfVolumes) {
    base::Random random(1);
    for (const char* formula : {"tetrahedron.two-cross-products", "tetrahedron.signed-volume"}) {
        int lost = 0;
        for (int i = 0; i < 100; ++i) {
            Case c;
            for (double& x : c.vertices) x = random.uniform(-1, 1);
            for (double& x : c.point) x = random.uniform(-0x1p30, 0x1p30);
            double w[4];
            if (find(formula)->weights(c.vertices.data(), c.point.data(), w) != 0) continue;
            const mpq_class right = exact_weights(c).weights[0];
            lost += abs(mpq_class(w[0]) - right) > abs(right) ? 1 : 0;
        }
        EXPECT_GT(lost, 0) << formula;
    }
}

/// In how many of 1000 random cases a variant's weights differ in bits from its base's.
int different(const std::string& base, const std::string& variant) {
    const Kernel &k = *find(base), &l = *find(base + variant);
    int count = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        base::Random random = base::Random::stream(1, 0, i);
        Case c;
        for (double& x : c.vertices) x = random.uniform(-1, 1);
        for (double& x : c.point) x = random.uniform(-1, 1);
        double w[4], z[4];
        k.weights(c.vertices.data(), c.point.data(), w);
        l.weights(c.vertices.data(), c.point.data(), z);
        bool same = true;
        for (int j = 0; j < vertex_count(k.simplex); ++j) {
            same &= std::bit_cast<std::uint64_t>(w[j]) == std::bit_cast<std::uint64_t>(z[j]);
        }
        count += same ? 0 : 1;
    }
    return count;
}

TEST(Variants, DifferInBitsFromTheirBaseButForO0) {
    int fast_math = 0;
    for (const char* base : {"triangle.signed-area", "tetrahedron.signed-volume", "tetrahedron.two-cross-products",
                             "tetrahedron.cramer"}) {
        fast_math += different(base, ".fast-math");
        if (find(std::string(base) + ".contracted") != nullptr) {
            EXPECT_GT(different(base, ".contracted"), 500) << base;
        }
        // With double evaluated as double, optimisation without -ffast-math may not change a bit.
        if (FLT_EVAL_METHOD == 0) {
            EXPECT_EQ(different(base, ".O0"), 0) << base;
        }
    }
    // Not each of them: GCC 12 leaves the three quotients of triangle.signed-area alone, Clang 14 does not.
    EXPECT_GT(fast_math, 1000);
}

/// A fused ab - cd with equal products is the rounding error of one of them. At its own vertex a triangle's areas are
/// such differences: the base kernel finds them exactly zero.
TEST(Variants, ContractionBreaksVerticesThatTheBaseGetsRight) {
    constexpr std::string_view contracted = "triangle.signed-area.contracted";
    if (find(std::string(contracted)) == nullptr) GTEST_SKIP() << "no FMA on this CPU";
    for (const BreakingCase& b : breaking_cases) {
        if (std::none_of(b.kernels.begin(), b.kernels.end(), [](std::string_view k) { return k == contracted; }))
            continue;
        double w[3];
        ASSERT_EQ(find("triangle.signed-area")->weights(b.vertices.data(), b.point.data(), w), 0);
        EXPECT_EQ(claimed_region(*find("triangle.signed-area"), 0, w), Region::boundary);
    }
}

/// A library linked with -ffast-math would have switched subnormals off for the whole process.
TEST(Variants, FastMathDoesNotLeak) {
    volatile double min = 0x1p-1074;
    EXPECT_GT(min * 2, 0.0);
    EXPECT_EQ(min / 0x1p-1073, 0.5);
}

}  // namespace
}  // namespace barycert
