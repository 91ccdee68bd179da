#include "barycert/io/png/text.hpp"

#include <array>

namespace barycert::io {
namespace {

constexpr std::size_t glyphs_a_band = 19;

/// From blank to tilde in five bands, each seven rows of dots from the top.
constexpr std::array<std::string_view, 5 * glyph_height> glyphs{
    "        #    # #   # #    #   #   #  ##     #      #   #                                      #  ###    #    ### ",
    "        #    # #  #####  #### #  #  #  #    #     #     #   # # #                             # #   #  ##   #   #",
    "        #          # #  # #      #   ##           #     #    ###    #                        #  #   # # #       #",
    "        #          # #   ###    #    ## #         #     #   ##### #####        ###          #   #   #   #     ## ",
    "        #          # #    # #  #    #  #          #     #    ###    #     #                #    #   #   #    #   ",
    "                  ##### ####   #  # #  #          #     #   # # #         #          ##   #     #   #   #   #    ",
    "        #          # #    #   #   #  ## #          #   #                 #           ##   #      ###  ##### #####",
    " ###  #  #  #####  ###  #####  ###   ###                                 ###   ###    #   ####   ###  ###   #####",
    "#   # #  #  #     #         # #   # #   #  ##     #      ##       ##    #   # #   #  # #  #   # #   # #  #  #    ",
    "    # #  #  ####  #        #  #   # #   #  ##     #    ##   #####   ##      # # ###  # #  #   # #     #   # #    ",
    "  ##  #####     # ####     #   ###   ####             #               #   ##  # # # #   # ####  #     #   # #### ",
    "    #    #      # #   #   #   #   #     #  ##     #    ##   #####   ##    #   # ### ##### #   # #     #   # #    ",
    "#   #    #  #   # #   #   #   #   #     #  ##     #      ##       ##          #     #   # #   # #   # #  #  #    ",
    " ###     #   ###   ###    #    ###   ###         #                        #    #### #   # ####   ###  ###   #####",
    "#####  ###  #   #  ###    ### #   # #     #   # #   #   #   ####   ###  ####   #### ##### #   # #   # #   # #   #",
    "#     #   # #   #   #      #  #  #  #     ## ## ##  #  # #  #   # #   # #   # #       #   #   # #   # #   # #   #",
    "#     #     #   #   #      #  # #   #     # # # ##  # #   # #   # #   # #   # #       #   #   # #   # #   #  # # ",
    "####  #  ## #####   #      #  ##    #     # # # # # # #   # ####  #   # ####   ###    #   #   #  # #  # # #   #  ",
    "#     #   # #   #   #      #  # #   #     #   # #  ## #   # #     # # # # #       #   #   #   #  # #  # # #  # # ",
    "#     #   # #   #   #   #  #  #  #  #     #   # #  ##  # #  #     #  #  #  #      #   #   #   #  # #  ## ## #   #",
    "#      ###  #   #  ###   ##   #   # ##### #   # #   #   #   #      ## # #   # ####    #    ###    #   #   # #   #",
    "#   # #####   ##  #      ##     #          #          #               #         ##        #       #      #  #    ",
    "#   #     #   #   #       #    # #          #         #               #        #          #                 #    ",
    " # #     #    #    #      #   #   #              ###  ####   ####  ####  ###  ####   #### ####   ##     ##  #  # ",
    " # #    #     #     #     #                         # #   # #     #   # #   #  #    #   # #   #   #      #  # #  ",
    "  #    #      #      #    #                      #### #   # #     #   # #####  #     #### #   #   #      #  ##   ",
    "  #   #       #       #   #                     #   # #   # #     #   # #      #        # #   #   #      #  # #  ",
    "  #   #####   ##      #  ##         #####        #### ####   ####  ####  ###   #     ###  #   #  ###   ##   #  # ",
    " ##                                              #                                           ##   #   ##         ",
    "  #                                              #                                          #     #     #        ",
    "  #   ####  ####   ###  ####   #### # ##   #### ####  #   # #   # # # # #   # #   # #####   #     #     #    #   ",
    "  #   # # # #   # #   # #   # #   # ##    #      #    #   # #   # # # #  # #  #   #    #   #      #      #  # # #",
    "  #   # # # #   # #   # ####   #### #      ###   #    #   #  # #  # # #   #    ####   #     #     #     #      # ",
    "  #   # # # #   # #   # #         # #         #  #    #   #  # #  # # #  # #      #  #      #     #     #        ",
    " ###  # # # #   #  ###  #         # #     ####    ##   ####   #    # #  #   #  ###  #####    ##   #   ##         ",
};

/// A byte of UTF-8 that goes on with a character.
bool goes_on(char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// True if the character has ink there. What is not printable ASCII is drawn as a box.
bool glyph_dot(char c, std::size_t line, std::size_t column) {
    if (c < ' ' || c > '~') return line % (glyph_height - 1) == 0 || column % (glyph_width - 1) == 0;
    const auto number = static_cast<std::size_t>(c - ' ');
    return glyphs[number / glyphs_a_band * glyph_height + line][number % glyphs_a_band * glyph_advance + column] == '#';
}

}  // namespace

std::size_t character_count(std::string_view text) {
    std::size_t count = 0;
    for (const char c : text) count += goes_on(c) ? 0 : 1;
    return count;
}

void draw_text(std::string_view text, std::size_t scale, std::size_t line, std::size_t left, std::uint8_t* pixels) {
    if (line >= scale * glyph_height) return;
    std::uint8_t* at = pixels + 4 * left;
    for (const char c : text) {
        if (goes_on(c)) continue;
        for (std::size_t x = 0; x < scale * glyph_width; ++x) {
            if (!glyph_dot(c, line / scale, x / scale)) continue;
            put_pixel(text_colour, at + 4 * x);
        }
        at += 4 * scale * glyph_advance;
    }
}

}  // namespace barycert::io
