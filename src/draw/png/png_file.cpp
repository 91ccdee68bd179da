#include "draw/png/png_file.hpp"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/result.hpp"
#include "files/input_file.hpp"
#include "files/output_file.hpp"

namespace barycert::png {
namespace {

/// All that outlives a jump: libpng leaves by longjmp, past which no object with a destructor may be.
struct Session {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::array<char, 200> message{};

    Session() = default;
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
};

struct Decoder : Session {
    std::string_view bytes;  ///< of the file
    std::size_t at = 0;      ///< of the next one
    PngPixels pixels = {};
    bool too_large = false, cut_short = false;

    ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct Encoder : Session {
    base::OutputFile& file;
    const std::function<void(std::size_t, std::uint8_t*)>& row;
    std::vector<std::uint8_t> pixels;
    png_uint_32 width, height;
    PngContent content;
    bool no_memory = false;

    ~Encoder() { png_destroy_write_struct(&png, &info); }
};

extern "C" {

void on_png_error(png_structp png, png_const_charp text) {
    auto& message = static_cast<Session*>(png_get_error_ptr(png))->message;
    std::snprintf(message.data(), message.size(), "%s", text);
    png_longjmp(png, 1);
}

void on_png_warning(png_structp, png_const_charp) {}  // libpng's own would print

void read_png_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto* const decoder = static_cast<Decoder*>(png_get_io_ptr(png));
    decoder->cut_short = count > decoder->bytes.size() - decoder->at;
    if (decoder->cut_short) png_error(png, "cannot read");
    std::copy_n(decoder->bytes.data() + decoder->at, count, reinterpret_cast<char*>(bytes));
    decoder->at += count;
}

void write_png_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto* const encoder = static_cast<Encoder*>(png_get_io_ptr(png));
    try {
        encoder->file.write({reinterpret_cast<const char*>(bytes), count});
    } catch (const std::bad_alloc&) {  // may not pass through C
        encoder->no_memory = true;
    }
    if (encoder->no_memory || !encoder->file.status()) png_error(png, "cannot write");
}

void flush_png(png_structp) {}

}  // extern "C"

/// False if libpng gave up, or no memory is to be taken for the pixels.
bool decode(Decoder& d, std::uint64_t max_pixels) {
    if (setjmp(png_jmpbuf(d.png)) != 0) return false;
    png_set_read_fn(d.png, &d, read_png_bytes);
    png_set_user_limits(d.png, static_cast<png_uint_32>(longest_png_side), static_cast<png_uint_32>(longest_png_side));
    // Skips all but IHDR, PLTE, tRNS, IDAT and IEND: for others libpng takes as much memory as they say they are long.
    png_set_keep_unknown_chunks(d.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_read_info(d.png, d.info);
    const std::uint64_t bits = std::uint64_t{png_get_bit_depth(d.png, d.info)} * png_get_channels(d.png, d.info);
    png_set_expand(d.png);    // palettes, less than 8 bits, a transparent colour
    png_set_scale_16(d.png);  // rounded, not cut
    png_set_gray_to_rgb(d.png);
    png_set_add_alpha(d.png, 0xff, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(d.png);
    png_read_update_info(d.png, d.info);
    d.pixels.width = png_get_image_width(d.png, d.info);
    d.pixels.height = png_get_image_height(d.png, d.info);
    const std::uint64_t pixels = std::uint64_t{d.pixels.width} * d.pixels.height;
    // Deflate makes a byte of 1032 at most: where the file cannot hold so many pixels, no memory is taken for them.
    constexpr std::uint64_t most_of_a_byte = 1032;
    d.too_large = pixels > max_pixels;
    d.cut_short = pixels * bits / 8 > most_of_a_byte * d.bytes.size();
    if (d.too_large || d.cut_short) return false;
    const std::size_t row = 4 * std::size_t{d.pixels.width};
    if (png_get_rowbytes(d.png, d.info) != row) png_error(d.png, "pixels of another size");
    d.pixels.rows.resize(4 * pixels);
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t at = 0; at < d.pixels.rows.size(); at += row)
            png_read_row(d.png, d.pixels.rows.data() + at, nullptr);
    }
    png_read_end(d.png, nullptr);
    return true;
}

bool encode(Encoder& e) {
    if (setjmp(png_jmpbuf(e.png)) != 0) return false;
    png_set_write_fn(e.png, &e, write_png_bytes, flush_png);
    png_set_IHDR(e.png, e.info, e.width, e.height, 8, PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(e.png, e.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_filter(e.png, PNG_FILTER_TYPE_BASE,
                   e.content == PngContent::few_colours ? PNG_FILTER_NONE : PNG_ALL_FILTERS);
    png_write_info(e.png, e.info);
    for (png_uint_32 r = 0; r < e.height; ++r) {
        e.row(r, e.pixels.data());
        png_write_row(e.png, e.pixels.data());
    }
    png_write_end(e.png, e.info);
    return true;
}

Result<std::string> in_memory(png_image& image, std::size_t width, std::size_t height,
                              std::span<const std::uint8_t> pixels, std::size_t bytes, const void* map) {
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string out(size, '\0');
    const auto stride = static_cast<png_int_32>(bytes * width);
    const int done = png_image_write_to_memory(&image, out.data(), &size, 0, pixels.data(), stride, map);
    const std::string message = image.message;
    png_image_free(&image);
    if (done == 0) return Error{.code = "picture.failed", .what = "cannot make a picture", .found = message};
    out.resize(size);
    return out;
}

}  // namespace

Result<PngPixels> read_png_pixels(const std::string& path, std::uint64_t max_pixels) {
    const Result<base::InputFile> input = base::InputFile::open(path);
    if (!input) return input.error();
    // Reads only the first bytes of a file that is no PNG, and refuses one larger than any picture of so many pixels.
    std::array<char, 8> start{};
    const Result<std::size_t> got = input->read_at(0, start, path);
    if (!got) return got.error();
    const bool is_png = *got == start.size() && png_sig_cmp(reinterpret_cast<png_const_bytep>(start.data()), 0, 8) == 0;
    const std::uint64_t most = 16 * max_pixels + (std::uint64_t{1} << 26);
    if (is_png && input->size() > most)
        return file_error("file.too-large", path, "the PNG file is too large",
                          "at most " + std::to_string(most) + " bytes", std::to_string(input->size()),
                          "save it without what is no picture");
    const auto file =
        base::MappedFile::read(*input, path, is_png ? static_cast<std::size_t>(input->size()) : start.size());
    if (!file) return file.error();
    Decoder d{{}, file->bytes()};
    d.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &d, on_png_error, on_png_warning);
    if (d.png != nullptr) d.info = png_create_info_struct(d.png);
    const bool made = d.info != nullptr;
    if (made && decode(d, max_pixels)) return std::move(d.pixels);
    if (d.too_large)
        return file_error("file.too-large", path, "the PNG file is too large",
                          "at most " + std::to_string(max_pixels) + " pixels",
                          std::to_string(d.pixels.width) + " by " + std::to_string(d.pixels.height), "scale it down");
    return file_error(d.cut_short ? ErrorCode("file.truncated") : ErrorCode("file.format"), path,
                      "cannot read the PNG file", d.at == 0 && made ? "a PNG file" : "",
                      !made         ? "libpng does not start"
                      : d.cut_short ? "the end of the file"
                                    : std::string(d.message.data()),
                      d.cut_short ? "get or make the file again: it is cut short" : "get or make the file again");
}

Status write_png_rows(const std::string& path, std::size_t width, std::size_t height,
                      const std::function<void(std::size_t, std::uint8_t*)>& row, PngContent content) {
    base::OutputFile file(path);
    if (Status opened = file.status(); !opened) return opened;
    const auto columns = static_cast<png_uint_32>(width), rows = static_cast<png_uint_32>(height);
    Encoder encoder{{}, file, row, std::vector<std::uint8_t>(4 * width), columns, rows, content};
    encoder.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &encoder, on_png_error, on_png_warning);
    if (encoder.png != nullptr) encoder.info = png_create_info_struct(encoder.png);
    const bool made = encoder.info != nullptr;
    const bool done = made && encode(encoder);
    if (encoder.no_memory) throw std::bad_alloc();
    if (Status written = file.status(); !written) return written;
    if (done) return file.commit();
    return file_error("picture.failed", path, "cannot make the PNG file", {},
                      made ? std::string(encoder.message.data()) : "libpng does not start",
                      "make sure that memory suffices and that the libpng installed is the one built with");
}

Result<std::string> indexed_png(std::size_t width, std::span<const std::uint8_t> pixels,
                                std::span<const Colour> colours) {
    std::vector<std::uint8_t> map;
    for (const Colour& c : colours) map.insert(map.end(), c.begin(), c.end());
    png_image image{};
    image.format = PNG_FORMAT_RGB_COLORMAP;
    image.colormap_entries = static_cast<png_uint_32>(colours.size());
    return in_memory(image, width, pixels.size() / width, pixels, 1, map.data());
}

Result<std::string> png_bytes(std::size_t width, std::span<const std::uint8_t> pixels) {
    png_image image{};
    image.format = PNG_FORMAT_RGBA;
    return in_memory(image, width, pixels.size() / 4 / width, pixels, 4, nullptr);
}

}  // namespace barycert::png
