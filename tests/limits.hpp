/// Limits of double, by short names.
#pragma once

#include <limits>

namespace barycert::testing {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double max_double = std::numeric_limits<double>::max();

}  // namespace barycert::testing
