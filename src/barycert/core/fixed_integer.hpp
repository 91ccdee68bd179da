/// Exact integers of a width known when compiling, for the frequent case of coordinates of like magnitude.
///
/// Two's complement in N limbs of 64 bits, no branches. A product has the limbs of both factors and cannot overflow; a
/// sum keeps its width, so that whoever adds has to show that there is room.
#pragma once

#include <array>
#include <cstdint>

#include "barycert/core/integer.hpp"

namespace barycert::core {

template <int N>
struct Fixed {
    std::array<std::uint64_t, N> limbs;  ///< the least significant first

    bool negative() const { return (limbs[N - 1] >> 63) != 0; }

    [[gnu::always_inline]] friend inline Fixed operator+(const Fixed& x, const Fixed& y) {
        Fixed r;
        Carry carry = 0;
        for (std::size_t i = 0; i < N; ++i) r.limbs[i] = add_with_carry(x.limbs[i], y.limbs[i], carry);
        return r;
    }

    [[gnu::always_inline]] friend inline Fixed operator-(const Fixed& x, const Fixed& y) {
        Fixed r;
        Carry borrow = 0;
        for (std::size_t i = 0; i < N; ++i) r.limbs[i] = subtract_with_borrow(x.limbs[i], y.limbs[i], borrow);
        return r;
    }
};

/// The unsigned product, less 2^(64 N) y if x is negative and 2^(64 M) x if y is: a negative number stands for itself
/// plus 2^(64 N).
template <int N, int M>
[[gnu::always_inline]] inline Fixed<N + M> operator*(const Fixed<N>& x, const Fixed<M>& y) {
    Fixed<N + M> r{};
    for (std::size_t i = 0; i < N; ++i) {
        std::uint64_t carry = 0;
        for (std::size_t j = 0; j < M; ++j) {
            const UInt128 t = static_cast<UInt128>(x.limbs[i]) * y.limbs[j] + r.limbs[i + j] + carry;
            r.limbs[i + j] = static_cast<std::uint64_t>(t);
            carry = static_cast<std::uint64_t>(t >> 64);
        }
        r.limbs[i + M] = carry;
    }
    const std::uint64_t x_mask = x.negative() ? ~std::uint64_t{0} : 0, y_mask = y.negative() ? ~std::uint64_t{0} : 0;
    Carry borrow = 0;
    for (std::size_t i = 0; i < M; ++i)
        r.limbs[N + i] = subtract_with_borrow(r.limbs[N + i], y.limbs[i] & x_mask, borrow);
    borrow = 0;
    for (std::size_t i = 0; i < N; ++i)
        r.limbs[M + i] = subtract_with_borrow(r.limbs[M + i], x.limbs[i] & y_mask, borrow);
    return r;
}

/// The same number without a fixed width.
template <int N>
inline Integer as_integer(const Fixed<N>& x) {
    if (!x.negative()) return {false, x.limbs};
    const Fixed<N> magnitude = Fixed<N>{} - x;
    return {true, magnitude.limbs};
}
inline const Integer& as_integer(const Integer& x) {
    return x;
}

}  // namespace barycert::core
