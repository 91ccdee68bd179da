/// Values that are rounded once: sums of shape functions times values at nodes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <vector>

#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/places.hpp"
#include "core/isoparametric/small_matrix.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {

/// One component: the values of active nodes, below 1 in size, and the exponent that gives them back. Values that
/// underflow are below 2^-1074, for which value_of() has room.
struct Component {
    std::array<double, max_nodes> values{};
    int exponent = 0;
    double off = 0;  ///< Evaluated::off
};

/// The sum of the component's values times the functions n, which are given times `scale`.
template <class T>
Ball<T> sum_of(std::size_t nodes, int scale, const std::array<Ball<T>, max_nodes>& n, const Component& c) {
    Ball<T> sum(0);
    for (std::size_t i = 0; i < nodes; ++i) {
        if (c.values[i] != 0) sum = sum + n[i] * Ball<T>(T(c.values[i]));
    }
    return scale == 1 ? sum : sum * inverse_of<T>(scale);
}

/// The value, if all numbers of the ball round to it.
inline std::optional<double> value_of(const Ball<TwoDoubles>& b, int exponent) {
    const auto [high, low] = b.mid;
    const double off = b.radius * (1 + 0x1p-40) + 0x1p-52 * std::abs(low) + 0x1p-1000;
    if (high + (low - off) != high || high + (low + off) != high) return std::nullopt;
    const double value = std::ldexp(high, exponent);
    if (!(std::abs(value) >= 0x1p-1021) || !std::isfinite(value)) return std::nullopt;
    return value;
}

/// Rounded, the exact value and the middle lie between the ends of the ball.
template <unsigned bits>
std::optional<double> value_of(const Ball<Wide<bits>>& b, int exponent, double* middle, double* off) {
    using Wider = Wide<2400>;  // sums with radii, 2^-1000 or more, are exact or off by far less than the room
    const auto end = [&](double by) { return rounded(Rational(ldexp(Wider(Wider(b.mid) + by), exponent))); };
    const double radius = b.radius * (1 + 0x1p-40);  // room for what underflowed
    const double low = end(-radius), high = end(radius);
    *middle = end(0);
    *off = high - low;
    return low == high ? std::optional(low) : std::nullopt;
}

/// Components of values[components * i + c], i below `nodes` and active, by powers of two below 1. Sets `open` to 1 for
/// those that are to be computed, and `out` for the others. Returns whether some are.
inline bool scale_components(std::size_t nodes, std::uint64_t active, const double* values, std::vector<Component>& all,
                             std::vector<std::uint8_t>& open, double* out) {
    const std::size_t components = all.size();
    bool any = false;
    for (std::size_t c = 0; c < components; ++c) {
        Component& own = all[c];
        double most = 0;
        bool finite = true;
        for (std::size_t i = 0; i < nodes; ++i) {
            if ((active >> i & 1U) == 0) continue;
            own.values[i] = values[components * i + c];
            finite = finite && std::isfinite(own.values[i]);
            most = std::max(most, std::abs(own.values[i]));
        }
        out[c] = finite ? 0 : std::numeric_limits<double>::quiet_NaN();
        if (!finite || most == 0) continue;
        own.exponent = exponent_above(most);
        for (double& x : own.values) x = std::ldexp(x, -own.exponent);
        open[c] = 1;
        any = true;
    }
    return any;
}

}  // namespace barycert::core::isoparametric
