/// PNG files into memory, by libpng.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "barycert/result.hpp"

namespace barycert::io {

struct PngPixels {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rows;  ///< 8-bit RGBA, 4 * width bytes a row, from the top
};

/// Reads a PNG file of any kind, see read_png in raster.hpp. Memory is 4 bytes a pixel, of which there are at most
/// max_pixels, and libpng's own, which limits keep below a few MiB. Errors: missing, unreadable, no PNG, damaged, cut
/// short, too many pixels.
Result<PngPixels> read_png_pixels(const std::string& path, std::uint64_t max_pixels);

}  // namespace barycert::io
