#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "barycert/raster.hpp"
#include "core/base/text.hpp"
#include "draw/axes.hpp"
#include "draw/colour_map.hpp"
#include "draw/files.hpp"
#include "draw/picture.hpp"

namespace barycert::draw {
namespace {

constexpr double gap = 14, wide = 16, beside = 8, line_height = 20, text_size = 12;

Ticks ticks_of(const ColourScale& s, double height) {
    if (s.low == s.high) return {{{0.5, number_text(s.low)}}};
    const int most = std::max(2, static_cast<int>(height / 45));
    Ticks all;
    if (s.log) {
        all.ticks = log_ticks(std::log10(s.low), std::log10(s.high));
        while (all.ticks.size() > static_cast<std::size_t>(most)) {
            // Every other one.
            std::vector<Tick> some;
            for (std::size_t i = 0; i < all.ticks.size(); i += 2) some.push_back(all.ticks[i]);
            all.ticks = some;
        }
        if (all.ticks.empty())
            for (const double x : {s.low, s.high}) all.ticks.push_back({std::log10(x), number_text(x)});
        for (Tick& t : all.ticks) t.at = place_in_range(t.at, std::log10(s.low), std::log10(s.high));
    } else {
        all = round_ticks(s.low, s.high, most);
        for (Tick& t : all.ticks) t.at = s.place(t.at);
    }
    return all;
}

double widest(const std::vector<std::string>& texts) {
    double most = 0;
    for (const std::string& t : texts) most = std::max(most, text_width(t, text_size));
    return most;
}

std::string label_text(const ColourBar& bar, std::size_t i) {
    return i < bar.names.size() ? bar.names[i] : base::shortest(bar.scale.labels[i]);
}

/// The texts beside the colours.
std::vector<std::string> texts_of(const ColourBar& bar, double height) {
    std::vector<std::string> texts;
    if (bar.none) texts.emplace_back("no value");
    for (std::size_t i = 0; i < bar.scale.labels.size(); ++i) texts.push_back(label_text(bar, i));
    if (!bar.scale.labels.empty()) return texts;
    const Ticks ticks = ticks_of(bar.scale, height);
    for (const Tick& t : ticks.ticks) texts.push_back(t.text);
    texts.push_back(ticks.common);
    return texts;
}

}  // namespace

double ColourBar::width() const {
    // The tallest bar has the most numbers.
    constexpr double tallest = 2000;
    return gap + wide + beside + widest(texts_of(*this, tallest)) + (title.empty() ? 0 : line_height) + 8;
}

double ColourBar::least_height() const {
    // Two tips, what stands above and below, and something between them; or a line for each label.
    constexpr double without_labels = 84, under = 24;
    return scale.labels.empty() ? without_labels : line_height * static_cast<double>(scale.labels.size()) + under;
}

void ColourBar::draw(Picture& picture, Pixel corner, double height) const {
    const double left = corner.x + gap, right = left + wide, text = right + beside;
    double top = corner.y, bottom = corner.y + height;
    const auto patch = [&](double at, Rgba colour, const std::string& name) {
        picture.bar({left, at}, wide, line_height - 6, "", {}, colour);
        picture.text({text, at + 11}, name, "tick");
    };
    if (none) patch(bottom -= line_height - 6, scale.no_value, "no value");
    if (none) bottom -= 10;
    const double middle = (top + bottom) / 2;
    const auto add_title = [&](double x) {
        if (!title.empty()) picture.text({x, middle}, title, "title m", true);
    };
    const double behind = corner.x + width() - 10;
    if (!scale.labels.empty()) {
        for (std::size_t i = 0; i < scale.labels.size(); ++i)
            patch(top + line_height * static_cast<double>(i), scale(scale.labels[i]), label_text(*this, i));
        return add_title(behind);
    }
    const Ticks ticks = ticks_of(scale, height);
    if (!ticks.common.empty()) picture.text({left, top + 10}, ticks.common, "tick");
    if (!ticks.common.empty()) top += line_height;
    constexpr double tip = 12;
    if (above) {
        picture.area({{left, top + tip}, {left + wide / 2, top}, {right, top + tip}}, "", scale.map.back());
        top += tip;
    }
    if (below) {
        bottom -= tip;
        picture.area({{left, bottom}, {left + wide / 2, bottom + tip}, {right, bottom}}, "", scale.map.front());
    }
    const double tall = bottom - top;
    if (scale.low == scale.high) {
        picture.bar({left, top}, wide, tall, "", {}, scale.map[scale.map.size() / 2]);
    } else {
        // Each from its lower end to the top, so that nothing shows between two.
        for (std::size_t i = 0; i < scale.map.size(); ++i) {
            const double part = 1 - static_cast<double>(i) / static_cast<double>(scale.map.size());
            picture.bar({left, top}, wide, tall * part, "", {}, scale.map[i]);
        }
    }
    for (const Tick& t : ticks.ticks) {
        const double y = bottom - tall * t.at;
        picture.line({right, y}, {right + 4, y}, "axis");
        picture.text({text, y + 4}, t.text, "tick");
    }
    add_title(behind);
}

}  // namespace barycert::draw
