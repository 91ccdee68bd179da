/// Which cells of a mesh may hold points of which layers of a grid.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/lists.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/sample/grid/fill_lanes.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::sample {

/// Slabs of a cell, the last one included; none: first > last.
struct SlabRange {
    std::uint32_t first, last;
};
inline constexpr SlabRange no_slab{~std::uint32_t{0}, 0};

/// The slabs of so many layers each that a cell from low to high along the last axis may lie in.
inline SlabRange slabs_between(const Raster& raster, std::size_t axis, std::uint32_t depth, double low, double high) {
    const std::vector<double>& layers = raster.at[axis];
    const double last_layer = static_cast<double>(layers.size() - 1);
    const auto slab_of = [&](auto layer) { return static_cast<std::uint32_t>(layer) / depth; };
    if (!raster.precise) {
        const auto first = std::lower_bound(layers.begin(), layers.end(), low);
        const auto end = std::upper_bound(first, layers.end(), high);
        if (first == end) return no_slab;
        return {slab_of(first - layers.begin()), slab_of(end - layers.begin() - 1)};
    }
    // Rounded down both: a layer more than there are is no matter.
    const double origin = raster.origin[axis], scale = raster.scale[axis], slack = raster.slack;
    const double from = (low - origin) * scale - slack, to = (high - origin) * scale + slack;
    if (!(from <= last_layer && to >= 0)) return no_slab;
    return {slab_of(std::max(from, 0.0)), slab_of(std::min(to, last_layer))};
}

constexpr std::size_t parts_of(std::size_t all, std::size_t size) {
    return (all + size - 1) / size;
}

/// For each slab of `depth` layers (the last may have fewer) all cells that may hold points of it, as the index goes.
class SlabCells {
public:
    SlabCells(const locate::CellIndex& index, const Raster& raster, std::size_t depth) {
        const std::size_t axis = index.dimension() - 1, cells = index.cell_count();
        constexpr std::size_t at_once = 32768;
        parts_.resize(parts_of(cells, at_once));
        base::parallel_for(parts_.size(), [&](std::size_t p) {
            const std::size_t first = p * at_once, count = std::min(at_once, cells - first);
            std::vector<SlabRange> ranges(count);
            SlabRange all = no_slab;
            for (std::size_t i = 0; i < count; ++i) {
                __builtin_prefetch(index.cells.data() + std::min(first + i + 64, cells - 1));
                const auto& node = index.cells[first + i].node;
                const auto at = [&](std::size_t n) { return index.nodes[static_cast<std::size_t>(node[n])].at[axis]; };
                // In 2D the last corner repeats the first one.
                const double a = at(0), b = at(1), c = at(2), d = at(3);
                const SlabRange r =
                    slabs_between(raster, axis, static_cast<std::uint32_t>(depth),
                                  std::min(std::min(a, b), std::min(c, d)), std::max(std::max(a, b), std::max(c, d)));
                ranges[i] = r;
                all = {std::min(all.first, r.first), std::max(all.last, r.last)};
            }
            if (all.first > all.last) return;
            const auto each = [&](const auto& add) {
                for (std::size_t i = 0; i < count; ++i) {
                    for (std::size_t s = ranges[i].first; s <= ranges[i].last; ++s)
                        add(s - all.first, static_cast<locate::Place>(first + i));
                }
            };
            parts_[p] = {all.first, {all.last - all.first + 1, each}};
        });
    }

    /// Calls work(cells), one part of them after the other.
    template <class Work>
    void for_parts(std::size_t slab, Work work) const {
        for (const RunOfCells& part : parts_) {
            if (slab < part.first_slab || slab - part.first_slab >= part.cells.size()) continue;
            const std::span<const locate::Place> cells = part.cells[slab - part.first_slab];
            if (!cells.empty()) work(cells);
        }
    }

private:
    /// The cells of each slab, from the first slab on, among cells that follow one another.
    struct RunOfCells {
        std::size_t first_slab = 0;
        base::Lists<locate::Place> cells;
    };
    std::vector<RunOfCells> parts_;
};

}  // namespace barycert::sample
