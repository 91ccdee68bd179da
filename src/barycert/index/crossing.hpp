/// Facets against cells, and cells against each other.
#pragma once

#include <array>

#include "barycert/index/cell_index.hpp"
#include "barycert/index/facet_contact.hpp"

namespace barycert::index {

/// False if the facet certainly meets the cell in a common face (of the same nodes) or not at all, and is not a linked
/// facet of the cell. May be true where that is so. Preconditions: the facet is not degenerate; its nodes are places.
bool may_cross(const CellIndex& index, Place cell, const PlacedFacet& facet);

/// False if a facet of one cell certainly separates the interiors of both. May be true where they are disjoint.
/// Precondition: neither is degenerate.
bool may_overlap(const CellIndex& index, Place a, Place b);

}  // namespace barycert::index
