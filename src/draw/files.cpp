// Text and vectors by cairo and FreeType.
#include "draw/files.hpp"

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "draw/picture.hpp"
#include "files/embedded.hpp"
#include "files/format.hpp"
#include "files/output_file.hpp"

// As it is in data/fonts.
BARYCERT_EMBED(barycert_font, BARYCERT_FONT);

namespace barycert::draw {
namespace {

template <auto destroy>
struct Destroy {
    template <class T>
    void operator()(T* p) const {
        destroy(p);
    }
};
template <class T, auto destroy>
using Owned = std::unique_ptr<T, Destroy<destroy>>;

/// A face may be used by one thread at a time: each has its own.
class Font {
public:
    static const Font& own() {
        thread_local const Font font;
        return font;
    }
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    cairo_font_face_t* face() const { return cairo_.get(); }

    double width(std::string_view text, double size) const {
        double units = 0;
        while (!text.empty()) {
            const base::Character c = base::first_character(text);
            if (FT_Load_Glyph(face_, FT_Get_Char_Index(face_, c.size == 0 ? 0xfffd : c.code), FT_LOAD_NO_SCALE) == 0)
                units += static_cast<double>(face_->glyph->metrics.horiAdvance);
            text.remove_prefix(std::max<std::size_t>(c.size, 1));
        }
        return units / face_->units_per_EM * size;
    }

private:
    Font() {
        const auto size = static_cast<FT_Long>(&barycert_font_end[0] - &barycert_font[0]);
        const auto* const bytes = reinterpret_cast<const FT_Byte*>(&barycert_font[0]);
        if (FT_Init_FreeType(&library_) != 0 || FT_New_Memory_Face(library_, bytes, size, 0, &face_) != 0)
            throw std::bad_alloc();  // nothing else can be wrong with a font that is built in
        cairo_.reset(cairo_ft_font_face_create_for_ft_face(face_, FT_LOAD_NO_HINTING));
        // Cairo keeps what it made of the face in a store of its own: it ends the library when that is done with.
        static const cairo_user_data_key_t key{};
        const auto end = [](void* library) { FT_Done_FreeType(static_cast<FT_Library>(library)); };
        cairo_font_face_set_user_data(cairo_.get(), &key, library_, end);
    }
    ~Font() = default;

    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
    Owned<cairo_font_face_t, cairo_font_face_destroy> cairo_;
};

/// As cairo has pixels: from the top, multiplied by their opacity, in the machine's own order of bytes.
std::vector<std::uint32_t> multiplied(const Image& image) {
    std::vector<std::uint32_t> out;
    out.reserve(image.data.size() / 4);
    for (std::int32_t j = image.height; j-- > 0;) {
        for (std::int32_t i = 0; i < image.width; ++i) {
            const Rgba c = image.pixel(i, j);
            std::uint32_t all = std::uint32_t{c[3]} << 24;
            for (std::size_t k = 0; k < 3; ++k)
                all |= (std::uint32_t{c[k]} * c[3] + 127) / 255 << (16 - 8 * static_cast<unsigned>(k));
            out.push_back(all);
        }
    }
    return out;
}

class Painter {
public:
    Painter(cairo_surface_t* surface, const Picture& picture, Rgba ground, double scale)
        : to_(cairo_create(surface)), dark_(is_dark(ground)), scale_(scale) {
        cairo_scale(to_.get(), scale, scale);
        const Owned<cairo_font_options_t, cairo_font_options_destroy> options(cairo_font_options_create());
        cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
        cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
        cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
        cairo_set_font_options(to_.get(), options.get());
        cairo_set_font_face(to_.get(), Font::own().face());
        cairo_set_line_join(to_.get(), CAIRO_LINE_JOIN_ROUND);
        if (ground[3] != 0) {
            set(ground);
            cairo_paint(to_.get());
        }
        for (const PictureItem& item : picture.items) add(item);
    }

    cairo_status_t status() const { return cairo_status(to_.get()); }

private:
    void set(Rgba c) { cairo_set_source_rgba(to_.get(), c[0] / 255.0, c[1] / 255.0, c[2] / 255.0, c[3] / 255.0); }

    void add(const PictureItem& item) {
        using Kind = PictureItem::Kind;
        const Look look = look_of(item.style, dark_);
        set(item.colour.value_or(look.colour));
        switch (item.kind) {
            case Kind::lines:
                for (const auto& line : item.lines) trace(line);
                return stroke(look, item.width > 0 ? item.width : look.line);
            case Kind::area:
                for (const auto& line : item.lines) trace(line);
                cairo_close_path(to_.get());
                cairo_fill_preserve(to_.get());
                cairo_set_line_width(to_.get(), item.width);
                return item.width > 0 ? cairo_stroke(to_.get()) : cairo_new_path(to_.get());
            case Kind::bar:
                cairo_rectangle(to_.get(), item.at.x, item.at.y, item.width, item.height);
                return cairo_fill(to_.get());
            case Kind::circle:
                cairo_arc(to_.get(), item.at.x, item.at.y, item.width, 0, 2 * std::numbers::pi);
                return cairo_fill(to_.get());
            case Kind::text:
                return write(item, look);
            case Kind::image:
                return place(item);
        }
    }

    void trace(const std::vector<Pixel>& line) {
        for (std::size_t i = 0; i < line.size(); ++i)
            (i == 0 ? cairo_move_to : cairo_line_to)(to_.get(), line[i].x, line[i].y);
    }

    void stroke(const Look& look, double width) {
        const double dash[2] = {look.on, look.off};
        cairo_set_dash(to_.get(), dash, look.on > 0 ? 2 : 0, 0);
        cairo_set_line_width(to_.get(), width);
        cairo_stroke(to_.get());
    }

    void write(const PictureItem& item, const Look& look) {
        const std::string text = clean_text(item.text);
        const double width = text_width(text, look.size);
        const double back = look.anchor == 'm' ? width / 2 : look.anchor == 'e' ? width : 0;
        cairo_save(to_.get());
        cairo_set_font_size(to_.get(), look.size);
        cairo_translate(to_.get(), item.at.x, item.at.y);
        if (item.upwards) cairo_rotate(to_.get(), -std::numbers::pi / 2);
        cairo_move_to(to_.get(), -back, 0);
        cairo_show_text(to_.get(), text.c_str());
        cairo_restore(to_.get());
    }

    /// Pixel by pixel where it has as many as the surface there.
    void place(const PictureItem& item) {
        const Image& image = *item.image;
        std::vector<std::uint32_t> pixels = multiplied(image);
        const Owned<cairo_surface_t, cairo_surface_destroy> surface(
            cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_ARGB32,
                                                image.width, image.height, 4 * image.width));
        const double wide = item.width / image.width, tall = item.height / image.height;
        cairo_save(to_.get());
        cairo_translate(to_.get(), item.at.x, item.at.y);
        cairo_scale(to_.get(), wide, tall);
        cairo_set_source_surface(to_.get(), surface.get(), 0, 0);
        const bool same =
            item.style == "pixels" || (std::fabs(wide * scale_ - 1) < 1e-9 && std::fabs(tall * scale_ - 1) < 1e-9);
        cairo_pattern_set_filter(cairo_get_source(to_.get()), same ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
        cairo_paint(to_.get());
        cairo_restore(to_.get());
    }

    Owned<cairo_t, cairo_destroy> to_;
    bool dark_;
    double scale_;
};

cairo_status_t append(void* to, const unsigned char* bytes, unsigned int count) {
    try {
        static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
        return CAIRO_STATUS_SUCCESS;
    } catch (const std::bad_alloc&) {  // may not pass through C
        return CAIRO_STATUS_NO_MEMORY;
    }
}

Result<std::string> pdf_text(const Picture& picture, Rgba ground) {
    constexpr double points = 0.75;  // a pixel is 1/96 of an inch
    std::string bytes;
    const Owned<cairo_surface_t, cairo_surface_destroy> surface(
        cairo_pdf_surface_create_for_stream(append, &bytes, points * picture.width, points * picture.height));
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, clean_text(picture.title).c_str());
    const cairo_status_t drawn = Painter(surface.get(), picture, ground, points).status();
    cairo_surface_finish(surface.get());
    const cairo_status_t status = drawn != CAIRO_STATUS_SUCCESS ? drawn : cairo_surface_status(surface.get());
    if (status != CAIRO_STATUS_SUCCESS)
        return Error{
            .code = "picture.failed", .what = "cannot make the PDF file", .found = cairo_status_to_string(status)};
    // The same picture is the same file, whenever it is made; places of objects in the file stay.
    const std::size_t date = bytes.rfind("/CreationDate (");
    if (date != std::string::npos)
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(date), bytes.find(')', date) + 1 - date, ' ');
    return bytes;
}

}  // namespace

double text_width(std::string_view text, double size) {
    return Font::own().width(text, size);
}

Result<Image> drawn(const Picture& picture, Rgba ground, double scale) {
    const double wide = std::round(scale * picture.width), tall = std::round(scale * picture.height);
    constexpr double most = 32767;
    if (!(wide <= most && tall <= most))
        return file_error("picture.too-large", {}, "the picture is too large",
                          fmt::format("at most {} pixels a side", most), fmt::format("{:.0f} by {:.0f}", wide, tall));
    Result<Image> image = blank_image(static_cast<std::int32_t>(wide), static_cast<std::int32_t>(tall), {});
    if (!image) return image;
    std::vector<std::uint32_t> pixels(image->data.size() / 4);
    const Owned<cairo_surface_t, cairo_surface_destroy> surface(
        cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_ARGB32,
                                            image->width, image->height, 4 * image->width));
    if (const cairo_status_t status = Painter(surface.get(), picture, ground, scale).status();
        status != CAIRO_STATUS_SUCCESS)
        return Error{
            .code = "picture.failed", .what = "cannot draw the picture", .found = cairo_status_to_string(status)};
    cairo_surface_flush(surface.get());
    std::size_t at = 0;
    for (std::int32_t j = image->height; j-- > 0;) {
        for (std::int32_t i = 0; i < image->width; ++i) {
            const std::uint32_t all = pixels[at++], opacity = all >> 24;
            Rgba c{0, 0, 0, static_cast<std::uint8_t>(opacity)};
            for (std::size_t k = 0; k < 3 && opacity != 0; ++k)
                c[k] = static_cast<std::uint8_t>(((all >> (16 - 8 * k) & 255U) * 255 + opacity / 2) / opacity);
            image->set_pixel(i, j, c);
        }
    }
    return image;
}

Result<std::string> file_text(std::string_view path, const Picture& picture, Rgba ground, double scale) {
    if (base::kind_of(path) == base::FormatKind::pdf) return pdf_text(picture, ground);
    if (base::kind_of(path) != base::FormatKind::png) return svg_text(picture, ground);
    const Result<Image> image = drawn(picture, ground, scale);
    return image ? png_text(*image) : Result<std::string>(image.error());
}

Status write_picture(const std::string& path, const Picture& picture, Rgba ground, double scale) {
    if (base::kind_of(path) == base::FormatKind::png) {  // row by row
        const Result<Image> image = drawn(picture, ground, scale);
        return image ? write_png(path, *image) : Status(image.error());
    }
    const Result<std::string> text = file_text(path, picture, ground, scale);
    if (!text) return text.error();
    base::OutputFile file(path);
    file.write(*text);
    return file.commit();
}

}  // namespace barycert::draw
