#include "mesh/index/facet_links.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/index/cell_index.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::index {
namespace {

/// A number for a set of nodes is the sum of the numbers of its nodes: those of all facets of a cell come from one sum.
std::uint64_t hash_of(Place node) {
    std::uint64_t x = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(node)) + 1) * 0x9e3779b97f4a7c15;
    x = (x ^ x >> 32) * 0xd6e8feb86659fd93;
    return x ^ x >> 29;
}

/// A facet of a cell, by its number: where it is looked for in a table, and by which it is known there.
struct HashedFacet {
    std::uint32_t start, tag;
    Place cell;
    std::uint8_t corner;  ///< of the cell, opposite to the facet
    std::uint8_t side;    ///< 0 or 1: on which side of the facet, as its nodes turn in ascending order, the cell lies
};

/// The facets of a cell that is not degenerate; `orientation`: the sign of its volume.
///
/// Sides. Sort the vertices of a cell by node, and let s be the sign of its volume in that order. The vertex of rank r
/// lies on the positive side of the others, in their order, if s (-1)^r has one certain sign, the same for all cells:
/// moving the vertex to the front takes r transpositions.
template <std::size_t d>
std::array<HashedFacet, d + 1> facets_of(const CellRecord* cells, Place cell, std::int8_t orientation) {
    const CellRecord& record = cells[cell];
    std::array<std::uint64_t, d + 1> hash;
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i <= d; ++i) sum += hash[i] = hash_of(record.node[i]);
    std::array<unsigned, d + 1> rank{};
    unsigned odd = orientation < 0 ? 1 : 0;
    for (std::size_t i = 0; i < d; ++i) {
        for (std::size_t j = i + 1; j <= d; ++j) {
            const unsigned after = record.node[i] > record.node[j] ? 1 : 0;
            odd ^= after;
            rank[i] += after;
            rank[j] += 1 - after;
        }
    }
    std::array<HashedFacet, d + 1> facets;
    for (std::size_t i = 0; i <= d; ++i)
        facets[i] = {static_cast<std::uint32_t>(sum - hash[i]), static_cast<std::uint32_t>((sum - hash[i]) >> 32), cell,
                     static_cast<std::uint8_t>(i), static_cast<std::uint8_t>((odd ^ rank[i]) & 1)};
    return facets;
}

/// A hash table of facets that look for partners. They are known to it by numbers from 0 on. Keeps its memory.
template <std::size_t d>
class FacetTable {
public:
    /// Empties it, for at most `facets` < 2^30 calls of meet.
    void reset(std::size_t facets) {
        // At most half full: about half of the facets find a partner, and leave a slot that is not used again.
        const std::size_t size = std::bit_ceil(std::max<std::size_t>(facets, 8) * 2);
        std::fill_n(slots_.begin(), used_, Slot{});
        if (slots_.size() < size) slots_.resize(size);
        used_ = size;
        mask_ = size - 1;
    }

    void fetch(const HashedFacet& facet) const { __builtin_prefetch(&slots_[facet.start & mask_], 1); }

    /// Links the facet with one of the same nodes whose cell lies on the other side, if one waits, or lets it wait
    /// under its number. at(number) is a facet by its number: its cell and corner are asked for.
    template <class At>
    void meet(const HashedFacet& facet, std::uint32_t number, CellRecord* cells, At at) {
        const std::uint32_t other_side = facet.side ^ 1U;
        for (std::size_t i = facet.start & mask_;; i = (i + 1) & mask_) {
            Slot& slot = slots_[i];
            if (slot.facet == empty) {
                slot = {facet.tag, (number << 1 | facet.side) + 1};
                return;
            }
            if (slot.tag != facet.tag || slot.facet == found || ((slot.facet - 1) & 1) != other_side) continue;
            const HashedFacet partner = at((slot.facet - 1) >> 1);
            if (!same(cells, partner, facet)) continue;
            cells[partner.cell].next[partner.corner] = facet.cell;
            cells[facet.cell].next[facet.corner] = partner.cell;
            slot.facet = found;
            return;
        }
    }

    static constexpr std::uint32_t empty = 0, found = ~std::uint32_t{0};

    struct Slot {
        std::uint32_t tag = 0;
        std::uint32_t facet = empty;  ///< 1 + (its number, then a bit for its side)

        std::uint32_t number() const { return (facet - 1) >> 1; }
        std::uint8_t side() const { return static_cast<std::uint8_t>((facet - 1) & 1); }
    };

    /// The facets that wait. They stand in the table up to the next reset.
    std::span<const Slot> take_waiting() {
        std::size_t count = 0;
        for (std::size_t i = 0; i <= mask_; ++i) {  // without a branch, which would be guessed wrong
            const Slot slot = slots_[i];
            slots_[i] = {};
            slots_[count] = slot;
            count += slot.facet != empty && slot.facet != found ? 1 : 0;
        }
        used_ = count + 1;
        return {slots_.data(), count};
    }

private:
    /// The same nodes: each facet has d different ones.
    static bool same(const CellRecord* cells, const HashedFacet& f, const HashedFacet& g) {
        const auto &a = cells[f.cell].node, &b = cells[g.cell].node;
        bool all = true;
        for (std::size_t i = 0; i <= d; ++i) {
            bool has = i == f.corner;
            for (std::size_t j = 0; j <= d; ++j) has |= j != g.corner && a[i] == b[j];
            all &= has;
        }
        return all;
    }

    std::size_t mask_ = 0, used_ = 0;  ///< slots from `used_` on are empty
    std::vector<Slot> slots_;
};

/// Cells that are linked among themselves first: near in space, so that most of their facets find their partners, and
/// the table stays in the second cache. Their number is fixed, and so is which of three facets of the same nodes are
/// partners.
constexpr std::size_t block_size = std::size_t{1} << 13;

/// Facets that blocks leave open are linked in parts, by hash.
constexpr std::size_t parts = 64;

struct OpenFacets {
    std::vector<HashedFacet> open;                 ///< part by part
    std::array<std::uint32_t, parts + 1> begin{};  ///< where each begins
    std::vector<Place> degenerate;

    std::span<const HashedFacet> part(std::size_t p) const {
        return {open.data() + begin[p], open.data() + begin[p + 1]};
    }
};

template <std::size_t d>
struct Memory {
    FacetTable<d> table;
    std::vector<std::int8_t> orientation = {};
    std::vector<HashedFacet> open = {};
};

template <std::size_t d>
void link_block(CellIndex& index, std::size_t first, std::size_t last, Memory<d>& memory, OpenFacets& block) {
    CellRecord* const cells = index.cells.data();
    std::vector<std::int8_t>& orientation = memory.orientation;
    orientation.resize(last - first);
    find_orientations(index, first, last - first, orientation.data());
    memory.table.reset((d + 1) * (last - first));
    const auto at = [&](std::uint32_t number) {
        return HashedFacet{0, 0, static_cast<Place>(first + number / 4), static_cast<std::uint8_t>(number % 4), 0};
    };
    // Slots are asked for a few cells ahead.
    constexpr std::size_t ahead = 8;
    std::array<std::array<HashedFacet, d + 1>, ahead> soon;
    const auto finish = [&](std::size_t place) {
        if (orientation[place - first] == 0) return;
        for (const HashedFacet& facet : soon[place % ahead])
            memory.table.meet(facet, static_cast<std::uint32_t>(4 * (place - first)) + facet.corner, cells, at);
    };
    for (std::size_t place = first; place < last; ++place) {
        if (place >= first + ahead) finish(place - ahead);
        cells[place].next = {-1, -1, -1, -1};
        const std::int8_t sign = orientation[place - first];
        if (sign == 0) block.degenerate.push_back(static_cast<Place>(place));
        auto& facets = soon[place % ahead];
        facets = facets_of<d>(cells, static_cast<Place>(place), sign);
        for (const HashedFacet& facet : facets) memory.table.fetch(facet);
    }
    for (std::size_t place = std::max(first + ahead, last) - ahead; place < last; ++place) finish(place);
    const auto waiting = memory.table.take_waiting();
    for (const auto& slot : waiting) ++block.begin[slot.tag % parts + 1];
    for (std::size_t p = 0; p < parts; ++p) block.begin[p + 1] += block.begin[p];
    std::array<std::uint32_t, parts + 1> next = block.begin;
    block.open.resize(waiting.size());
    for (const auto& slot : waiting) {
        HashedFacet& facet = block.open[next[slot.tag % parts]++];
        facet = at(slot.number());
        facet.start = static_cast<std::uint32_t>(slot.tag / parts);  // all of a part have the same remainder
        facet.tag = slot.tag;
        facet.side = slot.side();
    }
}

/// The part of all blocks, in their order.
template <std::size_t d>
void link_part(CellIndex& index, const std::vector<OpenFacets>& blocks, std::size_t part, Memory<d>& memory) {
    std::vector<HashedFacet>& open = memory.open;
    open.clear();
    for (const OpenFacets& block : blocks) open.insert(open.end(), block.part(part).begin(), block.part(part).end());
    memory.table.reset(open.size());
    constexpr std::size_t ahead = 16;
    for (std::size_t i = 0; i < open.size(); ++i) {
        if (i + ahead < open.size()) {
            memory.table.fetch(open[i + ahead]);
            __builtin_prefetch(&index.cells[static_cast<std::size_t>(open[i + ahead].cell)], 1);
        }
        memory.table.meet(open[i], static_cast<std::uint32_t>(i), index.cells.data(),
                          [&](std::uint32_t number) { return open[number]; });
    }
}

template <std::size_t d>
FacetLinks link(CellIndex& index) {
    const std::size_t cells = index.cell_count();
    std::vector<OpenFacets> blocks((cells + block_size - 1) / block_size);
    tbb::enumerable_thread_specific<Memory<d>> memory;
    base::parallel_for(blocks.size(), [&](std::size_t b) {
        link_block<d>(index, b * block_size, std::min(cells, (b + 1) * block_size), memory.local(), blocks[b]);
    });
    // Facets of one set of nodes are in one part, so no two threads write to the same entry of a cell.
    base::parallel_for(parts, [&](std::size_t p) { link_part<d>(index, blocks, p, memory.local()); });
    FacetLinks links;
    for (const OpenFacets& block : blocks) {
        links.degenerate.insert(links.degenerate.end(), block.degenerate.begin(), block.degenerate.end());
        for (const HashedFacet& f : block.open) {
            if (index.cells[static_cast<std::size_t>(f.cell)].next[f.corner] < 0)
                links.open.push_back({f.cell, f.corner});
        }
    }
    tbb::parallel_sort(links.open.begin(), links.open.end(), [](const CellFacet& f, const CellFacet& g) {
        return std::pair(f.cell, f.corner) < std::pair(g.cell, g.corner);
    });
    return links;
}

}  // namespace

FacetLinks link_facets(CellIndex& index) {
    return index.dimension() == 2 ? link<2>(index) : link<3>(index);
}

}  // namespace barycert::index
