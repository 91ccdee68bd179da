/// Pictures of pixels, their PNG files, and textures.
///
/// A pixel is red, green, blue and opacity of 8 bits each, in sRGB, not multiplied by the opacity. Rows go upwards: row
/// 0 is the lowest, as in raster.hpp and as v does. Files have their rows from the top: reading and writing turn them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "barycert/result.hpp"

namespace barycert {

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

/// Returns an Error if a side is less than 1, there are too many pixels, or `data` has not four bytes for each.
Status check_image(const Image& image);

/// Reads a PNG file of any colour type, depth and interlacing as 8-bit RGBA: 16 bits are rounded to 8, greys and
/// palettes become colours, a pixel without opacity is opaque. Numbers are taken as they are, whatever gamma or profile
/// the file names. Returns an Error if the file cannot be read, is no PNG file, is damaged or cut short, or has more
/// than max_image_pixels: memory is bounded by these, and by what a file of its size can hold.
Result<Image> read_png(const std::string& path);

/// Writes 8-bit RGBA in sRGB; the file appears whole or not at all. Returns an Error as check_image does, if a side is
/// longer than a million, or if the file cannot be written.
Status write_png(const std::string& path, const Image& image);

/// What lies beyond the picture.
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

/// The colour at (u, v): u runs along the width, v along the height, (0, 0) is the lower left corner of the picture and
/// (1, 1) the upper right one. Requires an image that check_image accepts.
///
/// Any doubles are safe: no texel outside the image is read, at u = 1 and v = 1 neither. NaN counts as 0; infinity as
/// the rim it lies beyond, with repeat and mirror as 0.
///
/// Filter::nearest is exact: texel i holds i <= u * width < i + 1, for the product without rounding. Texels are half
/// open, so that u = 1 is the last texel with clamp and mirror, and the first with repeat.
/// Filter::bilinear rounds each component to the nearest of 256 steps, halves upwards; with clamp and mirror it is the
/// texel's own colour at its centre and between the rim and the first centre.
Rgba texel(const Texture& texture, double u, double v);

/// A picture of 2 by 2 texels: below red and green, above blue and yellow.
Image four_colours();

/// A chequered picture of cells * cells squares, each of texels * texels texels, dark at the lower left. Returns an
/// Error if a number is less than 1 or the picture would have too many pixels.
Result<Image> checkerboard(std::int32_t cells, std::int32_t texels);

}  // namespace barycert
