/// Regular grids of points.
///
/// Example:
///
///     Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     mesh.point_fields = {{"T", 1, {20, 21, 22}}};
///     const Grid grid = grid_over(2, {65, 65, 1}, {0, 0, 0}, {1, 1, 0}).value();
///     const Table rows = resample(Sampler::build(mesh).value(), grid).value();
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"

namespace barycert {

/// Points on lines parallel to the axes, the first coordinate running fastest. In 2D there is one layer and no third
/// coordinate.
struct Grid {
    static constexpr std::int64_t max_on_axis = 0x7fffffff - 64;

    int dimension = 3;
    std::array<std::int64_t, 3> counts{1, 1, 1};
    std::array<double, 3> origin{}, spacing{}, last{};

    /// Returns origin + i * spacing, each operation rounded. For the last point it returns `last`, to the bit, so that
    /// a grid over a box ends on the box.
    double coordinate(std::size_t axis, std::int64_t i) const;
    std::uint64_t layer_size() const {
        return static_cast<std::uint64_t>(counts[0]) * static_cast<std::uint64_t>(counts[1]);
    }
    std::uint64_t point_count() const { return layer_size() * static_cast<std::uint64_t>(counts[2]); }
};

/// Returns the grid from low to high, ends included. An axis of one point has it in the middle. In 2D third entries are
/// ignored. Error: a dimension other than 2 or 3; a count below 1 or above max_on_axis; more than 2^62 points; bounds
/// that are not finite and ascending (low < high where there are several points).
Result<Grid> grid_over(int dimension, const std::array<std::int64_t, 3>& counts, const std::array<double, 3>& low,
                       const std::array<double, 3>& high);

/// Returns the grid from low in steps of `spacing` (> 0) up to high. Errors as above.
Result<Grid> grid_spaced(int dimension, const std::array<double, 3>& spacing, const std::array<double, 3>& low,
                         const std::array<double, 3>& high);

/// Returns the grid as readers of VTI files see it: they compute the last point like all others, as origin + i *
/// spacing. That is nearly always `last`; where no double as spacing leads there, it is below `last` by an ulp or two
/// of the larger end.
Grid as_in_vti(Grid grid);

/// The bounding box of the nodes of cells; zeros if there are no cells.
struct Bounds3 {
    std::array<double, 3> low{}, high{};
};
Bounds3 bounds_of_cells(const Mesh& mesh);

// Fields on a regular grid, cell by cell: each cell finds the grid points that it contains, which is many times faster
// than locating each point.

/// Receives some whole layers of a grid (2D: lines), in the order of the grid's points: `first_row` is the number of
/// the first point, `points` is empty. The view is valid during the call only. Calls come in order, from any thread.
using GridSink = std::function<Status(const TableView&)>;

/// Passes to `sink` the rows that Sampler::sample returns for the points of the grid, bit for bit, and returns their
/// counts. (LocationCounts::tests, and which tier decided a value, may differ.) Takes twice the memory of a few layers
/// for each thread. Errors of Sampler::sample; an Error of `sink`, after which it stops.
Result<SampleCounts> resample(const Sampler& sampler, const Grid& grid, const SampleOptions& options,
                              const GridSink& sink);

/// The same as one table without points.
Result<Table> resample(const Sampler& sampler, const Grid& grid, const SampleOptions& options = {});

}  // namespace barycert
