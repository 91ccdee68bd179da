#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "core/base/strict_math.hpp"
#include "draw/png/png_file.hpp"
#include "draw/raster/colour_bytes.hpp"

namespace barycert {
namespace {

std::string by(std::int64_t width, std::int64_t height) {
    return std::to_string(width) + " by " + std::to_string(height);
}

Status check_sides(std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1)
        return file_error("argument.value", {}, "an image of that size cannot be", "at least 1 pixel a side",
                          by(width, height), "choose another size");
    if (width > max_image_pixels / height)
        return file_error("picture.too-large", {}, "the image is too large",
                          "at most " + std::to_string(max_image_pixels) + " pixels", by(width, height),
                          "choose a smaller size");
    return Done{};
}

/// The greatest integer that is not above u * size, the product taken without rounding. Requires: |u| < 2,
/// 1 <= size <= 2^26, so that all is far from overflow.
///
/// A product that is rounded to a number that is no integer lies between the same integers as the exact one. One that
/// is rounded to an integer t may have come from below; then u * size - t < 0, a difference that one fused operation
/// tells rightly: it is rounded once, and not to zero, as it is a multiple of the unit of u.
std::int64_t exact_floor(double u, double size) {
    const double t = u * size;
    const double whole = std::floor(t);
    if (whole == t && std::fma(u, size, -t) < 0) return static_cast<std::int64_t>(whole) - 1;
    return static_cast<std::int64_t>(whole);
}

/// The same place in one period: [0, 1] with clamp, (-1, 1) with repeat, (-2, 2) with mirror. fmod is exact.
double reduced(double u, Wrap wrap) {
    if (std::isnan(u)) return 0;
    if (wrap == Wrap::clamp) return std::clamp(u, 0.0, 1.0);
    if (std::isinf(u)) return 0;
    const double period = wrap == Wrap::repeat ? 1 : 2;
    return std::abs(u) < period ? u : std::fmod(u, period);
}

/// The texel that stands at place i. Requires: -3 * size <= i <= 3 * size.
std::int64_t wrapped(std::int64_t i, std::int64_t size, Wrap wrap) {
    if (wrap == Wrap::clamp) return std::clamp<std::int64_t>(i, 0, size - 1);
    const std::int64_t period = wrap == Wrap::repeat ? size : 2 * size;
    i %= period;
    if (i < 0) i += period;
    return i < size ? i : period - 1 - i;  // the second only with mirror
}

/// Along one axis: the two texels, and the part of the second. With Filter::nearest both are one.
struct TexelPair {
    std::int32_t low, high;
    double part;
};

TexelPair texels_at(double u, std::int32_t size, Wrap wrap, Filter filter) {
    const double r = reduced(u, wrap);
    if (filter == Filter::nearest) {
        const auto i = static_cast<std::int32_t>(wrapped(exact_floor(r, size), size, wrap));
        return {i, i, 0};
    }
    const double x = r * size - 0.5;  // centres lie at integers
    const double whole = std::floor(x);
    const auto i = static_cast<std::int64_t>(whole);
    return {static_cast<std::int32_t>(wrapped(i, size, wrap)), static_cast<std::int32_t>(wrapped(i + 1, size, wrap)),
            x - whole};
}

}  // namespace

Result<Image> blank_image(std::int32_t width, std::int32_t height, Rgba colour) {
    if (Status good = check_sides(width, height); !good) return good.error();
    Image image{width, height, {}};
    image.data.resize(image.offset(0, height));
    for (std::size_t i = 0; i < image.data.size(); i += 4)
        std::copy_n(colour.begin(), 4, image.data.begin() + static_cast<std::ptrdiff_t>(i));
    return image;
}

Status check_image(const Image& image) {
    if (Status good = check_sides(image.width, image.height); !good) return good;
    const std::size_t bytes = image.offset(0, image.height);
    if (image.data.size() == bytes) return Done{};
    return file_error("argument.size", {}, "the data of the image do not fit its size",
                      std::to_string(bytes) + " bytes for " + by(image.width, image.height) + " pixels",
                      std::to_string(image.data.size()), "give four bytes a pixel");
}

Result<Image> read_png(const std::string& path) {
    Result<png::PngPixels> read = png::read_png_pixels(path, static_cast<std::uint64_t>(max_image_pixels));
    if (!read) return read.error();
    Image image{static_cast<std::int32_t>(read->width), static_cast<std::int32_t>(read->height), std::move(read->rows)};
    // From the top to from the bottom, in place.
    const auto row = static_cast<std::ptrdiff_t>(image.offset(0, 1));
    for (std::ptrdiff_t low = 0, high = image.height - 1; low < high; ++low, --high)
        std::swap_ranges(image.data.begin() + low * row, image.data.begin() + (low + 1) * row,
                         image.data.begin() + high * row);
    return image;
}

Status write_png(const std::string& path, const Image& image) {
    if (Status good = check_image(image); !good) {
        Error error = good.error();
        error.file = path;
        return error;
    }
    const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
    if (std::max(width, height) > png::longest_png_side)
        return file_error("picture.too-large", path, "the image is too long for a PNG file",
                          "at most " + std::to_string(png::longest_png_side) + " pixels a side",
                          by(image.width, image.height), "choose a smaller size");
    const std::size_t row = image.offset(0, 1);
    const auto copy_row = [&](std::size_t r, std::uint8_t* pixels) {
        std::copy_n(image.data.data() + (height - 1 - r) * row, row, pixels);
    };
    return png::write_png_rows(path, width, height, copy_row, png::PngContent::shades);
}

Rgba texel(const Texture& texture, double u, double v) {
    const ExactEnvironment environment;
    const Image& image = texture.image;
    const TexelPair x = texels_at(base::held(u), image.width, texture.wrap, texture.filter);
    const TexelPair y = texels_at(base::held(v), image.height, texture.wrap, texture.filter);
    if (texture.filter == Filter::nearest) return image.pixel(x.low, y.low);
    const Rgba a = image.pixel(x.low, y.low), b = image.pixel(x.high, y.low);
    const Rgba c = image.pixel(x.low, y.high), d = image.pixel(x.high, y.high);
    Rgba colour;
    for (std::size_t k = 0; k < 4; ++k) {
        const double below = a[k] + x.part * (b[k] - a[k]), above = c[k] + x.part * (d[k] - c[k]);
        // Between the four texels up to rounding: 0 <= part < 1, and by less than 2^-40 beyond. That is rounded away.
        colour[k] = raster::nearest_byte(std::max(0.0, below + y.part * (above - below)));
    }
    return colour;
}

Image four_colours() {
    return {2, 2, {220, 40, 40, 255, 40, 170, 60, 255, 40, 80, 210, 255, 240, 210, 50, 255}};
}

Result<Image> checkerboard(std::int32_t cells, std::int32_t texels) {
    constexpr Rgba dark{40, 60, 90, 255}, light{240, 235, 220, 255};
    const std::int64_t side = std::int64_t{cells} * texels;
    if (cells < 1 || texels < 1)
        return file_error("argument.value", {}, "a checkerboard of that size cannot be",
                          "at least 1 square a side and 1 texel a side of a square",
                          std::to_string(cells) + " and " + std::to_string(texels), "choose larger numbers");
    if (Status good = check_sides(side, side); !good) return good.error();
    Image image = blank_image(static_cast<std::int32_t>(side), static_cast<std::int32_t>(side), dark).value();
    for (std::int32_t j = 0; j < image.height; ++j) {
        for (std::int32_t i = 0; i < image.width; ++i) {
            if ((i / texels + j / texels) % 2 != 0) image.set_pixel(i, j, light);
        }
    }
    return image;
}

}  // namespace barycert
