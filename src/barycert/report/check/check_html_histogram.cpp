#include "barycert/report/check/check_html_histogram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/check.hpp"
#include "barycert/report/check/check_words.hpp"
#include "barycert/report/common/html_text.hpp"
#include "barycert/report/common/picture.hpp"
#include "barycert/report/common/svg.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {
namespace {

constexpr double max_bins = 48;

/// The smallest of 1, 2, 5 times a power of ten that covers the span with few enough bins.
double round_width(double span) {
    const double min = span / max_bins;
    const double power = std::pow(10, std::floor(std::log10(min)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= min) return factor * power;
    }
    return 10 * power;
}

void choose_bins(Histogram& h, double min, double max) {
    // Values that are all but the same get bins around them, a decade or a tenth of their size.
    const double smallest = h.logarithmic || max == 0 ? 1 : 0.1 * max;
    if (max - min < smallest) {
        const double middle = min + (max - min) / 2;
        min = middle - smallest / 2;
        max = min + smallest;
    }
    h.width = round_width(max - min);
    const double first = std::floor(min / h.width), last = std::floor(max / h.width) + 1;
    h.low = first * h.width;
    h.counts.assign(static_cast<std::size_t>(last - first), 0);
}

std::string superscript(double exponent) {
    constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string out;
    for (const char c : fmt::format("{:.0f}", exponent))
        out += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
    return out;
}

struct Tick {
    double at;
    std::string text;
};

std::vector<Tick> ticks_of(const Histogram& h) {
    std::vector<Tick> ticks;
    if (!h.logarithmic) {
        for (const double t : round_ticks(h.low, h.high(), 11)) ticks.push_back({t, fmt::format("{:.6g}", t)});
    } else if (h.high() - h.low > 3) {
        for (const double t : round_ticks(h.low, h.high(), 11)) {
            if (t == std::floor(t)) ticks.push_back({t, "10" + superscript(t)});
        }
    } else {
        const int low = static_cast<int>(std::floor(h.low)), high = static_cast<int>(std::floor(h.high()));
        for (int k = low; k <= high; ++k) {
            for (const double factor : {1.0, 2.0, 5.0}) {
                const double t = k + std::log10(factor);
                if (t < h.low || t > h.high()) continue;
                ticks.push_back({t, std::abs(k) <= 3 ? fmt::format("{:.6g}", factor * std::pow(10, k))
                                                     : fmt::format("{:.0f}e{}", factor, k)});
            }
        }
    }
    return ticks;
}

std::string bound(const Histogram& h, std::size_t bin) {
    const double x = h.low + h.width * static_cast<double>(bin);
    return h.logarithmic ? fmt::format("{:.3g}", std::pow(10, x)) : fmt::format("{:.6g}", x + 0.0);
}

/// A count to a height; linear, or logarithmic so that one cell can be seen.
struct CountAxis {
    bool logarithmic = false;
    double top = 1, height = 1;
    double operator()(double count) const {
        if (count <= 0) return 0;
        return height * (logarithmic ? std::log(2 * count) / std::log(2 * top) : count / top);
    }
    std::vector<double> ticks() const {
        std::vector<double> list;
        if (logarithmic) {
            double t = 1;
            while (t <= top) {
                list.push_back(t);
                t *= 10;
            }
            return list;
        }
        for (const double t : round_ticks(0, top, 6)) {
            if (t > 0 && t == std::floor(t)) list.push_back(t);
        }
        return list;
    }
};

CountAxis count_axis(const Histogram& h, double height) {
    std::uint64_t max = 1, min = std::numeric_limits<std::uint64_t>::max();
    for (const std::uint64_t c : h.counts) {
        max = std::max(max, c);
        if (c > 0) min = std::min(min, c);
    }
    return {.logarithmic = min < max / 100, .top = static_cast<double>(max), .height = height};
}

constexpr double chart_width = 520, chart_height = 262, left = 58, right = 498, base = 214, ceiling = 40;

void draw(Picture& svg, const Histogram& h, const HistogramText& text) {
    const CountAxis y = count_axis(h, base - ceiling);
    const auto x = [&](double value) { return left + (right - left) * (value - h.low) / (h.high() - h.low); };
    for (const double t : y.ticks()) {
        svg.line({left, base - y(t)}, {right, base - y(t)}, "grid");
        svg.text({left - 6, base - y(t) + 4}, brief_count(static_cast<std::uint64_t>(t)), "tick e");
    }
    const double wide = (right - left) / static_cast<double>(h.counts.size());
    for (std::size_t i = 0; i < h.counts.size(); ++i) {
        if (h.counts[i] == 0) continue;
        const double tall = std::max(y(static_cast<double>(h.counts[i])), 1.0);
        const double at = left + wide * static_cast<double>(i);
        svg.bar({at + 0.5, base - tall}, wide - 1, tall, "bar",
                fmt::format("{} to {}: {} {}", bound(h, i), bound(h, i + 1), grouped(h.counts[i]),
                            h.counts[i] == 1 ? "cell" : "cells"));
        svg.text({at + wide / 2 + 3, base - tall - 3}, brief_count(h.counts[i]), "count", true);
    }
    svg.line({left, base}, {right, base}, "axis");
    for (const Tick& t : ticks_of(h)) {
        svg.line({x(t.at), base}, {x(t.at), base + 5}, "axis");
        svg.text({x(t.at), base + 18}, t.text, "tick m");
    }
    svg.text({(left + right) / 2, base + 40}, std::string(text.axis) + (h.logarithmic ? ", logarithmic" : ""),
             "title m");
    svg.text({14, (base + ceiling) / 2}, y.logarithmic ? "cells, logarithmic" : "cells", "title m", true);
}

std::string counted_apart(const Histogram& h, const HistogramText& text) {
    std::string out;
    const auto add = [&](std::uint64_t count, std::string_view what) {
        if (count != 0) out += fmt::format("{}{}: {}", out.empty() ? "" : "; ", what, grouped(count));
    };
    add(h.infinite, text.infinite);
    add(h.zero, text.zero);
    add(h.unknown, "cells with no place in space");
    return out.empty() ? "" : "Not in the bars: " + out + ".";
}

}  // namespace

Histogram histogram(const std::vector<double>& values, const BinRule& rule) {
    Histogram h;
    double min = std::numeric_limits<double>::infinity(), smallest = min, max = -1;
    for (const double x : values) {
        if (!std::isfinite(x)) continue;
        min = std::min(min, x);
        if (x > 0) smallest = std::min(smallest, x);
        max = std::max(max, x);
    }
    const bool far_out = max > 1e300 || (max > 0 && max < 1e-300);  // bounds of bins might over- or underflow
    h.logarithmic = rule.kind == BinRule::Kind::logarithmic || (rule.kind != BinRule::Kind::given && far_out) ||
                    (rule.kind == BinRule::Kind::chosen && max > 0 && max / 20 > min);
    if (rule.kind == BinRule::Kind::given) {
        h.low = rule.low;
        h.width = rule.width;
        h.counts.assign(static_cast<std::size_t>(std::lround((rule.high - rule.low) / rule.width)), 0);
    } else if (max < 0 || (h.logarithmic && max == 0)) {  // nothing to show
        h.counts.assign(1, 0);
    } else if (h.logarithmic) {
        choose_bins(h, std::log10(smallest), std::log10(max));
    } else if (rule.kind == BinRule::Kind::linear) {
        choose_bins(h, std::min(min, rule.low), std::max(max, rule.high));
    } else {
        choose_bins(h, min, max);
    }
    const double last = static_cast<double>(h.counts.size() - 1);
    for (const double x : values) {
        if (std::isnan(x)) {
            ++h.unknown;
        } else if (std::isinf(x)) {
            ++h.infinite;
        } else if (h.logarithmic && x == 0) {
            ++h.zero;
        } else {
            const double bin = std::floor(((h.logarithmic ? std::log10(x) : x) - h.low) / h.width);
            ++h.counts[static_cast<std::size_t>(std::clamp(bin, 0.0, last))];
        }
    }
    return h;
}

std::string histogram_figure(const CheckReport& r, const std::vector<double>& values, const BinRule& rule,
                             const HistogramText& text) {
    const Histogram h = histogram(values, rule);
    // An empty picture says nothing; what is counted apart does.
    if (std::all_of(h.counts.begin(), h.counts.end(), [](std::uint64_t n) { return n == 0; }))
        return fmt::format("<p class=\"small\">{}: no cell in a bar. {}</p>\n", html_escaped(text.title),
                           html_escaped(counted_apart(h, text)));
    const Distribution d = distribution(values);
    std::string out = fmt::format("<figure><h3>{}</h3>\n", html_escaped(text.title));
    if (d.min_cell >= 0) {
        const auto figure = [](double x) { return std::isinf(x) ? "∞" : fmt::format("{:.4g}", x + 0.0); };
        out += fmt::format("<p class=\"small\">least {} · median {} · most {} · worst in cell <b>{}</b></p>\n",
                           figure(d.min), figure(d.median), figure(d.max),
                           r.cell_number(text.max_is_worst ? d.max_cell : d.min_cell));
    }
    Picture svg(chart_width, chart_height, std::string(text.title) + ": number of cells");
    draw(svg, h, text);
    return out + std::move(svg).finish() +
           fmt::format("<p class=\"small\">{}</p></figure>\n", html_escaped(counted_apart(h, text)));
}

}  // namespace barycert::report
