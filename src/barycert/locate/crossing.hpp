/// Facets against cells.
#pragma once

#include <array>

#include "barycert/check/facet_contact.hpp"
#include "barycert/locate/cell_index.hpp"

namespace barycert::locate {

/// False if the facet certainly meets the cell in a common face (of the same nodes) or not at all, and is not a linked
/// facet of the cell. May be true where that is so. Preconditions: the facet is not degenerate; its nodes are places.
bool may_cross(const CellIndex& index, Place cell, const check::PlacedFacet& facet);

}  // namespace barycert::locate
