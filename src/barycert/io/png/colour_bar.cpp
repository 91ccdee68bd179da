#include "barycert/io/png/colour_bar.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "barycert/base/text.hpp"
#include "barycert/io/png/colour_map.hpp"
#include "barycert/io/png/text.hpp"

namespace barycert::io {
namespace {

// In pixels at scale 1.
constexpr std::size_t margin = 4, bar_width = 10;

/// A height at which text is one pixel a dot; twice that gives twice the size.
constexpr std::size_t height_of_scale = 250;

/// Least distance of two numbers, in pixels at scale 1.
constexpr std::size_t tick_distance = 40;

void put(std::uint8_t* pixel, const Colour& colour) {
    for (std::size_t i = 0; i < 3; ++i) pixel[i] = colour[i];
    pixel[3] = 255;
}

}  // namespace

ColourBar::ColourBar(double low, double high, std::size_t height)
    : low_(base::shortest(low)),
      high_(base::shortest(high)),
      one_number_(low == high),
      height_(height),
      scale_(std::max<std::size_t>(1, height / height_of_scale)),
      width_(0) {
    add_ticks(low, high);
    std::size_t longest = std::max(low_.size(), high_.size());
    for (const Tick& t : ticks_) longest = std::max(longest, t.text.size());
    width_ = scale_ * (3 * margin + bar_width + glyph_advance * longest);
}

/// Multiples of 1, 2 or 5 times a power of ten, no closer than `tick_distance`, that keep clear of the ends' numbers.
void ColourBar::add_ticks(double low, double high) {
    const double range = high - low;
    if (!(range > 0) || !std::isfinite(range)) return;
    const std::size_t bar = height_ - 2 * scale_ * margin;
    const auto steps = static_cast<double>(bar - 1);
    const double least = range * static_cast<double>(scale_ * tick_distance) / static_cast<double>(bar);
    const auto clear = static_cast<double>(3 * scale_ * glyph_height);
    int exponent = static_cast<int>(std::floor(std::log10(least)));
    if (exponent < -300 || exponent > 300) return;
    // As text, so that ticks are the numbers that are written: powers of ten have rounding errors.
    const auto number = [&](double digits) {
        return base::parse_double(base::shortest(digits) + "e" + std::to_string(exponent)).value_or(0);
    };
    double digit = 1;
    for (const double next : {2.0, 5.0, 10.0}) {
        if (number(digit) >= least) break;
        digit = next;
    }
    const double first = std::ceil(low / number(digit)), last = std::floor(high / number(digit));
    if (!(std::fabs(first) < 0x1p40 && std::fabs(last) < 0x1p40)) return;  // a narrow range of huge numbers
    for (auto k = static_cast<std::int64_t>(first); k <= static_cast<std::int64_t>(last); ++k) {
        const double value = number(static_cast<double>(k) * digit);
        const double below = steps * (high - value) / range;  // the upper end
        if (below < clear || steps - below < clear) continue;
        ticks_.push_back({scale_ * margin + static_cast<std::size_t>(std::lround(below)), base::shortest(value + 0.0)});
    }
}

void ColourBar::row(std::size_t r, std::uint8_t* pixels) const {
    for (std::size_t x = 0; x < width_; ++x) put(pixels + 4 * x, {255, 255, 255});
    const std::size_t top = scale_ * margin, bottom = height_ - scale_ * margin;  // of the bar
    if (r < top || r >= bottom) return;
    const std::size_t steps = bottom - top - 1;
    const std::size_t i = one_number_ ? colour_count / 2 : ((colour_count - 1) * (bottom - 1 - r) + steps / 2) / steps;
    for (std::size_t x = scale_ * margin; x < scale_ * (margin + bar_width); ++x) {
        put(pixels + 4 * x, colour(static_cast<int>(i)));
    }
    put_text(high_, r, top, pixels);
    if (!one_number_) put_text(low_, r, bottom - scale_ * glyph_height, pixels);
    for (const Tick& t : ticks_) {
        put_text(t.text, r, t.row - scale_ * glyph_height / 2, pixels);
        if (r < t.row || r >= t.row + scale_) continue;
        for (std::size_t x = scale_ * (margin + bar_width); x < scale_ * (margin + bar_width + 2); ++x)
            put(pixels + 4 * x, text_colour);
    }
}

void ColourBar::put_text(const std::string& text, std::size_t r, std::size_t top, std::uint8_t* pixels) const {
    if (r < top || r >= top + scale_ * glyph_height) return;
    draw_text(text, scale_, r - top, scale_ * (2 * margin + bar_width), pixels);
}

}  // namespace barycert::io
