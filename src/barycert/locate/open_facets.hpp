/// Partners of facets, found while cells come by.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "barycert/locate/cell_index.hpp"

namespace barycert::locate {

/// A facet of a cell that has no partner yet.
struct OpenFacet {
    std::uint64_t others;  ///< its nodes besides the highest
    Place highest;         ///< node
    Place cell;
    std::uint8_t corner;  ///< of the cell, opposite to the facet
    std::uint8_t side;    ///< 0 or 1: on which side of the facet, as its ascending nodes turn, the cell lies
};

/// The facets that have been seen once. Cells come in the order of space, so the open facets are about the surface of
/// what has been seen: they stay in cache, where a table of all facets would not.
template <std::size_t d>
class OpenFacets {
public:
    explicit OpenFacets(std::size_t nodes) : head_(nodes, none) {}

    /// The facets of cells[place], each linked with an open one of the same nodes whose cell lies on the other side, if
    /// there is one. `orientation`: the sign of the cell, not 0.
    ///
    /// Sides. Sort the vertices of a cell by node, and let s be the sign of its volume in that order. The vertex of
    /// rank r lies on the positive side of the others, in their order, if s (-1)^r is of one certain sign, the same for
    /// all cells: moving the vertex to the front takes r transpositions.
    void add(Place place, int orientation, CellRecord* cells) {
        // Corners by descending node: all facets but the one opposite to the first have the first as their highest.
        std::array<std::uint64_t, d + 1> key;
        for (std::size_t i = 0; i <= d; ++i)
            key[i] = static_cast<std::uint64_t>(cells[place].node[i]) << 2 | static_cast<std::uint64_t>(i);
        unsigned odd = orientation < 0 ? 1 : 0;
        const auto order = [&](std::size_t i, std::size_t j) {
            odd ^= key[i] < key[j] ? 1U : 0U;
            const std::uint64_t high = std::max(key[i], key[j]);
            key[j] = std::min(key[i], key[j]);
            key[i] = high;
        };
        if constexpr (d == 3) {
            order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
        } else {
            order(0, 1), order(1, 2), order(0, 1);
        }
        const auto node = [&](std::size_t i) { return static_cast<Place>(key[i] >> 2); };
        for (std::size_t left_out = 0; left_out <= d; ++left_out) {
            std::array<Place, d> facet;
            for (std::size_t i = 0; i < d; ++i) facet[i] = node(i < left_out ? i : i + 1);
            std::uint64_t others = static_cast<std::uint64_t>(facet[1]);
            if constexpr (d == 3) others = others << 32 | static_cast<std::uint64_t>(facet[2]);
            meet({others, facet[0], place, static_cast<std::uint8_t>(key[left_out] & 3),
                  static_cast<std::uint8_t>((odd ^ left_out) & 1)},
                 cells);
        }
    }

    /// Links the facet with an open one, or keeps it as one.
    void meet(const OpenFacet& facet, CellRecord* cells) {
        std::uint32_t& head = head_[static_cast<std::size_t>(facet.highest)];
        for (std::uint32_t* link = &head; *link != none; link = &pool_[*link].next) {
            Open& open = pool_[*link];
            if (open.facet.others != facet.others || open.facet.side == facet.side) continue;
            cells[open.facet.cell].next[open.facet.corner] = facet.cell;
            cells[facet.cell].next[facet.corner] = open.facet.cell;
            open.facet.cell = -1;
            const std::uint32_t slot = std::exchange(*link, open.next);
            open.next = std::exchange(free_, slot);
            return;
        }
        if (free_ == none) {
            pool_.push_back({facet, head});
            head = static_cast<std::uint32_t>(pool_.size() - 1);
        } else {
            const std::uint32_t slot = free_;
            free_ = pool_[slot].next;
            pool_[slot] = {facet, head};
            head = slot;
        }
    }

    /// use(facet) for each that is left open, and forgets them.
    template <class Use>
    void take(Use use) {
        for (const Open& open : pool_) {
            if (open.facet.cell < 0) continue;
            head_[static_cast<std::size_t>(open.facet.highest)] = none;
            use(open.facet);
        }
        pool_.clear();
        free_ = none;
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    struct Open {
        OpenFacet facet;
        std::uint32_t next;
    };

    std::vector<std::uint32_t> head_;  ///< by highest node
    std::vector<Open> pool_;
    std::uint32_t free_ = none;
};

}  // namespace barycert::locate
