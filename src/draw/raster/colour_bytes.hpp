/// Components of colours as bytes.
#pragma once

#include <cstdint>

namespace barycert::raster {

/// x from 0 to 255, rounded to the nearest integer, halves upwards (and with them the last double below a half).
inline std::uint8_t nearest_byte(double x) {
    constexpr double half = 0.5;
    return static_cast<std::uint8_t>(x + half);
}

/// A component of a colour from 0 to 1, in 255 steps; what lies beyond as 0 and 1. NaN gives 0.
inline std::uint8_t component_byte(double x) {
    return x >= 1 ? 255 : x > 0 ? nearest_byte(x * 255) : 0;
}

}  // namespace barycert::raster
