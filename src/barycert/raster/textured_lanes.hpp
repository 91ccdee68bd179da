/// Textured triangles on SIMD lanes: one vector of pixels of a row at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/raster/edge.hpp"

namespace barycert::raster {

/// A picture of 32-bit pixels, row 0 the lowest.
struct PixelRows {
    std::uint32_t* pixels = nullptr;
    std::int32_t width = 0, height = 0;
};

/// Texels as they are read: `wrap` as Wrap of texture.hpp.
struct TexelRows {
    const std::uint32_t* texels = nullptr;
    std::int32_t width = 0, height = 0;
    std::uint8_t wrap = 0;  ///< 0 clamp, 1 repeat, 2 mirror
};

/// A vertex in window coordinates with the depth w of clip space, and texture coordinates in [0, 1] over the texture.
struct TexturedCorner {
    double x, y, w, u, v;
};

/// Draws triangles (three corners each) and returns the number of pixels drawn. Preconditions: x and y finite;
/// perspective: w > 0.
std::size_t draw_textured(const PixelRows& out, const TexelRows& texture, std::span<const TexturedCorner> corners,
                          bool perspective);

}  // namespace barycert::raster
