#include "barycert/report/common/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "barycert/report/common/html_text.hpp"

namespace barycert::report {
namespace {

struct Rectangle {
    double left, top, right, bottom;
    bool meets(const Rectangle& r) const {
        return left < r.right && r.left < right && top < r.bottom && r.top < bottom;
    }
};

/// A label's text takes so much, in the fonts of the page.
constexpr double letter = 6.6, letter_height = 12;

Rectangle room(Pixel centre, const std::string& text) {
    const double half = (letter * static_cast<double>(text.size()) + 3) / 2;
    return {centre.x - half, centre.y - letter_height / 2, centre.x + half, centre.y + letter_height / 2};
}

void join_close_ones(std::vector<Label>& labels) {
    std::vector<Label> joined;
    for (Label& l : labels) {
        const auto near = std::find_if(joined.begin(), joined.end(), [&](const Label& m) {
            return std::hypot(m.at.x - l.at.x, m.at.y - l.at.y) < 4;
        });
        if (near == joined.end()) {
            joined.push_back(std::move(l));
        } else if ((" " + near->text + " ").find(" " + l.text + " ") == std::string::npos) {
            near->text += " " + l.text;
        }
    }
    labels = std::move(joined);
}

}  // namespace

Picture::Picture(double width, double height, std::string_view title)
    : width_(width),
      height_(height),
      body_(fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
                        "height=\"{1:.0f}\" role=\"img\">\n<title>{2}</title>\n",
                        width, height, html_escaped(title))) {}

void Picture::line(Pixel a, Pixel b, std::string_view style) {
    body_ += fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", style, a.x, a.y, b.x, b.y);
}

void Picture::polygon(const std::vector<Pixel>& corners, std::string_view style) {
    body_ += fmt::format("<path class=\"{}\" d=\"", style);
    for (std::size_t i = 0; i < corners.size(); ++i)
        body_ += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", corners[i].x, corners[i].y);
    body_ += "Z\"/>\n";
}

void Picture::bar(Pixel corner, double width, double height, std::string_view style, std::string_view tip) {
    body_ += fmt::format(
        "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{}</title></rect>\n",
        style, corner.x, corner.y, width, height, html_escaped(tip));
}

void Picture::dot(Pixel at, double radius, std::string_view style, std::string_view tip) {
    body_ += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\">", style, at.x, at.y, radius);
    if (!tip.empty()) body_ += fmt::format("<title>{}</title>", html_escaped(tip));
    body_ += "</circle>\n";
}

void Picture::dots(const std::vector<Pixel>& at, std::string_view style) {
    if (at.empty()) return;
    body_ += fmt::format("<path class=\"{}\" d=\"", style);
    for (const Pixel& p : at) body_ += fmt::format("M{:.1f} {:.1f}h0", p.x, p.y);
    body_ += "\"/>\n";
}

void Picture::lines(const std::vector<std::pair<Pixel, Pixel>>& segments, std::string_view style) {
    if (segments.empty()) return;
    body_ += fmt::format("<path class=\"{}\" d=\"", style);
    for (const auto& [a, b] : segments) body_ += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x, a.y, b.x, b.y);
    body_ += "\"/>\n";
}

void Picture::text(Pixel at, std::string_view text, std::string_view style, bool upwards) {
    body_ += fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", style, at.x, at.y,
                         upwards ? fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", at.x, at.y) : "",
                         html_escaped(text));
}

std::string Picture::finish() && {
    body_ += "</svg>\n";
    return std::move(body_);
}

void place_labels(Picture& picture, std::vector<Label> labels, double top) {
    join_close_ones(labels);
    Pixel middle;
    for (const Label& l : labels) {
        middle.x += l.at.x / static_cast<double>(labels.size());
        middle.y += l.at.y / static_cast<double>(labels.size());
    }
    std::vector<Rectangle> taken;
    taken.reserve(2 * labels.size());
    for (const Label& l : labels) taken.push_back({l.at.x - 3, l.at.y - 3, l.at.x + 3, l.at.y + 3});
    for (const Label& l : labels) {
        const double outward = std::atan2(l.at.y - middle.y, l.at.x - middle.x);
        const double half = (letter * static_cast<double>(l.text.size()) + 3) / 2;
        Pixel best = l.at;
        double far = 0;
        const auto fits = [&](double distance, int turn) {
            const double a = outward + std::numbers::pi / 8 * (turn % 2 == 0 ? turn / 2 : -(turn + 1) / 2);
            // The text's box touches a small circle around the point.
            const double c = std::cos(a), s = std::sin(a);
            const double reach =
                std::min(half / std::max(std::fabs(c), 1e-9), letter_height / 2 / std::max(std::fabs(s), 1e-9));
            best = {l.at.x + c * (reach + distance), l.at.y + s * (reach + distance)};
            const Rectangle r = room(best, l.text);
            return r.left >= 0 && r.right <= picture.width() && r.top >= top && r.bottom <= picture.height() &&
                   std::none_of(taken.begin(), taken.end(), [&](const Rectangle& t) { return t.meets(r); });
        };
        bool placed = false;
        for (const double distance : {5.0, 14.0, 26.0, 40.0, 60.0, 85.0}) {
            for (int turn = 0; turn < 16 && !placed; ++turn) placed = fits(distance, turn);
            if (placed) {
                far = distance;
                break;
            }
        }
        if (!placed)
            best = {std::clamp(l.at.x, half, picture.width() - half), std::clamp(l.at.y, top, picture.height())};
        taken.push_back(room(best, l.text));
        if (far > 10) picture.line(l.at, best, "lead");
        if (far > 10) picture.text({best.x, best.y + 4}, l.text, "halo m");
        picture.text({best.x, best.y + 4}, l.text, std::string(l.style) + " m");
    }
}

}  // namespace barycert::report
