/// PNG files into memory, and out of pixels, by libpng.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "barycert/result.hpp"

namespace barycert::png {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue, sRGB

/// Libpng, and so most programs, reads no more pixels a side unless told to.
inline constexpr std::size_t longest_png_side = 1000000;

/// Kinds of pixels, for the compression. The picture is the same.
enum class PngContent : std::uint8_t {
    few_colours,  ///< in runs: filters would only make more of them
    shades,       ///< that change little from pixel to pixel: libpng chooses a filter for each row
};

/// Writes 8-bit RGBA in sRGB; `row(r, pixels)` sets the 4 * width bytes of row r, asked for from the top. Memory is
/// that of one row and libpng's own. Requires: sides of 1 to longest_png_side. Error: the file cannot be written.
Status write_png_rows(const std::string& path, std::size_t width, std::size_t height,
                      const std::function<void(std::size_t, std::uint8_t*)>& row,
                      PngContent content = PngContent::few_colours);

/// A small picture of few colours as the bytes of a PNG file. `pixels`: the index of each pixel's colour, row by row
/// from the top. Error: libpng does not make it, as without memory. Requires: pixels.size() is a multiple of
/// `width`, both > 0; 1 to 256 colours; indices are those of colours.
Result<std::string> indexed_png(std::size_t width, std::span<const std::uint8_t> pixels,
                                std::span<const Colour> colours);

/// 8-bit RGBA in sRGB, 4 bytes a pixel, row by row from the top, likewise.
Result<std::string> png_bytes(std::size_t width, std::span<const std::uint8_t> pixels);

struct PngPixels {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rows;  ///< 8-bit RGBA, 4 * width bytes a row, from the top
};

/// Reads a PNG file of any kind, see read_png in raster.hpp. Memory: the file, 4 bytes a pixel, a few MiB of libpng.
Result<PngPixels> read_png_pixels(const std::string& path, std::uint64_t max_pixels);

}  // namespace barycert::png
