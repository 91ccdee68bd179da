// Two textbook loops for textured triangles, as baselines of bench_raster.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/raster/textured_lanes.hpp"

namespace barycert::bench {

/// Every pixel of the box: weights by areas, one division, inside if none is negative; then the texel.
std::size_t barycentric_loop(const raster::PixelRows& out, const raster::TexelRows& texture,
                             std::span<const TexturedVertex> corners);

/// From row to row by steps along the sides, from pixel to pixel by steps along the row; then the texel.
std::size_t scanline_loop(const raster::PixelRows& out, const raster::TexelRows& texture,
                          std::span<const TexturedVertex> corners);

}  // namespace barycert::bench
