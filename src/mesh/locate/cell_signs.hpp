/// One point against one cell, in floating point with a bound, and exactly.
#pragma once

#include <cmath>
#include <cstddef>

#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "core/numerators-inl.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/names.hpp"

namespace barycert::locate {

/// The weights of a point in a cell as fractions in double. Their errors are those of filter-inl.hpp, if all extents
/// are in its range.
template <Simplex s>
struct CellAtPoint {
    static constexpr int n = vertex_count(s), d = space_dimension(s);
    static constexpr double epsilon = 0x1p-52;

    core::HWY_NAMESPACE::Fractions<s, double> weights;
    double product = 1;  ///< of the extents
    bool in_range = true;

    CellAtPoint(const CellIndex& index, const CellRecord& cell, const double* p) {
        core::HWY_NAMESPACE::Relative<s, double> relative;
        auto& r = relative.r;
        for (std::size_t i = 0; i < n; ++i) {
            const auto& at = index.nodes[cell.node[i]].at;
            for (std::size_t k = 0; k < d; ++k) r[i][k] = at[k] - p[k];
        }
        for (std::size_t k = 0; k < d; ++k) {
            double extent = std::abs(r[0][k]);
            for (std::size_t i = 1; i < n; ++i) extent = std::max(extent, std::abs(r[i][k]));
            product *= extent;
            in_range &= extent >= 0x1p-300 && extent <= 0x1p300;
        }
        solve(relative, 0.0, weights);
    }

    double numerator_error() const { return (d == 3 ? 49 : 8.5) * epsilon * product; }
    double denominator_error() const { return (d == 3 ? 245 : 37) * epsilon * product; }
};

/// weight_signs of predicates.hpp, with one more shortcut: where the vertices of a facet and the point agree in a
/// coordinate to the bit, that weight is zero, and nothing needs to be multiplied. On the sides of a box, and in meshes
/// along the axes, integers would else have to find most zeros. `point` has 3 coordinates (2D: the last is not looked
/// at), all finite.
WeightSigns cell_signs(const CellIndex& index, Place cell, const double* point, TierCounts& tiers);

/// The feature on which a point with these signs lies: of the whole cell, where this is a part of one.
Feature feature_of(const CellIndex& index, Place cell, WeightSigns signs);

/// False if the cell's box does not hold the point, told by comparisons alone.
inline bool box_holds(const CellIndex& index, Place cell, const double* point) {
    const CellRecord& record = index.cells[cell];
    bool holds = true;
    for (std::size_t k = 0; k < index.dimension(); ++k) {
        bool below = false, above = false;  // some vertex is not above, not below
        for (const Place node : record.node) {
            const double x = index.nodes[node].at[k];
            below |= x <= point[k];
            above |= x >= point[k];
        }
        holds &= below && above;
    }
    return holds;
}

}  // namespace barycert::locate
