/// Which cells may hold points of which layers of a grid.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "barycert/locate/names.hpp"
#include "barycert/sample/grid/raster_lanes.hpp"

namespace barycert::sample {

/// For each slab of `depth` layers (the last one may have fewer) all cells that may hold some of its points, in the
/// order of the index.
class SlabCells {
public:
    SlabCells(const locate::CellIndex& index, const Raster& raster, std::size_t depth);

    /// Calls work(cells), one part of them after the other.
    template <class Work>
    void for_parts(std::size_t slab, Work work) const {
        for (const Part& part : parts_) {
            if (slab < part.first_slab || slab - part.first_slab + 1 >= part.begin.size()) continue;
            const std::size_t* const begin = &part.begin[slab - part.first_slab];
            if (begin[0] != begin[1]) work(std::span(part.cells).subspan(begin[0], begin[1] - begin[0]));
        }
    }

private:
    /// Of cells that follow one another: by slab, from the first one on, where its cells begin; one more at the end.
    struct Part {
        std::size_t first_slab = 0;
        std::vector<std::size_t> begin;
        std::vector<locate::Place> cells;
    };
    std::vector<Part> parts_;
};

}  // namespace barycert::sample
