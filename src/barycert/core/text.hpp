/// Doubles as text that reads back to the same bits.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace barycert {

/// The shortest decimal form that reads back to x; "nan", "inf", "-inf" where x is not finite.
std::string shortest(double x);

/// Hexadecimal floating-point form, exact: 0x1.8p+1.
std::string hexadecimal(double x);

/// The double written in `text` (decimal or hexadecimal, all of it), or nothing.
std::optional<double> parse_double(std::string_view text);

/// True if `text` matches the shell-style pattern: `*` any run, `?` any one character.
bool glob_match(std::string_view pattern, std::string_view text);

}  // namespace barycert
