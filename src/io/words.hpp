/// Words of a text, between blanks and line ends.
#pragma once

#include <string_view>

namespace barycert::io {

inline bool is_white(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Takes the next word off `text`; empty at the end.
std::string_view next_word(std::string_view& text);

bool has_word(std::string_view text, std::string_view wanted);

}  // namespace barycert::io
