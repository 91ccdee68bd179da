/// Simplices of order 2 to 4 in Bernstein's form: what their sources share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/places.hpp"
#include "core/shape_functions.hpp"

namespace barycert::core::isoparametric {

/// Bernstein coefficients from values at nodes: rows of whole numbers over one denominator.
struct ToBernstein {
    std::vector<std::vector<double>> rows;
    double denominator = 1;
};

struct SimplexBasis {
    const Reference& reference;
    ToBernstein bernstein;
    /// Coefficient i of the derivative by coordinate k: control points `by[k]` less `by[-]`, of index `index`.
    struct Slope {
        std::array<std::uint8_t, 4> index;
        std::size_t base;
        std::array<std::size_t, 3> by;
    };
    std::vector<Slope> slopes;
    /// For each multi-index of a degree: the indices of the next degree that have one more of a corner.
    using Level = std::vector<std::array<std::uint8_t, 4>>;
    std::vector<Level> levels;  ///< of degree order - 1, order - 2, ...
};

const SimplexBasis& simplex_of(const Reference& of);

/// Control points in double, times `scale`, a power of two by which coordinates are at most 1. Each is off by at most
/// control_error: the absolute values of a row of ToBernstein add up to at most 35 denominators (order 4 in space), so
/// 35 products, their sums, a quotient and the rounding of a node lose at most 40 * 35 * 2^-53 < 2^-42.
std::vector<Vector<double>> rounded_control_points(const SimplexBasis& s, const Places& places, double scale);
constexpr double control_error = 0x1p-40;

}  // namespace barycert::core::isoparametric
