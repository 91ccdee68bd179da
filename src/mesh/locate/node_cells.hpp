/// The cells at each node of a mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "barycert/predicates.hpp"
#include "core/base/lists.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/names.hpp"

namespace barycert::locate {

/// The cells at each node, to name all cells around a vertex or edge.
class NodeCells {
public:
    /// Without the cells `degenerate`, ascending.
    NodeCells(const CellIndex& index, std::span<const Place> degenerate) {
        std::vector<Place> place(index.cell_count());
        for (std::size_t c = 0; c < place.size(); ++c)
            place[static_cast<std::size_t>(index.original[c])] = static_cast<Place>(c);
        std::erase_if(place, [&](Place c) { return std::ranges::binary_search(degenerate, c); });
        cells_ = {index.original_node.size(), [&](const auto& add) {
                      for (const Place c : place) {
                          for (std::size_t i = 0; i < index.corners(); ++i)
                              add(static_cast<std::size_t>(index.cells[c].node[i]), c);
                      }
                  }};
    }

    /// Returns the cells of a node, by ascending cell of the mesh.
    std::span<const Place> of(Place node) const { return cells_[static_cast<std::size_t>(node)]; }
    std::size_t bytes() const { return cells_.bytes(); }

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
    base::Lists<Place> cells_;
};

}  // namespace barycert::locate
