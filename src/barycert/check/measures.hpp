/// Measures of cells: exact orientation, volume, shape, condition.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "barycert/check/problem.hpp"

namespace barycert::check {

/// One entry a cell. A cell that has no place in space (an index out of range, a coordinate that is not finite) has
/// NaN everywhere and orientation 0.
struct Measures {
    std::vector<std::int8_t> orientation;  ///< exact sign of the volume in the order of the corners: -1, 0, 1
    std::vector<ProblemSet> problems;      ///< that the cell has a part in
    std::vector<double> volume;            ///< signed (2D: area), correctly rounded, in the unit of coordinates cubed
    std::vector<double> condition;         ///< of the weights, see core/condition.hpp; infinity if degenerate

    // Shape, in plain double from correctly rounded volumes. Of a degenerate cell: infinite ratios.
    std::vector<double> radius_edge;  ///< circumradius / shortest edge; regular: 0.612 (2D: 0.577)
    std::vector<double> aspect;       ///< longest edge / inradius, scaled so that the regular simplex has 1
    std::vector<double> min_angle;    ///< smallest dihedral angle (2D: angle), degrees
    std::vector<double> max_angle;    ///< largest one
};

/// Distribution of a measure over the cells where it is not NaN.
struct Distribution {
    double least = 0, median = 0, most = 0;
    std::int64_t least_cell = -1, most_cell = -1;
};

Distribution distribution(const std::vector<double>& values);

}  // namespace barycert::check
