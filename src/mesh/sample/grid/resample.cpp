#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/grid.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/sample/grid/fill_lanes.hpp"
#include "mesh/sample/grid/slab_cells.hpp"
#include "mesh/sample/grid/slab_sampler.hpp"
#include "mesh/sample/points/chunk_sampler.hpp"
#include "mesh/sample/points/sampler_data.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {
namespace sample {
namespace {

Raster raster_of(const Grid& grid, const locate::CellIndex& index) {
    Raster raster;
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
        // places: these times the scale, the roundings of that, and how far the last point is off the spacing.
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

/// Layers a slab. Few slabs, for a cell that lies in two of them is looked at twice; of `room` points or one layer
/// each; as many for each thread.
std::size_t slab_depth(std::size_t layers, std::size_t layer_size, std::size_t room, std::size_t threads) {
    const std::size_t fewest = parts_of(layers, std::max<std::size_t>(room / layer_size, 1));
    return parts_of(layers, std::min(parts_of(fewest, threads) * threads, layers));
}

Status check_grid(const SamplerData& data, const Grid& grid) {
    const int dimension = data.located().mesh->dimension;
    if (grid.dimension != dimension)
        return Error{.code = "point.dimension",
                     .what = "dimension of the grid",
                     .expected = std::to_string(dimension) + ", that of the mesh",
                     .found = std::to_string(grid.dimension)};
    for (std::size_t k = 0; k < 3; ++k) {
        const bool several = grid.counts[k] > 1;
        const bool good = grid.counts[k] >= 1 && grid.counts[k] <= Grid::max_on_axis && std::isfinite(grid.origin[k]) &&
                          std::isfinite(grid.last[k]) && grid.spacing[k] >= 0 && std::isfinite(grid.spacing[k]) &&
                          (!several || grid.spacing[k] > 0) &&
                          (!several || grid.coordinate(k, grid.counts[k] - 2) <= grid.last[k]) &&
                          (grid.dimension == 3 || k < 2 || !several);
        if (!good)
            return Error{
                .code = "argument.value", .what = "invalid grid", .remedy = "make it by grid_over or grid_spaced"};
    }
    const std::int64_t layer = grid.counts[0] * (grid.dimension == 3 ? grid.counts[1] : 1);
    if (layer > 0x7fffffff)
        return Error{.code = "argument.value",
                     .what = "points of one layer of the grid",
                     .expected = "at most 2147483647",
                     .found = std::to_string(layer),
                     .remedy = "resample in several grids"};
    return Done{};
}

/// Point by point, some layers at a time: cells that have maps, or are not listed, are not filled.
Result<SampleCounts> resample_points(const Sampler& sampler, const Grid& grid, const SampleOptions& options,
                                     const GridSink& sink) {
    SampleCounts all;
    Table rows;
    std::vector<double> points;
    const std::int64_t count = grid.point_count(), width = grid.counts[0], height = grid.counts[1];
    constexpr std::int64_t step = std::int64_t{1} << 18;
    for (std::int64_t first = 0; first < count; first += step) {
        points.clear();
        for (std::int64_t i = first; i < std::min(count, first + step); ++i) {
            points.push_back(grid.coordinate(0, i % width));
            points.push_back(grid.coordinate(1, i / width % height));
            if (grid.dimension == 3) points.push_back(grid.coordinate(2, i / width / height));
        }
        Status done = sampler.sample(points, options, rows, static_cast<std::size_t>(first));
        TableView block = rows.view();
        block.points = {};
        block.first_row = static_cast<std::uint64_t>(first);
        if (done) done = sink(block);
        if (!done) return done.error();
        ExactEnvironment::renew();
        rows.counts.locations.ways = {};
        all.add(rows.counts);
    }
    return all;
}

}  // namespace

}  // namespace sample

Result<SampleCounts> resample(const Sampler& sampler, const Grid& grid, const SampleOptions& options,
                              const GridSink& sink) {
    const ExactEnvironment environment;
    const sample::SamplerData& data = sample::SamplerData::of(sampler);
    if (Status status = sample::check_grid(data, grid); !status) return status.error();
    if (data.located().mapped || data.located().grid) return sample::resample_points(sampler, grid, options, sink);
    const sample::Raster raster = sample::raster_of(grid, data.index());
    const std::vector<double>& layers = raster.at[data.index().dimension() - 1];
    const std::size_t layer = static_cast<std::size_t>(grid.point_count()) / layers.size();
    // Points of 64 MiB or so.
    const std::size_t room = (std::size_t{1} << 26) / (16 + 8 * data.width);

    Status status = Done{};
    SampleCounts all;
    base::in_arena(options.threads, data.index().cell_count() + layer * layers.size(), [&] {
        const auto threads = static_cast<std::size_t>(base::arena_threads());
        const std::size_t depth = sample::slab_depth(layers.size(), layer, room, threads);
        const std::size_t slabs = sample::parts_of(layers.size(), depth);
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
                status = sample::outside_error("point " + std::to_string(*refused) + " of the grid");
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
