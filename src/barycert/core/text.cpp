#include "barycert/core/text.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include <fast_float/fast_float.h>

#include "barycert/core/exact_environment.hpp"

namespace barycert {

std::string shortest(double x) {
    const ExactEnvironment environment;
    if (std::isnan(x)) return "nan";  // its sign bit says nothing
    std::array<char, 32> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x);
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

}  // namespace barycert
