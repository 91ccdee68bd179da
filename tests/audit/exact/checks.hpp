/// One case held against the second path, and two answers against each other, bit for bit.
#pragma once

#include <gtest/gtest.h>

#include "barycert/oracle.hpp"
#include "tests/audit/exact/cases.hpp"
#include "tests/audit/exact/second_path.hpp"

namespace barycert::exact {

/// Equal bits; NaNs only have to be NaN.
inline void expect_same_bits(double got, double expected, std::string_view what) {
    if (std::isnan(expected)) {
        EXPECT_TRUE(std::isnan(got)) << what;
    } else {
        EXPECT_EQ(testing_cases::bits(got), testing_cases::bits(expected))
            << what << ": " << base::hexadecimal(got) << " instead of " << base::hexadecimal(expected);
    }
}

inline void expect_same(const OracleAnswer& a, const OracleAnswer& b) {
    EXPECT_EQ(a.region, b.region);
    EXPECT_EQ(a.feature, b.feature);
    EXPECT_EQ(a.support, b.support);
    EXPECT_EQ(a.signs, b.signs);
    for (std::size_t i = 0; i < 4; ++i) expect_same_bits(a.weights[i], b.weights[i], "weight");
    expect_same_bits(a.value, b.value, "value");
}

/// The answer that the oracle should give, from the exact weights of the second path.
inline OracleAnswer expected_answer(const Case& c, const std::optional<std::vector<second_path::Q>>& exact) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    OracleAnswer a;
    if (!exact) {
        a.region = Region::degenerate;
        a.feature = Feature::degenerate;
        a.weights.fill(nan);
        a.value = nan;
        return a;
    }
    second_path::Q value(0);
    int zeros = 0, negative = 0;
    for (std::size_t i = 0; i < exact->size(); ++i) {
        const auto& w = (*exact)[i];
        a.signs[i] = static_cast<std::int8_t>(sgn(w));
        a.weights[i] = second_path::nearest(w);
        if (w == 0) ++zeros;
        if (w < 0) ++negative;
        if (w != 0) a.support = static_cast<std::uint8_t>(a.support + (1 << i));
        value += w * second_path::Q(c.values[i]);
    }
    a.value = second_path::nearest(value);
    a.region = negative > 0 ? Region::outside : zeros > 0 ? Region::boundary : Region::interior;
    const bool solid = c.simplex == Simplex::tetrahedron;
    if (a.region == Region::outside) {
        a.feature = Feature::outside;
    } else if (a.region == Region::interior) {
        a.feature = Feature::interior;
    } else if (zeros + 1 == static_cast<int>(exact->size())) {
        a.feature = Feature::vertex;
    } else {
        a.feature = solid && zeros == 1 ? Feature::face : Feature::edge;
    }
    return a;
}

/// Everything ask_oracle() says of a case, by both widths. Returns the answer for tallies.
inline OracleAnswer check(const Case& c) {
    SCOPED_TRACE(testing_cases::describe(c));
    const OracleAnswer a = ask_oracle(c);
    expect_same(a, ask_wide(c));
    expect_same(a, expected_answer(c, second_path::weights(c)));
    EXPECT_EQ(affine_dimension(c), second_path::affine_dimension(c));
    return a;
}

}  // namespace barycert::exact
