// Measures of cells and their histograms.

#include <algorithm>

#include "barycert/draw/axes.hpp"
#include "barycert/report/check/check_pictures.hpp"
#include "barycert/report/check/check_words.hpp"

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

std::vector<Tick> ticks_of(const Histogram& h) {
    std::vector<Tick> ticks;
    if (h.logarithmic && h.high() - h.low <= 3) return log_ticks(h.low, h.high());
    for (const double t : round_numbers(h.low, h.high(), 11)) {
        if (!h.logarithmic) ticks.push_back({t, fmt::format("{:.6g}", t)});
        if (h.logarithmic && t == std::floor(t)) ticks.push_back({t, "10" + superscript(t)});
    }
    return ticks;
}

std::string bound(const Histogram& h, std::size_t bin) {
    const double x = h.low + h.width * static_cast<double>(bin);
    return h.logarithmic ? fmt::format("{:.3g}", std::pow(10, x)) : fmt::format("{:.6g}", x + 0.0);
}

/// Counts as parts of the largest; logarithmic where one cell could not be seen else.
struct CountAxis : Axis {
    double max = 1;
    bool logarithmic = false;

    explicit CountAxis(const std::vector<std::uint64_t>& counts) {
        from = 214;
        to = 40;
        title = "cells";
        double min = std::numeric_limits<double>::infinity();
        for (const std::uint64_t c : counts) {
            max = std::max(max, static_cast<double>(c));
            if (c > 0) min = std::min(min, static_cast<double>(c));
        }
        logarithmic = min < std::floor(max / 100);
        if (logarithmic) title += ", logarithmic";
        std::vector<double> at = logarithmic ? std::vector<double>{} : round_numbers(0, max, 6);
        for (double t = 1; logarithmic && t <= max; t *= 10) at.push_back(t);
        for (const double t : at) {
            if (t > 0 && t == std::floor(t)) ticks.push_back({height(t), brief_count(static_cast<std::uint64_t>(t))});
        }
    }
    double height(double count) const {
        return count <= 0 ? 0 : logarithmic ? std::log(2 * count) / std::log(2 * max) : count / max;
    }
};

std::string chart(const Histogram& h, const Measure& m) {
    Picture svg(520, 262, m.axis + ": number of cells");
    const CountAxis y(h.counts);
    const Axis x{.low = h.low,
                 .high = h.high(),
                 .from = 58,
                 .to = 498,
                 .title = m.axis + (h.logarithmic ? ", logarithmic" : ""),
                 .ticks = ticks_of(h),
                 .grid = false};
    draw_axes(svg, x, y);
    const double wide = (x.to - x.from) / static_cast<double>(h.counts.size());
    for (std::size_t i = 0; i < h.counts.size(); ++i) {
        if (h.counts[i] == 0) continue;
        const double tall = std::max(y.from - y.at(y.height(static_cast<double>(h.counts[i]))), 1.0);
        const double at = x.from + wide * static_cast<double>(i);
        svg.bar({at + 0.5, y.from - tall}, wide - 1, tall, "bar",
                fmt::format("{} to {}: {} {}", bound(h, i), bound(h, i + 1), grouped(h.counts[i]),
                            h.counts[i] == 1 ? "cell" : "cells"));
        svg.text({at + wide / 2 + 3, y.from - tall - 3}, brief_count(h.counts[i]), "count", true);
    }
    return svg_markup(svg);
}

std::string counted_apart(const Histogram& h, const Measure& m) {
    const std::array<std::pair<std::uint64_t, std::string_view>, 3> all{
        {{h.infinite, m.infinite}, {h.zero, "zero, or underflow"}, {h.unknown, "cells with no place in space"}}};
    const std::string some = joined(all, "; ", [](const auto& part) {
        return part.first == 0 ? "" : fmt::format("{}: {}", part.second, grouped(part.first));
    });
    return some.empty() ? "" : "Not in the bars: " + some + ".";
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

std::vector<Measure> measures_of(const CheckReport& r) {
    using Kind = BinRule::Kind;
    const CellMeasures& m = r.measures;
    const bool plane = r.dimension == 2;
    std::vector<double> sizes(m.volume), bits(m.condition);
    for (double& x : sizes) x = std::fabs(x);
    for (double& x : bits) x = std::isnan(x) ? x : std::log2(std::max(1.0, x));  // kappa is at least 1, but rounded
    // Angles from flat to regular: 70.53 degrees, in 2D 60.
    return {{plane ? "area" : "volume",
             plane ? "area, unit of coordinates squared" : "volume, unit of coordinates cubed",
             {.kind = Kind::logarithmic},
             std::move(sizes),
             false,
             "overflow"},
            {"accuracy lost to shape, bits",
             "accuracy lost to shape: log2 of the condition number, of 53 bits",
             {Kind::linear, 0, 10, 0},
             std::move(bits)},
            {"circumradius / shortest edge",
             fmt::format("circumradius / shortest edge (regular: {})", plane ? "0.577" : "0.612"),
             {.kind = Kind::chosen},
             m.radius_edge},
            {"aspect (regular cell: 1)",
             "aspect: longest edge / inradius, scaled (regular: 1)",
             {.kind = Kind::chosen},
             m.aspect},
            {plane ? "smallest angle, degrees" : "smallest dihedral angle, deg",
             plane ? "smallest angle, degrees (regular: 60)" : "smallest dihedral angle, degrees (regular: 70.5)",
             {Kind::given, 0, plane ? 60.0 : 72.0, plane ? 1.5 : 2.0},
             m.min_angle,
             false},
            {plane ? "largest angle, degrees" : "largest dihedral angle, deg",
             plane ? "largest angle, degrees (regular: 60)" : "largest dihedral angle, degrees (regular: 70.5)",
             {Kind::given, plane ? 60.0 : 70.0, 180, plane ? 3.0 : 2.5},
             m.max_angle}};
}

std::string histograms(const CheckReport& r) {
    std::string out;
    for (const Measure& m : measures_of(r)) {
        const Histogram h = histogram(m.values, m.rule);
        const std::string apart = xml_escaped(counted_apart(h, m));
        // An empty picture says nothing; what is counted apart does.
        const bool none = std::ranges::all_of(h.counts, [](std::uint64_t n) { return n == 0; });
        out += none ? fmt::format("<p class=\"small\">{}: no cell in a bar. {}</p>\n", xml_escaped(m.axis), apart)
                    : fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", chart(h, m), apart);
    }
    return "<div class=\"figures\">\n" + out + "</div>\n";
}

}  // namespace barycert::report
