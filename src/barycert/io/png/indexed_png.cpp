#include "barycert/io/png/indexed_png.hpp"

#include <png.h>

#include <vector>

namespace barycert::io {

Result<std::string> indexed_png(std::size_t width, std::span<const std::uint8_t> pixels,
                                std::span<const Colour> colours) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(pixels.size() / width);
    image.format = PNG_FORMAT_RGB_COLORMAP;
    image.colormap_entries = static_cast<png_uint_32>(colours.size());
    std::vector<std::uint8_t> map;
    for (const Colour& c : colours) map.insert(map.end(), c.begin(), c.end());
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    const auto stride = static_cast<png_int_32>(width);
    const int done = png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), stride, map.data());
    const std::string message = image.message;
    png_image_free(&image);
    if (done == 0) return Error{.what = "cannot make a picture", .found = message};
    bytes.resize(size);
    return bytes;
}

}  // namespace barycert::io
