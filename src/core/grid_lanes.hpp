/// Cells of a grid along axes that hold points, and values there, many at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/simplex.hpp"

namespace barycert::core {

/// Cells between planes across the axes, the first axis running fastest.
struct AxisGrid {
    /// Requires: coordinates, which must stay, increase, and are at least two along each axis.
    AxisGrid(int dimension, const std::array<std::vector<double>, 3>& axes);

    std::size_t dimension;
    std::array<const double*, 3> planes{};  ///< in the plane, 0 and 1 along the third axis
    std::array<std::size_t, 3> cells{};     ///< along each axis
    std::array<double, 3> cells_per_unit{};
    std::array<std::size_t, 3> node_step{};  ///< from a node to the next one along each axis

    /// The lowest node of a cell.
    std::size_t node_of(std::size_t cell) const;
    /// The lower plane of the cell along an axis that holds x, the lowest if there are two, near a guess perhaps.
    /// Requires: one does.
    std::size_t find(std::size_t axis, double x, std::int64_t guess) const;
};

/// One component of a field of nodes: data[step * node].
struct NodeComponent {
    const double* data;
    std::size_t step;
};

struct GridPoints {
    std::span<const double> points;
    std::int32_t* cells;  ///< the lowest cell that holds point i, or -1
    Feature* features;
    std::span<const NodeComponent> fields = {};
    bool multilinear = false;  ///< else linear on the parts of each cell, cut at its lowest node (pulling)
    double* values = nullptr;  ///< of point i: values[width * i], ..., each rounded once; outside any
    std::size_t width = 0;
};

/// Returns how many points inside have a value that is not certain, and these points, ascending, in `undecided`.
std::size_t sample_grid(const AxisGrid& grid, const GridPoints& points, std::uint32_t* undecided);

}  // namespace barycert::core
