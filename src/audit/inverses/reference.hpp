/// Cells of VTK's types 9, 12, 13 and 14, as those who know their maps have them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "barycert/inverse_rules.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/vtk_cell.hpp"

namespace barycert::audit {

namespace iso = core::isoparametric;

/// Where node i of the reference cell is; the apex of a pyramid over the middle of its base.
inline std::array<double, 3> reference_node(std::uint8_t type, std::size_t i) {
    if (type == vtk_wedge) return {double(i % 3 == 1), double(i % 3 == 2), double(i >= 3)};
    if (i == 4 && type == vtk_pyramid) return {0.5, 0.5, 1};
    return {double(i % 4 == 1 || i % 4 == 2), double(i % 4 >= 2), double(i >= 4)};
}

inline iso::Places places_of(const InverseCase& c) {
    iso::Places places;
    for (std::size_t i = 0; i < c.values.size(); ++i) places.at[i] = &c.nodes[c.point.size() * i];
    return places;
}

}  // namespace barycert::audit
