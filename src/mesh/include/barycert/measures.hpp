/// Measures of cells: exact orientation, volume and condition, and shape.
///
/// Example:
///
///     #include "barycert/check.hpp"
///     const Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     const CellMeasures measures = check_mesh(mesh).measures;
///     const Distribution areas = distribution(measures.volume);  // min, median, max, and cells
///     const std::vector<Field> fields = measure_fields(measures);
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"

namespace barycert {

/// Exact orientation, volume, condition and shape: one entry per cell. A cell with an index out of range or a
/// coordinate that is not finite has NaN everywhere and orientation 0.
struct CellMeasures {
    std::vector<std::int8_t> orientation;  ///< exact sign of the volume: -1, 0, 1
    std::vector<DefectSet> defects;        ///< that the cell is part of
    std::vector<double> volume;            ///< signed (2D: area), correctly rounded, in the unit of coordinates cubed
    std::vector<double> condition;         ///< of the weights, see weights.hpp; infinity if degenerate

    /// Sign of the Jacobian of each cell's isoparametric map (MapReport): -1, 1; 0 not known, 2 changes. For a cell
    /// without a map it is the orientation. Empty if no cell has a map.
    std::vector<std::int8_t> jacobian;

    // Shape, in plain double from correctly rounded volumes. Ratios of a degenerate cell are infinite.
    std::vector<double> radius_edge;  ///< circumradius / shortest edge; regular: 0.612 (2D: 0.577)
    std::vector<double> aspect;       ///< longest edge / inradius, scaled so that the regular simplex has 1
    std::vector<double> min_angle;    ///< smallest dihedral angle (2D: angle), degrees
    std::vector<double> max_angle;    ///< largest dihedral angle (2D: angle), degrees
};

/// Measures that are numbers, under the names that files and reports have.
inline constexpr std::array<std::pair<std::string_view, std::vector<double> CellMeasures::*>, 6> cell_measures{
    {{"volume", &CellMeasures::volume},
     {"condition", &CellMeasures::condition},
     {"radius_edge", &CellMeasures::radius_edge},
     {"aspect", &CellMeasures::aspect},
     {"min_angle", &CellMeasures::min_angle},
     {"max_angle", &CellMeasures::max_angle}}};

/// Distribution of a measure over the cells where it is not NaN.
struct Distribution {
    double min = 0, median = 0, max = 0;
    std::int64_t min_cell = -1, max_cell = -1;
};

Distribution distribution(const std::vector<double>& values);

/// Measures and defects of cells as fields: orientation, those of cell_measures, and problems, a DefectSet as a number.
std::vector<Field> measure_fields(const CellMeasures& measures);

}  // namespace barycert
