#include "barycert/statistics.hpp"
#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

TEST(ErrorSizes, DecadesAreExact) {
    const double infinity = std::numeric_limits<double>::infinity();
    struct Row {
        double error;
        std::size_t bin;
    };
    for (const Row& row :
         {Row{0, 0}, Row{5e-324, 1}, Row{std::nextafter(1e-17, 0), 1}, Row{1e-17, 2}, Row{9.9e-17, 2}, Row{1e-16, 3},
          Row{0.099, 17}, Row{0.1, 18}, Row{1, 19}, Row{99, 20}, Row{100, 21}, Row{1e300, 21}, Row{infinity, 22}}) {
        ErrorSizes e;
        e.add(row.error, 7);
        EXPECT_EQ(e.counts[row.bin], 1U) << row.error;
        EXPECT_EQ(e.total(), 1U);
        EXPECT_EQ(e.unanswered(), row.bin == 22 ? 1U : 0U);
        EXPECT_EQ(e.worst.value, row.bin == 22 ? -1 : row.error);
        EXPECT_EQ(e.worst.index, row.bin == 22 ? 0U : 7U);
    }
    ErrorSizes none;
    none.add(-1, 0);
    EXPECT_EQ(none.total(), 0U);
    EXPECT_EQ(none.within(0.5), -1);
}

TEST(ErrorSizes, WithinIsTheEdgeThatTheShareReaches) {
    ErrorSizes e;
    for (int i = 0; i < 98; ++i) e.add(0, 0);
    EXPECT_EQ(e.within(1), 0);
    e.add(2e-16, 1);
    e.add(3, 2);
    EXPECT_EQ(e.within(0.98), 0);
    EXPECT_EQ(e.within(0.99), 1e-15);
    EXPECT_EQ(e.within(1), 10);
    e.add(std::numeric_limits<double>::infinity(), 3);
    EXPECT_EQ(e.within(1), 10) << "of the cases with an answer";
    e.add(1000, 3);
    EXPECT_EQ(e.within(1), std::numeric_limits<double>::infinity());
    ErrorSizes both = e;
    both.merge(e);
    EXPECT_EQ(both.total(), 204U);
    EXPECT_EQ(both.within(0.98), 1e-15);
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
