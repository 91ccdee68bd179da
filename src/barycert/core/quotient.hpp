/// Quotients of exact integers, rounded to the nearest double.
#pragma once

#include <cstdint>
#include <span>

#include "barycert/core/integer.hpp"

namespace barycert::core {

/// A magnitude: limbs of 64 bits, the least significant first; leading zeros are allowed.
using Magnitude = std::span<const std::uint64_t>;

/// (numerator / denominator) * 2^exponent with a sign, rounded to nearest, ties to even, subnormal results and overflow
/// to infinity included. An exact zero gives +0; what is smaller than half of the smallest subnormal gives a zero with
/// its sign. Works on bits alone: the floating-point environment has no influence. Preconditions: denominator not zero;
/// both fit an Integer.
double round_quotient(bool negative, Magnitude numerator, Magnitude denominator, int exponent);

/// The same of two numbers with their signs.
inline double round_quotient(const Integer& numerator, const Integer& denominator, int exponent) {
    return round_quotient(numerator.sign() != denominator.sign(), numerator.magnitude(), denominator.magnitude(),
                          exponent);
}

/// number * 2^exponent rounded in the same way.
double round_integer(const Integer& number, int exponent);

}  // namespace barycert::core
