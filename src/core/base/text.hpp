/// Text: doubles that read back to the same bits, words from outside that are safe to show.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace barycert::base {

/// The shortest decimal form that reads back to x; "nan", "inf", "-inf" where x is not finite.
std::string shortest(double x);

/// x with so many digits, as printf writes it in the C locale: behind the point (%.*f, %.*e), or in all (%.*g).
/// Requires: at most 60 digits.
std::string rounded_text(double x, std::chars_format format, int digits);

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

/// The integer that is all of the text, without a plus; nothing if it is none of that type.
template <class Integer, int base = 10>
std::optional<Integer> whole_number(std::string_view text) {
    Integer value = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value, base);
    return error == std::errc{} && end == last ? std::optional(value) : std::nullopt;
}

/// text(item) of each, with `between` between them; empty ones are left out.
template <class Items, class Text>
std::string joined(const Items& items, std::string_view between, Text text) {
    std::string all;
    for (const auto& item : items) {
        const std::string one(std::invoke(text, item));
        if (!one.empty()) all.append(all.empty() ? "" : between).append(one);
    }
    return all;
}

/// At most five characters: "-", "9999", "12.3k", "229k", "1.32M".
std::string brief_count(std::uint64_t n);

/// "1,234,567".
std::string grouped(std::uint64_t n);

/// "1 row", "2 rows": the plural is the singular and an s, if none is given.
inline std::string counted(std::uint64_t n, std::string_view one, std::string_view more = {}) {
    const std::string number = std::to_string(n) + ' ';
    return n != 1 && more.empty() ? number + std::string(one) + 's' : number + std::string(n == 1 ? one : more);
}

inline void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// True if `text` matches the shell-style pattern: `*` any run, `?` any one character.
bool glob_match(std::string_view pattern, std::string_view text);

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

/// `text` as one word for a POSIX shell, to be copied, quoted where needed; printable, whatever it holds.
std::string shell_word(std::string_view text);

/// The name of each item: a member or name(item).
template <class Items>
std::vector<std::string> names_of(const Items& items) {
    std::vector<std::string> names;
    for (const auto& item : items) {
        if constexpr (requires { item.name; })
            names.push_back(item.name);
        else
            names.emplace_back(name(item));
    }
    return names;
}

/// A rule that bounds something: NAME, or NAME>NUMBER.
struct NamedLimit {
    std::string_view name;
    std::optional<double> most;  ///< 0 if none is written; nothing if what is written is no number >= 0
};

inline NamedLimit named_limit(std::string_view text) {
    const std::size_t sign = text.find('>');
    if (sign == std::string_view::npos) return {text, 0};
    const std::optional<double> most = parse_double(text.substr(sign + 1));
    return {text.substr(0, sign), most && *most >= 0 ? most : std::nullopt};
}

}  // namespace barycert::base
