#include "barycert/environment.hpp"

#include <cfenv>

#include <gtest/gtest.h>

#ifdef __SSE2__
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

namespace barycert {
namespace {

/// Sets a rounding mode for as long as it lives.
class Rounding {
public:
    explicit Rounding(int mode) : before_(std::fegetround()) { std::fesetround(mode); }
    ~Rounding() { std::fesetround(before_); }
    Rounding(const Rounding&) = delete;
    Rounding& operator=(const Rounding&) = delete;

private:
    int before_;
};

TEST(Environment, NormalStateIsFitForExactness) {
    const Environment e = measure_environment();
    EXPECT_EQ(e.rounding, "nearest");
    EXPECT_FALSE(e.flush_to_zero);
    EXPECT_FALSE(e.contraction);
    EXPECT_FALSE(e.excess_precision);
    EXPECT_FALSE(e.simd.empty());
    EXPECT_FALSE(e.compiler.empty());
    EXPECT_FALSE(e.version.empty());
    EXPECT_GE(e.hardware_threads, 1);
    EXPECT_TRUE(check_environment(e));
}

// The mode is measured, not asked for, and named; nothing else is blamed for it. Catches contraction or excess
// precision inferred from results that are merely rounded another way.
TEST(Environment, OtherRoundingModesAreFoundAndNamed) {
    const std::pair<int, const char*> modes[] = {
        {FE_UPWARD, "upward"}, {FE_DOWNWARD, "downward"}, {FE_TOWARDZERO, "toward-zero"}};
    for (const auto& [mode, text] : modes) {
        Environment e;
        {
            const Rounding set(mode);
            e = measure_environment();
        }
        EXPECT_EQ(e.rounding, text);
        EXPECT_FALSE(e.flush_to_zero) << text;
        EXPECT_FALSE(e.contraction) << text;
        EXPECT_FALSE(e.excess_precision) << text;
        const Status status = check_environment(e);
        ASSERT_FALSE(status) << text;
        EXPECT_EQ(status.error().found, std::string("rounding ") + text);
        EXPECT_FALSE(status.error().remedy.empty());
    }
    EXPECT_EQ(measure_environment().rounding, "nearest");
}

#ifdef __SSE2__
// Catches only results, or only operands, being looked at: each flag is set alone.
TEST(Environment, FlushedSubnormalsAreFound) {
    const unsigned before = _mm_getcsr();
    const auto measured = [before](unsigned flags) {
        _mm_setcsr(before | flags);
        const Environment e = measure_environment();
        _mm_setcsr(before);
        return e;
    };
    for (const unsigned flags : {_MM_FLUSH_ZERO_ON, _MM_DENORMALS_ZERO_ON, _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON}) {
        const Environment e = measured(flags);
        EXPECT_TRUE(e.flush_to_zero) << flags;
        EXPECT_EQ(e.rounding, "nearest");
        const Status status = check_environment(e);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().found, "subnormal numbers flushed to zero");
    }
    EXPECT_FALSE(measure_environment().flush_to_zero);
}
#endif

TEST(Environment, WhatTheCodeWasCompiledToIsNamedToo) {
    Environment e = measure_environment();
    e.contraction = true;
    ASSERT_FALSE(check_environment(e));
    EXPECT_EQ(check_environment(e).error().found, "a * b + c contracted");
    e.contraction = false;
    e.excess_precision = true;
    ASSERT_FALSE(check_environment(e));
    EXPECT_EQ(check_environment(e).error().found, "excess precision");
}

}  // namespace
}  // namespace barycert
