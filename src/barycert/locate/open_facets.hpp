/// Neighbours found while cells come by.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "barycert/locate/cell_index.hpp"

namespace barycert::locate {

/// The facets that have been seen once. Cells come in the order of space, so the open facets are about the surface of
/// what has been seen: they stay in cache, where a table of all facets would not.
template <std::size_t d>
class OpenFacets {
public:
    explicit OpenFacets(std::size_t nodes) : head_(nodes, none) {}

    /// The facets of cells[place], each linked with the one seen before if there is one. A facet that a third cell has
    /// is taken for a new one.
    void add(Place place, CellRecord* cells) {
        // Corners by descending node: all facets but the one opposite to the first have the first as their highest.
        std::array<std::uint64_t, d + 1> key;
        for (std::size_t i = 0; i <= d; ++i)
            key[i] = static_cast<std::uint64_t>(cells[place].node[i]) << 2 | static_cast<std::uint64_t>(i);
        const auto order = [&](std::size_t i, std::size_t j) {
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
            const std::uint64_t corner = key[left_out] & 3;
            meet(facet[0], others, static_cast<std::uint64_t>(place) << 2 | corner, cells);
        }
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    struct Open {
        std::uint64_t others;  ///< its nodes besides the highest
        std::uint64_t facet;
        std::uint32_t next;
    };

    void meet(Place highest, std::uint64_t others, std::uint64_t facet, CellRecord* cells) {
        std::uint32_t& head = head_[static_cast<std::size_t>(highest)];
        for (std::uint32_t* link = &head; *link != none; link = &pool_[*link].next) {
            Open& open = pool_[*link];
            if (open.others != others) continue;
            cells[open.facet >> 2].next[open.facet & 3] = static_cast<Place>(facet >> 2);
            cells[facet >> 2].next[facet & 3] = static_cast<Place>(open.facet >> 2);
            const std::uint32_t slot = std::exchange(*link, open.next);
            open.next = std::exchange(free_, slot);
            return;
        }
        if (free_ == none) {
            pool_.push_back({others, facet, head});
            head = static_cast<std::uint32_t>(pool_.size() - 1);
        } else {
            const std::uint32_t slot = free_;
            free_ = pool_[slot].next;
            pool_[slot] = {others, facet, head};
            head = slot;
        }
    }

    std::vector<std::uint32_t> head_;  ///< by highest node
    std::vector<Open> pool_;
    std::uint32_t free_ = none;
};

}  // namespace barycert::locate
