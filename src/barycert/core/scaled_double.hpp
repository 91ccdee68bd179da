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

/// The exponent fields of numbers that are to share a unit; subnormals count as 1, zeros not at all.
struct ExponentRange {
    int least = 2047, largest = 1;

    void add(double x) {
        const int exponent = std::max(biased_exponent(x), 1);
        largest = std::max(largest, exponent);
        least = std::min(least, x == 0 ? 2047 : exponent);
    }
    void add(const ExponentRange& r) {
        largest = std::max(largest, r.largest);
        least = std::min(least, r.least);
    }
};

/// By how much Fixed<N> shifts the significand of the largest number up: its magnitude is then below 2^(64 N - 3).
template <class T>
inline constexpr int headroom = std::is_same_v<T, Fixed<1>> ? 8 : 72;

/// The unit's exponent: x = aligned<T>(x, range, lost) * 2^aligned_unit<T>(range).
template <class T>
int aligned_unit(const ExponentRange& range) {
    return std::is_same_v<T, Integer> ? range.least - 1075 : range.largest - 1075 - headroom<T>;
}

/// x in the unit of its range. Fixed<N>: bits that would fall below the unit are added to `lost`, and the result is
/// then worthless. Integer: nothing is ever lost. Preconditions: x finite and counted in the range.
template <class T>
T aligned(double x, const ExponentRange& range, std::uint64_t& lost) {
    const std::uint64_t m = significand(x);
    const bool negative = std::signbit(x);
    const int exponent = std::max(biased_exponent(x), 1);
    if constexpr (std::is_same_v<T, Integer>) {
        return m == 0 ? Integer() : Integer(negative, m, exponent - range.least);
    } else {
        using Word = std::conditional_t<std::is_same_v<T, Fixed<1>>, std::uint64_t, UInt128>;
        const int shift = headroom<T> - (range.largest - exponent);
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

}  // namespace barycert
