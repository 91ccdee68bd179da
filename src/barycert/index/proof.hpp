/// The proof that cells partition a domain, or where they may not.
///
/// A cell is *contested* unless it is proved that every other cell meets it in a common face or not at all. In a
/// simplicial complex no cell is contested. A point in a cell that is not contested is in no other cell, or in those
/// that have the face in whose relative interior it lies: nobody else needs to be asked.
///
/// Words. Cells are those that are not degenerate. Facets of the same nodes are linked in pairs, one cell on either
/// side (facet_links.hpp); those that are left are *open*. m(x), for a point x on no facet, is the number of cells that
/// contain x. Two open facets *conflict* if they have a point in common that is not in a common face, or have the same
/// nodes.
///
/// (1) m changes at open facets alone: by one for each that is crossed, and is greater on the side of its cell. For a
///     path that avoids faces of dimension d - 2 leaves one cell of a pair where it enters the other.
/// (2) Open facets without conflicts that share a ridge which no other open facet has: near a point inside the ridge
///     there is no other open facet. Where two of them come one after the other around it, one region lies between
///     them; if the cells of both are on that side, or on the other side of both, m is the same along both. Two alone
///     are such a pair on either side, as m is what it was after a whole turn. So m on the inner side is one number for
///     a *sheet*, a set of such facets connected over such pairs.
/// (3) If all open facets are one sheet, that number is 1: the unbounded region, where m = 0, borders on it, and not on
///     its inner side, where m > 0. Otherwise it is 1 if a cell of the sheet has an interior that no other cell meets.
///     Sheets for which this is shown, and their facets, are *good*; all other open facets are *bad*.
/// (4) No good facet crosses the interior of a cell: m would be at least 1 on its outer side, where it is 0.
/// (5) If no facet is bad, no cell is contested, and the cells are a simplicial complex if none is degenerate: steps 3
///     and 4 of doc/theorem.md hold for linked facets as they do for facets of two cells. That three cells should have
///     a facet is excluded: one would be open, with m >= 1 on its outer side, and not be good.
///
/// If there are bad facets: a cell is *crossed* unless each bad facet meets it in a common face or not at all, and is
/// not, if it is a linked facet of the cell by its nodes.
/// (6) m is constant in the interior of a cell that is not crossed, by (1) and (4). It is the same in two such cells
///     that are linked: a good facet that meets the relative interior of theirs, f, lies in f's plane there, as it
///     crosses neither cell, and would have m >= 1 on both sides; a bad one meets both cells in common faces, and would
///     be f. So m is one number for a set of cells connected that way, and 1 if the interior of one of them meets no
///     other cell. Then no cell of the set is contested:
/// (7) Let c be such a cell, x a point of c in the relative interior of its face F, and k the number of cells that have
///     F, counted near x as m is. Open facets that contain x and have F change k as they change m. If some open facet
///     has F, a good one that contains x has F too, else both would conflict; a bad one has F as it meets c in a common
///     face. If none has F, k is constant near x, so m >= k >= 1, and there is no good facet, m being 0 on its outer
///     side; a bad one would have F. So m - k is constant near x, and 0, as it is in c. So every cell that contains x,
///     being the closure of its interior, has F.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "barycert/index/cell_index.hpp"
#include "barycert/index/cell_tree.hpp"
#include "barycert/index/facet_links.hpp"

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
