/// The exact signs of one point in one cell, cheaply where points lie on faces along the axes.
#pragma once

#include "barycert/locate/names.hpp"
#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"

namespace barycert::locate {

/// weight_signs of predicates.hpp, with one more shortcut: where the vertices of a facet and the point agree in a
/// coordinate to the bit, that weight is zero, and nothing needs to be multiplied. On the sides of a box, and in meshes
/// along the axes, integers would else have to find most zeros. `point` has 3 coordinates (2D: the last is not looked
/// at), all finite.
WeightSigns cell_signs(const CellIndex& index, Place cell, const double* point, TierCounts& tiers);

/// False if the cell's box does not hold the point, told by comparisons alone.
inline bool box_holds(const CellIndex& index, Place cell, const double* point) {
    const CellRecord& record = index.cells[static_cast<std::size_t>(cell)];
    bool holds = true;
    for (std::size_t k = 0; k < index.dimension(); ++k) {
        bool below = false, above = false;  // some vertex is not above, not below
        for (const Place node : record.node) {
            const double x = index.nodes[static_cast<std::size_t>(node)].at[k];
            below |= x <= point[k];
            above |= x >= point[k];
        }
        holds &= below && above;
    }
    return holds;
}

}  // namespace barycert::locate
