#include "mesh/index/cell_tree.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/index/cell_index.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::index {

CellBox box_of(const CellIndex& index, const double* const* points, std::size_t count) {
    CellBox box;
    for (std::size_t i = 0; i < count; ++i) {
        CellBox at{{}, {}};
        for (std::size_t k = 0; k < index.dimension(); ++k)
            at.low[k] = at.high[k] = index.bins.quantizer().at(k, points[i][k]);
        box.add(at);
    }
    return box;
}

CellBox box_of(const CellIndex& index, Place cell) {
    return box_of(index, index.corner_points(cell).data(), index.corners());
}

CellTree make_cell_tree(const CellIndex& index) {
    std::vector<std::array<std::int32_t, 3>> nodes(index.original_node.size());
    base::parallel_for_each(nodes.size(), 8192, [&](std::size_t i) {
        nodes[i] = {};
        for (std::size_t k = 0; k < index.dimension(); ++k)
            nodes[i][k] = index.bins.quantizer().at(k, index.nodes[i].at[k]);
    });
    return CellTree(index.cell_count(), [&](std::size_t cell) {
        CellBox box;
        for (std::size_t i = 0; i < index.corners(); ++i) {
            const auto& at = nodes[static_cast<std::size_t>(index.cells[cell].node[i])];
            box.add({at, at});
        }
        return box;
    });
}

}  // namespace barycert::index
