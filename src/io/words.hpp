/// Words of a text, between blanks and line ends.
#pragma once

#include <string_view>
#include <vector>

namespace barycert::io {

inline bool is_white(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Takes the next word off `text`; empty at the end.
std::string_view next_word(std::string_view& text);

/// The fields of a line, parted by blanks or a separator with blanks around it; empty where it has no neighbour.
std::vector<std::string_view> cut_fields(std::string_view line, std::string_view blanks, std::string_view separators);

bool has_word(std::string_view text, std::string_view wanted);

}  // namespace barycert::io
