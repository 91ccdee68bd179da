/// Text in pictures, and white panels beside and under them, row by row from the top, 4 bytes a pixel.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "barycert/io/png/colour_map.hpp"

namespace barycert::io {

// In dots: of a character, and from one to the next.
inline constexpr std::size_t glyph_width = 5, glyph_height = 7, glyph_advance = 6;

inline constexpr Colour text_colour{34, 34, 34};

/// Dots from the left end of the first character to the right end of the last.
inline constexpr std::size_t text_width(std::size_t characters) {
    return characters == 0 ? 0 : glyph_advance * characters - (glyph_advance - glyph_width);
}

/// How a picture writes a text: each byte that is not printable ASCII stands for a character that is not there, of
/// several bytes in UTF-8 only the first.
std::size_t character_count(std::string_view text);

/// Draws line `line` of scale * glyph_height of the text into a row of RGBA pixels, where it must fit, from `left` on.
void draw_text(std::string_view text, std::size_t scale, std::size_t line, std::size_t left, std::uint8_t* pixels);

/// Largest of 1, 2 and 5 times a power of ten that is at most `limit`. Precondition: limit > 0, finite.
double round_length(double limit);

/// Under a picture: a title and the scale of lengths.
class Caption {
public:
    /// For a picture of that width, `drawn` pixels of it so long (0: no scale). A title that is too long is cut.
    Caption(const std::string& title, double pixel_length, std::size_t drawn, std::size_t width, std::size_t dot);

    std::size_t height() const { return height_; }  ///< 0 if there is nothing to say
    void row(std::size_t r, std::uint8_t* pixels) const;

private:
    std::string title_, length_text_;
    std::size_t width_, scale_, height_ = 0;
    std::size_t bar_ = 0;  ///< pixels of the bar; 0: none
};

/// Least height of a colour bar: two lines of text and what is around them.
inline constexpr std::size_t min_bar_height = 25;

/// The colours from bottom to top, the numbers at the ends and, where there is room, round numbers between them.
class ColourBar {
public:
    /// For numbers low <= high, as high as asked for (at least min_bar_height). Text grows with the height.
    ColourBar(double low, double high, std::size_t height);

    std::size_t width() const { return width_; }
    std::size_t scale() const { return scale_; }  ///< pixels for each dot of the text
    void row(std::size_t r, std::uint8_t* pixels) const;

private:
    struct Tick {
        std::size_t row;
        std::string text;
    };
    void add_ticks(double low, double high);

    std::string low_, high_;
    bool one_number_;
    std::size_t height_, scale_, width_ = 0;
    std::vector<Tick> ticks_;
};

}  // namespace barycert::io
