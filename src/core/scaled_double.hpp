/// Finite doubles as integers times a power of two.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <type_traits>

#include "core/integer.hpp"

namespace barycert::core {

/// x = (-1)^negative * mantissa * 2^(exponent - 1074), the mantissa odd, or zero with an exponent of `none`.
struct ScaledDouble {
    static constexpr int none = 1 << 14;  ///< above all exponents, so that zeros do not count for the min

    std::uint64_t mantissa;
    int exponent;
    bool negative;
};

/// The parts of x, without branches. Requires: finite.
inline ScaledDouble scaled(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const int biased = static_cast<int>(bits >> 52 & 0x7ff);
    const std::uint64_t hidden = biased == 0 ? 0 : std::uint64_t{1} << 52;
    const std::uint64_t m = hidden | (bits & ((std::uint64_t{1} << 52) - 1));
    const int zeros = std::countr_zero(m | std::uint64_t{1} << 63);
    return {m >> zeros, m == 0 ? ScaledDouble::none : std::max(biased, 1) - 1 + zeros, (bits >> 63) != 0};
}

/// A unit for several numbers, the largest power of two of which all are multiples, and the width they need in it.
struct Unit {
    int exponent = ScaledDouble::none;  ///< the unit is 2^(exponent - 1074)
    int top = 0;                        ///< all numbers are below 2^(top - 1074)

    Unit(std::initializer_list<double> numbers = {}) {
        for (const double x : numbers) add(x);
    }
    void add(const ScaledDouble& x) {
        exponent = std::min(exponent, x.exponent);
        const int above = x.exponent + static_cast<int>(std::bit_width(x.mantissa));
        top = std::max(top, x.mantissa == 0 ? 0 : above);
    }
    void add(double x) { add(scaled(x)); }
    void add(const Unit& u) {
        exponent = std::min(exponent, u.exponent);
        top = std::max(top, u.top);
    }

    /// All numbers are below 2^bits() in this unit; below 1 if they are all zero.
    int bits() const { return top - exponent; }
    /// The power of two that the unit is; 0 if all numbers are zero.
    int power() const { return exponent == ScaledDouble::none ? 0 : exponent - 1074; }

    /// x as a multiple of this unit. Requires: x was added; Fixed<N> has more than bits() bits.
    template <class T>
    T multiple(const ScaledDouble& x) const {
        const int shift = x.mantissa == 0 ? 0 : x.exponent - exponent;
        if constexpr (std::is_same_v<T, Integer>) {
            return {x.negative, x.mantissa, shift};
        } else if constexpr (std::is_same_v<T, Fixed<1>>) {
            const std::uint64_t m = x.mantissa << shift;
            return {{x.negative ? 0 - m : m}};
        } else {
            const UInt128 m = static_cast<UInt128>(x.mantissa) << shift, value = x.negative ? 0 - m : m;
            return {{static_cast<std::uint64_t>(value), static_cast<std::uint64_t>(value >> 64)}};
        }
    }
    Integer integer(double x) const { return multiple<Integer>(scaled(x)); }
};

/// The width that the widest axis needs.
template <int count>
int max_bits(const Unit (&units)[count]) {
    int bits = 0;
    for (const Unit& u : units) bits = std::max(bits, u.bits());
    return bits;
}

/// f.operator()<T>() with the narrowest T of Fixed<1>, Fixed<2> and Integer that has `room` bits more than `bits`.
template <int room, class F>
decltype(auto) with_integers(int bits, F f) {
    if (bits <= 64 - room) return f.template operator()<Fixed<1>>();
    if (bits <= 128 - room) return f.template operator()<Fixed<2>>();
    return f.template operator()<Integer>();
}

/// Numbers on the axes of `count` points, as integers of type T in the unit of their axis: made when they are asked
/// for, as the widest fill the stack.
template <int count, int d, class T>
struct Lattice {
    const ScaledDouble (&parts)[count][d];
    const Unit (&units)[d];

    T at(int i, int k) const { return units[k].template multiple<T>(parts[i][k]); }
    /// The same numbers as integers of another type.
    template <class Other>
    Lattice<count, d, Other> in() const {
        return {parts, units};
    }
    /// Point i less point j. Inline, for GCC 12 folds the copies of different `count` into one and then warns of it.
    [[gnu::always_inline]] void difference(int i, int j, T (&out)[d]) const {
        for (int k = 0; k < d; ++k) out[k] = at(i, k) - at(j, k);
    }
};

/// Calls decide(lattice) with number(i, k) of point i on axis k as integers of the narrowest type that has `room` bits
/// more than they need: each axis in a unit of its own, or all in one.
template <int count, int d, int room = 3, class Number, class Decide>
auto with_lattice(Number number, bool common, Decide decide) {
    ScaledDouble parts[count][d];
    Unit units[d];
    for (int k = 0; k < d; ++k) {
        for (int i = 0; i < count; ++i) {
            parts[i][k] = scaled(number(i, k));
            units[k].add(parts[i][k]);
        }
    }
    if (common) {
        for (int k = 1; k < d; ++k) units[0].add(units[k]);
        std::fill_n(units, d, units[0]);
    }
    return with_integers<room>(max_bits(units), [&]<class T>() { return decide(Lattice<count, d, T>{parts, units}); });
}

}  // namespace barycert::core
