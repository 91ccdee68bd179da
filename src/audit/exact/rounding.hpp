/// Doubles as integers: every double is m * 2^e, so a set of doubles is a set of integers times one power of two. And
/// exact numbers rounded to the nearest double, ties to even, subnormals and overflow included.
///
/// The number type is Boost.Multiprecision's cpp_int, which CGAL supports as a number type of its own
/// (CGAL/boost_mp.h). Times of CGAL's number types for four signs of (point, tetrahedron): Mpzf 1.7 us, cpp_int 2.1 us,
/// gmp_int 3.9 us, Gmpz 6.1 us, Gmpq 12.3 us, Epeck 17.7 us; but most meshes need no more than 61 bits a coordinate,
/// and there machine words and a fixed-width cpp_int do the same in a fraction of that. So one algorithm is compiled
/// for two sets of types, `Narrow` and `Wide`.
#pragma once

#include <CGAL/boost_mp.h>

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>

namespace barycert::exact {

namespace mp = boost::multiprecision;

/// Any integer. 1024 bits stand in place, more go to the heap.
using BigInteger = mp::number<mp::cpp_int_backend<1024, 0, mp::signed_magnitude, mp::unchecked>, mp::et_off>;

/// An integer of at most 512 bits; the bounds that make this enough stand at the place of use (oracle.cpp).
using FixedInteger = mp::number<mp::cpp_int_backend<512, 512, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;

__extension__ using Int128 = __int128;
__extension__ using UInt128 = unsigned __int128;

/// A double taken apart: x = mantissa * 2^exponent, the mantissa odd; zero is 0 * 2^0.
struct Dyadic {
    std::int64_t mantissa = 0;
    int exponent = 0;
    int length = 0;  ///< bits of |mantissa|
};

/// Requires: x finite.
inline Dyadic dyadic(double x) {
    const auto word = std::bit_cast<std::uint64_t>(x);
    const int biased = static_cast<int>((word >> 52) & 0x7ff);
    std::uint64_t m = word & 0xfffffffffffffULL;
    if (biased != 0) m |= 0x10000000000000ULL;
    if (m == 0) return {};
    const int zeros = std::countr_zero(m);
    m >>= zeros;
    const auto magnitude = static_cast<std::int64_t>(m);
    return {(word >> 63) != 0 ? -magnitude : magnitude, (biased == 0 ? 1 : biased) - 1075 + zeros,
            static_cast<int>(std::bit_width(m))};
}

/// The span of exponents that a set of doubles needs.
struct Scale {
    int low = 0;   ///< every number of the set is an integer times 2^low
    int high = 0;  ///< and less than 2^high in magnitude
    bool empty = true;

    void include(double x) {
        const Dyadic d = dyadic(x);
        if (d.mantissa != 0) include(Scale{d.exponent, d.exponent + d.length, false});
    }
    void include(const Scale& other) {
        if (other.empty) return;
        low = empty || other.low < low ? other.low : low;
        high = empty || other.high > high ? other.high : high;
        empty = false;
    }
    int bits() const { return high - low; }
};

/// x / 2^low as an integer. Requires: x is a multiple of 2^low; for std::int64_t also |x| < 2^(low + 62).
template <class Integer>
Integer scaled(double x, int low) {
    const Dyadic d = dyadic(x);
    if (d.mantissa == 0) return Integer(0);
    if constexpr (sizeof(Integer) <= sizeof(Int128)) {
        return static_cast<Integer>(d.mantissa * (std::int64_t{1} << (d.exponent - low)));
    } else {
        return Integer(d.mantissa) << static_cast<unsigned>(d.exponent - low);
    }
}

/// Position of the part of a number below its last kept bit, as far as it is known.
enum class Tail : std::uint8_t {
    zero,
    positive,  ///< in (0, 1)
    unknown,   ///< in (-2^-5, 1)
};

/// Rounds (q + t) * 2^exponent with t described by `tail`. Requires: q >= 2^54.
/// Nothing is returned where an unknown tail would decide.
inline std::optional<double> round_scaled(std::uint64_t q, Tail tail, int exponent) {
    const int length = static_cast<int>(std::bit_width(q));
    const int top = length - 1 + exponent;  // 2^top <= value < 2^(top + 1)
    if (top > 1023) return std::numeric_limits<double>::infinity();
    const int kept = top >= -1022 ? 53 : 53 - (-1022 - top);  // bits that a double has there; below 1 if it underflows
    const int dropped = length - kept;                        // at least 2
    if (dropped > length) return 0.0;                         // less than half of the smallest subnormal
    // As q >= 2^54, dropped >= 2. NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult)
    const std::uint64_t half = std::uint64_t{1} << (dropped - 1);
    const std::uint64_t rest = q & (2 * half - 1);
    std::uint64_t m = dropped == 64 ? 0 : q >> dropped;
    if (rest == half && tail == Tail::unknown) return std::nullopt;
    if (rest > half || (rest == half && (tail == Tail::positive || (m & 1) != 0))) ++m;
    return std::ldexp(static_cast<double>(m), dropped + exponent);  // m <= 2^53: exact, or infinity as it should be
}

/// Bits of |n|. Requires: n != 0.
inline int bit_length(const auto& n) {
    const auto& b = n.backend();
    static_assert(sizeof(*b.limbs()) == 8, "limbs of 64 bits");
    return static_cast<int>(64 * b.size()) - std::countl_zero(static_cast<std::uint64_t>(b.limbs()[b.size() - 1]));
}

/// The leading `bits` (at most 128) bits of |n|; shorter ones are filled up with zeros from the right. `shift` becomes
/// the power of two left out: |n| = (result + rest) * 2^shift, 0 <= rest < 1, and rest = 0 if shift <= 0. Requires:
/// n != 0. Reads the limbs in place, for speed.
template <class Integer>
UInt128 leading_bits(const Integer& n, int bits, int& shift) {
    const auto& b = n.backend();
    shift = bit_length(n) - bits;
    const auto limb = [&](int i) {
        return i < static_cast<int>(b.size()) ? static_cast<std::uint64_t>(b.limbs()[i]) : 0;
    };
    const auto two = [&](int i) { return (static_cast<UInt128>(limb(i + 1)) << 64) | limb(i); };
    if (shift <= 0) return two(0) << -shift;
    const int first = shift / 64, offset = shift % 64;
    const UInt128 low = two(first) >> offset;
    return offset == 0 ? low : low | (static_cast<UInt128>(limb(first + 2)) << (128 - offset));
}

/// (numerator / denominator) * 2^exponent, correctly rounded. Requires: denominator != 0.
///
/// First from leading bits: n in [n', n'+1) 2^a with 2^118 <= n' < 2^119 and d in [d', d'+1) 2^b with 2^62 <= d' <
/// 2^63. With q = floor(n'/d'), which has 56 or 57 bits, the quotient x = (n/d) 2^(b-a) obeys
///     x < (n'+1)/d' <= q + 1   and   x > n'/(d'+1) > n'/d' - n'/d'^2 > q - 2^-5.
/// To 53 bits or fewer, all numbers of (q - 2^-5, q + 1) round alike unless q itself is a tie; only then is the long
/// division done.
template <class Integer>
double round_quotient(const Integer& numerator, const Integer& denominator, int exponent = 0) {
    const int sign = numerator.sign() * denominator.sign();
    if (sign == 0) return 0.0;
    int a = 0, b = 0;
    const UInt128 n_lead = leading_bits(numerator, 119, a);
    const auto d_lead = static_cast<std::uint64_t>(leading_bits(denominator, 63, b));
    // The first of the 63 bits of d_lead is 1. NOLINTNEXTLINE(clang-analyzer-core.DivideZero)
    const auto lead = static_cast<std::uint64_t>(n_lead / d_lead);
    if (const auto r = round_scaled(lead, Tail::unknown, a - b + exponent)) return sign < 0 ? -*r : *r;
    Integer n = abs(numerator);
    Integer d = abs(denominator);
    // floor(n 2^k / d) with k such that it has 55 or 56 bits, and whether anything is left.
    const int k = 55 - (bit_length(n) - bit_length(d));
    (k >= 0 ? n : d) <<= static_cast<unsigned>(std::abs(k));
    Integer q, r;
    mp::divide_qr(n, d, q, r);
    const double result =
        *round_scaled(static_cast<std::uint64_t>(q), r.sign() == 0 ? Tail::zero : Tail::positive, exponent - k);
    return sign < 0 ? -result : result;
}

/// sqrt(numerator / denominator) * 2^exponent, correctly rounded. Requires: numerator >= 0, denominator > 0.
///
/// floor(sqrt(x)) = floor(sqrt(floor(x))), so the integer root of the shifted quotient is the truncated root, and it
/// is exact only if neither the division nor the root left a rest.
inline double round_root(const BigInteger& numerator, const BigInteger& denominator, int exponent = 0) {
    if (numerator.sign() == 0) return 0.0;
    int k = 112 - (bit_length(numerator) - bit_length(denominator));
    if (k % 2 != 0) ++k;  // an even shift halves cleanly
    BigInteger n = numerator, d = denominator;
    (k >= 0 ? n : d) <<= static_cast<unsigned>(std::abs(k));
    BigInteger q, r, rest;
    mp::divide_qr(n, d, q, r);
    const BigInteger root = mp::sqrt(q, rest);
    const bool exact = r.sign() == 0 && rest.sign() == 0;
    return *round_scaled(static_cast<std::uint64_t>(root), exact ? Tail::zero : Tail::positive, exponent - k / 2);
}

}  // namespace barycert::exact
