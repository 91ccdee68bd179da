#include "barycert/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "barycert/base/strict_math.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"

namespace barycert {
namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};

Status check_bounds(std::size_t axis, double low, double high) {
    if (std::isfinite(low) && std::isfinite(high) && low <= high && std::isfinite(high - low)) return Done{};
    return Error{.what = std::string("bounds of the grid along ") + axis_names[axis],
                 .expected = "finite numbers, min before max, with a finite difference",
                 .found = base::shortest(low) + ", " + base::shortest(high)};
}

Status check_dimension(int dimension) {
    if (dimension == 2 || dimension == 3) return Done{};
    return Error{.what = "dimension of the grid", .expected = "2 or 3", .found = std::to_string(dimension)};
}

Status check_count(std::size_t axis, double count) {
    if (count >= 1 && count <= static_cast<double>(Grid::max_on_axis)) return Done{};
    return Error{.what = std::string("points of the grid along ") + axis_names[axis],
                 .expected = "1 to " + std::to_string(Grid::max_on_axis),
                 .found = base::shortest(count)};
}

Result<Grid> checked(const Grid& grid) {
    const double points =
        static_cast<double>(grid.counts[0]) * static_cast<double>(grid.counts[1]) * static_cast<double>(grid.counts[2]);
    if (!(points <= 0x1p62))
        return Error{.what = "points of the grid", .expected = "at most 2^62", .found = base::shortest(points)};
    for (std::size_t k = 0; k < 3; ++k) {
        // The spacing is rounded: among subnormal numbers, or far from zero, by more than it may.
        if (grid.counts[k] > 1 && grid.coordinate(k, grid.counts[k] - 2) > grid.last[k])
            return Error{.what = std::string("points of the grid along ") + axis_names[k],
                         .expected = "few enough that their coordinates differ",
                         .found = std::to_string(grid.counts[k])};
    }
    return grid;
}

}  // namespace

// Out of line, as all arithmetic that decides on results: in the caller's code the caller's flags would round it.
double Grid::coordinate(std::size_t axis, std::int64_t i) const {
    if (i == counts[axis] - 1 && i != 0) return last[axis];
    const ExactEnvironment environment;
    return held(held(origin[axis]) + static_cast<double>(i) * held(spacing[axis]));
}

Result<Grid> grid_over(int dimension, const std::array<std::int64_t, 3>& counts, const std::array<double, 3>& low,
                       const std::array<double, 3>& high) {
    const ExactEnvironment environment;
    if (Status status = check_dimension(dimension); !status) return status.error();
    Grid grid;
    grid.dimension = dimension;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
        if (Status status = check_bounds(k, low[k], high[k]); !status) return status.error();
        if (Status status = check_count(k, static_cast<double>(counts[k])); !status) return status.error();
        grid.counts[k] = counts[k];
        if (counts[k] == 1) {
            grid.origin[k] = grid.last[k] = low[k] + (high[k] - low[k]) / 2;
            continue;
        }
        grid.origin[k] = low[k];
        grid.last[k] = high[k];
        grid.spacing[k] = (high[k] - low[k]) / static_cast<double>(counts[k] - 1);
        if (!(grid.spacing[k] > 0))
            return Error{.what = std::string("bounds of the grid along ") + axis_names[k],
                         .expected = "different ends for  " + std::to_string(counts[k]) + " points",
                         .found = base::shortest(low[k]) + ", " + base::shortest(high[k])};
    }
    return checked(grid);
}

Result<Grid> grid_spaced(int dimension, const std::array<double, 3>& spacing, const std::array<double, 3>& low,
                         const std::array<double, 3>& high) {
    const ExactEnvironment environment;
    if (Status status = check_dimension(dimension); !status) return status.error();
    Grid grid;
    grid.dimension = dimension;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
        if (Status status = check_bounds(k, low[k], high[k]); !status) return status.error();
        if (!(spacing[k] > 0) || !std::isfinite(spacing[k]))
            return Error{.what = std::string("spacing of the grid along ") + axis_names[k],
                         .expected = "a positive number",
                         .found = base::shortest(spacing[k])};
        // A quotient rounded down by an ulp must not lose the last point.
        double steps = std::floor((high[k] - low[k]) / spacing[k]);
        if (Status status = check_count(k, steps + 1); !status) return status.error();
        if (low[k] + (steps + 1) * spacing[k] <= high[k]) ++steps;
        while (steps > 0 && low[k] + steps * spacing[k] > high[k]) --steps;
        if (Status status = check_count(k, steps + 1); !status) return status.error();
        grid.counts[k] = static_cast<std::int64_t>(steps) + 1;
        grid.origin[k] = low[k];
        grid.spacing[k] = spacing[k];
        grid.last[k] = low[k] + steps * spacing[k];
    }
    return checked(grid);
}

Bounds3 bounds_of_cells(const Mesh& mesh) {
    const ExactEnvironment environment;
    Bounds3 bounds;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t k = 0; k < d && !mesh.cells.empty(); ++k) {
        bounds.low[k] = std::numeric_limits<double>::infinity();
        bounds.high[k] = -bounds.low[k];
    }
    for (const Mesh::Index node : mesh.cells) {
        for (std::size_t k = 0; k < d; ++k) {
            const double x = mesh.points[d * static_cast<std::size_t>(node) + k];
            bounds.low[k] = std::min(bounds.low[k], x);
            bounds.high[k] = std::max(bounds.high[k], x);
        }
    }
    return bounds;
}

}  // namespace barycert
