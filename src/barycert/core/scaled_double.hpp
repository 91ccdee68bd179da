/// Internal: finite doubles as integers times a power of two.
#pragma once

#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "barycert/core/fixed_integer.hpp"
#include "barycert/core/integer.hpp"

namespace barycert {

/// The exponent field; a double is less than 2^(biased_exponent - 1022) and a multiple of 2^(max(it, 1) - 1075).
inline int biased_exponent(double x) {
    return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff);
}

/// The 53 bits of a finite double: |x| = significand * 2^(max(biased_exponent, 1) - 1075).
inline std::uint64_t significand(double x) {
    const std::uint64_t hidden = biased_exponent(x) == 0 ? 0 : std::uint64_t{1} << 52;
    return hidden | (std::bit_cast<std::uint64_t>(x) & ((std::uint64_t{1} << 52) - 1));
}

/// x in a unit that depends on `largest` alone, the greatest biased exponent among the numbers that share it.
///
/// Fixed<N>: |result| < 2^(64 N - 3), the significand of the largest number shifted up by 64 N - 56; bits that would
/// fall below the unit are added to `lost`, and the result is then worthless. Integer: the unit is 2^-1074, always
/// enough. Preconditions: x finite, biased_exponent(x) <= largest.
template <class T>
T aligned(double x, int largest, std::uint64_t& lost) {
    const std::uint64_t m = significand(x);
    const bool negative = std::signbit(x);
    const int exponent = std::max(biased_exponent(x), 1);
    if constexpr (std::is_same_v<T, Integer>) {
        return Integer(negative, m, exponent - 1);
    } else {
        constexpr int top = std::is_same_v<T, Fixed<1>> ? 8 : 72;
        using Word = std::conditional_t<std::is_same_v<T, Fixed<1>>, std::uint64_t, UInt128>;
        const int shift = top - (std::max(largest, 1) - exponent);
        const int down = std::min(std::max(-shift, 0), 63);
        lost |= m & ((std::uint64_t{1} << down) - 1);
        const Word magnitude = static_cast<Word>(m >> down) << std::max(shift, 0);
        const Word value = negative ? Word{0} - magnitude : magnitude;
        if constexpr (std::is_same_v<T, Fixed<1>>) {
            return {{value}};
        } else {
            return {{static_cast<std::uint64_t>(value), static_cast<std::uint64_t>(value >> 64)}};
        }
    }
}

/// mantissa * 2^exponent, the mantissa odd or zero.
struct ScaledDouble {
    std::uint64_t mantissa = 0;
    int exponent = INT_MAX;  ///< of zero: never the least of several
    bool negative = false;
};

/// The parts of x. Precondition: finite.
inline ScaledDouble scaled(double x) {
    const std::uint64_t m = significand(x);
    if (m == 0) return {};
    const int zeros = std::countr_zero(m);
    return {m >> zeros, std::max(biased_exponent(x), 1) - 1075 + zeros, std::signbit(x)};
}

/// x / 2^unit. Precondition: unit <= x.exponent.
inline Integer integer(const ScaledDouble& x, int unit) {
    return x.mantissa == 0 ? Integer() : Integer(x.negative, x.mantissa, x.exponent - unit);
}

}  // namespace barycert
