/// Internal: exact integers of a width known when compiling, for the frequent case of coordinates of like magnitude.
///
/// Two's complement in N limbs of 64 bits, no branches. A product has the limbs of both factors and cannot overflow; a
/// sum keeps its width, so that whoever adds has to show that there is room.
#pragma once

#include <array>
#include <cstdint>

#include "barycert/core/integer.hpp"

namespace barycert {

template <int N>
struct Fixed {
    std::array<std::uint64_t, N> limbs;  ///< the least significant first

    bool negative() const { return (limbs[N - 1] >> 63) != 0; }

    friend Fixed operator+(const Fixed& x, const Fixed& y) {
        Fixed r;
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < N; ++i) {
            const UInt128 t = static_cast<UInt128>(x.limbs[i]) + y.limbs[i] + carry;
            r.limbs[i] = static_cast<std::uint64_t>(t);
            carry = static_cast<std::uint64_t>(t >> 64);
        }
        return r;
    }

    friend Fixed operator-(const Fixed& x, const Fixed& y) {
        Fixed r;
        std::uint64_t borrow = 0;
        for (std::size_t i = 0; i < N; ++i) {
            const UInt128 t = static_cast<UInt128>(x.limbs[i]) - y.limbs[i] - borrow;
            r.limbs[i] = static_cast<std::uint64_t>(t);
            borrow = static_cast<std::uint64_t>(t >> 64) & 1;
        }
        return r;
    }
};

/// The unsigned product, less 2^(64 N) y if x is negative and 2^(64 M) x if y is: a negative number stands for itself
/// plus 2^(64 N).
template <int N, int M>
Fixed<N + M> operator*(const Fixed<N>& x, const Fixed<M>& y) {
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
    const auto subtract = [&r](std::uint64_t mask, const auto& what, std::size_t from, std::size_t count) {
        std::uint64_t borrow = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const UInt128 t = static_cast<UInt128>(r.limbs[from + i]) - (what.limbs[i] & mask) - borrow;
            r.limbs[from + i] = static_cast<std::uint64_t>(t);
            borrow = static_cast<std::uint64_t>(t >> 64) & 1;
        }
    };
    subtract(x.negative() ? ~std::uint64_t{0} : 0, y, N, M);
    subtract(y.negative() ? ~std::uint64_t{0} : 0, x, M, N);
    return r;
}

template <int N>
Integer to_integer(const Fixed<N>& x) {
    const Fixed<N> magnitude = x.negative() ? Fixed<N>{} - x : x;
    return Integer(x.negative(), magnitude.limbs.data(), N);
}

inline const Integer& to_integer(const Integer& x) {
    return x;
}

}  // namespace barycert
