/// Colours for a scalar: 256 steps from dark violet over blue, teal and green to light yellow, lighter at each step and
/// each as different from the next as any other, so that the picture shows the differences that the field has. In
/// greys, and to eyes that tell few hues apart, the order stays.
///
/// The map is ours. It is the curve in Oklab (B. Ottosson, "A perceptual color space for image processing", 2020)
/// with, for t from 0 to 1, lightness from 0.27 to 0.93 and hue from 305 to 108 degrees, both linear, and chroma 0.12,
/// 0.10, 0.17 at t = 0, 1/2, 1, quadratic; divided into 255 pieces of equal length; in 8-bit sRGB. A test computes it
/// anew.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace barycert::io {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue, sRGB

/// Sets an RGBA pixel, without transparency.
inline void put_pixel(const Colour& colour, std::uint8_t* pixel) {
    for (std::size_t k = 0; k < 3; ++k) pixel[k] = colour[k];
    pixel[3] = 255;
}

inline constexpr int colour_count = 256;

/// Precondition: 0 <= i < colour_count.
Colour colour(int i);

}  // namespace barycert::io
