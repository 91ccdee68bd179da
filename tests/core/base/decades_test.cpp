#include "core/base/decades.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/text.hpp"

namespace barycert::base {
namespace {

TEST(Decades, EveryPowerOfTenBeginsABin) {
    for (std::size_t i = 0; i < decade_edges.size(); ++i) {
        const double edge = decade_edges[i];
        EXPECT_EQ(edge, parse_double("1e" + std::to_string(static_cast<int>(i) - 17)).value());
        EXPECT_EQ(decade_bin(edge), i + 2) << edge;
        EXPECT_EQ(decade_bin(std::nextafter(edge, 0)), i + 1) << edge;
    }
    EXPECT_EQ(decade_bin(5e-324), 1U);
    for (const double x : {1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(decade_bin(x), decade_bins - 1);
}

TEST(Decades, ALabelNamesTheUpperEdge) {
    EXPECT_EQ(decade_label(1), "< 1e-17");
    EXPECT_EQ(decade_label(18), "< 1e+00");
    EXPECT_EQ(decade_label(decade_bins - 1), ">= 100");
    for (std::size_t bin = 1; bin + 1 < decade_bins; ++bin)
        EXPECT_EQ(parse_double(decade_label(bin).substr(2)).value(), decade_edges[bin - 1]);
}

}  // namespace
}  // namespace barycert::base
