// Measures of cells and their histograms.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/report/check/check_measures.hpp"
#include "app/report/check/check_pictures.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/check.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "draw/axes.hpp"
#include "draw/histogram.hpp"
#include "draw/picture.hpp"

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

void choose_bins(Bins& h, double min, double max) {
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

std::vector<Tick> ticks_of(const Bins& h) {
    std::vector<Tick> ticks;
    if (h.logarithmic && h.high() - h.low <= 3) return log_ticks(h.low, h.high());
    for (const double t : round_numbers(h.low, h.high(), 11)) {
        if (!h.logarithmic) ticks.push_back({t, fmt::format("{:.6g}", t)});
        if (h.logarithmic && t == std::floor(t)) ticks.push_back({t, "10" + superscript(t)});
    }
    return ticks;
}

std::string bound(const Bins& h, std::size_t bin) {
    const double x = h.low + h.width * static_cast<double>(bin);
    return h.logarithmic ? fmt::format("{:.3g}", std::pow(10, x)) : fmt::format("{:.6g}", x + 0.0);
}

Picture chart(const Bins& h, const Measure& m) {
    return draw::histogram({.title = m.axis + ": number of cells",
                            .x = {.low = h.low,
                                  .high = h.high(),
                                  .title = m.axis + (h.logarithmic ? ", logarithmic" : ""),
                                  .ticks = ticks_of(h)},
                            .counts = h.counts,
                            .range = [&](std::size_t i) { return bound(h, i) + " to " + bound(h, i + 1); }});
}

/// An empty picture says nothing; what is counted apart does.
bool is_empty(const Bins& h) {
    return std::ranges::all_of(h.counts, [](std::uint64_t n) { return n == 0; });
}

std::string counted_apart(const Bins& h, const Measure& m) {
    const std::array<std::pair<std::uint64_t, std::string_view>, 3> all{
        {{h.infinite, m.infinite}, {h.zero, "zero, or underflow"}, {h.unknown, "cells with no place in space"}}};
    const std::string some = joined(all, "; ", [](const auto& part) {
        return part.first == 0 ? "" : fmt::format("{}: {}", part.second, grouped(part.first));
    });
    return some.empty() ? "" : "Not in the bars: " + some + ".";
}

}  // namespace

Bins bins_of(const std::vector<double>& values, const BinRule& rule) {
    Bins h;
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

std::string histograms(const CheckReport& r) {
    std::string out;
    for (const Measure& m : measures_of(r)) {
        const Bins h = bins_of(m.values, m.rule);
        const std::string apart = xml_escaped(counted_apart(h, m));
        out += is_empty(h)
                   ? fmt::format("<p class=\"small\">{}: no cell in a bar. {}</p>\n", xml_escaped(m.axis), apart)
                   : fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", svg_markup(chart(h, m)), apart);
    }
    return "<div class=\"figures\">\n" + out + "</div>\n";
}

}  // namespace barycert::report

namespace barycert {

Result<std::string> check_plot(const CheckReport& report, const std::string& name, const std::string& path) {
    const ExactEnvironment environment;
    std::vector<draw::Picture> all;
    for (const report::Measure& m : report::measures_of(report))
        if (const report::Bins h = report::bins_of(m.values, m.rule); !report::is_empty(h)) {
            all.push_back(report::chart(h, m));
            all.back().text({58, 14}, report::counted_apart(h, m), "small");
        }
    return draw::rows_text(path, all, name);
}

}  // namespace barycert
