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
constexpr SlabRange no_slab{~std::uint32_t{0}, 0};

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
    const std::size_t axis = index.dimension() - 1, cells = index.cell_count();
    constexpr std::size_t at_once = 32768;
    parts_.resize((cells + at_once - 1) / at_once);
    tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t p) {
        const std::size_t first = p * at_once, count = std::min(at_once, cells - first);
        std::vector<SlabRange> ranges(count);
        SlabRange all{~std::uint32_t{0}, 0};
        for (std::size_t i = 0; i < count; ++i) {
            __builtin_prefetch(index.cells.data() + std::min(first + i + 64, cells - 1));
            const auto& node = index.cells[first + i].node;
            const auto at = [&](std::size_t n) { return index.nodes[static_cast<std::size_t>(node[n])].at[axis]; };
            // In 2D the last corner repeats the first one.
            const double a = at(0), b = at(1), c = at(2), d = at(3);
            const SlabRange r =
                slabs.between(std::min(std::min(a, b), std::min(c, d)), std::max(std::max(a, b), std::max(c, d)));
            ranges[i] = r;
            all = {std::min(all.first, r.first), std::max(all.last, r.last)};
        }
        if (all.first > all.last) return;
        Part& part = parts_[p];
        part.first_slab = all.first;
        // First how many of each slab, two entries behind; then, one behind, where the next one goes.
        part.begin.assign(all.last - all.first + 3, 0);
        for (const SlabRange& r : ranges) {
            for (std::size_t s = r.first; s <= r.last; ++s) ++part.begin[s - all.first + 2];
        }
        for (std::size_t s = 2; s < part.begin.size(); ++s) part.begin[s] += part.begin[s - 1];
        part.cells.resize(part.begin.back());
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t s = ranges[i].first; s <= ranges[i].last; ++s)
                part.cells[part.begin[s - all.first + 1]++] = static_cast<locate::Place>(first + i);
        }
        part.begin.pop_back();
    });
}

}  // namespace barycert::sample
