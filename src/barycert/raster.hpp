/// Triangles on a raster: which pixels they cover, and the values at these pixels.
///
/// Window coordinates: x to the right, y up, in pixels. Pixel (i, j), column i from the left and row j from the bottom,
/// has its centre at (i + 0.5, j + 0.5).
///
/// Laws (each is a test of that name in tests/raster):
///   R1  A triangle covers the pixels whose centres lie in its open interior, and of those on its sides the ones that
///       the top-left rule gives it: centres on a left side (the triangle is to the right of it) or on a top side (it
///       is horizontal and the triangle is below it). All signs are exact, for any finite coordinates. So triangles
///       that partition a region cover each pixel centre in it exactly once, whatever their orientations and order.
///   R2  A triangle with an area of exactly zero covers nothing.
///   D1  Coverage depends on the coordinates alone, not on threads, SIMD target, compiler or optimisation.
///
/// Why R1: a centre on the side of a triangle is treated as if it were moved right by e and down by e * e, for an e > 0
/// too small for anything else to change. The moved point lies on no line through two distinct points with finite
/// coordinates, so of triangles that partition its surroundings exactly one holds it, in its interior.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
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

/// Appends the pixels of the raster that the triangle covers (R1), from the bottom row to the top. `vertices`: x and y
/// of three vertices. Returns an Error, and appends nothing, if there are not six numbers, one is not finite, or the
/// size is refused.
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

/// Sets the values of the pixels that the triangle covers and returns their number. `vertices`: x and y of three
/// vertices; `values`: out.components numbers a vertex, vertex after vertex. With Rounding::plain, and coordinates and
/// values below 2^100, a value differs from the exact one by at most fill_error(...). Returns an Error, and changes
/// nothing, if the numbers are too few or many or a coordinate is not finite.
Result<std::size_t> fill_triangle(std::span<const double> vertices, std::span<const double> values, PixelValues& out,
                                  const FillOptions& options = {});

/// A bound on the error of a component that fill_triangle computes with Rounding::plain. `values`: one number a vertex.
/// Infinite for a triangle so flat that plain arithmetic has no bound.
double fill_error(std::span<const double> vertices, std::span<const double> values, FillMethod method);

}  // namespace barycert
