#include "core/base/ulp.hpp"

#include <gmpxx.h>

#include <array>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "tests/audit/exact/second_path.hpp"
#include "tests/limits.hpp"

namespace barycert {
namespace {

TEST(UlpExponent, AtTheEndsOfBinades) {
    EXPECT_EQ(base::ulp_exponent(1), -52);
    EXPECT_EQ(base::ulp_exponent(-1), -52);
    EXPECT_EQ(base::ulp_exponent(0x1.fffffffffffffp+0), -52);
    EXPECT_EQ(base::ulp_exponent(0x1.fffffffffffffp-1), -53);
    EXPECT_EQ(base::ulp_exponent(2), -51);
    EXPECT_EQ(base::ulp_exponent(testing::max_double), 971);
    EXPECT_EQ(base::ulp_exponent(0x1p-1022), -1074);  // the last normal and all below share one ulp
    EXPECT_EQ(base::ulp_exponent(0x1p-1021), -1073);
    EXPECT_EQ(base::ulp_exponent(0x0.fffffffffffffp-1022), -1074);
    EXPECT_EQ(base::ulp_exponent(0x1p-1074), -1074);
    EXPECT_EQ(base::ulp_exponent(0), -1074);
    EXPECT_EQ(base::ulp_exponent(-0.0), -1074);
}

TEST(UlpError, ByHand) {
    EXPECT_EQ(base::ulp_error(1, 1), 0);
    EXPECT_EQ(base::ulp_error(1 + 0x1p-52, 1), 1);
    EXPECT_EQ(base::ulp_error(1 - 0x1p-53, 1), 0.5);  // below a power of two the doubles lie twice as dense
    EXPECT_EQ(base::ulp_error(1, 1 - 0x1p-53), 1);
    EXPECT_EQ(base::ulp_error(-1, 1), 0x1p+53);
    EXPECT_EQ(base::ulp_error(0, 1), 0x1p+52);
    EXPECT_EQ(base::ulp_error(0, 0x1p-1074), 1);
    EXPECT_EQ(base::ulp_error(-0x1p-1074, 0x1p-1074), 2);
    EXPECT_EQ(base::ulp_error(0x0.fffffffffffffp-1022, 0x1p-1022), 1);
    EXPECT_EQ(base::ulp_error(testing::max_double, -testing::max_double),
              0x1.fffffffffffffp+53);  // the plain difference would overflow
    EXPECT_EQ(base::ulp_error(testing::max_double, 0x1p-1074), testing::max_double);  // the quotient does
    EXPECT_EQ(base::ulp_error(0, testing::max_double), 0x1.fffffffffffffp+52);
}

double random_finite(base::Random& r) {
    while (true) {
        const auto x = std::bit_cast<double>(r.bits());
        if (std::isfinite(x)) return x;
    }
}

/// |computed - reference| / ulp(reference), rounded once and kept below infinity. The ulp by its definition.
double exact_error(double computed, double reference) {
    using second_path::Q;
    int exponent = 1023;
    while (exponent > -1022 && cmp(abs(Q(reference)), second_path::power_of_two(exponent)) < 0) --exponent;
    const Q error = abs(Q(Q(computed) - Q(reference))) / second_path::power_of_two(exponent - 52);
    return std::min(second_path::nearest(error), testing::max_double);
}

// Any two doubles; neighbours; across binades; subnormals. Catches a difference that is rounded twice.
TEST(UlpError, IsExactButForOneRounding) {
    for (int k = 0; k < 6000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("ulp"), static_cast<std::uint64_t>(k));
        double reference = random_finite(r), computed = random_finite(r);
        switch (r.integer(0, 5)) {
            case 0:  // a few ulps away
                computed = std::bit_cast<double>(std::bit_cast<std::uint64_t>(reference) ^ r.below(16));
                break;
            case 1:  // within a few binades
                computed = std::ldexp(reference, r.integer(-3, 3)) + reference * 0x1p-30;
                break;
            case 2:  // about the smallest normal
                reference = std::ldexp(r.uniform(-1, 1), -1000 - r.integer(0, 70));
                computed = std::ldexp(r.uniform(-1, 1), -990 - r.integer(0, 80));
                break;
            case 3:  // about the testing::max_double
                reference = std::ldexp(r.uniform(1, 2), 1023 - r.integer(0, 3));
                computed = -std::ldexp(r.uniform(1, 2), 1023 - r.integer(0, 60));
                break;
            case 4:  // around a power of two
                reference = std::ldexp(1, r.integer(-1074, 1023));
                computed = r.coin() ? std::nextafter(reference, 0) : std::nextafter(reference, HUGE_VAL);
                break;
            default:
                break;
        }
        if (!std::isfinite(computed) || reference == 0) continue;
        ASSERT_EQ(base::ulp_error(computed, reference), exact_error(computed, reference))
            << base::hexadecimal(computed) << ' ' << base::hexadecimal(reference);
    }
}

// Half of an odd subnormal is no double. Catches halves taken where nothing overflows: the difference of these is a
// tie only if the last bit of the reference is lost.
TEST(UlpError, KeepsTheLastBitOfASubnormalReference) {
    for (const double computed : {0x1p-998, 0x1p-999, 0x1p-1000}) {
        for (int k = 0; k < 40; ++k) {
            const double reference = std::ldexp(1, -1074 + k) + 0x1p-1074;
            ASSERT_EQ(base::ulp_error(computed, reference), exact_error(computed, reference)) << k;
            ASSERT_EQ(base::ulp_error(-computed, reference), exact_error(-computed, reference)) << k;
        }
    }
}

TEST(Neighbours, NextUpAndDown) {
    EXPECT_EQ(base::next_up(1), 1 + 0x1p-52);
    EXPECT_EQ(base::next_down(1), 1 - 0x1p-53);
    EXPECT_EQ(base::next_up(0), 0x1p-1074);
    EXPECT_EQ(base::next_down(0), -0x1p-1074);
    EXPECT_EQ(base::next_up(testing::max_double), HUGE_VAL);
    EXPECT_EQ(base::next_down(-testing::max_double), -HUGE_VAL);
    EXPECT_EQ(base::next_up(-0x1p-1074), 0);
}

}  // namespace
}  // namespace barycert
