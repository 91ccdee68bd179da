/// Internal: what the predicates of single points have in common: what follows where the filter leaves a sign open.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>

#include "barycert/predicates.hpp"
#include "barycert/result.hpp"

namespace barycert {

template <std::size_t count>
bool all_finite(const std::array<const double*, count>& points, int d) {
    return std::all_of(points.begin(), points.end(), [d](const double* p) {
        return std::all_of(p, p + d, [](double x) { return std::isfinite(x); });
    });
}

/// exact(). Integers that were made of NaN or infinity have the width of finite ones (scaled_double.hpp).
template <std::size_t count, class Exact>
Sign exact_sign([[maybe_unused]] const std::array<const double*, count>& points, [[maybe_unused]] int d, Exact exact) {
    assert(all_finite(points, d));
    return static_cast<Sign>(exact());
}

/// The first coordinate that is not finite as an Error, or else exact().
template <std::size_t count, class Exact>
[[gnu::noinline]] Result<Sign> checked_exact_sign(const std::array<const double*, count>& points, int d, Exact exact) {
    for (std::size_t i = 0; i < count; ++i) {
        for (int k = 0; k < d; ++k) {
            if (!std::isfinite(points[i][k]))
                return Error{.what = "coordinate " + std::to_string(k) + " of point " + std::to_string(i),
                             .expected = "a finite number",
                             .found = std::to_string(points[i][k])};
        }
    }
    return static_cast<Sign>(exact());
}

}  // namespace barycert
