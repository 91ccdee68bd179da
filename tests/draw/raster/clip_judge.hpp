/// Clipping in rationals, as textbooks have it: bound after bound, each new vertex from the two beside it.
#pragma once

#include <vector>

#include "tests/draw/raster/rational.hpp"

namespace barycert {

using RationalRow = std::vector<Rational>;  ///< x, y, z, w and attributes

/// The triangle (three rows of doubles) clipped to -w <= x, y, z <= w.
std::vector<RationalRow> judge_clip(const std::vector<double>& vertices);

}  // namespace barycert
