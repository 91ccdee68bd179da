#include <fmt/format.h>

#include <cmath>

#include "matrix.hpp"

namespace barycert::flags {
namespace {

constexpr int side = 26, left = 226, top = 172, gap = 14;

/// 0 where nothing changes, 1 to 5 by the share of answers: up to 0.1, 1, 10, 50 % and beyond.
int shade(const Cell& c) {
    if (c.changed == 0) return 0;
    const double p = static_cast<double>(c.changed) / static_cast<double>(c.cases);
    return p <= 0.001 ? 1 : p <= 0.01 ? 2 : p <= 0.1 ? 3 : p <= 0.5 ? 4 : 5;
}

/// Columns of one compiler stand together.
double left_of(const Matrix& m, std::size_t column) {
    int groups = 0;
    for (std::size_t k = 1; k <= column; ++k) {
        const bool other =
            m.columns[k].compiler != m.columns[k - 1].compiler || m.columns[k].flush != m.columns[k - 1].flush;
        groups += other ? 1 : 0;
    }
    return left + side * static_cast<double>(column) + gap * groups;
}

/// By the share of answers that get wrong: up to 0.1, 1 % and beyond.
double radius(double p) {
    return p <= 0.001 ? 2.5 : p <= 0.01 ? 4.5 : 7;
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
    return fmt::format("{:.3g} %", 100 * static_cast<double>(part) / static_cast<double>(whole));
}

}  // namespace

std::string picture(const Matrix& m) {
    const double right = left_of(m, m.columns.size() - 1) + side + 84;
    const double bottom = top + side * static_cast<double>(m.rows.size()), height = bottom + 76;
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
        "{1:.0f}\" "
        "role=\"img\" aria-labelledby=\"t d\">\n<title id=\"t\">Formulas under compiler flags</title>\n"
        "<desc id=\"d\">A square for each formula and set of flags: the darker, the more answers change. A ring marks "
        "squares where answers get wrong that the strict build has right.</desc>\n",
        right, height);
    out +=
        "<style>\n"
        "svg{background:#fff}text{font:12px system-ui,'DejaVu Sans',sans-serif;fill:#1d2227}.s{fill:#59636c}\n"
        ".c0{fill:#eef1f3}.c1{fill:#d3e5f3}.c2{fill:#a6cbe8}.c3{fill:#6baed6}.c4{fill:#2f7fb8}.c5{fill:#084a81}\n"
        ".w{fill:#fff;stroke:#c8102e;stroke-width:2.5}\n"
        "@media (prefers-color-scheme:dark){svg{background:#15191c}text{fill:#e4e8eb}.s{fill:#a3adb5}\n"
        ".c0{fill:#242b30}.c1{fill:#1f3d52}.c2{fill:#245877}.c3{fill:#2f7aa5}.c4{fill:#56a4d0}.c5{fill:#a8d8f4}\n"
        ".w{fill:#15191c;stroke:#ff7a88}}\n</style>\n";
    for (std::size_t k = 0; k < m.columns.size(); ++k) {
        const double x = left_of(m, k) + side / 2.0 + 4;
        out += fmt::format("<text transform=\"translate({:.1f} {}) rotate(-60)\">{} {}</text>\n", x, top - 8,
                           m.columns[k].compiler, m.columns[k].label);
    }
    for (std::size_t i = 0; i < m.rows.size(); ++i) {
        const double y = top + side * static_cast<double>(i);
        out += fmt::format("<text x=\"{}\" y=\"{:.0f}\" text-anchor=\"end\">{}</text>\n", left - 8, y + 17,
                           m.rows[i].kernel);
        for (std::size_t k = 0; k < m.columns.size(); ++k) {
            const Cell& c = m.rows[i].cells[k];
            if (!c.ran) continue;
            const double x = left_of(m, k);
            out += fmt::format("<g><title>{}, {} {}: {} of the answers change, {} get wrong, {} get right</title>",
                               m.rows[i].kernel, m.columns[k].compiler, m.columns[k].label, percent(c.changed, c.cases),
                               percent(c.newly_wrong, c.cases), percent(c.newly_right, c.cases));
            out += fmt::format("<rect class=\"c{}\" x=\"{:.0f}\" y=\"{:.0f}\" width=\"{}\" height=\"{}\"/>", shade(c),
                               x + 1, y + 1, side - 2, side - 2);
            if (c.newly_wrong != 0) {
                const double p = static_cast<double>(c.newly_wrong) / static_cast<double>(c.cases);
                out += fmt::format("<circle class=\"w\" cx=\"{:.0f}\" cy=\"{:.0f}\" r=\"{}\"/>", x + side / 2.0,
                                   y + side / 2.0, radius(p));
            }
            out += "</g>\n";
        }
    }
    const char* const words[] = {"none", "to 0.1 %", "to 1 %", "to 10 %", "to 50 %", "more"};
    out += fmt::format("<text class=\"s\" x=\"{}\" y=\"{:.0f}\" text-anchor=\"end\">answers that change</text>\n",
                       left - 8, bottom + 34);
    for (int s = 0; s < 6; ++s) {
        const double x = left + 84.0 * s;
        out += fmt::format("<rect class=\"c{}\" x=\"{:.0f}\" y=\"{:.0f}\" width=\"16\" height=\"16\"/>", s, x,
                           bottom + 22);
        out += fmt::format("<text class=\"s\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n", x + 22, bottom + 34, words[s]);
    }
    out += fmt::format("<text class=\"s\" x=\"{}\" y=\"{:.0f}\" text-anchor=\"end\">of these get wrong</text>\n",
                       left - 8, bottom + 60);
    const double shares[] = {0.0005, 0.005, 1};
    const char* const sizes[] = {"to 0.1 %", "to 1 %", "more, of all answers; the strict build has them right"};
    for (int s = 0; s < 3; ++s) {
        const double x = left + 84.0 * s;
        out += fmt::format("<circle class=\"w\" cx=\"{:.0f}\" cy=\"{:.0f}\" r=\"{}\"/>", x + 8, bottom + 56,
                           radius(shares[s]));
        out += fmt::format("<text class=\"s\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n", x + 22, bottom + 60, sizes[s]);
    }
    out += "</svg>\n";
    return out;
}

}  // namespace barycert::flags
