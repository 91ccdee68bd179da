/// Points as whole numbers without a bound on their size, and quotients of such numbers as doubles: where what is
/// computed is rare, and of a high degree.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <memory>

#include "barycert/base/vectors.hpp"
#include "barycert/core/quotient.hpp"
#include "barycert/core/scaled_double.hpp"

namespace barycert::core {

/// Without heap up to 512 bits: what most of them need.
using WholeNumber =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
                                      512, 0, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked,
                                      std::allocator<boost::multiprecision::limb_type>>,
                                  boost::multiprecision::et_off>;
using WholeVector = base::Vector3<WholeNumber>;

/// As whole multiples of 2^exponent().
class WholePoints {
public:
    WholePoints(std::initializer_list<const double*> points) {
        for (const double* const p : points) add(p);
    }
    void add(const double* p) {
        for (int k = 0; k < 3; ++k) unit_.add(scaled(p[k]));
    }
    /// Precondition: it was added.
    WholeVector at(const double* p) const {
        WholeVector v;
        for (std::size_t k = 0; k < 3; ++k) {
            const ScaledDouble x = scaled(p[k]);
            if (x.mantissa == 0) continue;
            v[k] = x.mantissa;
            v[k] <<= static_cast<unsigned>(x.exponent - unit_.exponent);
            if (x.negative) v[k] = -v[k];
        }
        return v;
    }
    /// Of the unit; 0 if all is zero.
    int exponent() const { return unit_.exponent == ScaledDouble::none ? 0 : unit_.exponent - 1074; }

private:
    Unit unit_;
};

/// numerator / denominator * 2^exponent, correctly rounded. Precondition: the denominator is positive.
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
