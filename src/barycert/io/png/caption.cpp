#include "barycert/io/png/caption.hpp"

#include <algorithm>
#include <cmath>

#include "barycert/base/strict_math.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/png/text.hpp"

namespace barycert::io {
namespace {

// In dots.
constexpr std::size_t space = 4, tick = 5, line_height = glyph_height + space;

/// As many characters as fit.
std::string cut_to(const std::string& text, std::size_t dots) {
    std::size_t bytes = text.size();
    while (bytes > 0 && text_width(character_count({text.data(), bytes})) > dots) --bytes;
    return text.substr(0, bytes);
}

}  // namespace

double round_length(double limit) {
    // As text, so that it is the number that is written: powers of ten have rounding errors.
    for (int exponent = static_cast<int>(std::floor(std::log10(limit))) + 1;; --exponent) {
        for (const char* const digit : {"5", "2", "1"}) {
            const auto length = base::parse_double(digit + ("e" + std::to_string(exponent)));
            if (length && *length <= limit) return *length;
        }
        if (exponent < -330) return limit;
    }
}

Caption::Caption(const std::string& title, double pixel_length, std::size_t drawn, std::size_t width, std::size_t dot)
    : width_(width), scale_(dot) {
    const std::size_t dots = width / scale_, inner = dots < 2 * space ? 0 : dots - 2 * space;
    title_ = cut_to(title, inner);
    const double third = pixel_length * static_cast<double>(drawn) / 3;
    if (third > 0 && std::isfinite(third)) {
        const double length = round_length(third);
        length_text_ = base::shortest(length);
        bar_ = static_cast<std::size_t>(std::lround(length / pixel_length));
        // Too small a picture has no place for it.
        const std::size_t needed = scale_ * (3 * space + text_width(length_text_.size())) + bar_;
        if (bar_ < 2 || needed > width) bar_ = 0;
    }
    const std::size_t lines = (title_.empty() ? 0 : 1) + (bar_ == 0 ? 0U : 1U);
    height_ = lines == 0 ? 0 : scale_ * (space + lines * line_height);
}

void Caption::row(std::size_t r, std::uint8_t* pixels) const {
    std::fill(pixels, pixels + 4 * width_, std::uint8_t{255});
    std::size_t top = scale_ * space;
    if (!title_.empty()) {
        if (r >= top && r < top + scale_ * glyph_height) draw_text(title_, scale_, r - top, scale_ * space, pixels);
        top += scale_ * line_height;
    }
    if (bar_ == 0 || r < top || r >= top + scale_ * glyph_height) return;
    const std::size_t left = scale_ * space;
    draw_text(length_text_, scale_, r - top, left + bar_ + scale_ * space, pixels);
    // The bar is a line between two ticks.
    const std::size_t line = (r - top) / scale_;
    const std::size_t first = (glyph_height - tick) / 2;
    if (line < first || line >= first + tick) return;
    for (std::size_t x = 0; x < bar_; ++x) {
        const bool end = x < scale_ || x + scale_ >= bar_;
        if (!end && line != first + tick / 2) continue;
        for (std::size_t k = 0; k < 3; ++k) pixels[4 * (left + x) + k] = text_colour[k];
    }
}

}  // namespace barycert::io
