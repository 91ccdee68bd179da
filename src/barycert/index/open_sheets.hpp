/// Open facets, as places in space: which conflict, which belong to one sheet (doc/theorem.md).
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/index/candidates.hpp"
#include "barycert/index/cell_index.hpp"
#include "barycert/index/facet_contact.hpp"
#include "barycert/index/facet_links.hpp"

namespace barycert::index {

/// Nodes ascending, by place.
PlacedFacet placed(const CellIndex& index, const CellFacet& facet);

Item item_of(const PlacedFacet& facet, int d);

/// 1 for each facet that conflicts with another one.
std::vector<std::uint8_t> find_conflicts(const CellIndex& index, const std::vector<PlacedFacet>& facets);

/// The pairs that conflict, or are of the same nodes, the lower one first: all, or from the first on more than `limit`
/// of them, which do not depend on threads. Facets are in the order of space, and proper.
std::vector<FacetPair> conflicting_pairs(const CellIndex& index, const std::vector<PlacedFacet>& facets,
                                         std::size_t limit);

/// The facets of each sheet, those without conflicts alone. `facets`: the open ones, placed.
std::vector<std::vector<std::uint32_t>> find_sheets(const CellIndex& index, const std::vector<CellFacet>& open,
                                                    const std::vector<PlacedFacet>& facets,
                                                    const std::vector<std::uint8_t>& conflict);

}  // namespace barycert::index
