/// Doubles as integers: every double is m * 2^e, so a set of doubles is a set of integers times one power of two.
///
/// The number type is Boost.Multiprecision's cpp_int, which CGAL supports as a number type of its own
/// (CGAL/boost_mp.h). Of CGAL's number types, measured on four signs of (point, tetrahedron): Mpzf 1.7 us, cpp_int 2.1
/// us, gmp_int 3.9 us, Gmpz 6.1 us, Gmpq 12.3 us, Epeck 17.7 us; but most meshes need no more than 61 bits a
/// coordinate, and there machine words and a fixed-width cpp_int do the same in a fraction of that. So one algorithm is
/// compiled for two sets of types, `Narrow` and `Wide`.
#pragma once

#include <CGAL/boost_mp.h>

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>

namespace barycert::exact {

namespace mp = boost::multiprecision;

/// Any integer. 1024 bits stand in place, more go to the heap.
using BigInteger = mp::number<mp::cpp_int_backend<1024, 0, mp::signed_magnitude, mp::unchecked>, mp::et_off>;

/// An integer of at most 512 bits; the bounds that make this enough stand at the place of use (solve.hpp).
using FixedInteger = mp::number<mp::cpp_int_backend<512, 512, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;

__extension__ using Int128 = __int128;
__extension__ using UInt128 = unsigned __int128;

/// A double taken apart: x = mantissa * 2^exponent, the mantissa odd; zero is 0 * 2^0.
struct Dyadic {
    std::int64_t mantissa = 0;
    int exponent = 0;
    int length = 0;  ///< bits of |mantissa|
};

/// Precondition: x finite.
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

/// x / 2^low as an integer. Preconditions: x is a multiple of 2^low; for std::int64_t also |x| < 2^(low + 62).
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

}  // namespace barycert::exact
