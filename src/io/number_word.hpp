/// A word of text as a number: all of it, or none. The format decides what separates words; nothing behind a number is
/// passed over, and only decimal numbers are numbers of files: `0x10` is 0 to some programs and 16 to others.
#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "core/base/text.hpp"

namespace barycert::io {

inline std::string_view without_plus(std::string_view word) {
    const bool plus = word.starts_with('+') && !word.starts_with("+-") && !word.starts_with("++");
    return word.substr(plus ? 1 : 0);
}

/// The double nearest to the word; nothing if it is no decimal number, too large for a double, or not finite where it
/// has to be. Else nan, inf and infinity are taken, in any case.
inline std::optional<double> real_of_word(std::string_view word, bool finite) {
    const std::string_view body = word.substr(word.starts_with('+') || word.starts_with('-') ? 1 : 0);
    if (body.starts_with("0x") || body.starts_with("0X")) return std::nullopt;
    const std::optional<double> value = base::parse_double(word);
    return value && finite && !std::isfinite(*value) ? std::nullopt : value;
}

/// The integer of that type; nothing if the word is none.
template <class Integer>
std::optional<Integer> integer_of_word(std::string_view word) {
    return base::whole_number<Integer>(without_plus(word));
}

}  // namespace barycert::io
