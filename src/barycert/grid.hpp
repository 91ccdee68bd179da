/// Regular grids of points.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

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

    /// origin + i * spacing, each operation rounded; the last one is `last` to the bit, so that a grid over a box ends
    /// on it.
    double coordinate(std::size_t axis, std::int64_t i) const;
    std::uint64_t layer_size() const {
        return static_cast<std::uint64_t>(counts[0]) * static_cast<std::uint64_t>(counts[1]);
    }
    std::uint64_t point_count() const { return layer_size() * static_cast<std::uint64_t>(counts[2]); }
};

/// From low to high, ends included. An axis of one point has it in the middle of low and high. In 2D the third entries
/// are not looked at. Errors: a dimension other than 2 and 3; a count below 1 or above most_on_axis, or more than 2^62
/// points in all; bounds that are not finite, or not ascending (low < high where there are several points).
Result<Grid> grid_over(int dimension, const std::array<std::int64_t, 3>& counts, const std::array<double, 3>& low,
                       const std::array<double, 3>& high);

/// From low on in steps of `spacing` (> 0) as far as high. Errors: as above.
Result<Grid> grid_spaced(int dimension, const std::array<double, 3>& spacing, const std::array<double, 3>& low,
                         const std::array<double, 3>& high);

/// The box of the nodes that cells have; nothing but zeros if there are no cells.
struct Bounds3 {
    std::array<double, 3> low{}, high{};
};
Bounds3 bounds_of_cells(const Mesh& mesh);

// Fields on a regular grid, cell by cell: each cell finds the points of the grid that it holds, which is many times
// faster than asking for the cell of each point.

/// Takes some layers of a grid (2D: some lines), whole, in the order of the grid's points: `first_row` is the number of
/// the first point, `points` is empty. The view is gone after the call.
using GridSink = std::function<Status(const TableView&)>;

/// The rows that sampler.sample gives for the points of the grid, bit for bit: owners, features, values, counts (but
/// LocationCounts::tests, and which tier decided a value). Blocks come in order and are gone after the call; memory is
/// that of a few layers. Works on every mesh; no certificate is needed. Errors: those of sample (a point outside, with
/// policy `error`), and of `sink`, after which nothing is done any more.
Result<SampleCounts> resample(const Sampler& sampler, const Grid& grid, const SampleOptions& options,
                              const GridSink& sink);

/// The same as one table without points.
Result<Table> resample(const Sampler& sampler, const Grid& grid, const SampleOptions& options = {});

}  // namespace barycert
