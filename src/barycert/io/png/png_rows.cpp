#include "barycert/io/png/png_rows.hpp"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdio>
#include <new>
#include <string_view>
#include <vector>

#include "barycert/base/output_file.hpp"

namespace barycert::io {
namespace {

/// All that outlives a jump: libpng leaves by longjmp, past which no object with a destructor may be.
struct Encoder {
    base::OutputFile& file;
    const std::function<void(std::size_t, std::uint8_t*)>& row;
    std::vector<std::uint8_t> pixels;
    png_uint_32 width = 0, height = 0;
    PngContent content = PngContent::few_colours;
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::array<char, 200> message{};
    bool no_memory = false;

    Encoder(base::OutputFile& f, const std::function<void(std::size_t, std::uint8_t*)>& r) : file(f), row(r) {}
    ~Encoder() { png_destroy_write_struct(&png, &info); }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;
};

extern "C" {

void on_png_error(png_structp png, png_const_charp text) {
    auto& message = static_cast<Encoder*>(png_get_error_ptr(png))->message;
    std::snprintf(message.data(), message.size(), "%s", text);
    png_longjmp(png, 1);
}

void on_png_warning(png_structp, png_const_charp) {}  // libpng's own would print

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

/// False if libpng gave up.
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

}  // namespace

Status write_png_rows(const std::string& path, std::size_t width, std::size_t height,
                      const std::function<void(std::size_t, std::uint8_t*)>& row, PngContent content) {
    base::OutputFile file(path);
    if (Status opened = file.status(); !opened) return opened;
    Encoder encoder(file, row);
    encoder.pixels.resize(4 * width);
    encoder.width = static_cast<png_uint_32>(width);
    encoder.height = static_cast<png_uint_32>(height);
    encoder.content = content;
    encoder.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &encoder, on_png_error, on_png_warning);
    if (encoder.png != nullptr) encoder.info = png_create_info_struct(encoder.png);
    const bool made = encoder.info != nullptr;
    const bool done = made && encode(encoder);
    if (encoder.no_memory) throw std::bad_alloc();
    if (Status written = file.status(); !written) return written;
    if (done) return file.commit();
    return Error{.what = "cannot make the PNG file",
                 .file = path,
                 .expected = {},
                 .found = made ? std::string(encoder.message.data()) : "libpng does not start",
                 .remedy = "make sure that memory suffices and that the libpng installed is the one built with"};
}

}  // namespace barycert::io
