#include "barycert/index/facet_links.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "barycert/index/facet_table.hpp"
#include "barycert/index/orientation_lanes.hpp"

namespace barycert::index {
namespace {

/// Cells that are linked among themselves first: near in space, so that most of their facets find their partners, and
/// the table stays in the second cache. Their number is fixed, and so is which of three facets of the same nodes are
/// partners.
constexpr std::size_t block_size = std::size_t{1} << 13;

/// What blocks leave open is linked in parts, by hash.
constexpr std::size_t parts = 64;
std::size_t part_of(std::uint32_t tag) {
    return tag % parts;
}

struct Block {
    std::array<std::vector<HashedFacet>, parts> open;
    std::vector<Place> degenerate;
};

template <std::size_t d>
struct Memory {
    FacetTable<d> table;
    std::vector<std::int8_t> orientation = {};
};

template <std::size_t d>
void link_block(CellIndex& index, std::size_t first, std::size_t last, Memory<d>& memory, Block& block) {
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
    memory.table.for_each_waiting([&](std::uint32_t number, std::uint32_t tag, std::uint8_t side) {
        HashedFacet facet = at(number);
        facet.start = static_cast<std::uint32_t>(tag / parts);  // all of a part have the same remainder
        facet.tag = tag;
        facet.side = side;
        block.open[part_of(tag)].push_back(facet);
    });
}

/// The part of all blocks, in their order.
template <std::size_t d>
void link_part(CellIndex& index, const std::vector<Block>& blocks, std::size_t part, Memory<d>& memory) {
    std::vector<HashedFacet> open;
    for (const Block& block : blocks) open.insert(open.end(), block.open[part].begin(), block.open[part].end());
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
    std::vector<Block> blocks((cells + block_size - 1) / block_size);
    tbb::enumerable_thread_specific<Memory<d>> memory;
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
        link_block<d>(index, b * block_size, std::min(cells, (b + 1) * block_size), memory.local(), blocks[b]);
    });
    // Facets of one set of nodes are in one part, so no two threads write to the same entry of a cell.
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t p) { link_part<d>(index, blocks, p, memory.local()); });
    FacetLinks links;
    for (const Block& block : blocks) {
        links.degenerate.insert(links.degenerate.end(), block.degenerate.begin(), block.degenerate.end());
        for (const auto& part : block.open) {
            for (const HashedFacet& f : part) {
                if (index.cells[static_cast<std::size_t>(f.cell)].next[f.corner] < 0)
                    links.open.push_back({f.cell, f.corner});
            }
        }
    }
    std::sort(links.open.begin(), links.open.end(), [](const CellFacet& a, const CellFacet& b) {
        return a.cell != b.cell ? a.cell < b.cell : a.corner < b.corner;
    });
    return links;
}

}  // namespace

FacetLinks link_facets(CellIndex& index) {
    return index.dimension() == 2 ? link<2>(index) : link<3>(index);
}

}  // namespace barycert::index
