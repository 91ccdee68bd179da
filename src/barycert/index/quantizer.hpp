/// Coordinates as integers, for boxes and bins.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace barycert::index {

/// Maps each axis of a box onto integers of 31 bits. The map is monotone: x <= y gives at(k, x) <= at(k, y), whatever
/// is rounded, because halving, subtracting, multiplying by a positive number, cutting off and clamping all are. So
/// what lies in a box lies in its image, and comparing images excludes no cell that holds a point.
class Quantizer {
public:
    static constexpr int bits = 31;
    static constexpr std::int32_t max = std::numeric_limits<std::int32_t>::max();

    Quantizer() = default;

    /// Of the box from low to high, d coordinates each, finite and ordered.
    Quantizer(std::size_t d, const double* low, const double* high) {
        for (std::size_t k = 0; k < d; ++k) {
            half_low_[k] = low[k] * 0.5;
            // Halves, for the difference of two doubles may be none.
            const double half = high[k] * 0.5 - half_low_[k];
            const double scale = static_cast<double>(max) / half;  // the clamp takes what rounding puts above
            scale_[k] = half > 0 ? std::min(scale, std::numeric_limits<double>::max()) : 0;
        }
    }

    /// Precondition: x is finite.
    std::int32_t at(std::size_t k, double x) const {
        const double t = (x * 0.5 - half_low_[k]) * scale_[k];
        return static_cast<std::int32_t>(std::clamp(t, 0.0, static_cast<double>(max)));
    }

    /// Numbers that no coordinate mapped to q falls below, or rises above, by more than a rounding of their own size.
    /// Infinite on an axis that the halves of its ends do not tell apart.
    double below(std::size_t k, std::int32_t q) const {
        return scale_[k] > 0 ? 2 * (half_low_[k] + (q - 1.0) / scale_[k]) : -std::numeric_limits<double>::infinity();
    }
    double above(std::size_t k, std::int32_t q) const {
        return scale_[k] > 0 ? 2 * (half_low_[k] + (q + 2.0) / scale_[k]) : std::numeric_limits<double>::infinity();
    }

private:
    std::array<double, 3> half_low_{}, scale_{};
};

}  // namespace barycert::index
