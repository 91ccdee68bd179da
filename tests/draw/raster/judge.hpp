/// The slow twin of the rasteriser: rational numbers, one pixel at a time, the top-left rule as textbooks have it.
#pragma once

#include <array>
#include <cstdint>

namespace barycert {

using Corners = std::array<double, 6>;  ///< x and y of three vertices

/// Whether the triangle covers pixel (i, j).
bool judge_covers(const Corners& triangle, std::int32_t i, std::int32_t j);

/// The exact value at the centre of pixel (i, j), rounded once. Requires: not degenerate.
double judge_value(const Corners& triangle, const std::array<double, 3>& values, std::int32_t i, std::int32_t j);

/// |value - exact value|, rounded up or down by one ulp at most.
double judge_error(const Corners& triangle, const std::array<double, 3>& values, std::int32_t i, std::int32_t j,
                   double value);

}  // namespace barycert
