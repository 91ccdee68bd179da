/// Internal: what the predicates of single points have in common: their answer or their error.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "barycert/predicates.hpp"
#include "barycert/result.hpp"

namespace barycert {

inline Sign as_sign(int s) {
    return s < 0 ? Sign::negative : s > 0 ? Sign::positive : Sign::zero;
}

/// What follows if the filter cannot tell: the first coordinate that is not finite as an Error, or else exact().
template <std::size_t count, class Exact>
[[gnu::noinline]] Result<Sign> exact_sign(const std::array<const double*, count>& points, int d, Exact exact) {
    for (std::size_t i = 0; i < count; ++i) {
        for (int k = 0; k < d; ++k) {
            if (!std::isfinite(points[i][k]))
                return Error{.what = "coordinate " + std::to_string(k) + " of point " + std::to_string(i),
                             .expected = "a finite number",
                             .found = std::to_string(points[i][k])};
        }
    }
    return as_sign(exact());
}
}  // namespace barycert
