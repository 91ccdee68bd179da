/// From correctly rounded doubles to values of other types, as if the exact value had been rounded once.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "barycert/predicates.hpp"

namespace barycert::in_vtk {

/// `value` is the exact value rounded to nearest; `side(t)` tells the sign of the exact value less t, and is asked only
/// where `value` lies in the middle between two values of T. To float: nearest, ties to even. To integers: nearest,
/// halves away from zero, within the range of T, and 0 for NaN, as VTK rounds.
template <class T, class Side>
T once_rounded(double value, Side&& side) {
    if constexpr (std::is_same_v<T, double>) {
        return value;
    } else if constexpr (std::is_same_v<T, float>) {
        const auto near = static_cast<float>(value);
        if (static_cast<double>(near) == value || !std::isfinite(near)) return near;
        const float other =
            std::nextafter(near, static_cast<double>(near) < value ? std::numeric_limits<float>::infinity()
                                                                   : -std::numeric_limits<float>::infinity());
        // Both have 24 bits: their mean is a double.
        if (!std::isfinite(other) || (static_cast<double>(near) + static_cast<double>(other)) / 2 != value) return near;
        const Sign rest = side(value);
        if (rest == Sign::zero) return near;
        return (rest == Sign::positive) == (other > near) ? other : near;
    } else {
        if (std::isnan(value)) return 0;
        double whole = std::round(value);
        if (std::abs(value - std::trunc(value)) == 0.5) {
            const Sign rest = side(value);
            if (rest == (value > 0 ? Sign::negative : Sign::positive)) whole = std::trunc(value);
        }
        // The bounds are powers of two, or one less: as doubles they are never below what T holds.
        if (whole <= static_cast<double>(std::numeric_limits<T>::min())) return std::numeric_limits<T>::min();
        if (whole >= static_cast<double>(std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
        return static_cast<T>(whole);
    }
}

}  // namespace barycert::in_vtk
