/// Small pieces of text: numbers of few characters, lists, words for a shell.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/text.hpp"

namespace barycert::report {

/// A magnitude in three digits, of at most nine characters; "-" where there is none.
inline std::string brief(double x) {
    if (std::isnan(x) || x < 0) return "-";
    if (x >= 999.5 && x < 99999.5) return fmt::format("{:.0f}", x);
    return fmt::format("{:.3g}", x);
}

/// Nanoseconds in at most five characters; "-" where nothing was timed.
inline std::string brief_time(double ns) {
    if (!(ns > 0)) return "-";
    if (ns < 999.95) return fmt::format("{:.1f}", ns);
    return ns < 99999.5 ? fmt::format("{:.0f}", ns) : fmt::format("{:.0e}", ns);
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

using base::brief_count, base::counted, base::grouped, base::joined, base::shell_word;

/// "2 snapped; 3 extrapolated": how many of each; those of which there are none are left out.
inline std::string clauses(const std::vector<std::pair<std::uint64_t, std::string>>& all,
                           std::string_view between = "; ") {
    return joined(all, between,
                  [](const auto& c) { return c.first == 0 ? "" : fmt::format("{} {}", c.first, c.second); });
}

/// "0.5, 1, 2": the first so many numbers of an array, or from a pointer on.
std::string coordinates(const auto& all, int count, std::string (*text)(double) = base::shortest,
                        std::string_view between = ", ") {
    return joined(std::span(&all[0], static_cast<std::size_t>(count)), between, text);
}

/// "48 tetrahedra"; in the plane triangles.
inline std::string simplices_text(std::uint64_t n, int dimension) {
    return dimension == 2 ? counted(n, "triangle") : counted(n, "tetrahedron", "tetrahedra");
}

/// "8 cells, cut into 48 tetrahedra"; "8 cells" without parts.
inline std::string cells_text(std::uint64_t cells, std::uint64_t parts, int dimension) {
    return counted(cells, "cell") + (parts == 0 ? "" : ", cut into " + simplices_text(parts, dimension));
}

}  // namespace barycert::report
