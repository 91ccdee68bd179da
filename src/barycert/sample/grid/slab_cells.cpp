#include "barycert/sample/grid/slab_cells.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>

#include "barycert/base/strict_math.hpp"

namespace barycert::sample {
namespace {

/// Slabs of a cell, the last one included; none: first > last.
struct SlabRange {
    std::uint32_t first, last;
};
constexpr SlabRange no_slab{1, 0};

/// Slabs by coordinates.
class Slabs {
public:
    Slabs(const locate::CellIndex& index, const Raster& raster, std::size_t depth)
        : layers_(raster.at[index.dimension() - 1]),
          origin_(raster.origin[index.dimension() - 1]),
          scale_(raster.scale[index.dimension() - 1]),
          slack_(raster.slack),
          precise_(raster.precise) {
        for (std::size_t i = 0; i < layers_.size(); ++i) slab_.push_back(static_cast<std::uint32_t>(i / depth));
    }

    std::size_t count() const { return slab_.back() + 1; }

    SlabRange between(double low, double high) const {
        const double last_layer = static_cast<double>(layers_.size() - 1);
        if (!precise_) {
            const auto first = std::lower_bound(layers_.begin(), layers_.end(), low);
            const auto end = std::upper_bound(first, layers_.end(), high);
            if (first == end) return no_slab;
            return {slab_[static_cast<std::size_t>(first - layers_.begin())],
                    slab_[static_cast<std::size_t>(end - layers_.begin()) - 1]};
        }
        // Rounded down both: a layer more than there are is no matter.
        const double from = (low - origin_) * scale_ - slack_, to = (high - origin_) * scale_ + slack_;
        if (!(from <= last_layer && to >= 0)) return no_slab;
        return {slab_[static_cast<std::size_t>(std::max(from, 0.0))],
                slab_[static_cast<std::size_t>(std::min(to, last_layer))]};
    }

private:
    const std::vector<double>& layers_;
    double origin_, scale_, slack_;
    bool precise_;
    std::vector<std::uint32_t> slab_;  ///< by layer
};

}  // namespace

SlabCells::SlabCells(const locate::CellIndex& index, const Raster& raster, std::size_t depth) {
    const Slabs slabs(index, raster, depth);
    const std::size_t count = slabs.count(), axis = index.dimension() - 1, cells = index.cell_count();
    constexpr std::size_t at_once = 16384;
    const std::size_t parts = (cells + at_once - 1) / at_once;
    std::vector<SlabRange> ranges(cells);
    std::vector<std::size_t> next(parts * count);  ///< by part of the cells and slab: how many, then where they go
    const auto for_parts = [&](const auto& work) {
        tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t p) {
            for (std::size_t c = p * at_once; c < std::min(cells, (p + 1) * at_once); ++c) work(c, &next[p * count]);
        });
    };
    for_parts([&](std::size_t c, std::size_t* of_part) {
        const auto& node = index.cells[c].node;
        const auto at = [&](std::size_t i) { return index.nodes[static_cast<std::size_t>(node[i])].at[axis]; };
        // In 2D the last corner repeats the first one.
        const double a = std::min(at(0), at(1)), b = std::min(at(2), at(3));
        const double e = std::max(at(0), at(1)), f = std::max(at(2), at(3));
        ranges[c] = slabs.between(std::min(a, b), std::max(e, f));
        for (std::size_t s = ranges[c].first; s <= ranges[c].last; ++s) ++of_part[s];
    });
    begin_.push_back(0);
    std::size_t sum = 0;
    for (std::size_t s = 0; s < count; ++s) {
        for (std::size_t p = 0; p < parts; ++p) {
            const std::size_t here = next[p * count + s];
            next[p * count + s] = sum;
            sum += here;
        }
        begin_.push_back(sum);
    }
    cells_.resize(sum);
    for_parts([&](std::size_t c, std::size_t* of_part) {
        for (std::size_t s = ranges[c].first; s <= ranges[c].last; ++s)
            cells_[of_part[s]++] = static_cast<locate::Place>(c);
    });
}

}  // namespace barycert::sample
