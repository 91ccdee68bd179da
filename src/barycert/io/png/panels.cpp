#include "barycert/io/png/panels.hpp"

#include <algorithm>
#include <cmath>

#include "barycert/base/strict_math.hpp"
#include "barycert/base/text.hpp"

namespace barycert::io {
namespace {

// In dots.
constexpr std::size_t margin = 4, tick_height = 5, line_height = glyph_height + margin, bar_width = 10;

/// A height of a colour bar at which text is one pixel a dot; twice that gives twice the size.
constexpr std::size_t height_of_scale = 250;

/// Least distance of two numbers at a colour bar, in dots.
constexpr std::size_t tick_distance = 40;

/// As text, so that it is the number that is written: powers of ten have rounding errors. 0 if no double is so large.
double times_power_of_ten(double digits, int exponent) {
    return base::parse_double(base::shortest(digits) + "e" + std::to_string(exponent)).value_or(0);
}

/// From blank to tilde: seven rows of five dots, from the top left one in the highest of 35 bits.
constexpr std::array<std::uint64_t, 95> glyphs{
    0x000000000, 0x108421004, 0x294000000, 0x2bea52bea, 0x11f4717c4, 0x464222131, 0x324c6ca4d, 0x108000000, 0x088421082,
    0x208421088, 0x02aefbaa0, 0x0004f9000, 0x000001088, 0x000070000, 0x00000018c, 0x042222210, 0x3a318c62e, 0x11942109f,
    0x3a213221f, 0x3a213062e, 0x4a52f8842, 0x7e1e0862e, 0x3a10f462e, 0x7c2211084, 0x3a317462e, 0x3a317842e, 0x018c03180,
    0x008401088, 0x006c83060, 0x001f07c00, 0x030609b00, 0x3a2131004, 0x3a37ade0f, 0x114a8fe31, 0x7a31f463e, 0x3a308422e,
    0x72518c65c, 0x7e10f421f, 0x7e10f4210, 0x3a309c62e, 0x4631fc631, 0x38842108e, 0x1c4210a4c, 0x4654c5251, 0x42108421f,
    0x4775ac631, 0x4739ace71, 0x11518c544, 0x7a31f4210, 0x3a318d64d, 0x7a31f5251, 0x3e107043e, 0x7c8421084, 0x46318c62e,
    0x463152944, 0x4631ad771, 0x462a22a31, 0x462a51084, 0x7c222221f, 0x188421086, 0x420820821, 0x30842108c, 0x115100000,
    0x00000001f, 0x208000000, 0x000e0be2f, 0x421e8c63e, 0x000f8420f, 0x042f8c62f, 0x000e8fe0e, 0x191e42108, 0x000f8bc2e,
    0x421e8c631, 0x100c2108e, 0x08061084c, 0x4212a6292, 0x30842108e, 0x001ead6b5, 0x001e8c631, 0x000e8c62e, 0x001e8fa10,
    0x000f8bc21, 0x0016c4210, 0x000f8383e, 0x211e42106, 0x00118c62f, 0x00118a944, 0x0015ad6aa, 0x001151151, 0x00118bc2e,
    0x001f1111f, 0x0c8441083, 0x108421084, 0x608411098, 0x0008a8800,
};

/// A byte of UTF-8 that goes on with a character.
bool goes_on(char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// True if the character has ink there. What is not printable ASCII is drawn as a box.
bool glyph_dot(char c, std::size_t line, std::size_t column) {
    if (c < ' ' || c > '~') return line % (glyph_height - 1) == 0 || column % (glyph_width - 1) == 0;
    const std::size_t behind = glyph_height * glyph_width - 1 - (line * glyph_width + column);
    return (glyphs[static_cast<std::size_t>(c - ' ')] >> behind & 1U) != 0;
}

void put_run(const Colour& colour, std::size_t first, std::size_t last, std::uint8_t* pixels) {
    for (std::size_t x = first; x < last; ++x) put_pixel(colour, pixels + 4 * x);
}

}  // namespace

std::size_t character_count(std::string_view text) {
    return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, goes_on));
}

void draw_text(std::string_view text, std::size_t scale, std::size_t line, std::size_t left, std::uint8_t* pixels) {
    if (line >= scale * glyph_height) return;
    std::uint8_t* at = pixels + 4 * left;
    for (const char c : text) {
        if (goes_on(c)) continue;
        for (std::size_t x = 0; x < scale * glyph_width; ++x) {
            if (glyph_dot(c, line / scale, x / scale)) put_pixel(text_colour, at + 4 * x);
        }
        at += 4 * scale * glyph_advance;
    }
}

double round_length(double limit) {
    for (int exponent = static_cast<int>(std::floor(std::log10(limit))) + 1;; --exponent) {
        for (const double digit : {5.0, 2.0, 1.0}) {
            const double length = times_power_of_ten(digit, exponent);
            if (length > 0 && length <= limit) return length;
        }
        if (exponent < -330) return limit;
    }
}

Caption::Caption(const std::string& title, double pixel_length, std::size_t drawn, std::size_t width, std::size_t dot)
    : title_(title), width_(width), scale_(dot) {
    const std::size_t dots = width / scale_, inner = dots < 2 * margin ? 0 : dots - 2 * margin;
    while (!title_.empty() && text_width(character_count(title_)) > inner) title_.pop_back();
    const double third = pixel_length * static_cast<double>(drawn) / 3;
    if (third > 0 && std::isfinite(third)) {
        const double length = round_length(third);
        length_text_ = base::shortest(length);
        bar_ = static_cast<std::size_t>(std::lround(length / pixel_length));
        // Too small a picture has no place for it.
        const std::size_t needed = scale_ * (3 * margin + text_width(length_text_.size())) + bar_;
        if (bar_ < 2 || needed > width) bar_ = 0;
    }
    const std::size_t lines = (title_.empty() ? 0 : 1) + (bar_ == 0 ? 0U : 1U);
    height_ = lines == 0 ? 0 : scale_ * (margin + lines * line_height);
}

void Caption::row(std::size_t r, std::uint8_t* pixels) const {
    put_run({255, 255, 255}, 0, width_, pixels);
    const std::size_t left = scale_ * margin, top = left + (title_.empty() ? 0 : scale_ * line_height);
    if (!title_.empty()) draw_text(title_, scale_, r - left, left, pixels);
    if (bar_ == 0 || r < top) return;
    draw_text(length_text_, scale_, r - top, left + bar_ + scale_ * margin, pixels);
    // The bar is a line between two ticks.
    constexpr std::size_t first = (glyph_height - tick_height) / 2;
    const std::size_t line = (r - top) / scale_;
    if (line < first || line >= first + tick_height) return;
    const std::size_t end = line == first + tick_height / 2 ? bar_ : std::min(scale_, bar_);
    put_run(text_colour, left, left + end, pixels);
    put_run(text_colour, left + bar_ - std::min(scale_, bar_), left + bar_, pixels);
}

ColourBar::ColourBar(double low, double high, std::size_t height)
    : low_(base::shortest(low)),
      high_(base::shortest(high)),
      one_number_(low == high),
      height_(height),
      scale_(std::max<std::size_t>(1, height / height_of_scale)) {
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
    const auto steps = static_cast<double>(bar - 1), clear = static_cast<double>(3 * scale_ * glyph_height);
    const double least = range * static_cast<double>(scale_ * tick_distance) / static_cast<double>(bar);
    const int exponent = static_cast<int>(std::floor(std::log10(least)));
    if (exponent < -300 || exponent > 300) return;
    double digit = 1;
    for (const double next : {2.0, 5.0, 10.0}) {
        if (times_power_of_ten(digit, exponent) >= least) break;
        digit = next;
    }
    const double step = times_power_of_ten(digit, exponent);
    const double first = std::ceil(low / step), last = std::floor(high / step);
    if (!(std::fabs(first) < 0x1p40 && std::fabs(last) < 0x1p40)) return;  // a narrow range of huge numbers
    for (auto k = static_cast<std::int64_t>(first); k <= static_cast<std::int64_t>(last); ++k) {
        const double value = times_power_of_ten(static_cast<double>(k) * digit, exponent);
        const double below = steps * (high - value) / range;  // the upper end
        if (below < clear || steps - below < clear) continue;
        ticks_.push_back({scale_ * margin + static_cast<std::size_t>(std::lround(below)), base::shortest(value + 0.0)});
    }
}

void ColourBar::row(std::size_t r, std::uint8_t* pixels) const {
    put_run({255, 255, 255}, 0, width_, pixels);
    const std::size_t top = scale_ * margin, bottom = height_ - scale_ * margin;  // of the bar
    if (r < top || r >= bottom) return;
    const std::size_t steps = bottom - top - 1, end = scale_ * (margin + bar_width);
    const std::size_t i = one_number_ ? colour_count / 2 : ((colour_count - 1) * (bottom - 1 - r) + steps / 2) / steps;
    put_run(colour(static_cast<int>(i)), scale_ * margin, end, pixels);
    const auto put_text = [&](const std::string& text, std::size_t from) {
        draw_text(text, scale_, r - from, end + scale_ * margin, pixels);
    };
    put_text(high_, top);
    if (!one_number_) put_text(low_, bottom - scale_ * glyph_height);
    for (const Tick& t : ticks_) {
        put_text(t.text, t.row - scale_ * glyph_height / 2);
        if (r >= t.row && r < t.row + scale_) put_run(text_colour, end, end + 2 * scale_, pixels);
    }
}

}  // namespace barycert::io
