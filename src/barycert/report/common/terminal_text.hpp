/// Small pieces of terminal text: numbers of few characters, colours, words for a shell.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "barycert/base/text.hpp"

namespace barycert::report {

/// At most five characters: "-", "9999", "12.3k", "229k", "1.32M".
inline std::string brief_count(std::uint64_t n) {
    if (n == 0) return "-";
    if (n < 10000) return std::to_string(n);
    double x = static_cast<double>(n);
    for (const char* unit : {"k", "M", "G", "T"}) {
        x /= 1000;
        if (x < 999.5) return fmt::format("{:.{}f}{}", x, x < 9.995 ? 2 : x < 99.95 ? 1 : 0, unit);
    }
    return fmt::format("{:.1e}", static_cast<double>(n));
}

/// A magnitude in three digits, of at most nine characters; "-" where there is none.
inline std::string brief(double x) {
    if (std::isnan(x) || x < 0) return "-";
    if (x >= 999.5 && x < 99999.5) return fmt::format("{:.0f}", x);
    return fmt::format("{:.3g}", x);
}

/// Nanoseconds in at most five characters; "-" where nothing was timed.
inline std::string brief_time(double ns) {
    if (!(ns > 0)) return "-";
    return fmt::format(ns < 999.95    ? fmt::runtime("{:.1f}")
                       : ns < 99999.5 ? fmt::runtime("{:.0f}")
                                      : fmt::runtime("{:.0e}"),
                       ns);
}

/// A share in per cent: never "0" or "100" unless it is exactly that.
inline std::string percent(std::uint64_t part, std::uint64_t whole) {
    if (part == 0 || whole == 0) return "0";
    if (part == whole) return "100";
    const double p = 100 * static_cast<double>(part) / static_cast<double>(whole);
    if (p < 0.001) return "<0.001";
    if (p >= 99.95) return ">99.9";  // one decimal would round it to 100.0
    return fmt::format("{:.{}f}", p, p < 0.1 ? 3 : p < 10 ? 2 : 1);
}

class Colours {
public:
    explicit Colours(bool on) : on_(on) {}
    std::string bold(std::string_view s) const { return wrap("1", s); }
    std::string bad(std::string_view s) const { return wrap("31", s); }
    std::string good(std::string_view s) const { return wrap("32", s); }
    std::string dim(std::string_view s) const { return wrap("2", s); }

private:
    std::string wrap(const char* code, std::string_view s) const {
        return on_ ? fmt::format("\033[{}m{}\033[0m", code, s) : std::string(s);
    }
    bool on_;
};

using base::shell_word;

}  // namespace barycert::report
