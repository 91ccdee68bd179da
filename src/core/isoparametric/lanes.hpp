/// Values in hexahedra, wedges, pyramids and tetrahedra of order 2, many at a time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace barycert::core::isoparametric {

inline constexpr std::size_t max_lanes = 16;

/// Elements whose values lanes compute. `hexahedron` is also for pyramids, with their apex four times; a wedge is given
/// by nodes 0 1 2 0 3 4 5 3; a tetrahedron has ten nodes as VTK numbers them.
enum class LaneElement : std::uint8_t { hexahedron, wedge, tetrahedron };

constexpr std::size_t lane_nodes(LaneElement element) {
    return element == LaneElement::tetrahedron ? 10 : 8;
}

/// Cases of one element. Number j of a row belongs to case j; rows have max_lanes numbers, all of which are set.
struct LaneCases {
    std::size_t count = 0;  ///< at most max_lanes
    LaneElement element = LaneElement::hexahedron;
    const double* places = nullptr;  ///< 3 rows a node: x, y, z
    const double* others = nullptr;  ///< of nodes 4 to 9 of tetrahedra likewise: each is amid its place and that one
    const double* point = nullptr;   ///< 3 rows
    const double* values = nullptr;  ///< a row a node, a component after the other
    std::size_t components = 0;
    double* out = nullptr;  ///< a row a component
};

/// A bit for each case.
struct LanesProved {
    std::uint32_t inside = 0;  ///< the point is inside the cell, on none of its sides
    std::uint32_t values = 0;  ///< all values, if the point is in the cell
};

/// Sets values, each rounded once. Requires: as of evaluate(), but the point may be anywhere; values are finite.
LanesProved evaluate_lanes(const LaneCases& cases);

}  // namespace barycert::core::isoparametric
