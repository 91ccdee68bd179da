#include "barycert/grid.hpp"

#include <tbb/blocked_range.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/base/strict_math.hpp"
#include "barycert/environment.hpp"
#include "barycert/locate/batch.hpp"
#include "barycert/sample/grid/slab_sampler.hpp"

namespace barycert {
namespace {

using locate::Place;

std::size_t layer_axis(const Grid& grid) {
    return grid.dimension == 3 ? 2 : 1;
}

sample::Raster raster_of(const Grid& grid, const locate::CellIndex& index) {
    sample::Raster raster;
    raster.slack = 0x1p-8;
    raster.precise = true;
    for (std::size_t k = 0; k < 3; ++k) {
        std::vector<double>& at = raster.at[k];
        at.reserve(static_cast<std::size_t>(grid.counts[k]));
        for (std::int64_t i = 0; i < grid.counts[k]; ++i) at.push_back(grid.coordinate(k, i));
        if (k >= index.dimension()) break;
        double max = 0;
        for (const double x : {at.front(), at.back(), index.low[k], index.high[k]}) max = std::max(max, std::abs(x));
        // One point alone stands at place 0, whatever the scale: one in which the slack is nothing beside the mesh.
        const double extent = index.high[k] - index.low[k];
        raster.origin[k] = grid.origin[k];
        raster.scale[k] = grid.counts[k] > 1 ? 1 / grid.spacing[k] : extent > 0 ? 0x1p16 / extent : 1;
        // Ends of intervals: some roundings of numbers up to `largest`; the same for coordinates of the grid. In
        // places: these times the scale, the roundings of that, and how far the last point is from where it were by the
        // spacing.
        const double count = static_cast<double>(grid.counts[k]);
        const double regular_last = grid.origin[k] + (count - 1) * grid.spacing[k];
        const double error =
            (48 * 0x1p-53 * max + 2 * std::abs(at.back() - regular_last)) * raster.scale[k] + 16 * 0x1p-53 * count;
        raster.precise = raster.precise && error <= raster.slack / 2 && raster.scale[k] <= 0x1p300 &&
                         raster.scale[k] >= 0x1p-300 && max <= 0x1p300;
    }
    return raster;
}

/// For each slab of `depth` layers the cells that may hold some of its points, in the order of the index.
struct SlabCells {
    std::vector<std::size_t> begin;
    std::vector<locate::Place> cells;
};

SlabCells cells_of_slabs(const locate::CellIndex& index, const std::vector<double>& layers, std::size_t depth) {
    const std::size_t slabs = (layers.size() + depth - 1) / depth, axis = index.dimension() - 1;
    struct Range {
        std::uint32_t first = 1, last = 0;  ///< slabs, both included
    };
    std::vector<Range> ranges(index.cell_count());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ranges.size(), 4096), [&](const auto& block) {
        for (std::size_t c = block.begin(); c != block.end(); ++c) {
            double low = std::numeric_limits<double>::infinity(), high = -low;
            for (std::size_t i = 0; i < index.corners(); ++i) {
                const double x = index.nodes[static_cast<std::size_t>(index.cells[c].node[i])].at[axis];
                low = std::min(low, x);
                high = std::max(high, x);
            }
            const auto first = std::lower_bound(layers.begin(), layers.end(), low);
            if (first == layers.end() || *first > high) continue;
            const auto last = std::upper_bound(first, layers.end(), high) - 1;
            ranges[c] = {static_cast<std::uint32_t>(static_cast<std::size_t>(first - layers.begin()) / depth),
                         static_cast<std::uint32_t>(static_cast<std::size_t>(last - layers.begin()) / depth)};
        }
    });
    SlabCells out;
    out.begin.assign(slabs + 1, 0);
    for (const Range& r : ranges) {
        for (std::size_t s = r.first; s <= r.last && r.first <= r.last; ++s) ++out.begin[s + 1];
    }
    for (std::size_t s = 0; s < slabs; ++s) out.begin[s + 1] += out.begin[s];
    out.cells.resize(out.begin.back());
    std::vector<std::size_t> next(out.begin.begin(), out.begin.end() - 1);
    for (std::size_t c = 0; c < ranges.size(); ++c) {
        for (std::size_t s = ranges[c].first; s <= ranges[c].last && ranges[c].first <= ranges[c].last; ++s)
            out.cells[next[s]++] = static_cast<locate::Place>(c);
    }
    return out;
}

Status check_grid(const sample::SamplerData& data, const Grid& grid) {
    const int dimension = data.located().mesh->dimension;
    if (grid.dimension != dimension)
        return Error{.what = "dimension of the grid",
                     .expected = std::to_string(dimension) + ", that of the mesh",
                     .found = std::to_string(grid.dimension)};
    for (std::size_t k = 0; k < 3; ++k) {
        const bool several = grid.counts[k] > 1;
        const bool good = grid.counts[k] >= 1 && grid.counts[k] <= Grid::max_on_axis && std::isfinite(grid.origin[k]) &&
                          std::isfinite(grid.last[k]) && grid.spacing[k] >= 0 && std::isfinite(grid.spacing[k]) &&
                          (!several || grid.spacing[k] > 0) &&
                          (!several || grid.coordinate(k, grid.counts[k] - 2) <= grid.last[k]) &&
                          (grid.dimension == 3 || k < 2 || !several);
        if (!good) return Error{.what = "invalid grid", .remedy = "make it by grid_over or grid_spaced"};
    }
    const std::int64_t layer = grid.counts[0] * (grid.dimension == 3 ? grid.counts[1] : 1);
    if (layer > 0x7fffffff)
        return Error{.what = "points of one layer of the grid",
                     .expected = "at most 2147483647",
                     .found = std::to_string(layer),
                     .remedy = "resample in several grids"};
    return Done{};
}

}  // namespace

Result<SampleCounts> resample(const Sampler& sampler, const Grid& grid, const SampleOptions& options,
                              const GridSink& sink) {
    const ExactEnvironment environment;
    const sample::SamplerData& data = sampler.data();
    if (Status status = check_grid(data, grid); !status) return status.error();
    const sample::Raster raster = raster_of(grid, data.index());
    const std::vector<double>& layers = raster.at[layer_axis(grid)];
    const std::size_t layer = static_cast<std::size_t>(grid.point_count()) / layers.size();
    // Many layers, for a cell that lies in two slabs is looked at twice; few enough for 64 MiB or so.
    const std::size_t room = (std::size_t{1} << 26) / (16 + 8 * data.columns.size());

    Status status = Done{};
    SampleCounts all;
    locate::in_arena(options.threads, [&] {
        const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
        const std::size_t share = (layers.size() + threads - 1) / threads;
        const std::size_t depth = std::clamp<std::size_t>(room / layer, 1, share);
        const std::size_t slabs = (layers.size() + depth - 1) / depth;
        const SlabCells cells = cells_of_slabs(data.index(), layers, depth);
        const std::size_t width = std::min(slabs, threads);
        std::vector<sample::SlabSampler> samplers(width, sample::SlabSampler(data, grid, raster, options));
        for (std::size_t wave = 0; wave < slabs && status; wave += width) {
            const std::size_t count = std::min(width, slabs - wave);
            tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
                const std::size_t s = wave + i;
                samplers[i].run(static_cast<std::int32_t>(s * depth),
                                static_cast<std::int32_t>(std::min(layers.size(), (s + 1) * depth)),
                                std::span(cells.cells).subspan(cells.begin[s], cells.begin[s + 1] - cells.begin[s]));
            });
            for (std::size_t i = 0; i < count && status; ++i) {
                if (const auto refused = samplers[i].refused()) {
                    status = Error{.what = "point " + std::to_string(*refused) + " of the grid is outside the mesh",
                                   .remedy = "choose what points outside get: nan, fill, nearest or extrapolate"};
                    break;
                }
                status = sink(samplers[i].block());
                ExactEnvironment::renew();
                all.add(samplers[i].counts());
            }
        }
    });
    if (!status) return status.error();
    return all;
}

Result<Table> resample(const Sampler& sampler, const Grid& grid, const SampleOptions& options) {
    Table all;
    all.dimension = grid.dimension;
    all.columns = sampler.columns();
    const auto append = [&](const TableView& rows) -> Status {
        all.cells.insert(all.cells.end(), rows.cells.begin(), rows.cells.end());
        all.features.insert(all.features.end(), rows.features.begin(), rows.features.end());
        all.values.insert(all.values.end(), rows.values.begin(), rows.values.end());
        all.distances.insert(all.distances.end(), rows.distances.begin(), rows.distances.end());
        return Done{};
    };
    Result<SampleCounts> counts = resample(sampler, grid, options, append);
    if (!counts) return counts.error();
    all.counts = *counts;
    return all;
}

}  // namespace barycert
