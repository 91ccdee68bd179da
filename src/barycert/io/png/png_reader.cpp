#include "barycert/io/png/png_reader.hpp"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdio>
#include <new>

#include "barycert/base/input_file.hpp"
#include "barycert/io/png/png_rows.hpp"

namespace barycert::io {
namespace {

/// All that outlives a jump: libpng leaves by longjmp, past which no object with a destructor may be.
struct Decoder {
    const base::InputFile& file;
    const std::string& path;
    std::uint64_t at = 0;  ///< of the next byte
    PngPixels pixels = {};
    std::uint64_t bits = 0;              ///< of a pixel in the file
    std::vector<png_bytep> places = {};  ///< of the rows
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::array<char, 200> message{};
    Error unreadable = {};  ///< what the system said, if it was the system
    bool no_memory = false, cut_short = false;

    Decoder(const base::InputFile& f, const std::string& p) : file(f), path(p) {}
    ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
};

extern "C" {

void on_png_read_error(png_structp png, png_const_charp text) {
    auto& message = static_cast<Decoder*>(png_get_error_ptr(png))->message;
    std::snprintf(message.data(), message.size(), "%s", text);
    png_longjmp(png, 1);
}

void on_png_read_warning(png_structp, png_const_charp) {}  // libpng's own would print

void read_png_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto* const decoder = static_cast<Decoder*>(png_get_io_ptr(png));
    bool failed = true;
    try {
        const auto read = decoder->file.read_at(decoder->at, {reinterpret_cast<char*>(bytes), count}, decoder->path);
        decoder->cut_short = read && *read != count;
        if (!read) decoder->unreadable = read.error();
        failed = !read || decoder->cut_short;
    } catch (const std::bad_alloc&) {  // may not pass through C
        decoder->no_memory = true;
    }
    if (failed) png_error(png, "cannot read");
    decoder->at += count;
}

}  // extern "C"

/// The size, and how pixels will come. False if libpng gave up.
bool decode_header(Decoder& d) {
    if (setjmp(png_jmpbuf(d.png)) != 0) return false;
    png_set_read_fn(d.png, &d, read_png_bytes);
    png_set_user_limits(d.png, static_cast<png_uint_32>(longest_png_side), static_cast<png_uint_32>(longest_png_side));
    // Skips all but IHDR, PLTE, tRNS, IDAT and IEND: for others libpng takes as much memory as they say they are long.
    png_set_keep_unknown_chunks(d.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_read_info(d.png, d.info);
    d.bits = std::uint64_t{png_get_bit_depth(d.png, d.info)} * png_get_channels(d.png, d.info);
    png_set_expand(d.png);    // palettes, less than 8 bits, a transparent colour
    png_set_scale_16(d.png);  // rounded, not cut
    png_set_gray_to_rgb(d.png);
    png_set_add_alpha(d.png, 0xff, PNG_FILLER_AFTER);
    png_set_interlace_handling(d.png);
    png_read_update_info(d.png, d.info);
    d.pixels.width = png_get_image_width(d.png, d.info);
    d.pixels.height = png_get_image_height(d.png, d.info);
    return true;
}

/// Precondition: there are places for the rows. False if libpng gave up.
bool decode_rows(Decoder& d) {
    if (setjmp(png_jmpbuf(d.png)) != 0) return false;
    if (png_get_rowbytes(d.png, d.info) != 4 * std::size_t{d.pixels.width}) png_error(d.png, "pixels of another size");
    png_read_image(d.png, d.places.data());
    png_read_end(d.png, nullptr);
    return true;
}

Error failure(const Decoder& d) {
    if (d.no_memory) throw std::bad_alloc();
    if (!d.unreadable.what.empty()) return d.unreadable;
    const bool no_struct = d.png == nullptr || d.info == nullptr;
    return {.what = "cannot read the PNG file",
            .file = d.path,
            .expected = d.at == 0 && !no_struct ? "a PNG file" : "",
            .found = no_struct     ? "libpng does not start"
                     : d.cut_short ? "the end of the file"
                                   : std::string(d.message.data()),
            .remedy = d.cut_short ? "get or make the file again: it is cut short" : "get or make the file again"};
}

}  // namespace

Result<PngPixels> read_png_pixels(const std::string& path, std::uint64_t max_pixels) {
    const Result<base::InputFile> file = base::InputFile::open(path);
    if (!file) return file.error();
    Decoder decoder(*file, path);
    decoder.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &decoder, on_png_read_error, on_png_read_warning);
    if (decoder.png != nullptr) decoder.info = png_create_info_struct(decoder.png);
    if (decoder.info == nullptr || !decode_header(decoder)) return failure(decoder);
    PngPixels& pixels = decoder.pixels;
    if (std::uint64_t{pixels.width} * pixels.height > max_pixels) {
        return Error{.what = "the PNG file is too large",
                     .file = path,
                     .expected = "at most " + std::to_string(max_pixels) + " pixels",
                     .found = std::to_string(pixels.width) + " by " + std::to_string(pixels.height),
                     .remedy = "scale it down"};
    }
    // Deflate makes a byte of 1032 at most: where the file cannot hold so many pixels, no memory is taken for them.
    constexpr std::uint64_t most_of_a_byte = 1032;
    if (std::uint64_t{pixels.width} * pixels.height * decoder.bits / 8 > most_of_a_byte * file->size()) {
        decoder.cut_short = true;
        return failure(decoder);
    }
    const std::size_t row = 4 * std::size_t{pixels.width};
    pixels.rows.resize(row * pixels.height);
    decoder.places.resize(pixels.height);
    for (std::size_t r = 0; r < pixels.height; ++r) decoder.places[r] = pixels.rows.data() + r * row;
    if (!decode_rows(decoder)) return failure(decoder);
    return std::move(decoder.pixels);
}

}  // namespace barycert::io
