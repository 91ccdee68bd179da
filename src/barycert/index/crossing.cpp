#include "barycert/index/crossing.hpp"

#include <cstddef>
#include <span>

#include "barycert/predicates.hpp"

namespace barycert::index {
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

/// The plane of a facet of cell a has all of b on its outer side, or on it.
bool facet_separates(const CellIndex& index, const CellRecord& a, const CellRecord& b) {
    const auto n = index.dimension();
    const auto at = [&](Place node) { return index.nodes[static_cast<std::size_t>(node)].at.data(); };
    for (std::size_t i = 0; i <= n; ++i) {
        Plane plane{static_cast<int>(n), {}};
        for (std::size_t j = 0, k = 0; j <= n; ++j) {
            if (j != i) plane.at[k++] = at(a.node[j]);
        }
        const Sign inner = plane.side(at(a.node[i]));
        bool separates = true;
        for (std::size_t j = 0; j <= n && separates; ++j) {
            bool common = false;  // a vertex of the facet is on its plane
            for (std::size_t k = 0; k <= n; ++k) common |= k != i && a.node[k] == b.node[j];
            separates = common || plane.side(at(b.node[j])) != inner;
        }
        if (separates) return true;
    }
    return false;
}

}  // namespace

// A plane through all common vertices that has the other vertices of one of both strictly on one side, and the other
// one on the other side or on it, meets the first in the common face alone. Planes of facets are tried.
bool may_cross(const CellIndex& index, Place cell, const PlacedFacet& facet) {
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

bool may_overlap(const CellIndex& index, Place a, Place b) {
    const CellRecord &first = index.cells[static_cast<std::size_t>(a)],
                     &second = index.cells[static_cast<std::size_t>(b)];
    return !facet_separates(index, first, second) && !facet_separates(index, second, first);
}

}  // namespace barycert::index
