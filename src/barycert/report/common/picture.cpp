#include "barycert/report/common/picture.hpp"

#include <algorithm>
#include <numbers>

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
        const auto near = std::ranges::find_if(
            joined, [&](const Label& m) { return std::hypot(m.at.x - l.at.x, m.at.y - l.at.y) < 4; });
        if (near == joined.end()) {
            joined.push_back(std::move(l));
        } else if ((" " + near->text + " ").find(" " + l.text + " ") == std::string::npos) {
            near->text += " " + l.text;
        }
    }
    labels = std::move(joined);
}

}  // namespace

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
                   std::ranges::none_of(taken, [&](const Rectangle& t) { return t.meets(r); });
        };
        bool placed = false;
        for (const double distance : {5.0, 14.0, 26.0, 40.0, 60.0, 85.0})
            for (int turn = 0; turn < 16 && !placed; ++turn) placed = fits(far = distance, turn);
        if (!placed) {
            far = 0;
            best = {std::clamp(l.at.x, half, picture.width() - half), std::clamp(l.at.y, top, picture.height())};
        }
        taken.push_back(room(best, l.text));
        if (far > 10) picture.line(l.at, best, "lead");
        if (far > 10) picture.text({best.x, best.y + 4}, l.text, "halo m");
        picture.text({best.x, best.y + 4}, l.text, std::string(l.style) + " m");
    }
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

std::vector<Tick> decade_ticks(double low, double high) {
    std::vector<Tick> ticks;
    for (int k = static_cast<int>(std::floor(low)); k <= static_cast<int>(std::floor(high)); ++k) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double t = k + std::log10(factor);
            if (t < low || t > high) continue;
            ticks.push_back({t, std::abs(k) <= 4 ? fmt::format("{:.6g}", factor * std::pow(10, k))
                                                 : fmt::format("{:.0f}e{}", factor, k)});
        }
    }
    return ticks;
}

std::string superscript(double exponent) {
    constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string out;
    for (const char c : fmt::format("{:.0f}", exponent))
        out += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
    return out;
}

void draw_axes(Picture& picture, const Axis& x, const Axis& y) {
    for (const Tick& t : y.ticks) {
        if (y.grid) picture.line({x.from, y.at(t.at)}, {x.to, y.at(t.at)}, "grid");
        picture.text({x.from - 7, y.at(t.at) + 4}, t.text, "tick e");
    }
    for (const Tick& t : x.ticks) {
        if (x.grid) picture.line({x.at(t.at), y.from}, {x.at(t.at), y.to}, "grid");
        picture.line({x.at(t.at), y.from}, {x.at(t.at), y.from + 5}, "axis");
        picture.text({x.at(t.at), y.from + 19}, t.text, "tick m");
    }
    picture.line({x.from, y.from}, {x.to, y.from}, "axis");
    picture.line({x.from, y.from}, {x.from, y.to}, "axis");
    picture.text({(x.from + x.to) / 2, y.from + 42}, x.title, "title m");
    picture.text({x.from - 46, (y.from + y.to) / 2}, y.title, "title m", true);
}

void draw_line_through(Picture& picture, const Axis& x, const Axis& y, Pixel a, Pixel b, std::string_view style) {
    // Liang and Barsky: the line a + t (b - a), cut by each side in turn.
    const double dx = b.x - a.x, dy = b.y - a.y;
    double first = -1e9, last = 1e9;
    const auto cut = [&](double direction, double room) {  // keeps t * direction <= room
        if (direction > 0) last = std::min(last, room / direction);
        if (direction < 0) first = std::max(first, room / direction);
        if (direction == 0 && room < 0) last = -1e9;
    };
    cut(dx, x.high - a.x);
    cut(-dx, a.x - x.low);
    cut(dy, y.high - a.y);
    cut(-dy, a.y - y.low);
    if (first >= last) return;
    picture.line({x.at(a.x + first * dx), y.at(a.y + first * dy)}, {x.at(a.x + last * dx), y.at(a.y + last * dy)},
                 style);
}

}  // namespace barycert::report
