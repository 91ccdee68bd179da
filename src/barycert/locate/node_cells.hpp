/// The cells at each node, to name all cells around a vertex or edge.
#pragma once

#include "barycert/locate/names.hpp"
#include "barycert/predicates.hpp"

namespace barycert::locate {

class NodeCells {
public:
    /// Without the cells `degenerate`, ascending.
    NodeCells(const CellIndex& index, std::span<const Place> degenerate)
        : begin_(index.original_node.size() + 1, 0),
          cells_((index.cell_count() - degenerate.size()) * index.corners()) {
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
                cells_[next[static_cast<std::size_t>(index.cells[c].node[i])]++] = c;
        }
    }

    /// Those of a node, by ascending cell of the mesh.
    std::span<const Place> of(Place node) const {
        const auto i = static_cast<std::size_t>(node);
        return {cells_.data() + begin_[i], begin_[i + 1] - begin_[i]};
    }
    std::size_t bytes() const { return begin_.size() * sizeof(std::uint64_t) + cells_.size() * sizeof(Place); }

    /// The lowest cell of the mesh that has the vertex, edge or face on which a point with these signs lies. In a
    /// simplicial complex it is the lowest that holds the point. Precondition: the signs are those of a point in the
    /// closed cell, which is not degenerate.
    Place lowest_around(const CellIndex& index, Place cell, WeightSigns signs) const {
        const CellRecord& record = index.cells[cell];
        std::array<Place, 4> support;
        std::size_t count = 0;
        for (std::size_t i = 0; i < index.corners(); ++i) {
            if (signs.sign(static_cast<int>(i)) != Sign::zero) support[count++] = record.node[i];
        }
        return *std::ranges::find_if(of(support[0]), [&](Place candidate) {
            const auto& nodes = index.cells[candidate].node;
            return std::all_of(support.begin() + 1, support.begin() + static_cast<std::ptrdiff_t>(count),
                               [&](Place node) { return std::ranges::find(nodes, node) != nodes.end(); });
        });
    }

private:
    std::vector<std::uint64_t> begin_;
    std::vector<Place> cells_;
};

}  // namespace barycert::locate
