/// Many textured triangles, fast: exact coverage, texture coordinates on SIMD lanes, one texel a pixel. No depth, no
/// blending: later triangles are drawn over earlier ones. scene.hpp has the whole pipeline.
#pragma once

#include <cstddef>
#include <span>

#include "barycert/result.hpp"
#include "barycert/texture.hpp"

namespace barycert {

/// A vertex in window coordinates (raster.hpp), the w of its clip coordinates, and texture coordinates (texture.hpp).
struct TexturedVertex {
    double x = 0, y = 0, w = 1, u = 0, v = 0;
};

/// Draws triangles, three vertices each, and returns the number of pixels drawn. Covers the pixels that cover_triangle
/// names (law R1), and gives each the texel that holds its texture coordinates (Filter::nearest). `perspective`: these
/// are interpolated with w, else w is not used.
///
/// Texture coordinates are computed in fixed point or single precision. For pictures and textures of up to 1024 by
/// 1024, coordinates u and v in [-1, 2] and depths that differ by a factor of up to 16 in a triangle they are off by
/// less than 2^-8 of a texel: so near to the border of two texels the neighbour may be taken. They may differ that much
/// between SIMD targets. No texel outside the texture is read, whatever the numbers.
///
/// Returns an Error, and draws nothing, if the number of vertices is no multiple of 3, a number is not finite, w <= 0
/// with perspective, the filter is not Filter::nearest, or check_image refuses the image or the texture.
Result<std::size_t> draw_textured(Image& image, const Texture& texture, std::span<const TexturedVertex> vertices,
                                  bool perspective = true);

}  // namespace barycert
