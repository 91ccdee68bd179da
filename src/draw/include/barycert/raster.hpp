/// Triangles on a raster: which pixels they cover, and the values at these pixels.
///
/// Window coordinates: x to the right, y up, in pixels. Pixel (i, j), column i from the left and row j from the bottom,
/// has its centre at (i + 0.5, j + 0.5).
///
/// Laws (each is a test of that name in tests/draw/raster):
///   R1  A triangle covers the pixels whose centres lie in its open interior, and of those on its sides the ones that
///       the top-left rule gives it: centres on a left side (the triangle is to the right of it) or on a top side (it
///       is horizontal and the triangle is below it). All signs are exact, for any finite coordinates. So triangles
///       that partition a region cover each pixel centre in it exactly once, whatever their orientations and order.
///   R2  A triangle with an area of exactly zero covers nothing.
///   D1  Coverage depends on the coordinates alone, not on threads, SIMD target, compiler or optimisation.
///
/// Why R1: the rule moves a centre on a side right by e and down by e * e, for an e > 0 too small for anything else to
/// change. The moved point lies on no line through two distinct points with finite coordinates, so that of triangles
/// that partition its surroundings exactly one holds it, in its interior.
///
/// Example:
///
///     Image image = blank_image(64, 64, {255, 255, 255, 255}).value();
///     image.set_pixel(3, 3, {255, 0, 0, 255});
///     write_png("dot.png", image).value();
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "barycert/result.hpp"
#include "barycert/weights.hpp"

namespace barycert {

/// Columns and rows of a raster: at least 1, at most max_raster_side each.
struct RasterSize {
    std::int32_t width = 0, height = 0;

    friend bool operator==(RasterSize, RasterSize) = default;
};

inline constexpr std::int32_t max_raster_side = 32768;

/// Returns an Error if a side is less than 1 or more than max_raster_side.
Status check_raster_size(RasterSize size);

/// The pixels begin, ..., end - 1 of a row. Never empty.
struct PixelSpan {
    std::int32_t row = 0, begin = 0, end = 0;

    friend bool operator==(PixelSpan, PixelSpan) = default;
};

/// Appends the pixels that the triangle covers (R1), from the bottom row up. `vertices`: x and y of three. Error, and
/// nothing appended: not six finite numbers, or a size that is refused.
Status cover_triangle(RasterSize size, std::span<const double> vertices, std::vector<PixelSpan>& spans);

/// How values are interpolated. All three cover the same pixels.
enum class FillMethod : std::uint8_t {
    barycentric,  ///< the weights at each pixel's centre
    scanline,     ///< constant steps: from row to row along the sides, from pixel to pixel along the row
    bilinear,     ///< along the two sides that the row's line meets, then along that line; one division a row
};

/// Values at the pixels of a raster: component c of pixel (i, j) is data[(j * width + i) * components + c].
struct PixelValues {
    RasterSize size;
    int components = 1;
    std::vector<double> data;
};

/// The raster with NaN everywhere, or an Error if the size is refused, components < 1, or memory would exceed 8 GiB.
Result<PixelValues> empty_pixels(RasterSize size, int components);

struct FillOptions {
    FillMethod method = FillMethod::barycentric;
    /// `correct`: each value is the exact one at the pixel's centre, rounded once; with FillMethod::barycentric only.
    Rounding rounding = Rounding::plain;
};

/// Sets the values of the pixels that the triangle covers and returns their number. `values`: out.components numbers a
/// vertex, vertex after vertex. With Rounding::plain, and coordinates and values below 2^100, a value is off by at most
/// fill_error(...). Error, and nothing changed: too few or many numbers, or a coordinate that is not finite.
Result<std::size_t> fill_triangle(std::span<const double> vertices, std::span<const double> values, PixelValues& out,
                                  const FillOptions& options = {});

/// A bound on the error of a component that fill_triangle computes with Rounding::plain. `values`: one number a vertex.
/// Infinite for a triangle so flat that plain arithmetic has no bound.
double fill_error(std::span<const double> vertices, std::span<const double> values, FillMethod method);

// Pictures of pixels, their PNG files, and textures.
//
// A pixel is red, green, blue and opacity of 8 bits each, in sRGB, not multiplied by the opacity. Row 0 is the lowest;
// files have their rows from the top: reading and writing turn them.

using Rgba = std::array<std::uint8_t, 4>;  ///< red, green, blue, opacity

struct Image {
    std::int32_t width = 0, height = 0;
    std::vector<std::uint8_t> data;  ///< pixel (i, j): four bytes from 4 * (j * width + i) on

    std::size_t offset(std::int32_t i, std::int32_t j) const {
        return 4 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i));
    }
    /// Requires 0 <= i < width, 0 <= j < height, as many bytes as the size asks for.
    Rgba pixel(std::int32_t i, std::int32_t j) const {
        const std::uint8_t* const p = data.data() + offset(i, j);
        return {p[0], p[1], p[2], p[3]};
    }
    void set_pixel(std::int32_t i, std::int32_t j, Rgba colour) {
        std::uint8_t* const p = data.data() + offset(i, j);
        for (std::size_t k = 0; k < 4; ++k) p[k] = colour[k];
    }

    friend bool operator==(const Image&, const Image&) = default;
};

/// The most pixels that an image may have: 2^26, a square of 8192. That is 256 MiB.
inline constexpr std::int64_t max_image_pixels = std::int64_t{1} << 26;

/// An image of one colour, or an Error if a side is less than 1 or there would be too many pixels.
Result<Image> blank_image(std::int32_t width, std::int32_t height, Rgba colour);

/// Returns an Error if a side is less than 1, there are too many pixels, or `data` does not have four bytes for each.
Status check_image(const Image& image);

/// Reads a PNG file of any colour type, depth and interlacing as 8-bit RGBA: 16 bits are rounded to 8, greys and
/// palettes become colours, a pixel without opacity is opaque; gamma and profiles are not looked at. Error: no readable
/// whole PNG file, or more than max_image_pixels. Memory is bounded by these, and by what a file of its size can hold.
Result<Image> read_png(const std::string& path);

/// Writes 8-bit RGBA in sRGB, whole or not at all. Error: as check_image; a side above a million; it cannot be written.
Status write_png(const std::string& path, const Image& image);

/// Rule for texels beyond the picture.
enum class Wrap : std::uint8_t {
    clamp,   ///< its rim
    repeat,  ///< the picture again
    mirror,  ///< the picture again, every other time reversed
};

enum class Filter : std::uint8_t {
    nearest,   ///< the texel that holds the point
    bilinear,  ///< from the four texels around the point, by the distances from their centres
};

struct Texture {
    Image image;
    Wrap wrap = Wrap::clamp;
    Filter filter = Filter::nearest;
};

/// The colour at (u, v), from (0, 0) at the lower left corner to (1, 1) at the upper right one. Requires an image that
/// check_image accepts. Any doubles are safe: NaN counts as 0; infinity as the rim it lies beyond, with repeat and
/// mirror as 0.
///
/// Filter::nearest is exact: texel i holds i <= u * width < i + 1, for the product without rounding; u = 1 is the last
/// texel with clamp and mirror, and the first with repeat. Filter::bilinear rounds each component to the nearest of 256
/// steps, halves upwards; with clamp and mirror it is the texel's own colour at its centre and between the rim and the
/// first centre.
Rgba texel(const Texture& texture, double u, double v);

/// A picture of 2 by 2 texels: below red and green, above blue and yellow.
Image four_colours();

/// A chequered picture of cells * cells squares, each of texels * texels texels, dark at the lower left. Error: a
/// number below 1, or too many pixels.
Result<Image> checkerboard(std::int32_t cells, std::int32_t texels);

// Many textured triangles, fast: exact coverage, texture coordinates on SIMD lanes, one texel a pixel. No depth, no
// blending: later triangles are drawn over earlier ones. scene.hpp has the whole pipeline.

/// A vertex in window coordinates, the w of its clip coordinates, and texture coordinates.
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
/// between SIMD targets. No texel outside the texture is read, whatever the numbers. `threads`: 0 as many as the
/// machine has; the picture is the same with any number. Error, and nothing drawn: a number of vertices that is no
/// multiple of 3, one that is not finite, w <= 0 with perspective, another filter than Filter::nearest, or what
/// check_image refuses.
Result<std::size_t> draw_textured(Image& image, const Texture& texture, std::span<const TexturedVertex> vertices,
                                  bool perspective = true, int threads = 0);

// Clipping: what of a segment or triangle lies in a half-space, a box or the clip volume, with attributes.
//
// A vertex is a row of numbers: its position, then its attributes. Where a bound cuts, a new vertex C stands between A
// and B, and each of its numbers is V_C = W_A * V_A + (1 - W_A) * V_B.
//
// Laws (each is a test of that name in tests/draw/raster):
//   C1  Which part lies inside is decided exactly, for any finite numbers.
//   C2  Every number of a new vertex is the exact one of the segment or triangle given, rounded to nearest, ties to
//       even, however many bounds have cut it. An exact zero is +0. Vertices that stay keep their bits.
//   C3  The end of an edge has the same bits for both triangles that share the edge, in whatever order they name its
//       ends.
//   C4  What was clipped by a box or the clip volume lies in it, rounded as it is: clipping it again changes nothing.
//   D1  Answers depend on the numbers alone, not on the machine nor (D2) on the floating-point environment.
//
// Why C4: rounding to nearest is monotonic and commutes with the sign.
//
// Not promised: that a new vertex, rounded, lies on the line of its edge, or in an oblique half-space.

/// The points x with normal . x + offset >= 0. The dimension is that of the segment; further entries are not used.
struct HalfSpace {
    std::array<double, 3> normal{};
    double offset = 0;
};

/// The points with min <= x <= max on each axis. Infinite where there is no bound.
struct ClipBox {
    std::array<double, 3> min{}, max{};
};

struct ClippedSegment {
    bool empty = true;                  ///< nothing lies inside; a and b are empty
    bool new_a = false, new_b = false;  ///< a bound has cut: that end is a new vertex
    std::vector<double> a, b;  ///< the ends of what lies inside, in the order of the segment; equal if that is a point
};

/// Clips the segment from a to b, each a row of `dimension` coordinates (1 to 3) and any attributes. A point on a bound
/// is inside. Error: rows that differ in length or are too short; a number that is not finite (bounds of a box may be
/// infinite).
Result<ClippedSegment> clip_segment(int dimension, std::span<const double> a, std::span<const double> b,
                                    const HalfSpace& bound);
Result<ClippedSegment> clip_segment(int dimension, std::span<const double> a, std::span<const double> b,
                                    const ClipBox& box);

/// Fate of a triangle.
enum class Clip : std::uint8_t {
    inside,   ///< all of it is inside
    cut,      ///< part of it
    outside,  ///< nothing, or only an edge or a corner
    at_eye,   ///< part of it, and this holds the point (0, 0, 0, 0), which is nowhere on a screen: what there is of the
              ///< rest is seen edge-on. Also where a new vertex is so near to it that its w is rounded to zero
};

/// The most vertices of a clipped triangle: each of the six bounds may cut off one corner.
inline constexpr int max_clipped_vertices = 9;

/// Clips a triangle in homogeneous coordinates, before the division, to the volume -w <= x, y, z <= w; all of it has
/// w >= 0, and what is behind the eye never wraps around. `vertices`: three rows of x, y, z, w and any attributes, one
/// after the other. `polygon` is replaced by the rows of the part inside, a convex polygon with the triangle's order of
/// vertices: the three of the triangle (inside), 3 to max_clipped_vertices (cut), or none. Error, and `polygon` as it
/// was: rows shorter than 4, or a number that is not finite.
Result<Clip> clip_triangle(std::span<const double> vertices, std::vector<double>& polygon);

}  // namespace barycert
