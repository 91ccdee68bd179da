/// Figures in JSON, which knows neither NaN nor infinity.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace barycert::report {

/// null where there is no figure. null would hide an infinity: the largest double stands for it.
inline nlohmann::ordered_json figure(double x) {
    constexpr double max = std::numeric_limits<double>::max();
    if (std::isnan(x)) return nullptr;
    return std::clamp(x, -max, max);
}

/// Of figures that are never below 0: a negative number says that there is none.
inline nlohmann::ordered_json magnitude(double x) {
    return x >= 0 ? figure(x) : nullptr;
}

}  // namespace barycert::report
