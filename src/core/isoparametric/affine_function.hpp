/// Functions that are affine in the places of a cell's nodes: such a function is the cell's own, whatever its map.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/places.hpp"
#include "core/isoparametric/small_matrix.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {

struct AffineFunction {
    std::array<Rational, 3> gradient{};
    Rational at_first;  ///< at node 0

    Rational at(const Places& places, const double* point, std::size_t dimension) const {
        Rational sum = at_first;
        for (std::size_t k = 0; k < dimension; ++k)
            sum += gradient[k] * (Rational(point[k]) - exact_place(places, 0, k));
        return sum;
    }
};

/// The affine function with the values[stride * i] at nodes i. Nothing if there is none, a value is not finite, or the
/// edges from node 0 are not independent.
inline std::optional<AffineFunction> affine_function(const Reference& of, const Places& places, const double* values,
                                                     std::size_t stride) {
    const std::size_t d = of.dimension();
    for (std::size_t i = 0; i < of.nodes; ++i) {
        if (!std::isfinite(values[stride * i])) return std::nullopt;
    }
    AffineFunction f{.at_first = Rational(values[0])};
    const auto from_first = [&](std::size_t node, std::size_t k) {
        return Rational(exact_place(places, node, k) - exact_place(places, 0, k));
    };
    const bool three = of.is_simplex() || of.element == Element::wedge;
    const std::array<std::size_t, 3> along =
        three ? std::array<std::size_t, 3>{1, 2, 3} : std::array<std::size_t, 3>{1, 3, 4};
    std::array<std::array<Rational, 4>, 3> rows;
    for (std::size_t j = 0; j < d; ++j) {
        for (std::size_t k = 0; k < d; ++k) rows[j][k] = from_first(along[j], k);
        rows[j][d] = Rational(values[stride * along[j]]) - f.at_first;
    }
    if (!eliminate(rows, d)) return std::nullopt;
    for (std::size_t k = 0; k < d; ++k) f.gradient[k] = rows[k][d];
    for (std::size_t i = 1; i < of.nodes; ++i) {
        Rational sum = f.at_first;
        for (std::size_t k = 0; k < d; ++k) sum += f.gradient[k] * from_first(i, k);
        if (sum != Rational(values[stride * i])) return std::nullopt;
    }
    return f;
}

}  // namespace barycert::core::isoparametric
