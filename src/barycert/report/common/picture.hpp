/// Pictures in HTML reports: bars, polygons and dots that take their looks from the page's style sheet by
/// class, and labels that keep clear of each other. Unlike Svg's they are no files of their own.
///
/// Coordinates are pixels, y downwards. All text that comes in is escaped.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace barycert::report {

struct Pixel {
    double x = 0, y = 0;
};

class Picture {
public:
    Picture(double width, double height, std::string_view title);

    void line(Pixel from, Pixel to, std::string_view style);
    void polygon(const std::vector<Pixel>& corners, std::string_view style);
    void bar(Pixel corner, double width, double height, std::string_view style, std::string_view tip);
    void dot(Pixel at, double radius, std::string_view style, std::string_view tip = {});
    void dots(const std::vector<Pixel>& at, std::string_view style);                           ///< many, in one element
    void lines(const std::vector<std::pair<Pixel, Pixel>>& segments, std::string_view style);  ///< likewise
    /// `style` may be several classes; "m" and "e" are the anchors middle and end.
    void text(Pixel at, std::string_view text, std::string_view style, bool upwards = false);

    double width() const { return width_; }
    double height() const { return height_; }
    std::string finish() &&;

private:
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

}  // namespace barycert::report
