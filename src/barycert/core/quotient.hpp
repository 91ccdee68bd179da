/// Internal: quotients of exact integers, rounded to the nearest double.
#pragma once

#include "barycert/core/integer.hpp"

namespace barycert {

/// (numerator / denominator) * 2^exponent rounded to nearest, ties to even, subnormal results and overflow to infinity
/// included. An exact zero gives +0; what is smaller than half of the smallest subnormal gives a zero with its sign.
/// Works on bits alone: the floating-point environment has no influence. Precondition: denominator != 0.
double round_quotient(const Integer& numerator, const Integer& denominator, int exponent);

/// number * 2^exponent rounded in the same way.
double round_integer(const Integer& number, int exponent);

}  // namespace barycert
