#include "barycert/index/overlapped.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "barycert/index/overlap.hpp"

namespace barycert::index {
namespace {

bool has(std::span<const Place> ascending, Place cell) {
    return std::binary_search(ascending.begin(), ascending.end(), cell);
}

bool overlapped(const CellIndex& index, Place cell, std::span<const Place> degenerate, const CellTree& tree) {
    const auto d = static_cast<int>(index.dimension());
    const Corners at = item_of(index, cell).at;
    bool found = false;
    tree.for_each_meeting(box_of(index, cell), [&](std::size_t i) {
        const auto other = static_cast<Place>(i);
        if (other != cell && !has(degenerate, other)) found = interiors_meet(d, at, item_of(index, other).at);
        return !found;
    });
    return found;
}

}  // namespace

Item item_of(const CellIndex& index, Place cell) {
    const auto& node = index.cells[static_cast<std::size_t>(cell)].node;
    Item item{.count = static_cast<int>(index.corners())};
    for (std::size_t i = 0; i < index.corners(); ++i) {
        item.nodes[i] = node[i];
        item.at[i] = index.nodes[static_cast<std::size_t>(node[i])].at.data();
    }
    return item;
}

bool is_crowded(const CellIndex& index) {
    std::vector<std::uint32_t> cells(index.original_node.size(), 0);
    std::uint32_t most = 0;
    for (std::size_t c = 0; c < index.cell_count(); ++c) {
        for (std::size_t i = 0; i < index.corners(); ++i)
            most = std::max(most, ++cells[static_cast<std::size_t>(index.cells[c].node[i])]);
    }
    return most > crowd;
}

// A few are looked up in the tree of all cells. If they are many, or if there is a node around which the boxes of too
// many cells meet, all cells are looked up among them.
std::vector<std::uint8_t> find_overlapped(const CellIndex& index, std::span<const Place> asked,
                                          std::span<const Place> degenerate,
                                          const std::function<const CellTree&()>& tree) {
    std::vector<std::uint8_t> out(asked.size(), 0);
    if (64 * asked.size() < index.cell_count() && !is_crowded(index)) {
        const CellTree& cells = tree();
        tbb::parallel_for(std::size_t{0}, asked.size(),
                          [&](std::size_t i) { out[i] = overlapped(index, asked[i], degenerate, cells) ? 1 : 0; });
        return out;
    }
    const auto d = static_cast<int>(index.dimension());
    std::vector<Item> items(asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i) items[i] = item_of(index, asked[i]);
    const Candidates candidates(d, items, crowd);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, index.cell_count(), 1 << 10), [&](const auto& range) {
        for (std::size_t c = range.begin(); c < range.end(); ++c) {
            const auto cell = static_cast<Place>(c);
            if (has(degenerate, cell)) continue;
            const Item item = item_of(index, cell);
            candidates.for_each(item, [&](std::uint32_t i) {
                const std::atomic_ref<std::uint8_t> flag(out[i]);
                if (asked[i] != cell && flag.load(std::memory_order_relaxed) == 0 &&
                    interiors_meet(d, items[i].at, item.at))
                    flag.store(1, std::memory_order_relaxed);
                return true;
            });
        }
    });
    return out;
}

}  // namespace barycert::index
