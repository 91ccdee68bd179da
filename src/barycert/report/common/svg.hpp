/// Pictures as SVG, in one self-contained file: a canvas for lines, marks and text, and a frame with axes.
///
/// Coordinates are pixels, y downwards. Everything that comes from outside (names) goes through text(), which escapes
/// it. Numbers are written with one decimal, so that the same data give the same bytes.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace barycert::report {

/// As an XML reader takes it back; control characters, which no XML may hold, become spaces.
std::string xml_escaped(std::string_view text);

/// Round numbers in [low, high]: multiples of 1, 2 or 5 times a power of ten, at most `most` of them (at least 2).
std::vector<double> round_ticks(double low, double high, int max);

struct Stroke {
    std::string_view colour = "#222";
    double width = 1;
    std::string_view dashes = "";  ///< as SVG's stroke-dasharray; empty: a full line
    double opacity = 1;
};

enum class Anchor : unsigned char { start, middle, end };
enum class Mark : unsigned char { circle, square, diamond, up, down, cross };

struct TextStyle {
    double size = 13;
    std::string_view colour = "#222";
    Anchor anchor = Anchor::start;
    bool bold = false;
    bool upwards = false;  ///< turned to read from bottom to top, around its own place
};

class Svg {
public:
    using Point = std::pair<double, double>;

    /// On a white ground. `title` is what a reader of the picture is told who cannot see it.
    Svg(int width, int height, std::string_view title);

    void line(Point from, Point to, const Stroke& stroke);
    void polyline(const std::vector<Point>& points, const Stroke& stroke);
    void mark(Point at, Mark mark, double radius, std::string_view colour);
    void text(Point at, std::string_view text, const TextStyle& style = {});

    /// The whole file.
    std::string finish() &&;

private:
    std::string body_;
};

/// A linear axis: numbers [low, high] onto pixels [from, to].
struct Axis {
    double low = 0, high = 1;
    double from = 0, to = 1;
    std::string_view title;
    std::string (*label)(double) = nullptr;  ///< what a tick is called, where it is not the number itself

    double at(double x) const { return from + (to - from) * (x - low) / (high - low); }
};

/// A frame around both axes' pixels, with ticks, a light grid and titles below and to the left, which take 60 pixels.
void draw_frame(Svg& svg, const Axis& x, const Axis& y);

/// The part of the line through `a` and `b` (numbers, not pixels) that lies in the frame; nothing if none does.
void draw_line_through(Svg& svg, const Axis& x, const Axis& y, Svg::Point a, Svg::Point b, const Stroke& stroke);

}  // namespace barycert::report
