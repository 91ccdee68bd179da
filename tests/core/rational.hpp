/// References for tests of the exact core: GMP's numbers, and rounding by its definition alone.
#pragma once

#include <gmpxx.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "core/integer.hpp"

namespace barycert::testing_rational {

using core::Fixed;
using core::Integer;

using Q = mpq_class;
using Z = mpz_class;

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double max = std::numeric_limits<double>::max();

inline std::uint64_t bits(double x) {
    return std::bit_cast<std::uint64_t>(x);
}

inline Z limbs(const std::uint64_t* words, int count) {
    Z z;
    mpz_import(z.get_mpz_t(), static_cast<std::size_t>(count), -1, 8, 0, 0, words);
    return z;
}

inline Z number(const Integer& x) {
    const Z magnitude = limbs(x.magnitude().data(), static_cast<int>(x.magnitude().size()));
    return x.sign() < 0 ? Z(-magnitude) : magnitude;
}

template <int N>
Z number(const Fixed<N>& x) {
    const Z z = limbs(x.limbs.data(), N);
    return x.limbs[N - 1] >> 63 != 0 ? Z(z - (Z(1) << (64 * N))) : z;
}

/// x * 2^exponent.
inline Q scaled_by(const Q& x, int exponent) {
    Q r;
    if (exponent >= 0) {
        mpq_mul_2exp(r.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
    } else {
        mpq_div_2exp(r.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
    }
    return r;
}

/// A double, or for infinity the number that rounding takes it for.
inline Q rational(double x) {
    return std::isinf(x) ? Q((x < 0 ? -1 : 1) * (Z(1) << 1024)) : Q(x);
}

/// r is the double nearest to `exact`: none of its neighbours is nearer, and in a tie it is the even one. An exact zero
/// is +0, what underflows keeps its sign.
inline ::testing::AssertionResult nearest(double r, const Q& exact) {
    const auto wrong = [&](const char* what) {
        return ::testing::AssertionFailure() << base::hexadecimal(r) << " is not the rounding of about "
                                             << base::hexadecimal(exact.get_d()) << ": " << what;
    };
    if (std::isnan(r)) return wrong("not a number");
    if (exact == 0) return bits(r) == 0 ? ::testing::AssertionSuccess() : wrong("zero should be +0");
    if (std::signbit(r) != (exact < 0)) return wrong("sign");
    const Q distance = abs(Q(rational(r) - exact));
    for (const double direction : {-infinity, infinity}) {
        const double neighbour = std::isinf(r) ? std::copysign(max, r) : std::nextafter(r, direction);
        const int order = cmp(distance, abs(Q(rational(neighbour) - exact)));
        if (order > 0 && (!std::isinf(r) || abs(exact) < rational(infinity))) return wrong("a neighbour is nearer");
        if (order == 0 && bits(r) % 2 != 0) return wrong("tie to odd");
    }
    return ::testing::AssertionSuccess();
}

/// A word that long carries, borrows and runs of zeros are made of.
inline std::uint64_t awkward_word(base::Random& r) {
    switch (r.integer(0, 5)) {
        case 0:
            return 0;
        case 1:
        case 2:
            return ~std::uint64_t{0};
        case 3:
            return std::uint64_t{1} << r.integer(0, 63);
        default:
            return r.bits();
    }
}

/// An integer of at most `size` limbs.
inline Integer awkward_integer(base::Random& r, int size) {
    std::uint64_t words[Integer::capacity];
    const bool ones = r.integer(0, 3) == 0;
    for (int i = 0; i < size; ++i) words[i] = ones ? ~std::uint64_t{0} : awkward_word(r);
    return Integer(r.coin(), {words, static_cast<std::size_t>(size)});
}

/// Any finite double, as likely as another.
inline double any_finite(base::Random& r) {
    while (true) {
        const auto x = std::bit_cast<double>(r.bits());
        if (std::isfinite(x)) return x;
    }
}

}  // namespace barycert::testing_rational
