/// Measures of cells as people see them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/measures.hpp"

namespace barycert::report {

/// Where bins lie. `given`: as many of `width` from `low` on as make `high`; values beyond (rounding) go to the outer
/// ones. Else bins of a round width between the least and the greatest finite value, 20 to 50 of them: as they are if
/// `linear`, and then [low, high] is always shown; in log10 if `logarithmic`, or if `chosen` and max > 20 min.
struct BinRule {
    enum class Kind : std::uint8_t { given, linear, logarithmic, chosen } kind = Kind::linear;
    double low = 0, high = 0, width = 0;
};

struct Measure {
    std::string name;  ///< in tables
    std::string axis;  ///< the measure, with its unit
    BinRule rule;
    std::vector<double> values;
    std::vector<double> CellMeasures::*of = nullptr;  ///< the measure of the report that the values are, if one is
    bool max_is_worst = true;
    std::string_view infinite = "infinite (degenerate cells)";  ///< what an infinite value is
};

/// Returns the report's measures as people see them: |volume|, the bits of accuracy that shape may cost, ratios,
/// angles.
std::vector<Measure> measures_of(const CheckReport& report);

}  // namespace barycert::report
