// Pictures as SVG: as markup of a page, and as files.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/raster.hpp"
#include "core/base/text.hpp"
#include "draw/picture.hpp"
#include "draw/png/png_file.hpp"

namespace barycert::draw {
namespace {

std::string colour_text(Rgba c) {
    return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

class Writer {
public:
    /// Without a ground it is markup for a page.
    Writer(const Picture& picture, const Rgba* ground) : ground_(ground) {
        out_ = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
            "height=\"{1:.0f}\" role=\"img\"{3}>\n<title>{2}</title>\n",
            picture.width, picture.height, xml_escaped(picture.title),
            ground == nullptr ? "" : " font-family=\"DejaVu Sans,Verdana,sans-serif\"");
        if (ground != nullptr && (*ground)[3] != 0)
            out_ += fmt::format("<rect width=\"{:.0f}\" height=\"{:.0f}\" fill=\"{}\"/>\n", picture.width,
                                picture.height, colour_text(*ground));
        for (const PictureItem& item : picture.items) add(item);
        out_ += "</svg>\n";
    }

    std::string text() && { return std::move(out_); }

private:
    enum class Paint : unsigned char { stroke, fill, text };

    /// The attributes of its look.
    std::string look(const PictureItem& item, Paint paint) const {
        if (ground_ == nullptr) {
            const std::string own = item.colour ? fmt::format(" fill=\"{}\"", colour_text(*item.colour)) : "";
            return item.style.empty() ? own : fmt::format(" class=\"{}\"{}", item.style, own);
        }
        const Look l = look_of(item.style, is_dark(*ground_));
        const Rgba colour = item.colour.value_or(l.colour);
        const bool edged = item.kind == PictureItem::Kind::area && item.width > 0;
        if (paint == Paint::fill)
            return fmt::format(" fill=\"{}\"{}", colour_text(colour), opacity(colour)) +
                   (edged ? fmt::format(" stroke=\"{}\" stroke-width=\"{:g}\"", colour_text(colour), item.width) : "");
        if (paint == Paint::text) {
            const std::string_view anchor = l.anchor == 'm'   ? " text-anchor=\"middle\""
                                            : l.anchor == 'e' ? " text-anchor=\"end\""
                                                              : "";
            return fmt::format(" font-size=\"{:g}\" fill=\"{}\"{}", l.size, colour_text(colour), anchor);
        }
        return fmt::format(" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\" stroke-linejoin=\"round\"{}",
                           colour_text(colour), item.width > 0 ? item.width : l.line,
                           l.on > 0 ? fmt::format(" stroke-dasharray=\"{:g} {:g}\"", l.on, l.off) : "");
    }
    static std::string opacity(Rgba c) {
        return c[3] == 255 ? "" : fmt::format(" fill-opacity=\"{:.3g}\"", c[3] / 255.0);
    }

    static std::string tip(const PictureItem& item) {
        return item.text.empty() ? "" : fmt::format("<title>{}</title>", xml_escaped(item.text));
    }

    void add(const PictureItem& item) {
        using Kind = PictureItem::Kind;
        switch (item.kind) {
            case Kind::lines:
            case Kind::area:
                return add_path(item);
            case Kind::bar:
                out_ += fmt::format("<rect{} x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">{}</rect>\n",
                                    look(item, Paint::fill), item.at.x, item.at.y, item.width, item.height, tip(item));
                break;
            case Kind::circle:
                out_ += fmt::format("<circle{} cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\">{}</circle>\n",
                                    look(item, Paint::fill), item.at.x, item.at.y, item.width, tip(item));
                break;
            case Kind::text:
                out_ += fmt::format(
                    "<text{} x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", look(item, Paint::text), item.at.x, item.at.y,
                    item.upwards ? fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", item.at.x, item.at.y) : "",
                    xml_escaped(item.text));
                break;
            case Kind::image:
                out_ += fmt::format(
                    "<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                    "preserveAspectRatio=\"none\"{} "
                    "href=\"{}\"/>\n",
                    item.at.x, item.at.y, item.width, item.height,
                    item.style == "pixels" ? " style=\"image-rendering:pixelated\"" : "",
                    data_uri("image/png", png_text(*item.image)));
                break;
        }
    }

    void add_path(const PictureItem& item) {
        const bool closed = item.kind == PictureItem::Kind::area;
        const int decimals = item.width > 0 ? 3 : 1;
        const std::string path = base::joined(item.lines, "", [&](const std::vector<Pixel>& line) {
            return "M" +
                   base::joined(line, "L",
                                [&](Pixel p) { return fmt::format("{:.{}f} {:.{}f}", p.x, decimals, p.y, decimals); }) +
                   (closed ? "Z" : "");
        });
        out_ += fmt::format("<path{} d=\"{}\"/>\n", look(item, closed ? Paint::fill : Paint::stroke), path);
    }

    const Rgba* ground_;
    std::string out_;
};

}  // namespace

std::string clean_text(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const base::Character c = base::first_character(text);
        const bool control = c.code < 0x20 || c.code == 0x7f || c.code == 0xfffe || c.code == 0xffff;
        out += c.size == 0 ? "\xef\xbf\xbd" : control ? " " : text.substr(0, c.size);
        text.remove_prefix(std::max<std::size_t>(c.size, 1));
    }
    return out;
}

std::string xml_escaped(std::string_view text) {
    std::string out;
    for (const char c : clean_text(text)) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string png_text(const Image& image) {
    const auto row = static_cast<std::size_t>(4 * image.width);
    std::vector<std::uint8_t> pixels;
    pixels.reserve(image.data.size());
    for (std::size_t at = image.data.size(); at >= row; at -= row)
        pixels.insert(pixels.end(), image.data.begin() + static_cast<std::ptrdiff_t>(at - row),
                      image.data.begin() + static_cast<std::ptrdiff_t>(at));
    return png::png_bytes(static_cast<std::size_t>(image.width), pixels).value();
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) out += k > left ? '=' : digits[group >> (18 - 6 * k) & 63U];
    }
    return out;
}

std::string svg_markup(const Picture& picture) {
    return Writer(picture, nullptr).text();
}

std::string svg_text(const Picture& picture, Rgba ground) {
    return Writer(picture, &ground).text();
}

}  // namespace barycert::draw
