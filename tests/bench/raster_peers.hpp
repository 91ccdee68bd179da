// Two textbook loops for textured triangles, as baselines of bench_raster.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/raster.hpp"

namespace barycert::bench {

/// A picture of 32-bit pixels, row 0 the lowest.
struct PixelRows {
    std::uint32_t* pixels = nullptr;
    std::int32_t width = 0, height = 0;
};

/// Texels as they are read, clamped.
struct TexelRows {
    const std::uint32_t* texels = nullptr;
    std::int32_t width = 0, height = 0;
};

/// Every pixel of the box: weights by areas, one division, inside if none is negative; then the texel.
std::size_t barycentric_loop(const PixelRows& out, const TexelRows& texture, std::span<const TexturedVertex> corners);

/// From row to row by steps along the sides, from pixel to pixel by steps along the row; then the texel.
std::size_t scanline_loop(const PixelRows& out, const TexelRows& texture, std::span<const TexturedVertex> corners);

}  // namespace barycert::bench
