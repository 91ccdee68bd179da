/// The proof that cells partition a domain, or where they may not.
///
/// A cell is *contested* unless it is proved that every other cell meets it in a common face or not at all. In a
/// simplicial complex no cell is contested. A point in a cell that is not contested is in no other cell, or in those
/// that have the face in whose relative interior it lies: nobody else needs to be asked.
///
/// doc/theorem.md has the proof for parts of a mesh ("A part of a mesh"), its words and its numbers, (1) to (7), to
/// which comments in this room refer. Facets of the same nodes are linked in pairs (facet_links.hpp); the others are
/// *open*.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/facet_links.hpp"

namespace barycert::index {

struct Proof {
    bool partition = false;                ///< the cells are a simplicial complex: P1 to P4 of check.hpp hold
    std::uint64_t contested_count = 0;     ///< cells
    std::vector<std::uint64_t> contested;  ///< a bit for each place; empty if there are none

    bool is_contested(Place cell) const {
        const auto i = static_cast<std::size_t>(cell);
        return !contested.empty() && (contested[i / 64] >> (i % 64) & 1) != 0;
    }
};

/// `tree`: that of the index, asked for where it is needed. Takes time O(n log n) in the number of open facets, and
/// about 0.1 microseconds for each pair of them whose boxes meet; where some are bad, O(cells) besides, and for each of
/// them a look at the cells whose boxes meet its own. Uses the threads of the calling arena, which do not change the
/// outcome.
Proof prove(const CellIndex& index, const FacetLinks& links, const std::function<const CellTree&()>& tree);

/// Proof::partition alone: in a bad mesh it takes less.
bool is_partition(const CellIndex& index, const FacetLinks& links, const std::function<const CellTree&()>& tree);

}  // namespace barycert::index
