#include "barycert/locate/node_cells.hpp"

#include <algorithm>

namespace barycert::locate {

NodeCells::NodeCells(const CellIndex& index, std::span<const Place> degenerate)
    : begin_(index.original_node.size() + 1, 0), cells_((index.cell_count() - degenerate.size()) * index.corners()) {
    const std::size_t corners = index.corners();
    std::vector<Place> place(index.cell_count(), -1);
    for (std::size_t c = 0; c < index.cell_count(); ++c) {
        if (std::binary_search(degenerate.begin(), degenerate.end(), static_cast<Place>(c))) continue;
        place[static_cast<std::size_t>(index.original[c])] = static_cast<Place>(c);
        for (std::size_t i = 0; i < corners; ++i) ++begin_[static_cast<std::size_t>(index.cells[c].node[i]) + 1];
    }
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    std::vector<std::uint64_t> next(begin_.begin(), begin_.end() - 1);
    for (const Place c : place) {
        if (c < 0) continue;
        for (std::size_t i = 0; i < corners; ++i)
            cells_[next[static_cast<std::size_t>(index.cells[static_cast<std::size_t>(c)].node[i])]++] = c;
    }
}

}  // namespace barycert::locate
