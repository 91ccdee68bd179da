/// The floating-point environment of the calling thread, measured by what arithmetic does.
#pragma once

#include <cfloat>
#include <string_view>

#include "core/base/strict_math.hpp"

namespace barycert::base {

/// Volatile operands keep the compiler from folding what is to be measured.
inline double volatile_value(double x) {
    volatile double v = x;
    return v;
}

/// "nearest", "upward", "downward" or "toward-zero". 1 + 2^-54 lies below the middle of 1 and its upper neighbour,
/// 1 + 3 * 2^-54 above it; with the first one mirrored they tell the four modes apart. The mode register is not asked,
/// because it may lie about the unit that computes (x87 against SSE).
inline std::string_view measured_rounding() {
    const double one = volatile_value(1);
    const double over = volatile_value(0x3p-54);
    const double under = volatile_value(0x1p-54);
    const double up = volatile_value(one + under);
    const double down = volatile_value(one + over);
    const double negative = volatile_value(-one - under);
    if (up > 1) return "upward";
    if (negative < -1) return "downward";
    return down > 1 ? "nearest" : "toward-zero";
}

inline bool measured_flush_to_zero() {
    const double result = volatile_value(volatile_value(DBL_MIN) * 0.5);          // flush-to-zero shows here
    const double operand = volatile_value(volatile_value(0x1p-1074) * 0x1p+200);  // denormals-are-zero here
    return result == 0 || operand == 0;
}

}  // namespace barycert::base
