/// Open facets, as places in space: which conflict, which belong to one sheet (proof.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/check/facet_contact.hpp"
#include "barycert/locate/cell_index.hpp"
#include "barycert/locate/facet_links.hpp"

namespace barycert::locate {

/// Nodes ascending, by place.
check::PlacedFacet placed(const CellIndex& index, const CellFacet& facet);

/// 1 for each facet that conflicts with another one.
std::vector<std::uint8_t> find_conflicts(const CellIndex& index, const std::vector<check::PlacedFacet>& facets);

/// The facets of each sheet, those without conflicts alone.
std::vector<std::vector<std::uint32_t>> find_sheets(int d, const std::vector<check::PlacedFacet>& facets,
                                                    const std::vector<std::uint8_t>& conflict);

}  // namespace barycert::locate
