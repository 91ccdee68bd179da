/// Pictures of lines, bars, marks, text and images, kept until they are written: into a page, whose style sheet says
/// how each class looks, or as a file, where look_of says it.
///
/// Coordinates are pixels, y downwards.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/raster.hpp"

namespace barycert::draw {

struct Pixel {
    double x = 0, y = 0;
};

enum class Mark : unsigned char { circle, square, diamond, up, down, cross };

/// One thing that is drawn, in one look. `kind` says which members count.
struct PictureItem {
    enum class Kind : unsigned char { lines, area, bar, circle, text, image };
    Kind kind;
    std::string style = {};                      ///< classes; "m" and "e" are the anchors middle and end of a text
    std::vector<std::vector<Pixel>> lines = {};  ///< of an area one, closed
    Pixel at = {};                               ///< the upper left corner, the centre, or where the text stands
    double width = 0, height = 0;                ///< of a circle its radius; of lines that of a line, if not 0
    std::string text = {};                       ///< or what a page tells when it is pointed at
    bool upwards = false;                        ///< text
    std::optional<Rgba> colour = {};             ///< in place of the look's
    std::shared_ptr<const Image> image = {};     ///< one pixel of it is width / image->width pixels wide
};

class Picture {
public:
    /// `told`: to a reader who cannot see it.
    Picture(double wide, double tall, std::string told) : width(wide), height(tall), title(std::move(told)) {}

    double width, height;
    std::string title;
    std::vector<PictureItem> items = {};

    void line(Pixel from, Pixel to, std::string style) { path({from, to}, std::move(style)); }
    void path(std::vector<Pixel> corners, std::string style) {
        if (corners.size() > 1) items.push_back({PictureItem::Kind::lines, std::move(style), {std::move(corners)}});
    }
    /// Many in one item.
    void lines(const std::vector<std::pair<Pixel, Pixel>>& segments, std::string style) {
        if (segments.empty()) return;
        PictureItem& item = items.emplace_back(PictureItem{PictureItem::Kind::lines, std::move(style)});
        for (const auto& [a, b] : segments) item.lines.push_back({a, b});
    }
    void area(std::vector<Pixel> corners, std::string style, std::optional<Rgba> colour = {}) {
        items.push_back({.kind = PictureItem::Kind::area, .style = std::move(style), .lines = {std::move(corners)}});
        items.back().colour = colour;
    }
    void bar(Pixel corner, double wide, double tall, std::string style, std::string tip = {},
             std::optional<Rgba> colour = {}) {
        items.push_back({.kind = PictureItem::Kind::bar,
                         .style = std::move(style),
                         .at = corner,
                         .width = wide,
                         .height = tall,
                         .text = std::move(tip),
                         .colour = colour});
    }
    void circle(Pixel at, double radius, std::string style, std::string tip = {}) {
        items.push_back({.kind = PictureItem::Kind::circle,
                         .style = std::move(style),
                         .at = at,
                         .width = radius,
                         .text = std::move(tip)});
    }
    void mark(Pixel at, Mark mark, double r, const std::string& style);
    void text(Pixel at, std::string text, std::string style, bool upwards = false) {
        items.push_back({.kind = PictureItem::Kind::text,
                         .style = std::move(style),
                         .at = at,
                         .text = std::move(text),
                         .upwards = upwards});
    }
    /// The items of another one, from there on.
    void add(const Picture& other, Pixel corner);
    /// "pixels": they stay squares, however large.
    void place(Pixel corner, double wide, double tall, std::shared_ptr<const Image> image, std::string style = {}) {
        items.push_back({.kind = PictureItem::Kind::image,
                         .style = std::move(style),
                         .at = corner,
                         .width = wide,
                         .height = tall,
                         .image = std::move(image)});
    }
};

/// How a class looks in a file.
struct Look {
    Rgba colour{34, 34, 34, 255};
    double line = 1;         ///< its width
    double on = 0, off = 0;  ///< dashes; 0: none
    double size = 12;        ///< of text
    char anchor = 's';       ///< of text: s, m or e
};

/// Returns the look of some classes, each overriding what those before it say. `dark`: on a dark ground.
Look look_of(std::string_view classes, bool dark);

/// Colours of curves and classes, which most eyes tell apart (Okabe's and Ito's); one after the other.
Rgba curve_colour(std::size_t i);

/// Control characters, which no XML may hold, become spaces, bytes that are not UTF-8 U+FFFD.
std::string clean_text(std::string_view text);

/// As an XML reader takes it back, clean.
std::string xml_escaped(std::string_view text);

/// RFC 4648's, with padding.
std::string base64(std::string_view bytes);
inline std::string data_uri(const std::string& type, std::string_view bytes) {
    return "data:" + type + ";base64," + base64(bytes);
}

/// The bytes of a .png file.
std::string png_text(const Image& image);

/// Markup for a page, by classes, with one decimal, so that the same data give the same bytes.
std::string svg_markup(const Picture& picture);

/// True of a ground on which text and lines are light.
bool is_dark(Rgba ground);

/// A file of its own; text stays text. Opacity 0: no ground.
std::string svg_text(const Picture& picture, Rgba ground = {255, 255, 255, 255});

/// Text at a point: beside it, where it keeps clear of other labels.
struct Label {
    Pixel at;
    std::string text;
    std::string style;
};

/// Away from the middle of all points where there is room, inside the picture from `top` on. Labels of points less than
/// 4 pixels apart are joined; one that went far from its point gets a line to it.
void place_labels(Picture& picture, std::vector<Label> labels, double top = 0);

}  // namespace barycert::draw
