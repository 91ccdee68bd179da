// Where the error of one value is counted.

#include "mesh/verify/errors.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace barycert::verify {
namespace {

/// The bin of an error of that size, in parts of a range of 1.
std::size_t bin_of(double error) {
    ValueErrors to;
    const VerifyOptions options;
    count(compare(error, 0, 1), error, options, to);
    EXPECT_EQ(std::accumulate(to.by_relative.begin(), to.by_relative.end(), std::uint64_t{0}), 1U);
    for (std::size_t bin = 0; bin < to.by_relative.size(); ++bin) {
        if (to.by_relative[bin] != 0) return bin;
    }
    return to.by_relative.size();
}

// by_relative[k]: 10^(k-19) <= relative < 10^(k-18). Edges that are made by multiplying drift off these powers.
TEST(VerifyErrors, APowerOfTenIsCountedWithTheLargerErrors) {
    const std::array<double, 20> powers{1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8,
                                        1e-7,  1e-6,  1e-5,  1e-4,  1e-3,  1e-2,  1e-1,  1e0,   1e1,  1e2};
    for (std::size_t i = 0; i < powers.size(); ++i) {
        EXPECT_EQ(bin_of(powers[i]), i + 2) << powers[i];
        EXPECT_EQ(bin_of(std::nextafter(powers[i], 0)), i + 1) << powers[i];
    }
}

TEST(VerifyErrors, AnErrorThatUnderflowsIsNoRightValue) {
    ValueErrors to;
    count(compare(5e-324, 0, 1e300), 5e-324, {}, to);
    EXPECT_EQ(to.by_relative[0], 0U);
    EXPECT_EQ(to.by_relative[1], 1U);
}

}  // namespace
}  // namespace barycert::verify
