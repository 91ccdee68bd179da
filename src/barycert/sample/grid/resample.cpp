#include "barycert/grid.hpp"

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "barycert/base/strict_math.hpp"
#include "barycert/environment.hpp"
#include "barycert/locate/batch.hpp"
#include "barycert/sample/grid/slab_cells.hpp"
#include "barycert/sample/grid/slab_sampler.hpp"

namespace barycert {
namespace {

std::size_t layer_axis(const Grid& grid) {
    return grid.dimension == 3 ? 2 : 1;
}

sample::Raster raster_of(const Grid& grid, const locate::CellIndex& index) {
    sample::Raster raster;
    raster.precise = true;
    double worst = 0;
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
        raster.spacing[k] = grid.spacing[k];
        raster.scale[k] = grid.counts[k] > 1 ? 1 / grid.spacing[k] : extent > 0 ? 0x1p16 / extent : 1;
        // Ends of intervals: some roundings of numbers up to `largest`; the same for coordinates of the grid. In
        // places: these times the scale, the roundings of that, and how far the last point is from where it were by the
        // spacing.
        const double count = static_cast<double>(grid.counts[k]);
        const double regular_last = grid.origin[k] + (count - 1) * grid.spacing[k];
        const double error =
            (48 * 0x1p-53 * max + 2 * std::abs(at.back() - regular_last)) * raster.scale[k] + 16 * 0x1p-53 * count;
        worst = std::max(worst, error);
        raster.precise = raster.precise && error <= 0x1p-9 && raster.scale[k] <= 0x1p300 &&
                         raster.scale[k] >= 0x1p-300 && max <= 0x1p300;
    }
    raster.slack = std::clamp(64 * worst, 0x1p-30, 0x1p-8);
    return raster;
}

/// Layers a slab, and how many of them.
struct Division {
    std::size_t depth, slabs;
};

/// Few slabs, for a cell that lies in two of them is looked at twice; of `room` points or one layer each; as many for
/// each thread.
Division divide(std::size_t layers, std::size_t layer_size, std::size_t room, std::size_t threads) {
    const auto parts = [](std::size_t all, std::size_t size) { return (all + size - 1) / size; };
    const std::size_t fewest = parts(layers, std::max<std::size_t>(room / layer_size, 1));
    const std::size_t depth = parts(layers, std::min(parts(fewest, threads) * threads, layers));
    return {depth, parts(layers, depth)};
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
    const sample::SamplerData& data = sample::SamplerData::of(sampler);
    if (Status status = check_grid(data, grid); !status) return status.error();
    const sample::Raster raster = raster_of(grid, data.index());
    const std::vector<double>& layers = raster.at[layer_axis(grid)];
    const std::size_t layer = static_cast<std::size_t>(grid.point_count()) / layers.size();
    // Many layers, for a cell that lies in two slabs is looked at twice; few enough for 64 MiB or so.
    const std::size_t room = (std::size_t{1} << 26) / (16 + 8 * data.width);

    Status status = Done{};
    SampleCounts all;
    locate::in_arena(options.threads, [&] {
        const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
        const Division division = divide(layers.size(), layer, room, threads);
        const std::size_t depth = division.depth, slabs = division.slabs;
        const sample::SlabCells cells(data.index(), raster, depth);
        // A slab may wait for its turn while others are filled. As they are begun and end in order, those under way
        // are consecutive.
        const std::size_t at_once = std::min(threads == 1 ? 1 : threads + 1, slabs);
        std::vector<sample::SlabSampler> samplers;
        samplers.reserve(at_once);
        for (std::size_t i = 0; i < at_once; ++i) samplers.emplace_back(data, grid, raster, options);
        std::atomic<bool> stopped = false;
        std::size_t next = 0;
        const auto begin = [&](tbb::flow_control& control) {
            if (next == slabs || stopped) control.stop();
            return next++;
        };
        const auto fill = [&](std::size_t s) {
            samplers[s % at_once].run(static_cast<std::int32_t>(s * depth),
                                      static_cast<std::int32_t>(std::min(layers.size(), (s + 1) * depth)), cells, s);
            return s;
        };
        const auto pass_on = [&](std::size_t s) {
            if (!status) return;
            const sample::SlabSampler& slab = samplers[s % at_once];
            if (const auto refused = slab.refused()) {
                status = Error{.what = "point " + std::to_string(*refused) + " of the grid is outside the mesh",
                               .remedy = "choose what points outside get: nan, fill, nearest or extrapolate"};
            } else {
                status = sink(slab.block());
                ExactEnvironment::renew();
                all.add(slab.counts());
            }
            if (!status) stopped = true;
        };
        using tbb::filter_mode;
        tbb::parallel_pipeline(at_once, tbb::make_filter<void, std::size_t>(filter_mode::serial_in_order, begin) &
                                            tbb::make_filter<std::size_t, std::size_t>(filter_mode::parallel, fill) &
                                            tbb::make_filter<std::size_t, void>(filter_mode::serial_in_order, pass_on));
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
