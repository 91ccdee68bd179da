/// Text in pictures: printable ASCII, each character five dots wide and seven high.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

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

/// Draws line `line` of the text, scaled up, from `left` on into a row of RGBA pixels; other pixels stay, and all if
/// the text has no such line: it has scale * glyph_height. What is not printable ASCII is a box. Precondition: `left` +
/// scale * text_width(character_count(text)) pixels in the row.
void draw_text(std::string_view text, std::size_t scale, std::size_t line, std::size_t left, std::uint8_t* pixels);

}  // namespace barycert::io
