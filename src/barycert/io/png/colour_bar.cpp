#include "barycert/io/png/colour_bar.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "barycert/base/text.hpp"
#include "barycert/io/png/colour_map.hpp"

namespace barycert::io {
namespace {

// In pixels at scale 1.
constexpr std::size_t margin = 4, bar_width = 10, glyph_width = 5, glyph_height = 7, advance = 6;

/// A height at which text is one pixel a dot; twice that gives twice the size.
constexpr std::size_t height_of_scale = 250;

// What shortest() makes numbers of. Each glyph is seven rows of five dots, from the top.
constexpr std::string_view characters = "0123456789-+.e";
constexpr std::array<std::array<std::string_view, glyph_height>, 14> glyphs{{
    {" ### ", "#   #", "#   #", "#   #", "#   #", "#   #", " ### "},
    {"  #  ", " ##  ", "# #  ", "  #  ", "  #  ", "  #  ", "#####"},
    {" ### ", "#   #", "    #", "  ## ", " #   ", "#    ", "#####"},
    {" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "},
    {"#  # ", "#  # ", "#  # ", "#####", "   # ", "   # ", "   # "},
    {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "},
    {" ### ", "#    ", "#    ", "#### ", "#   #", "#   #", " ### "},
    {"#####", "    #", "   # ", "   # ", "  #  ", "  #  ", "  #  "},
    {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "},
    {" ### ", "#   #", "#   #", " ####", "    #", "    #", " ### "},
    {"     ", "     ", "     ", " ### ", "     ", "     ", "     "},
    {"     ", "     ", "  #  ", "#####", "  #  ", "     ", "     "},
    {"     ", "     ", "     ", "     ", "     ", " ##  ", " ##  "},
    {"     ", "     ", " ### ", "#   #", "#####", "#    ", " ### "},
}};

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
      width_(scale_ * (3 * margin + bar_width + advance * std::max(low_.size(), high_.size()))) {}

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
    const std::size_t line = (r - top) / scale_;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const std::size_t glyph = characters.find(text[k]);
        if (glyph == std::string_view::npos) continue;
        const std::size_t left = scale_ * (2 * margin + bar_width + advance * k);
        for (std::size_t x = 0; x < scale_ * glyph_width; ++x) {
            if (glyphs[glyph][line][x / scale_] == '#') put(pixels + 4 * (left + x), {34, 34, 34});
        }
    }
}

}  // namespace barycert::io
