// PNG files in memory, read back by libpng.
#include <gtest/gtest.h>
#include <png.h>

#include <vector>

#include "draw/png/png_file.hpp"

namespace barycert::png {
namespace {

TEST(IndexedPng, EveryPixelIsItsColour) {
    const std::vector<Colour> colours{{1, 2, 3}, {255, 255, 255}, {0, 114, 178}, {32, 32, 32}};
    for (const std::size_t width : {1U, 3U, 16U}) {
        std::vector<std::uint8_t> pixels;
        for (std::size_t i = 0; i < 5 * width; ++i) pixels.push_back(static_cast<std::uint8_t>(i * i % 4));
        const std::string bytes = indexed_png(width, pixels, colours).value();
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        ASSERT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0) << image.message;
        EXPECT_EQ(image.width, width);
        EXPECT_EQ(image.height, 5U);
        image.format = PNG_FORMAT_RGB;
        std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(image));
        ASSERT_NE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr), 0) << image.message;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(read[3 * i + k], colours[pixels[i]][k]);
        }
    }
}

}  // namespace
}  // namespace barycert::png
