/// Units in the last place.
///
/// ulp(x) is the distance of neighbouring doubles in x's binade: 2^(e-52) for 2^e <= |x| < 2^(e+1), and 2^-1074 for
/// zero and subnormals.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace barycert::base {

/// Exponent of ulp(x): ulp(x) = 2^ulp_exponent(x). Requires: x finite.
constexpr int ulp_exponent(double x) {
    const int biased = static_cast<int>((std::bit_cast<std::uint64_t>(x) >> 52) & 0x7ff);
    return std::max(biased, 1) - 1075;
}

/// |computed - reference| in ulps of the reference. Requires: both finite, reference != 0.
///
/// The subtraction is exact where the two lie within a factor of two (Sterbenz); elsewhere it is rounded once, so that
/// the result is the exact error rounded to nearest. Scaling by a power of two loses nothing: two doubles that differ
/// do so by at least half an ulp of either. A result over the largest double is reported as that double.
double ulp_error(double computed, double reference);

/// The same. Requires an ExactEnvironment of the caller's.
inline double ulp_error_here(double computed, double reference) {
    double difference = std::fabs(computed - reference);
    int shift = -ulp_exponent(reference);
    if (std::isinf(difference)) {  // both are huge then, and halving them is exact
        difference = std::fabs(computed * 0.5 - reference * 0.5);
        ++shift;
    }
    // A product with a power of two that is a normal number does what ldexp does, without the call.
    const double scaled = shift <= 1023 && shift >= -1022
                              ? difference * std::bit_cast<double>(static_cast<std::uint64_t>(shift + 1023) << 52)
                              : std::ldexp(difference, shift);
    return std::min(scaled, 0x1.fffffffffffffp+1023);
}

/// The next double above / below x. Requires: x finite.
double next_up(double x);
double next_down(double x);

/// The double `n` places above x in the order of doubles, in which zero is one place; infinite beyond the largest.
/// Requires: x finite, |n| < 2^62.
inline double places_above(double x, std::int64_t n) {
    const auto bits = std::bit_cast<std::int64_t>(x);
    const std::int64_t place = (bits >= 0 ? bits : std::numeric_limits<std::int64_t>::min() - bits) + n;
    constexpr std::int64_t infinite = 0x7ff0000000000000;
    if (place >= infinite) return HUGE_VAL;
    if (place <= -infinite) return -HUGE_VAL;
    return std::bit_cast<double>(place >= 0 ? place : std::numeric_limits<std::int64_t>::min() - place);
}

}  // namespace barycert::base
