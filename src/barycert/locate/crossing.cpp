#include "barycert/locate/crossing.hpp"

#include <cstddef>
#include <span>

#include "barycert/predicates.hpp"

namespace barycert::locate {
namespace {

using Point = const double*;

struct Corner {
    Point at;
    bool common;  ///< a vertex of both
};

/// The vertices of a facet of the cell, or of the facet itself.
struct Plane {
    int d;
    std::array<Point, 3> at;

    Sign side(Point p) const { return d == 2 ? orient2d(at[0], at[1], p) : orient3d(at[0], at[1], at[2], p); }
};

/// All that are not common lie strictly on the given side.
bool all_on_side(const Plane& plane, std::span<const Corner> corners, Sign side) {
    for (const Corner& c : corners) {
        if (!c.common && plane.side(c.at) != side) return false;
    }
    return true;
}

/// All that are not common lie strictly on one side.
bool all_on_one_side(const Plane& plane, std::span<const Corner> corners) {
    for (const Corner& c : corners) {
        if (c.common) continue;
        const Sign side = plane.side(c.at);
        return side != Sign::zero && all_on_side(plane, corners, side);
    }
    return false;
}

}  // namespace

// A plane through all common vertices that has the other vertices of one of both strictly on one side, and the other
// one on the other side or on it, meets the first in the common face alone. Planes of facets are tried.
bool may_cross(const CellIndex& index, Place cell, const check::PlacedFacet& facet) {
    const auto d = static_cast<int>(index.dimension());
    const auto n = static_cast<std::size_t>(d);
    const CellRecord& record = index.cells[static_cast<std::size_t>(cell)];
    std::array<Corner, 4> of_cell{};
    std::array<Corner, 3> of_facet{};
    for (std::size_t j = 0; j < n; ++j) of_facet[j] = {facet.at[j], false};
    std::size_t common = 0, apex = 0;
    for (std::size_t i = 0; i <= n; ++i) {
        of_cell[i] = {index.nodes[static_cast<std::size_t>(record.node[i])].at.data(), false};
        for (std::size_t j = 0; j < n; ++j) {
            if (record.node[i] == facet.nodes[j]) of_cell[i].common = of_facet[j].common = true;
        }
        common += of_cell[i].common ? 1 : 0;
        if (!of_cell[i].common) apex = i;
    }
    if (common == n) return record.next[apex] >= 0;
    const std::span<const Corner> cell_corners(of_cell.data(), n + 1), facet_corners(of_facet.data(), n);
    if (all_on_one_side({d, facet.at}, cell_corners)) return false;
    for (std::size_t i = 0; i <= n; ++i) {
        if (of_cell[i].common) continue;  // the plane of the facet opposite to it would miss it
        Plane plane{d, {}};
        for (std::size_t j = 0, k = 0; j <= n; ++j) {
            if (j != i) plane.at[k++] = of_cell[j].at;
        }
        const Sign inner = plane.side(of_cell[i].at);
        if (inner == Sign::zero) return true;  // degenerate
        const Sign outer = inner == Sign::positive ? Sign::negative : Sign::positive;
        if (all_on_side(plane, facet_corners, outer)) return false;
    }
    return true;
}

}  // namespace barycert::locate
