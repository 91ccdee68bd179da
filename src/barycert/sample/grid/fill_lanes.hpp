/// Cells fill in the points of a grid that they hold, on SIMD lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/sample/grid/raster_lanes.hpp"
#include "barycert/sample/points/value_lanes.hpp"

namespace barycert::sample {

/// In FillTarget::feature: in the interior of the owner, the value still to be found.
inline constexpr Feature interior_without_value = Feature::degenerate;

/// The points of some layers (2D: lines) of a grid, line after line. Each array has room for eight points more.
struct FillTarget {
    Mesh::Index* owner = nullptr;  ///< -1: none yet
    Feature* feature = nullptr;    ///< outside: none yet; interior: with its value
    double* values = nullptr;
    std::size_t stride = 1;  ///< numbers a point in `values`, of which the first are the components of the nodes
    std::size_t columns = 0, rows = 0;
    std::int32_t first_layer = 0, last_layer = 0;
    bool overlapping = false;  ///< cells may overlap: the lowest keeps a point
};

/// For points that are certainly in the interior of one of the cells: sets owner, feature, and values where their
/// rounding is certain. Spans with points of which that is not certain go to `unsure`, without the cells in `hard`, of
/// which nothing is known. Components: those of `nodes`, at least 1; cells are linear. Precondition: raster.precise.
void fill_cells(const locate::CellIndex& index, const NodeValues& nodes, const Raster& raster,
                const locate::Place* cells, std::size_t count, const FillTarget& target, std::vector<Span>& unsure,
                std::vector<locate::Place>& hard);

}  // namespace barycert::sample
