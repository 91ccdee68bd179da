/// Which cells may hold points of which layers of a grid.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "barycert/locate/cell_index.hpp"
#include "barycert/sample/grid/raster_lanes.hpp"

namespace barycert::sample {

/// For each slab of `depth` layers (the last one may have fewer) all cells that may hold some of its points, in the
/// order of the index.
class SlabCells {
public:
    SlabCells(const locate::CellIndex& index, const Raster& raster, std::size_t depth);

    std::span<const locate::Place> of(std::size_t slab) const {
        return std::span(cells_).subspan(begin_[slab], begin_[slab + 1] - begin_[slab]);
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<locate::Place> cells_;
};

}  // namespace barycert::sample
