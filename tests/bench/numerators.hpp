/// The weights of a point in a tetrahedron as fractions, in any ring of numbers: what peers compute.
#pragma once

#include <array>
#include <cstddef>

#include "barycert/simplex.hpp"

namespace barycert::bench {

/// Numerators of the four weights relative to the point; their sum is the denominator.
template <class Number>
std::array<Number, 4> numerators(const Case& c) {
    std::array<std::array<Number, 3>, 4> v;
    for (std::size_t k = 0; k < 3; ++k) {
        const Number p(c.point[k]);
        for (std::size_t i = 0; i < 4; ++i) v[i][k] = Number(c.vertices[3 * i + k]) - p;
    }
    const auto cross = [](const auto& a, const auto& b) {
        return std::array<Number, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const auto& a, const auto& b) { return Number(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); };
    const auto ab = cross(v[0], v[1]), cd = cross(v[2], v[3]);
    return {dot(v[1], cd), Number(-dot(v[0], cd)), dot(v[3], ab), Number(-dot(v[2], ab))};
}

/// The value of the linear field; still to be rounded.
template <class Number>
Number value_in(const Case& c) {
    const std::array<Number, 4> n = numerators<Number>(c);
    Number sum(0);
    for (std::size_t i = 0; i < 4; ++i) sum += n[i] * Number(c.values[i]);
    return sum / (n[0] + n[1] + n[2] + n[3]);
}

}  // namespace barycert::bench
