// PNG files in and out: every kind that libpng writes, and every way to be broken.
#include <gtest/gtest.h>
#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>

#include "barycert/raster.hpp"
#include "core/base/random.hpp"
#include "tests/temporary_folder.hpp"

namespace barycert {
namespace {

using testing::get;
using testing::put;
using testing::TemporaryFolder;

struct Kind {
    int colour_type, depth;
    bool interlaced = false, transparent = false;
};

/// Samples of `depth` bits, most significant first, packed into the bytes of a row.
void append_sample(std::vector<std::uint8_t>& row, std::size_t& bits, unsigned value, int depth) {
    for (int b = depth - 1; b >= 0; --b, ++bits) {
        if (bits % 8 == 0) row.push_back(0);
        row.back() = static_cast<std::uint8_t>(row.back() | (value >> b & 1U) << (7 - bits % 8));
    }
}

int channels_of(int colour_type) {
    switch (colour_type) {
        case PNG_COLOR_TYPE_RGB:
            return 3;
        case PNG_COLOR_TYPE_RGBA:
            return 4;
        case PNG_COLOR_TYPE_GRAY_ALPHA:
            return 2;
        default:
            return 1;
    }
}

/// The 8 bits nearest to a sample of `depth` bits.
std::uint8_t to_byte(unsigned value, int depth) {
    const double most = (1U << depth) - 1;
    return static_cast<std::uint8_t>(255 * value / most + 0.5);
}

/// Writes random samples by libpng's own functions and returns the image that should be read.
Image write_kind(const std::string& path, const Kind& kind, std::int32_t width, std::int32_t height) {
    base::Random random(static_cast<std::uint64_t>(kind.colour_type * 100 + kind.depth));
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), kind.depth,
                 kind.colour_type, kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    std::vector<png_color> palette;
    std::vector<png_byte> opacity;
    if (kind.colour_type == PNG_COLOR_TYPE_PALETTE) {
        for (int i = 0; i < 1 << kind.depth; ++i) {
            palette.push_back(
                {static_cast<png_byte>(7 * i), static_cast<png_byte>(255 - i), static_cast<png_byte>(13 * i)});
            opacity.push_back(static_cast<png_byte>(255 - 3 * i));
        }
        png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
        if (kind.transparent) png_set_tRNS(png, info, opacity.data(), static_cast<int>(opacity.size()), nullptr);
    }
    png_color_16 clear{};  // this grey or colour is transparent
    if (kind.transparent && kind.colour_type != PNG_COLOR_TYPE_PALETTE) png_set_tRNS(png, info, nullptr, 0, &clear);
    png_write_info(png, info);
    Image expected = blank_image(width, height, {}).value();
    std::vector<std::vector<std::uint8_t>> rows(static_cast<std::size_t>(height));
    const int channels = channels_of(kind.colour_type);
    for (std::int32_t r = 0; r < height; ++r) {
        std::size_t bits = 0;
        for (std::int32_t i = 0; i < width; ++i) {
            unsigned s[4] = {};
            for (int c = 0; c < channels; ++c) {
                s[c] = static_cast<unsigned>(random.below(std::uint64_t{1} << kind.depth));
                if (random.below(4) == 0) s[c] = 0;
                append_sample(rows[static_cast<std::size_t>(r)], bits, s[c], kind.depth);
            }
            Rgba pixel{0, 0, 0, 255};
            if (kind.colour_type == PNG_COLOR_TYPE_PALETTE) {
                pixel = {palette[s[0]].red, palette[s[0]].green, palette[s[0]].blue,
                         kind.transparent ? opacity[s[0]] : std::uint8_t{255}};
            } else {
                const bool grey = channels < 3;
                for (std::size_t c = 0; c < 3; ++c) pixel[c] = to_byte(s[grey ? 0 : c], kind.depth);
                if (channels % 2 == 0) pixel[3] = to_byte(s[channels - 1], kind.depth);
                if (kind.transparent && s[0] == 0 && (grey || (s[1] == 0 && s[2] == 0))) pixel[3] = 0;
            }
            expected.set_pixel(i, height - 1 - r, pixel);
        }
    }
    std::vector<png_bytep> places;
    for (auto& row : rows) places.push_back(row.data());
    png_write_image(png, places.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
    return expected;
}

TEST(ReadPng, EveryKind) {
    const TemporaryFolder folder;
    std::vector<Kind> kinds;
    for (const int depth : {1, 2, 4, 8, 16}) {
        kinds.push_back({PNG_COLOR_TYPE_GRAY, depth});
        kinds.push_back({PNG_COLOR_TYPE_GRAY, depth, false, true});
        if (depth <= 8) kinds.push_back({PNG_COLOR_TYPE_PALETTE, depth});
        if (depth <= 8) kinds.push_back({PNG_COLOR_TYPE_PALETTE, depth, false, true});
        if (depth < 8) continue;
        for (const int type : {PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGBA, PNG_COLOR_TYPE_GRAY_ALPHA})
            kinds.push_back({type, depth});
        kinds.push_back({PNG_COLOR_TYPE_RGB, depth, false, true});
    }
    for (Kind kind : kinds) {
        for (const bool interlaced : {false, true}) {
            kind.interlaced = interlaced;
            const Image expected = write_kind(folder / "kind.png", kind, 13, 11);
            const Result<Image> read = read_png(folder / "kind.png");
            ASSERT_TRUE(read) << read.error().message();
            EXPECT_EQ(*read, expected) << kind.colour_type << ' ' << kind.depth << ' ' << interlaced
                                       << kind.transparent;
        }
    }
}

TEST(ReadPng, WhatIsWrittenIsRead) {
    const TemporaryFolder folder;
    base::Random random(3);
    for (const auto& [width, height] : {std::pair(1, 1), {1, 9}, {17, 1}, {33, 20}}) {
        Image image = blank_image(width, height, {}).value();
        for (std::uint8_t& x : image.data) x = static_cast<std::uint8_t>(random.below(256));
        ASSERT_TRUE(write_png(folder / "image.png", image));
        EXPECT_EQ(read_png(folder / "image.png").value(), image);
    }
}

TEST(WritePng, BadImagesAreRefused) {
    const TemporaryFolder folder;
    EXPECT_FALSE(write_png(folder / "none.png", Image{}));
    EXPECT_FALSE(write_png(folder / "short.png", {2, 2, {1, 2, 3}}));
    EXPECT_FALSE(write_png(folder / "long.png", blank_image(1000001, 1, {}).value()));
    EXPECT_FALSE(write_png(folder / "no/such/folder.png", four_colours()));
    EXPECT_EQ(folder.file_count(), 0U);
}

TEST(ReadPng, CutShortAnywhere) {
    const TemporaryFolder folder;
    write_kind(folder / "whole.png", {PNG_COLOR_TYPE_RGB, 8}, 5, 4);
    const std::string whole = get(folder / "whole.png");
    for (std::size_t n = 0; n < whole.size(); ++n) {
        put(folder / "part.png", whole.substr(0, n));
        const Result<Image> read = read_png(folder / "part.png");
        ASSERT_FALSE(read) << n;
        EXPECT_EQ(read.error().file, folder / "part.png");
        EXPECT_FALSE(read.error().remedy.empty());
    }
}

TEST(ReadPng, AnyByteChanged) {
    const TemporaryFolder folder;
    write_kind(folder / "whole.png", {PNG_COLOR_TYPE_PALETTE, 4, true, true}, 9, 7);
    const std::string whole = get(folder / "whole.png");
    std::size_t errors = 0;
    for (std::size_t n = 0; n < whole.size(); ++n) {
        std::string damaged = whole;
        damaged[n] = static_cast<char>(damaged[n] ^ (1 << n % 8));
        put(folder / "damaged.png", damaged);
        const Result<Image> read = read_png(folder / "damaged.png");
        errors += read ? 0U : 1U;
        if (read) {
            EXPECT_TRUE(check_image(*read));
        }
    }
    EXPECT_GT(errors, whole.size() / 2);  // checksums see nearly all
}

/// The header of a PNG file of that size, and nothing that could fill it.
std::string header_only(std::uint32_t width, std::uint32_t height) {
    std::string chunk = "IHDR";
    for (const std::uint32_t n : {width, height}) {
        for (int b = 24; b >= 0; b -= 8) chunk += static_cast<char>(n >> b & 255U);
    }
    chunk += std::string("\x08\x06\x00\x00\x00", 5);
    std::uint32_t crc = 0xffffffffU;
    for (const char c : chunk) {
        crc ^= static_cast<std::uint8_t>(c);
        for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (0xedb88320U & (0U - (crc & 1U)));
    }
    crc = ~crc;
    std::string file("\x89PNG\r\n\x1a\n\0\0\0\x0d", 12);
    file += chunk;
    for (int b = 24; b >= 0; b -= 8) file += static_cast<char>(crc >> b & 255U);
    return file + std::string("\0\0\0\0IDAT\x35\xaf\x06\x1e", 12);
}

TEST(ReadPng, TooLargeIsRefusedBeforeMemoryIsTaken) {
    const TemporaryFolder folder;
    put(folder / "large.png", header_only(60000, 60000));
    const Result<Image> large = read_png(folder / "large.png");
    ASSERT_FALSE(large);
    EXPECT_NE(large.error().message().find("60000 by 60000"), std::string::npos) << large.error().message();
    put(folder / "huge.png", header_only(0x7fffffffU, 0x7fffffffU));
    EXPECT_FALSE(read_png(folder / "huge.png"));
    put(folder / "none.png", header_only(0, 5));
    EXPECT_FALSE(read_png(folder / "none.png"));
}

TEST(ReadPng, WhatIsNoPng) {
    const TemporaryFolder folder;
    EXPECT_FALSE(read_png(folder / "missing.png"));
    EXPECT_FALSE(read_png(folder / ""));
    put(folder / "text.png", "This is text, and more than eight bytes of it.");
    const Result<Image> text = read_png(folder / "text.png");
    ASSERT_FALSE(text);
    EXPECT_NE(text.error().message().find("text.png"), std::string::npos);
}

}  // namespace
}  // namespace barycert
