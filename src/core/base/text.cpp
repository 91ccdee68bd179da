#include "core/base/text.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "barycert/environment.hpp"
#include "barycert/result.hpp"

namespace barycert::base {
namespace {

bool is_printable(char32_t code) {
    if (code < 0x20 || (code >= 0x7F && code <= 0x9F)) return false;
    if (code >= 0x200B && code <= 0x200F) return false;  // without width, and marks of direction
    if (code >= 0x2028 && code <= 0x202E) return false;  // separators, embeddings, overrides
    return !(code >= 0x2060 && code <= 0x2069) && code != 0x61C && code != 0xFEFF;  // isolates, marks without width
}

/// The digits of a byte in that base, with leading zeros.
std::string digits_of(unsigned char byte, unsigned base, std::size_t width) {
    std::string out(width, '0');
    for (unsigned rest = byte; width > 0; rest /= base) out[--width] = "0123456789abcdef"[rest % base];
    return out;
}

/// A word that is not printable: printf makes its bytes, also of -, which at the front would begin an option of its.
/// Line ends after the last other byte are lost in "$(...)" and follow as they are.
std::string word_of_bytes(std::string_view text) {
    const std::size_t end = text.find_last_not_of('\n') + 1;
    std::string word = "\"$(printf '";
    for (const char c : text.substr(0, end)) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = byte >= 0x20 && byte < 0x7f && c != '\'' && c != '\\' && c != '-';
        if (plain)
            word += c == '%' ? std::string(2, c) : std::string(1, c);
        else
            word.append("\\").append(digits_of(byte, 8, 3));
    }
    word += "')\"";
    if (end != text.size()) word.append("'").append(text.substr(end)).append("'");
    return word;
}

}  // namespace

std::string shortest(double x) {
    const ExactEnvironment environment;
    if (std::isnan(x)) return "nan";  // its sign bit says nothing
    std::array<char, 32> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
    return {buffer.data(), end};
}

std::string rounded_text(double x, std::chars_format format, int digits) {
    const ExactEnvironment environment;
    std::array<char, 400> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x, format, digits);
    return {buffer.data(), end};
}

std::string hexadecimal(double x) {
    const ExactEnvironment environment;
    if (!std::isfinite(x)) return shortest(x);
    std::array<char, 40> buffer{};
    const auto [end, error] =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::fabs(x), std::chars_format::hex);
    return (std::signbit(x) ? "-0x" : "0x") + std::string(buffer.data(), end);
}

std::optional<double> parse_double(std::string_view text) {
    const ExactEnvironment environment;
    const bool negative = !text.empty() && text.front() == '-';
    std::string_view body = text;
    if (!body.empty() && (body.front() == '-' || body.front() == '+')) body.remove_prefix(1);
    if (body.empty() || body.front() == '-' || body.front() == '+') return std::nullopt;
    double x = 0;
    const char* const last = body.data() + body.size();
    if (body.starts_with("0x") || body.starts_with("0X")) {
        // from_chars would take a second sign, "inf" and "nan" here.
        if (body.find_first_of(".0123456789abcdefABCDEF", 2) != 2) return std::nullopt;
        const auto [end, error] = std::from_chars(body.data() + 2, last, x, std::chars_format::hex);
        if (error != std::errc{} || end != last) return std::nullopt;
    } else {
        const auto [end, error] = fast_float::from_chars(body.data(), last, x);
        if (error == std::errc::invalid_argument || end != last) return std::nullopt;
        // Overflow and underflow set x alike in every version of fast_float, but only newer ones call them errors.
        if (std::isinf(x) && body.find_first_of("iI") != 0) return std::nullopt;
    }
    return negative ? -x : x;
}

std::string printable(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const Character c = first_character(text);
        const std::string_view bytes = text.substr(0, std::max<std::size_t>(c.size, 1));
        text.remove_prefix(bytes.size());
        if (c.size != 0 && is_printable(c.code)) {
            out += bytes;
        } else if (bytes == "\n" || bytes == "\t" || bytes == "\r") {
            out += bytes == "\n" ? "\\n" : bytes == "\t" ? "\\t" : "\\r";
        } else {
            for (const char byte : bytes) out.append("\\x").append(digits_of(static_cast<unsigned char>(byte), 16, 2));
        }
    }
    return out;
}

std::string quoted(std::string_view word) {
    constexpr std::size_t longest = 40;
    return '"' + printable(word.substr(0, longest)) + (word.size() > longest ? "...\"" : "\"");
}

bool glob_match(std::string_view pattern, std::string_view text) {
    // Greedy with one point of return: on a mismatch the last star swallows one character more.
    std::size_t p = 0, t = 0, star = std::string_view::npos, mark = 0;
    while (t < text.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            mark = t;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
            ++p;
            ++t;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            t = ++mark;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::string shell_word(std::string_view text) {
    if (printable(text) != text) return word_of_bytes(text);
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+,-^=:@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos) return std::string(text);
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

std::string brief_count(std::uint64_t n) {
    if (n == 0) return "-";
    if (n < 10000) return std::to_string(n);
    double x = static_cast<double>(n);
    for (const char* unit : {"k", "M", "G", "T"}) {
        x /= 1000;
        if (x < 999.5) return rounded_text(x, std::chars_format::fixed, x < 9.995 ? 2 : x < 99.95 ? 1 : 0) + unit;
    }
    return rounded_text(static_cast<double>(n), std::chars_format::scientific, 1);
}

std::string grouped(std::uint64_t n) {
    std::string digits = std::to_string(n);
    for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
    return digits;
}

}  // namespace barycert::base

namespace barycert {

std::string Error::message() const {
    std::string text;
    if (!file.empty()) text += file + (line != 0 ? ":" + std::to_string(line) : "") + ": ";
    text += what;
    if (!expected.empty()) text += ": expected " + expected;
    if (!found.empty()) text += (expected.empty() ? ": found " : ", found ") + found;
    if (!remedy.empty()) text += "; " + remedy;
    return base::printable(text);
}

std::string message(const Note& note) {
    const std::string file = note.file.empty() ? "" : note.file + ": ";
    return base::printable(file + std::string(name(note.kind)) + ": " + note.text);
}

}  // namespace barycert
