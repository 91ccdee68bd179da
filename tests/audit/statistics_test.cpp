#include "barycert/audit.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace barycert::audit {
namespace {

TEST(LogHistogram, SmallIntegersAreExact) {
    for (int n = 0; n <= 16; ++n) {
        LogHistogram h;
        h.add(n);
        EXPECT_EQ(h.quantile(1), n);
    }
}

TEST(LogHistogram, EmptyHasNoQuantile) {
    EXPECT_EQ(LogHistogram().quantile(0.5), -1);
}

TEST(LogHistogram, QuantilesCount) {
    LogHistogram h;
    for (int i = 0; i < 999; ++i) h.add(1);
    h.add(1000);
    EXPECT_EQ(h.quantile(0.999), 1);
    EXPECT_EQ(h.quantile(1), 1024);  // bins above 16 are an eighth of an octave wide
    EXPECT_EQ(h.total(), 1000U);
}

// Never below the number, never over by more than an eighth of its power of two.
RC_GTEST_PROP(LogHistogram, EdgeIsTight, (unsigned char exponent, unsigned short mantissa)) {
    const double x = std::ldexp(1 + mantissa / 65536.0, exponent % 127);
    LogHistogram h;
    h.add(x);
    const double edge = h.quantile(1);
    RC_ASSERT(edge >= x);
    RC_ASSERT(edge - x <= std::ldexp(0.125, exponent % 127));
}

TEST(LogHistogram, HugeNumbersShareTheLastBin) {
    LogHistogram h;
    h.add(1e300);
    EXPECT_GE(h.quantile(1), 0x1p127);
}

TEST(WorstCase, EqualValuesKeepTheFirstCase) {
    WorstCase w;
    w.include(2, 7);
    w.include(2, 3);
    w.include(2, 9);
    w.include(1, 0);
    EXPECT_EQ(w.value, 2);
    EXPECT_EQ(w.index, 3U);
}

Comparison comparison(int seed) {
    Comparison r;
    r.claimed = all_regions[static_cast<std::size_t>(seed % 4)];
    r.counts[static_cast<std::size_t>(seed % 9)] = static_cast<std::uint8_t>(seed % 3);
    r.weight_ulps = {static_cast<double>(seed % 50), -1, static_cast<double>(seed % 7), -1};
    r.value_ulp = seed % 11;
    r.weight_error = seed % 13;
    return r;
}

// Merging parts in any order gives what adding one by one gives: results cannot depend on threads.
RC_GTEST_PROP(KernelStatistics, MergeIsAdd, (std::vector<unsigned short> seeds, unsigned char cut)) {
    KernelStatistics whole, left, right;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        const Region exact = all_regions[seeds[i] / 7 % 4];
        whole.add(comparison(seeds[i]), exact, i);
        (i % 256 < cut ? left : right).add(comparison(seeds[i]), exact, i);
    }
    right.merge(left);
    RC_ASSERT(right.cases == whole.cases);
    RC_ASSERT(right.wrong_cases == whole.wrong_cases);
    RC_ASSERT(right.counts == whole.counts);
    RC_ASSERT(right.confusion == whole.confusion);
    RC_ASSERT(right.weight_ulp.index == whole.weight_ulp.index);
    RC_ASSERT(right.value_ulp.value == whole.value_ulp.value);
    for (std::size_t i = 0; i < witness_reasons; ++i) {
        RC_ASSERT(right.witnesses[i].value == whole.witnesses[i].value);
        RC_ASSERT(right.witnesses[i].index == whole.witnesses[i].index);
    }
    for (const double q : {0.5, 0.9, 0.999}) RC_ASSERT(right.weight_ulps.quantile(q) == whole.weight_ulps.quantile(q));
}

}  // namespace
}  // namespace barycert::audit
