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

}  // namespace barycert::report
