#include <algorithm>
#include <string>

#include "barycert/io/png/png_file.hpp"
#include "barycert/raster.hpp"

namespace barycert {
namespace {

std::string by(std::int64_t width, std::int64_t height) {
    return std::to_string(width) + " by " + std::to_string(height);
}

Status check_sides(std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1) {
        return Error{.what = "an image of that size cannot be",
                     .expected = "at least 1 pixel a side",
                     .found = by(width, height),
                     .remedy = "choose another size"};
    }
    if (width > max_image_pixels / height) {
        return Error{.what = "the image is too large",
                     .expected = "at most " + std::to_string(max_image_pixels) + " pixels",
                     .found = by(width, height),
                     .remedy = "choose a smaller size"};
    }
    return Done{};
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
    return Error{.what = "the data of the image do not fit its size",
                 .expected = std::to_string(bytes) + " bytes for " + by(image.width, image.height) + " pixels",
                 .found = std::to_string(image.data.size()),
                 .remedy = "give four bytes a pixel"};
}

Result<Image> read_png(const std::string& path) {
    Result<io::PngPixels> read = io::read_png_pixels(path, static_cast<std::uint64_t>(max_image_pixels));
    if (!read) return read.error();
    Image image{static_cast<std::int32_t>(read->width), static_cast<std::int32_t>(read->height), std::move(read->rows)};
    // From the top to from the bottom, in place.
    const auto row = static_cast<std::ptrdiff_t>(image.offset(0, 1));
    for (std::ptrdiff_t low = 0, high = image.height - 1; low < high; ++low, --high) {
        std::swap_ranges(image.data.begin() + low * row, image.data.begin() + (low + 1) * row,
                         image.data.begin() + high * row);
    }
    return image;
}

Status write_png(const std::string& path, const Image& image) {
    Status good = check_image(image);
    if (good && std::max<std::size_t>(static_cast<std::size_t>(image.width), static_cast<std::size_t>(image.height)) >
                    io::longest_png_side) {
        good = Error{.what = "the image is too long for a PNG file",
                     .expected = "at most " + std::to_string(io::longest_png_side) + " pixels a side",
                     .found = by(image.width, image.height),
                     .remedy = "choose a smaller size"};
    }
    if (!good) {
        Error error = good.error();
        error.file = path;
        return error;
    }
    const std::size_t row = image.offset(0, 1);
    const auto copy_row = [&](std::size_t r, std::uint8_t* pixels) {
        const std::size_t upwards = static_cast<std::size_t>(image.height) - 1 - r;
        std::copy_n(image.data.data() + upwards * row, row, pixels);
    };
    return io::write_png_rows(path, static_cast<std::size_t>(image.width), static_cast<std::size_t>(image.height),
                              copy_row, io::PngContent::shades);
}

Image four_colours() {
    return {2, 2, {220, 40, 40, 255, 40, 170, 60, 255, 40, 80, 210, 255, 240, 210, 50, 255}};
}

Result<Image> checkerboard(std::int32_t cells, std::int32_t texels) {
    constexpr Rgba dark{40, 60, 90, 255}, light{240, 235, 220, 255};
    const std::int64_t side = std::int64_t{cells} * texels;
    if (cells < 1 || texels < 1) {
        return Error{.what = "a checkerboard of that size cannot be",
                     .expected = "at least 1 square a side and 1 texel a side of a square",
                     .found = std::to_string(cells) + " and " + std::to_string(texels),
                     .remedy = "choose larger numbers"};
    }
    if (Status good = check_sides(side, side); !good) return good.error();
    Result<Image> image = blank_image(static_cast<std::int32_t>(side), static_cast<std::int32_t>(side), dark);
    if (!image) return image.error();
    for (std::int32_t j = 0; j < image->height; ++j) {
        for (std::int32_t i = 0; i < image->width; ++i) {
            if ((i / texels + j / texels) % 2 != 0) image->set_pixel(i, j, light);
        }
    }
    return image;
}

}  // namespace barycert
