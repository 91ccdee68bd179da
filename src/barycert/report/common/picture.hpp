/// Pictures as SVG, in HTML pages or files of their own: lines, bars, marks, text, axes, and labels that keep clear of
/// each other. Looks are classes of a style sheet: the page's, or the file's.
///
/// Coordinates are pixels, y downwards, with one decimal, so that the same data give the same bytes. Text is escaped.
#pragma once

#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {

// Text and bytes in HTML and XML.

/// As an XML reader takes it back; control characters, which no XML may hold, become spaces, bytes not UTF-8 U+FFFD.
std::string html_escaped(std::string_view text);

/// A name of words and dots: escaped, and where lines are short broken behind dots, not within words.
std::string html_name(std::string_view name);

/// Bytes as "data:TYPE;base64,...".
std::string data_uri(std::string_view type, std::string_view bytes);

struct Pixel {
    double x = 0, y = 0;
};

enum class Mark : unsigned char { circle, square, diamond, up, down, cross };

class Picture {
public:
    /// `title` is what a reader is told who cannot see it. With a style of its own, on a white ground, it is a file.
    Picture(double width, double height, std::string_view title, std::string_view style = {})
        : width_(width),
          height_(height),
          body_(
              fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
                          "height=\"{1:.0f}\" role=\"img\">\n<title>{2}</title>\n",
                          width, height, html_escaped(title))) {
        if (!style.empty())
            body_ += fmt::format("<style>{}</style>\n<rect width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#fff\"/>\n", style,
                                 width, height);
    }

    void line(Pixel from, Pixel to, std::string_view style) { path({from, to}, style); }
    void path(const std::vector<Pixel>& corners, std::string_view style, bool closed = false) {
        if (corners.size() < 2) return;
        const auto more = [](const Pixel& p) { return fmt::format("{:.1f} {:.1f}", p.x, p.y); };
        draw(style, "M" + joined(corners, "L", more) + (closed ? "Z" : ""));
    }
    void polygon(const std::vector<Pixel>& corners, std::string_view style) { path(corners, style, true); }
    void bar(Pixel corner, double width, double height, std::string_view style, std::string_view tip) {
        body_ += fmt::format(
            "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
            "height=\"{:.1f}\"><title>{}</title></rect>\n",
            style, corner.x, corner.y, width, height, html_escaped(tip));
    }
    void dot(Pixel at, double radius, std::string_view style, std::string_view tip = {}) {
        body_ +=
            fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\">", style, at.x, at.y, radius);
        if (!tip.empty()) body_ += fmt::format("<title>{}</title>", html_escaped(tip));
        body_ += "</circle>\n";
    }
    void mark(Pixel at, Mark mark, double r, std::string_view style) {
        const auto [x, y] = at;
        const std::string filled = std::string(style) + " mark";
        if (mark == Mark::circle) dot(at, r, filled);
        if (mark == Mark::cross) lines({{{x - r, y - r}, {x + r, y + r}}, {{x - r, y + r}, {x + r, y - r}}}, style);
        if (mark == Mark::square) polygon({{x - r, y - r}, {x + r, y - r}, {x + r, y + r}, {x - r, y + r}}, filled);
        if (mark == Mark::diamond) polygon({{x - r, y}, {x, y - r}, {x + r, y}, {x, y + r}}, filled);
        if (mark == Mark::up) polygon({{x - r, y + r}, {x, y - r}, {x + r, y + r}}, filled);
        if (mark == Mark::down) polygon({{x - r, y - r}, {x, y + r}, {x + r, y - r}}, filled);
    }
    /// Many, in one element; and lines likewise.
    void dots(const std::vector<Pixel>& at, std::string_view style) {
        draw(style, joined(at, "", [](const Pixel& p) { return fmt::format("M{:.1f} {:.1f}h0", p.x, p.y); }));
    }
    void lines(const std::vector<std::pair<Pixel, Pixel>>& segments, std::string_view style) {
        draw(style, joined(segments, "", [](const auto& s) {
                 return fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", s.first.x, s.first.y, s.second.x, s.second.y);
             }));
    }
    /// `style` may be several classes; "m" and "e" are the anchors middle and end.
    void text(Pixel at, std::string_view text, std::string_view style, bool upwards = false) {
        body_ += fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", style, at.x, at.y,
                             upwards ? fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", at.x, at.y) : "",
                             html_escaped(text));
    }

    double width() const { return width_; }
    double height() const { return height_; }
    std::string finish() && {
        body_ += "</svg>\n";
        return std::move(body_);
    }

private:
    /// Nothing if there is no path.
    void draw(std::string_view style, const std::string& path) {
        if (!path.empty()) body_ += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, path);
    }

    double width_, height_;
    std::string body_;
};

/// Text at a point: beside it, where it keeps clear of other labels.
struct Label {
    Pixel at;
    std::string text;
    std::string_view style;
};

/// Away from the middle of all points where there is room, inside the picture from `top` on. Labels of points less than
/// 4 pixels apart are joined; one that went far from its point gets a line to it.
void place_labels(Picture& picture, std::vector<Label> labels, double top = 0);

struct Tick {
    double at;
    std::string text;
};

/// Round numbers in [low, high]: multiples of 1, 2 or 5 times a power of ten, at most `max` of them (at least 2).
std::vector<double> round_ticks(double low, double high, int max);
/// Of an axis of log10: 1, 2 and 5 times each power of ten in [low, high].
std::vector<Tick> decade_ticks(double low, double high);

/// "⁻¹²": the number, rounded, as an exponent.
std::string superscript(double exponent);

/// A linear axis: numbers [low, high] onto pixels [from, to].
struct Axis {
    double low = 0, high = 1;
    double from = 0, to = 1;
    std::string title = {};
    std::vector<Tick> ticks = {};
    bool grid = true;  ///< a line across the picture at each tick

    double at(double x) const { return from + (to - from) * (x - low) / (high - low); }
};

/// The line across, ticks with their numbers, the grid, and the titles below and to the left, which take 60 pixels.
void draw_axes(Picture& picture, const Axis& x, const Axis& y);

/// The part of the line through `a` and `b` (numbers, not pixels) that lies between the axes; nothing if none does.
void draw_line_through(Picture& picture, const Axis& x, const Axis& y, Pixel a, Pixel b, std::string_view style);

}  // namespace barycert::report
