// Onto a regular grid, cell by cell.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "barycert/grid.hpp"
#include "resample.hpp"
#include "resample_files.hpp"
#include "sampling_run.hpp"

namespace barycert::cli {
namespace {

Error wrong_axes(const std::string& option, int dimension, const std::string& expected, std::size_t found) {
    return {.what = option + " does not fit the mesh",
            .file = {},
            .line = 0,
            .expected = fmt::format("{} for a mesh of dimension {}", expected, dimension),
            .found = std::to_string(found),
            .remedy = {}};
}

Result<Grid> grid_of(const ResampleArguments& a, const Mesh& mesh) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    Bounds3 box = bounds_of_cells(mesh);
    if (!a.bounds.empty()) {
        if (a.bounds.size() != 2 * d)
            return wrong_axes("--bounds", mesh.dimension, fmt::format("{} numbers", 2 * d), a.bounds.size());
        for (std::size_t k = 0; k < d; ++k) {
            box.low[k] = a.bounds[2 * k];
            box.high[k] = a.bounds[2 * k + 1];
        }
    }
    if (!a.counts.empty()) {
        const bool one_layer = d == 2 && a.counts.size() == 3 && a.counts[2] == 1;
        if (a.counts.size() != d && !one_layer)
            return wrong_axes("--grid", mesh.dimension, fmt::format("{} numbers of points", d), a.counts.size());
        std::array<std::int64_t, 3> counts{1, 1, 1};
        for (std::size_t k = 0; k < d; ++k) counts[k] = a.counts[k];
        return grid_over(mesh.dimension, counts, box.low, box.high);
    }
    if (a.spacing.size() != 1 && a.spacing.size() != d)
        return wrong_axes("--spacing", mesh.dimension, fmt::format("one number or {}", d), a.spacing.size());
    std::array<double, 3> spacing{};
    for (std::size_t k = 0; k < d; ++k) spacing[k] = a.spacing[a.spacing.size() == 1 ? 0 : k];
    return grid_spaced(mesh.dimension, spacing, box.low, box.high);
}

std::vector<double> point_of(const Grid& grid, std::uint64_t i) {
    const auto nx = static_cast<std::uint64_t>(grid.counts[0]), ny = static_cast<std::uint64_t>(grid.counts[1]);
    const std::array<std::uint64_t, 3> at{i % nx, i / nx % ny, i / (nx * ny)};
    std::vector<double> point;
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k)
        point.push_back(grid.coordinate(k, static_cast<std::int64_t>(at[k])));
    return point;
}

}  // namespace

Status resample_grid(const ResampleArguments& a, SamplingEngine& engine, SampleRun& run, Progress& progress) {
    const Result<Grid> grid = grid_of(a, engine.mesh());
    if (!grid) return grid.error();
    run.from = PointsFrom::grid;
    run.grid = *grid;
    Status ready = engine.prepare_without_search(FoundBy::grid, "each cell finds the points that it holds", progress);
    if (!ready) return ready;
    Stopwatch watch, within;
    auto output = open_grid_output(a, engine, *grid);
    if (!output) return output.error();
    double writing = 0;
    const bool refuse = a.options.outside.kind == Outside::error;
    SampleOptions options = a.options;
    if (refuse) options.outside = {};
    const std::size_t columns = engine.sampler().columns().size();
    const std::uint64_t all = grid->point_count();
    const auto sink = [&](const GridBlock& block) -> Status {
        const auto outside = refuse ? std::find(block.cells.begin(), block.cells.end(), -1) : block.cells.end();
        if (outside != block.cells.end()) {
            const std::uint64_t i =
                block.first_point + static_cast<std::uint64_t>(std::distance(block.cells.begin(), outside));
            return outside_error("point " + std::to_string(i) + " of the grid", point_of(*grid, i), "");
        }
        count_nan(block.cells, block.values, columns, run.nan_values);
        within.lap();
        Status written = (*output)->write(block);
        writing += within.lap();
        progress.count(fmt::format("points of {}", all), block.first_point + block.cells.size());
        return written;
    };
    Status done = resample(engine.sampler(), *grid, options, sink, run.counts);
    if (!done) return done;
    run.rows = all;
    run.seconds.sample = watch.lap() - writing;
    Status committed = (*output)->commit();
    run.seconds.write = writing + watch.lap();
    run.picture = (*output)->picture();
    return committed;
}

}  // namespace barycert::cli
