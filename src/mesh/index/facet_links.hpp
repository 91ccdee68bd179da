/// Cells linked over their facets, and what that leaves open.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/index/cell_index.hpp"

namespace barycert::index {

/// The facet of a cell opposite to one of its corners.
struct CellFacet {
    Place cell;
    std::int32_t corner;
};

struct FacetLinks {
    /// Facets without a partner, by cell, then corner. Where facets have at most two cells, on opposite sides, this is
    /// the boundary.
    std::vector<CellFacet> open;
    std::vector<Place> degenerate;  ///< cells of volume exactly zero, ascending: they have no links
};

/// Sets `next` of all cells. Two facets of the same nodes are partners if their cells, neither degenerate, certainly
/// lie on opposite sides; each facet has at most one partner. The outcome does not depend on threads. Uses those of the
/// calling arena.
FacetLinks link_facets(CellIndex& index);

/// On SIMD lanes: out[i] = the sign of the volume of the cell at place first + i, for i < count: -1, 0 or 1. One
/// determinant in double with its bound; integers where that leaves it open.
void find_orientations(const CellIndex& index, std::size_t first, std::size_t count, std::int8_t* out);

}  // namespace barycert::index
