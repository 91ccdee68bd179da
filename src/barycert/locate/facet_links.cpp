#include "barycert/locate/facet_links.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "barycert/environment.hpp"
#include "barycert/locate/open_facets.hpp"
#include "barycert/locate/orientation_lanes.hpp"

namespace barycert::locate {
namespace {

/// Cells that are linked among themselves first. Their number is fixed, and so is which of three facets of the same
/// nodes are partners.
constexpr std::size_t block_size = std::size_t{1} << 15;

struct Block {
    std::vector<OpenFacet> open;
    std::vector<Place> degenerate;
};

template <std::size_t d>
void link_block(CellIndex& index, std::size_t first, std::size_t last, OpenFacets<d>& facets,
                std::vector<std::int8_t>& orientation, Block& block) {
    orientation.resize(last - first);
    find_orientations(index, first, last - first, orientation.data());
    for (std::size_t place = first; place < last; ++place) {
        index.cells[place].next = {-1, -1, -1, -1};
        const int sign = orientation[place - first];
        if (sign != 0) {
            facets.add(static_cast<Place>(place), sign, index.cells.data());
        } else {
            block.degenerate.push_back(static_cast<Place>(place));
        }
    }
    facets.take([&](const OpenFacet& facet) { block.open.push_back(facet); });
}

template <std::size_t d>
FacetLinks link(CellIndex& index) {
    const std::size_t cells = index.cell_count(), nodes = index.original_node.size();
    std::vector<Block> blocks((cells + block_size - 1) / block_size);
    struct Memory {
        OpenFacets<d> facets;
        std::vector<std::int8_t> orientation = {};
    };
    tbb::enumerable_thread_specific<Memory> memory([&] { return Memory{OpenFacets<d>(nodes)}; });
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
        Memory& mine = memory.local();
        link_block<d>(index, b * block_size, std::min(cells, (b + 1) * block_size), mine.facets, mine.orientation,
                      blocks[b]);
    });
    FacetLinks links;
    OpenFacets<d> between(nodes);
    for (const Block& block : blocks) {
        for (const OpenFacet& facet : block.open) between.meet(facet, index.cells.data());
        links.degenerate.insert(links.degenerate.end(), block.degenerate.begin(), block.degenerate.end());
    }
    between.take([&](const OpenFacet& facet) { links.open.push_back({facet.cell, facet.corner}); });
    std::sort(links.open.begin(), links.open.end());
    return links;
}

}  // namespace

FacetLinks link_facets(CellIndex& index) {
    return index.dimension() == 2 ? link<2>(index) : link<3>(index);
}

}  // namespace barycert::locate
