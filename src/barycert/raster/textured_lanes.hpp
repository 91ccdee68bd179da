/// Textured triangles on SIMD lanes: one vector of pixels of a row at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/raster.hpp"

namespace barycert::raster {

/// A picture of 32-bit pixels, row 0 the lowest.
struct PixelRows {
    std::uint32_t* pixels = nullptr;
    std::int32_t width = 0, height = 0;
};

/// Texels as they are read.
struct TexelRows {
    const std::uint32_t* texels = nullptr;
    std::int32_t width = 0, height = 0;
    Wrap wrap = Wrap::clamp;
};

/// draw_textured of raster.hpp. Preconditions: three vertices a triangle, all numbers finite, with perspective w > 0.
std::size_t draw_lanes(const PixelRows& out, const TexelRows& texture, std::span<const TexturedVertex> vertices,
                       bool perspective);

}  // namespace barycert::raster
