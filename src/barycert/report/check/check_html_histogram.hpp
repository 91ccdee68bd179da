/// Histograms of measures for the HTML report.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/check.hpp"

namespace barycert::report {

/// Where bins lie. `given`: as many of `width` from `low` on as make `high`; values beyond (rounding) go to the outer
/// ones. Else bins of a round width between the least and the greatest finite value, 20 to 50 of them: as they are if
/// `linear`, and then [low, high] is always shown; in log10 if `logarithmic`; `chosen` is logarithmic if the greatest
/// value is more than 20 times the least.
struct BinRule {
    enum class Kind : std::uint8_t { given, linear, logarithmic, chosen } kind = Kind::linear;
    double low = 0, high = 0, width = 0;
};

struct Histogram {
    bool logarithmic = false;  ///< bins are of log10 of the values
    double low = 0, width = 1;
    std::vector<std::uint64_t> counts;

    // Counted apart.
    std::uint64_t unknown = 0;   ///< NaN
    std::uint64_t infinite = 0;  ///< or beyond the largest double
    std::uint64_t zero = 0;      ///< where bins are logarithmic

    double high() const { return low + width * static_cast<double>(counts.size()); }
};

/// Every value is in one bin or counted apart. Values are not negative.
Histogram histogram(const std::vector<double>& values, const BinRule& rule);

struct HistogramText {
    std::string_view title;
    std::string_view axis;      ///< the measure, with its unit
    std::string_view infinite;  ///< what an infinite value is
    std::string_view zero;      ///< what zero is, where bins are logarithmic
    bool max_is_worst = true;
};

/// Empty if no bar would be drawn; else a figure: title, least, median, most, the bars, what was counted apart. Counts
/// are on a logarithmic axis if the smallest bar would else be lower than 1 % of the tallest one.
std::string histogram_figure(const CheckReport& report, const std::vector<double>& values, const BinRule& rule,
                             const HistogramText& text);

}  // namespace barycert::report
