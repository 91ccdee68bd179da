#include "barycert/sample/quantity/length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/base/strict_math.hpp"

namespace barycert::sample {

// u = 2^-53, n components, m the largest magnitude, scaled so that 2^-500 <= m <= 2^500. That is exact: where m is
// scaled down, what a small component loses is below 2^-1074, while m > 2^-100.
//
// The sum S of squares as high + low: products and sums of two terms are exact but for the remainders of products below
// 2^-969, each off by at most 2^-1074, where S >= 2^-1000: n 2^-74 S at most. `low` sums 2 n - 1 terms of at most u S
// in plain double: off by at most (2 n)^2 u^2 S. So (high + low) is S (1 + e) with |e| <= n 2^-74 + 4 n^2 u^2.
//
// r = sqrt(high) (1 + d), |d| <= u. The remainder high - r^2 is a double, and r + (high - r^2 + low) / (2 r), the first
// step of Newton's method, is off by (high - r^2 + low)^2 / (8 r^3) and the roundings of its second term, which is at
// most 3 u r: less than 16 u^2 r in all, before the last sum is rounded. With n <= 2^20 that is 2^-53 u r and what
// comes of e, less than 2^-20 units in the last place. Beyond the normal numbers the last product rounds once more, to
// the same unit: by half of it.
//
// Of a vector whose components are correctly rounded, each is off by at most u of itself, or 2^-1075 where it is
// subnormal, so the length is off by u of itself, which is less than one unit in the last place, or sqrt(n) 2^-1075.
// With n <= 9 that is 1.5 subnormal units: together with the last rounding less than 1.51 units where the length is not
// subnormal, else at most 2.
double euclidean_length(std::span<const double> v) {
    double max = 0;
    bool nan = false;
    for (const double x : v) {
        nan = nan || std::isnan(x);
        max = std::max(max, std::abs(x));
    }
    if (nan) return std::numeric_limits<double>::quiet_NaN();
    if (max == 0 || std::isinf(max)) return max;
    const double scale = max < 0x1p-500 ? 0x1p600 : max > 0x1p500 ? 0x1p-600 : 1, back = 1 / scale;
    double high = 0, low = 0;
    for (const double x : v) {
        const double s = x * scale, square = s * s;
        const double sum = high + square, part = sum - high;
        low += (high - (sum - part)) + (square - part);
        low += std::fma(s, s, -square);
        high = sum;
    }
    const double r = std::sqrt(high);
    const double correction = (std::fma(-r, r, high) + low) / (2 * r);
    return (r + correction) * back;
}

}  // namespace barycert::sample
