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

/// The double nearest to the number written in `text` (decimal or hexadecimal, all of it), ties to even, or nothing.
/// "inf", "infinity" and "nan" in any case, signed or not, are read as what they say: callers that need finite numbers
/// check. A number too large for a double is nothing; one too small is rounded to zero if it is decimal, and nothing if
/// it is hexadecimal, the form of exact numbers.
std::optional<double> parse_double(std::string_view text);

/// True if `text` matches the shell-style pattern: `*` any run, `?` any one character.
bool glob_match(std::string_view pattern, std::string_view text);

}  // namespace barycert
