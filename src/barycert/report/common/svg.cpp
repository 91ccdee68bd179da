#include "barycert/report/common/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "barycert/base/text.hpp"

namespace barycert::report {
namespace {

std::string stroke_attributes(const Stroke& s) {
    std::string out = fmt::format(R"(fill="none" stroke="{}" stroke-width="{:.1f}")", s.colour, s.width);
    if (!s.dashes.empty()) out += fmt::format(R"( stroke-dasharray="{}")", s.dashes);
    if (s.opacity < 1) out += fmt::format(R"( stroke-opacity="{:.2f}")", s.opacity);
    return out;
}

std::string path(const std::vector<Svg::Point>& points) {
    std::string out;
    for (const auto& [x, y] : points) out += fmt::format("{}{:.1f},{:.1f}", out.empty() ? "" : " ", x, y);
    return out;
}

}  // namespace

std::string xml_escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
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
                out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
        }
    }
    return out;
}

std::vector<double> round_ticks(double low, double high, int max) {
    double step = std::pow(10, std::floor(std::log10((high - low) / max)));
    for (const double factor : {2.0, 2.5, 2.0, 2.0}) {  // 1, 2, 5, 10, 20 times the power of ten
        if (std::floor(high / step) - std::ceil(low / step) < max) break;
        step *= factor;
    }
    std::vector<double> ticks;
    for (double k = std::ceil(low / step); k * step <= high; ++k) ticks.push_back(k * step + 0.0);  // no -0
    return ticks;
}

Svg::Svg(int width, int height, std::string_view title) {
    const std::string escaped = xml_escaped(title);
    body_ = fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" role="img" )"
        R"(aria-label="{2}" font-family="Helvetica, Arial, 'DejaVu Sans', sans-serif">)"
        "\n<title>{2}</title>\n"
        R"(<rect width="{0}" height="{1}" fill="#fff"/>)"
        "\n",
        width, height, escaped);
}

void Svg::line(Point from, Point to, const Stroke& stroke) {
    body_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", from.first,
                         from.second, to.first, to.second, stroke_attributes(stroke));
}

void Svg::polyline(const std::vector<Point>& points, const Stroke& stroke) {
    if (points.size() < 2) return;
    body_ += fmt::format("<polyline points=\"{}\" stroke-linejoin=\"round\" {}/>\n", path(points),
                         stroke_attributes(stroke));
}

void Svg::mark(Point at, Mark mark, double r, std::string_view colour) {
    const auto [x, y] = at;
    switch (mark) {
        case Mark::circle:
            body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"/>\n", x, y, r, colour);
            return;
        case Mark::cross:
            line({x - r, y - r}, {x + r, y + r}, {.colour = colour, .width = 1.6});
            line({x - r, y + r}, {x + r, y - r}, {.colour = colour, .width = 1.6});
            return;
        default:
            break;
    }
    std::vector<Point> corners;
    if (mark == Mark::square) corners = {{x - r, y - r}, {x + r, y - r}, {x + r, y + r}, {x - r, y + r}};
    if (mark == Mark::diamond) corners = {{x - r, y}, {x, y - r}, {x + r, y}, {x, y + r}};
    if (mark == Mark::up) corners = {{x - r, y + r}, {x, y - r}, {x + r, y + r}};
    if (mark == Mark::down) corners = {{x - r, y - r}, {x, y + r}, {x + r, y - r}};
    body_ += fmt::format("<polygon points=\"{}\" fill=\"{}\"/>\n", path(corners), colour);
}

void Svg::text(Point at, std::string_view text, const TextStyle& style) {
    constexpr std::array anchors{"start", "middle", "end"};
    const auto [x, y] = at;
    body_ += fmt::format(
        "<text x=\"{0:.1f}\" y=\"{1:.1f}\" font-size=\"{2:.0f}\" fill=\"{3}\" text-anchor=\"{4}\"{5}{6}>{7}</text>\n",
        x, y, style.size, style.colour, anchors[static_cast<std::size_t>(style.anchor)],
        style.bold ? " font-weight=\"bold\"" : "",
        style.upwards ? fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", x, y) : "", xml_escaped(text));
}

std::string Svg::finish() && {
    body_ += "</svg>\n";
    return std::move(body_);
}

namespace {

std::string tick_text(const Axis& axis, double t) {
    return axis.label == nullptr ? base::shortest(t) : axis.label(t);
}

}  // namespace

void draw_frame(Svg& svg, const Axis& x, const Axis& y) {
    const Stroke grid{.colour = "#e4e4e4"}, rule{.colour = "#444"};
    for (const double t : round_ticks(x.low, x.high, 12)) {
        svg.line({x.at(t), y.from}, {x.at(t), y.to}, grid);
        svg.line({x.at(t), y.from}, {x.at(t), y.from + 5}, rule);
        svg.text({x.at(t), y.from + 20}, tick_text(x, t), {.anchor = Anchor::middle});
    }
    for (const double t : round_ticks(y.low, y.high, 12)) {
        svg.line({x.from, y.at(t)}, {x.to, y.at(t)}, grid);
        svg.line({x.from - 5, y.at(t)}, {x.from, y.at(t)}, rule);
        svg.text({x.from - 9, y.at(t) + 4.5}, tick_text(y, t), {.anchor = Anchor::end});
    }
    svg.polyline({{x.from, y.from}, {x.to, y.from}, {x.to, y.to}, {x.from, y.to}, {x.from, y.from}}, rule);
    svg.text({(x.from + x.to) / 2, y.from + 44}, x.title, {.size = 14, .anchor = Anchor::middle});
    svg.text({x.from - 44, (y.from + y.to) / 2}, y.title, {.size = 14, .anchor = Anchor::middle, .upwards = true});
}

void draw_line_through(Svg& svg, const Axis& x, const Axis& y, Svg::Point a, Svg::Point b, const Stroke& stroke) {
    // Liang and Barsky: the line a + t (b - a), cut by each side in turn.
    const double dx = b.first - a.first, dy = b.second - a.second;
    double first = -1e9, last = 1e9;
    const auto cut = [&](double direction, double room) {  // keeps t * direction <= room
        if (direction > 0) last = std::min(last, room / direction);
        if (direction < 0) first = std::max(first, room / direction);
        if (direction == 0 && room < 0) last = -1e9;
    };
    cut(dx, x.high - a.first);
    cut(-dx, a.first - x.low);
    cut(dy, y.high - a.second);
    cut(-dy, a.second - y.low);
    if (first >= last) return;
    svg.line({x.at(a.first + first * dx), y.at(a.second + first * dy)},
             {x.at(a.first + last * dx), y.at(a.second + last * dy)}, stroke);
}

}  // namespace barycert::report
