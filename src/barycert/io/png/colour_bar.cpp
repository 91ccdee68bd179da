#include "barycert/io/png/colour_bar.hpp"

#include <algorithm>

#include "barycert/base/text.hpp"
#include "barycert/io/png/colour_map.hpp"
#include "barycert/io/png/text.hpp"

namespace barycert::io {
namespace {

// In pixels at scale 1.
constexpr std::size_t margin = 4, bar_width = 10;

/// A height at which text is one pixel a dot; twice that gives twice the size.
constexpr std::size_t height_of_scale = 250;

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
      width_(scale_ * (3 * margin + bar_width + glyph_advance * std::max(low_.size(), high_.size()))) {}

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
}

void ColourBar::put_text(const std::string& text, std::size_t r, std::size_t top, std::uint8_t* pixels) const {
    if (r < top || r >= top + scale_ * glyph_height) return;
    draw_text(text, scale_, r - top, scale_ * (2 * margin + bar_width), pixels);
}

}  // namespace barycert::io
