/// Open facets, as places in space: which conflict, which belong to one sheet (doc/theorem.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/predicates.hpp"
#include "mesh/index/candidates.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/facet_links.hpp"
#include "mesh/index/ridges.hpp"

namespace barycert::index {

/// Nodes ascending, by place.
PlacedFacet placed(const CellIndex& index, const CellFacet& facet);

Item item_of(const PlacedFacet& facet, int d);

/// Facets around a ridge.
class RidgeTurn {
public:
    RidgeTurn(int d, const std::vector<PlacedFacet>& facets) : d_(d), facets_(facets) {}

    /// Ridges of the same nodes in the order of a turn around these from the first one on, in space counterclockwise as
    /// seen along the edge from its lower node to its higher one. They stand until the next call. Requires: no two
    /// facets have one direction from there.
    std::span<const Ridge> sorted(std::span<const Ridge> ridges);

    /// Positive if the turn from that facet to the point is below a half, zero if it is none or a half.
    Sign to(const Ridge& from, const double* p) const;

private:
    int d_;
    const std::vector<PlacedFacet>& facets_;
    std::vector<Ridge> sorted_;
};

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
