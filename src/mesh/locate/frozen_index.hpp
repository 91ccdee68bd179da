/// The part of a Locator that does not change once it is built.
#pragma once

#include <cstddef>
#include <memory>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "core/grid_lanes.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/mapped/mapped_cells.hpp"
#include "mesh/locate/names.hpp"

namespace barycert::locate {

struct FrozenIndex {
    /// Calls stage("...") before what takes long. The mesh must stay.
    template <class Stage>
    FrozenIndex(const Mesh& of, const BuildOptions& options, const Stage& stage) : mesh(&of) {
        const bool products = options.interpolation == CellInterpolation::multilinear;
        if (!of.is_listed()) {
            grid = std::make_unique<core::AxisGrid>(of.dimension, of.axes);
            multilinear = products;
        }
        stage("ordering cells");
        index = make_cell_index(of);
        const bool curves = options.curved != Curved::straight && (!of.mid_nodes.empty() || !of.shapes.types.empty());
        if (grid == nullptr && (products || curves)) mapped = MappedCells::make(of, index, products, options.curved);
    }
    FrozenIndex(const FrozenIndex&) = delete;
    FrozenIndex& operator=(const FrozenIndex&) = delete;

    const Mesh* mesh;
    /// Links of its cells, index.cells[].next, are set once by LazyParts::prove(), and read by those alone who have
    /// found LazyParts::proved(): they stand where a step of a walk reads them with the nodes of the cell.
    CellIndex index;
    std::unique_ptr<const MappedCells> mapped;   ///< nullptr: cells are simplices, or their parts
    std::unique_ptr<const core::AxisGrid> grid;  ///< of a mesh that is not listed; then the index is empty
    bool multilinear = false;                    ///< that grid

    /// Asks memory for what is read of maps of the owners that follow the first, of these nodes.
    void fetch_maps(const Place* owner, std::size_t count, const NodeRecord* nodes) const {
        constexpr std::size_t apart = 8;
        for (std::size_t step = 0, ahead = MappedCells::fetch_steps * apart; ahead != 0; ++step, ahead -= apart)
            if (ahead < count && owner[ahead] >= 0) mapped->fetch(owner[ahead], step, nodes);
    }
};

}  // namespace barycert::locate
