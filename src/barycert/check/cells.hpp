/// What each cell is by itself: exact orientation and volume, shape, condition.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/check/defect_list.hpp"
#include "barycert/check/exact_volumes.hpp"
#include "barycert/core/integer.hpp"
#include "barycert/mesh.hpp"

namespace barycert::check {

struct Cells {
    std::vector<std::uint8_t> usable;  ///< 1 for each cell of d + 1 different nodes with finite coordinates
    Integer total;                     ///< d! times the sum of all |volume|, in the unit of ExactVolumes
    std::uint64_t positive = 0, negative = 0, degenerate = 0;  ///< of the usable ones
};

/// Fills `measures`, without `shapes` their orientations and problems alone. Finds index_out_of_range, repeated_node,
/// degenerate_cell, plain_sign_wrong, mixed_orientation.
Cells check_cells(const Mesh& mesh, const std::vector<std::uint8_t>& finite, const ExactVolumes& volumes, bool shapes,
                  CellMeasures& measures, DefectList& defects);

/// Where the corners of a cell stand. Precondition: it is usable.
inline std::array<const double*, 4> corner_points(const Mesh& mesh, std::size_t cell) {
    std::array<const double*, 4> p{};
    for (std::size_t i = 0; i < mesh.corners(); ++i) {
        p[i] = &mesh.points[static_cast<std::size_t>(mesh.cells[cell * mesh.corners() + i]) *
                            static_cast<std::size_t>(mesh.dimension)];
    }
    return p;
}

}  // namespace barycert::check
