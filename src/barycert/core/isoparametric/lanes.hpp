/// Values in hexahedra, wedges and pyramids, many at a time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace barycert::core::isoparametric {

inline constexpr std::size_t max_lanes = 16;

/// Cases of one element, as corners of hexahedra: a pyramid has its apex four times, a wedge nodes 0 1 2 0 3 4 5 3.
/// Number j of a row belongs to case j; rows have max_lanes numbers, all of which are set.
struct LaneCases {
    std::size_t count = 0;  ///< at most max_lanes
    bool wedge = false;
    const double* places = nullptr;  ///< 24 rows: x, y, z of each corner
    const double* point = nullptr;   ///< 3 rows
    const double* values = nullptr;  ///< 8 rows a component
    std::size_t components = 0;
    double* out = nullptr;  ///< a row a component
};

/// A bit for each case.
struct LanesProved {
    std::uint32_t inside = 0;  ///< the point is inside the cell, on none of its sides
    std::uint32_t values = 0;  ///< all values, if the point is in the cell
};

/// Sets values, each rounded once. Preconditions: as of evaluate(), but the point may be anywhere; values are finite.
LanesProved evaluate_lanes(const LaneCases& cases);

}  // namespace barycert::core::isoparametric
