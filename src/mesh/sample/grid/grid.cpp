#include "barycert/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/text.hpp"
#include "mesh/index/box_tree.hpp"

namespace barycert {
namespace {

Error along_axis(const char* what, std::size_t axis, std::string expected, std::string found) {
    return {.code = "argument.value",
            .what = std::string(what) + " of the grid along " + "xyz"[axis],
            .expected = std::move(expected),
            .found = std::move(found)};
}

Status check_box(int dimension, const std::array<double, 3>& low, const std::array<double, 3>& high) {
    if (dimension != 2 && dimension != 3)
        return Error{.code = "argument.value",
                     .what = "dimension of the grid",
                     .expected = "2 or 3",
                     .found = std::to_string(dimension)};
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
        if (!(std::isfinite(low[k]) && std::isfinite(high[k]) && low[k] <= high[k] && std::isfinite(high[k] - low[k])))
            return along_axis("bounds", k, "finite numbers, min before max, with a finite difference",
                              base::shortest(low[k]) + ", " + base::shortest(high[k]));
    }
    return Done{};
}

Status check_count(std::size_t axis, double count) {
    if (count >= 1 && count <= static_cast<double>(Grid::max_on_axis)) return Done{};
    return along_axis("points", axis, "1 to " + std::to_string(Grid::max_on_axis), base::shortest(count));
}

/// A spacing for points from low to high. Who reads a VTI file of the grid computes low + i * spacing, each operation
/// rounded: of the doubles beside the quotient the nearest is taken that leads to `high` so, else one that leads
/// nearest below it.
double spacing_between(double low, double high, std::int64_t count) {
    const double steps = static_cast<double>(count - 1), infinity = std::numeric_limits<double>::infinity();
    constexpr int around = 4;  // the quotient is off by less than two units, and so is the last point by rounding
    double more = (high - low) / steps, less = more, best = 0, best_last = low;
    const auto look = [&](double spacing) {
        const double last = low + steps * spacing;
        if (!(spacing > 0) || last > high || last <= best_last) return;
        best = spacing;
        best_last = last;
    };
    look(more);
    for (int i = 0; i < around; ++i) {
        more = std::nextafter(more, infinity);
        less = std::nextafter(less, -infinity);
        look(more);
        look(less);
    }
    return best;
}

Result<Grid> checked(const Grid& grid) {
    const double points =
        static_cast<double>(grid.counts[0]) * static_cast<double>(grid.counts[1]) * static_cast<double>(grid.counts[2]);
    if (!(points <= 0x1p62))
        return Error{.code = "argument.value",
                     .what = "points of the grid",
                     .expected = "at most 2^62",
                     .found = base::shortest(points)};
    for (std::size_t k = 0; k < 3; ++k) {
        if (grid.counts[k] == 1) continue;
        // Among subnormal numbers, or far from zero, a spacing may be less than what doubles differ by.
        const double far = std::max(std::fabs(grid.origin[k]), std::fabs(grid.last[k]));
        const double apart = far - std::nextafter(far, 0);
        if (grid.spacing[k] < apart || grid.coordinate(k, grid.counts[k] - 2) >= grid.last[k])
            return along_axis("points", k, "few enough that their coordinates differ", std::to_string(grid.counts[k]));
    }
    return grid;
}

}  // namespace

// Out of line, as all arithmetic that decides on results: in the caller's code the caller's flags would round it.
double Grid::coordinate(std::size_t axis, std::int64_t i) const {
    if (i == counts[axis] - 1 && i != 0) return last[axis];
    const ExactEnvironment environment;
    return base::held(base::held(origin[axis]) + static_cast<double>(i) * base::held(spacing[axis]));
}

Result<Grid> grid_over(int dimension, const std::array<std::int64_t, 3>& counts, const std::array<double, 3>& low,
                       const std::array<double, 3>& high) {
    const ExactEnvironment environment;
    Grid grid{.dimension = dimension};
    if (Status status = check_box(dimension, low, high); !status) return status.error();
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
        if (Status status = check_count(k, static_cast<double>(counts[k])); !status) return status.error();
        grid.counts[k] = counts[k];
        if (counts[k] == 1) {
            grid.origin[k] = grid.last[k] = low[k] + (high[k] - low[k]) / 2;
            continue;
        }
        grid.origin[k] = low[k];
        grid.last[k] = high[k];
        grid.spacing[k] = spacing_between(low[k], high[k], counts[k]);
        if (!(grid.spacing[k] > 0))
            return along_axis("bounds", k, "ends far enough apart for " + std::to_string(counts[k]) + " points",
                              base::shortest(low[k]) + ", " + base::shortest(high[k]));
    }
    return checked(grid);
}

Result<Grid> grid_spaced(int dimension, const std::array<double, 3>& spacing, const std::array<double, 3>& low,
                         const std::array<double, 3>& high) {
    const ExactEnvironment environment;
    Grid grid{.dimension = dimension};
    if (Status status = check_box(dimension, low, high); !status) return status.error();
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
        if (!(spacing[k] > 0) || !std::isfinite(spacing[k]))
            return along_axis("spacing", k, "a positive number", base::shortest(spacing[k]));
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

Grid as_in_vti(Grid grid) {
    const ExactEnvironment environment;
    for (std::size_t k = 0; k < 3; ++k) {
        if (grid.counts[k] > 1)
            grid.last[k] = grid.origin[k] + static_cast<double>(grid.counts[k] - 1) * grid.spacing[k];
    }
    return grid;
}

Bounds3 bounds_of_cells(const Mesh& mesh) {
    const ExactEnvironment environment;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    index::Box box = mesh.cells.empty() ? index::Box{} : index::empty_box;
    for (std::size_t k = 0; k < d && !mesh.is_listed(); ++k) {
        box.low[k] = mesh.axes[k].front();
        box.high[k] = mesh.axes[k].back();
    }
    for (const Mesh::Index node : mesh.cells) {
        std::array<double, 3> x{};
        for (std::size_t k = 0; k < d; ++k) x[k] = mesh.point(node)[k];
        box.add({x, x});
    }
    return {box.low, box.high};
}

}  // namespace barycert
