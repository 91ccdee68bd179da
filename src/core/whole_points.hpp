/// Points as whole numbers without a bound on their size, and quotients of such numbers as doubles: where what is
/// computed is rare, and of a high degree.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <memory>

#include "core/base/vectors.hpp"
#include "core/integer.hpp"
#include "core/scaled_double.hpp"

namespace barycert::core {

/// Without heap up to 512 bits: what most of them need.
using WholeNumber =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
                                      512, 0, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked,
                                      std::allocator<boost::multiprecision::limb_type>>,
                                  boost::multiprecision::et_off>;
using WholeVector = base::Vector3<WholeNumber>;

/// x as a multiple of the unit. Requires: it was added.
inline WholeNumber whole(double x, const Unit& unit) {
    const ScaledDouble parts = scaled(x);
    WholeNumber n = parts.mantissa;
    if (parts.mantissa != 0) n <<= static_cast<unsigned>(parts.exponent - unit.exponent);
    return parts.negative ? WholeNumber(-n) : n;
}

/// As whole multiples of 2^exponent().
class WholePoints {
public:
    WholePoints(std::initializer_list<const double*> points) {
        for (const double* const p : points) add(p);
    }
    void add(const double* p) {
        for (int k = 0; k < 3; ++k) unit_.add(p[k]);
    }
    /// Requires: it was added.
    WholeVector at(const double* p) const { return {whole(p[0], unit_), whole(p[1], unit_), whole(p[2], unit_)}; }
    int exponent() const { return unit_.power(); }

private:
    Unit unit_;
};

/// numerator / denominator * 2^exponent, correctly rounded. Requires: the denominator is positive.
template <class Number>
double rounded_quotient(Number numerator, Number denominator, int exponent) {
    if (numerator == 0) return 0;
    const bool negative = numerator < 0;
    if (negative) numerator = -numerator;
    // 63 or 64 bits of the quotient, and one more that tells whether anything was cut off.
    const int shift = 63 + static_cast<int>(msb(denominator)) - static_cast<int>(msb(numerator));
    (shift >= 0 ? numerator : denominator) <<= static_cast<unsigned>(std::abs(shift));
    Number quotient, rest;
    divide_qr(numerator, denominator, quotient, rest);
    const auto bits = static_cast<std::uint64_t>(quotient);
    const std::array<std::uint64_t, 2> limbs{bits << 1 | (rest != 0 ? 1U : 0U), bits >> 63};
    return round_integer(Integer(negative, limbs), exponent - shift - 1);
}

}  // namespace barycert::core
