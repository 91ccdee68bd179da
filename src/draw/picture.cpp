#include "draw/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/raster.hpp"

namespace barycert::draw {
namespace {

/// In dark and on light ground.
struct Named {
    std::string_view name;
    Rgba light, dark;
    double line = 0, on = 0, off = 0, size = 0;  // 0: as before
};

constexpr Rgba ink{34, 34, 34, 255}, pale{228, 232, 235, 255}, soft{89, 99, 108, 255}, soft_pale{163, 173, 181, 255};

constexpr std::array<Named, 13> looks{{
    {"head", ink, pale, 0, 0, 0, 16},
    {"title", ink, pale, 0, 0, 0, 14},
    {"small", soft, soft_pale, 0, 0, 0, 12},
    {"tick", ink, pale, 1, 0, 0, 12},
    {"grid", {228, 228, 228, 255}, {55, 63, 69, 255}},
    {"axis", {68, 68, 68, 255}, soft_pale},
    {"median", ink, pale, 0, 3, 3},
    {"prediction", {0, 0, 0, 255}, {255, 255, 255, 255}, 2},
    {"level", {136, 136, 136, 255}, {136, 136, 136, 255}, 0, 8, 4},
    {"thick", ink, pale, 1.6},
    {"bar", {0, 114, 178, 255}, {86, 180, 233, 255}},
    {"bad", {200, 16, 46, 255}, {255, 107, 125, 255}},
    {"count", soft, soft_pale, 0, 0, 0, 9},
}};

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

bool is_dark(Rgba ground) {
    const auto& [r, g, b, opacity] = ground;
    constexpr int half = 128 * 1000;
    return opacity != 0 && 299 * r + 587 * g + 114 * b < half;
}

Rgba curve_colour(std::size_t i) {
    constexpr std::array<Rgba, 12> colours{{{213, 94, 0, 255},
                                            {0, 114, 178, 255},
                                            {0, 158, 115, 255},
                                            {204, 121, 167, 255},
                                            {230, 159, 0, 255},
                                            {86, 180, 233, 255},
                                            {120, 120, 120, 255},
                                            {136, 34, 85, 255},
                                            {153, 153, 51, 255},
                                            {68, 170, 153, 255},
                                            {102, 17, 0, 255},
                                            {51, 34, 136, 255}}};
    return colours[i % colours.size()];
}

Look look_of(std::string_view classes, bool dark) {
    Look look{.colour = dark ? pale : ink};
    while (!classes.empty()) {
        const std::string_view word = classes.substr(0, classes.find(' '));
        classes.remove_prefix(std::min(word.size() + 1, classes.size()));
        if (word == "m" || word == "e") look.anchor = word[0];
        if (word.size() == 2 && word[0] == 'k')
            look.colour = curve_colour(static_cast<std::size_t>(word[1] - '0')), look.line = 1.6;
        const auto named = std::ranges::find(looks, word, &Named::name);
        if (named == looks.end()) continue;
        if (word != "median" && word != "thick") look.colour = dark ? named->dark : named->light;
        if (named->line > 0) look.line = named->line;
        if (named->on > 0) look.on = named->on, look.off = named->off;
        if (named->size > 0) look.size = named->size;
    }
    return look;
}

void Picture::add(const Picture& other, Pixel corner) {
    for (PictureItem item : other.items) {
        item.at = {item.at.x + corner.x, item.at.y + corner.y};
        for (std::vector<Pixel>& line : item.lines)
            for (Pixel& p : line) p = {p.x + corner.x, p.y + corner.y};
        items.push_back(std::move(item));
    }
}

void Picture::mark(Pixel at, Mark mark, double r, const std::string& style) {
    const auto [x, y] = at;
    if (mark == Mark::circle) circle(at, r, style);
    if (mark == Mark::cross) lines({{{x - r, y - r}, {x + r, y + r}}, {{x - r, y + r}, {x + r, y - r}}}, style);
    if (mark == Mark::square) area({{x - r, y - r}, {x + r, y - r}, {x + r, y + r}, {x - r, y + r}}, style);
    if (mark == Mark::diamond) area({{x - r, y}, {x, y - r}, {x + r, y}, {x, y + r}}, style);
    if (mark == Mark::up) area({{x - r, y + r}, {x, y - r}, {x + r, y + r}}, style);
    if (mark == Mark::down) area({{x - r, y - r}, {x, y + r}, {x + r, y - r}}, style);
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
            return r.left >= 0 && r.right <= picture.width && r.top >= top && r.bottom <= picture.height &&
                   std::ranges::none_of(taken, [&](const Rectangle& t) { return t.meets(r); });
        };
        bool placed = false;
        for (const double distance : {5.0, 14.0, 26.0, 40.0, 60.0, 85.0})
            for (int turn = 0; turn < 16 && !placed; ++turn) placed = fits(far = distance, turn);
        if (!placed) {
            far = 0;
            best = {std::clamp(l.at.x, half, picture.width - half), std::clamp(l.at.y, top, picture.height)};
        }
        taken.push_back(room(best, l.text));
        if (far > 10) picture.line(l.at, best, "lead");
        if (far > 10) picture.text({best.x, best.y + 4}, l.text, "halo m");
        picture.text({best.x, best.y + 4}, l.text, l.style + " m");
    }
}

}  // namespace barycert::draw
