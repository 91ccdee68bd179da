/// Small pictures of few colours as the bytes of a PNG file, in memory.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "barycert/io/png/colour_map.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// `pixels`: the index of each pixel's colour, row by row from the top. Error: libpng does not make it, as without
/// memory. Preconditions: pixels.size() is a multiple of `width`, both > 0; 1 to 256 colours; indices are those of
/// colours.
Result<std::string> indexed_png(std::size_t width, std::span<const std::uint8_t> pixels,
                                std::span<const Colour> colours);

}  // namespace barycert::io
