/// Text: doubles that read back to the same bits, words from outside that are safe to show.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace barycert::base {

/// The shortest decimal form that reads back to x; "nan", "inf", "-inf" where x is not finite.
std::string shortest(double x);

/// Hexadecimal floating-point form, exact: 0x1.8p+1.
std::string hexadecimal(double x);

/// The double nearest to the number written in `text` (decimal or hexadecimal, all of it), ties to even, or nothing.
/// "inf", "infinity" and "nan" in any case, signed or not, are read as what they say: callers that need finite numbers
/// check. A number too large for a double is nothing; one too small is rounded to zero if it is decimal, and nothing if
/// it is hexadecimal, the form of exact numbers.
std::optional<double> parse_double(std::string_view text);

/// `text` as it may be shown on a terminal: what is not printable stands as \n, \t, \r or \x1b (its bytes), so that a
/// name in a file cannot move the cursor, colour, or pass for a line of its own. Not printable are control characters
/// (C0, DEL, C1), line and paragraph separators, marks that turn the direction of text, and bytes that are not UTF-8.
/// All else stays as it is, so printable(printable(x)) is printable(x).
std::string printable(std::string_view text);

/// A word from a file as it stands in messages: printable, in quotes, at most 40 bytes of it.
std::string quoted(std::string_view word);

/// True if `text` matches the shell-style pattern: `*` any run, `?` any one character.
bool glob_match(std::string_view pattern, std::string_view text);

}  // namespace barycert::base
