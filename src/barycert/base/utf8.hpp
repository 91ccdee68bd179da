/// Characters of UTF-8 (RFC 3629).
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace barycert::base {

struct Character {
    char32_t code = 0;
    std::size_t size = 0;  ///< bytes; 0: they are not UTF-8
};

/// The first character of a text that is not empty. Overlong forms, surrogates and codes past the last are not UTF-8.
inline Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    if (byte(0) < 0x80) return {byte(0), 1};
    const std::size_t size = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
    if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < size) return {};
    char32_t code = byte(0) & (0x7FU >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xC0U) != 0x80) return {};
        code = code << 6U | (byte(i) & 0x3FU);
    }
    constexpr std::array<char32_t, 5> min{0, 0, 0x80, 0x800, 0x10000};
    if (code < min[size] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return {};
    return {code, size};
}

}  // namespace barycert::base
