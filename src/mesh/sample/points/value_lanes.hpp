/// Values of many points in their cells at once, on SIMD lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/names.hpp"

namespace barycert::sample {

using locate::NodeValues, locate::ValueRecord;

/// Points in their cells. Component c of the value of a point goes to out[stride * n + c], n the number in its record.
struct LanePoints {
    Simplex simplex;  ///< of the cells, linear
    const locate::CellRecord* cells;
    const NodeValues& nodes;
    const locate::PointRecord* points;
    std::span<const locate::Walk> items;  ///< points[item.point] lies in cells[item.cell]
    double* out;
    std::size_t stride;
};

/// Returns how many items are undecided, these in undecided[0 ...], ascending; their values are unspecified.
/// Rounding::plain decides all.
std::size_t interpolate_lanes(const LanePoints& points, Rounding rounding, std::uint32_t* undecided);

}  // namespace barycert::sample
