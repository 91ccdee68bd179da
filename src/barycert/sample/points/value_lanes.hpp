/// Values of many points in their cells at once, on SIMD lanes.
#pragma once

#include "barycert/locate/lanes.hpp"
#include "barycert/locate/names.hpp"
#include "barycert/weights.hpp"

namespace barycert::sample {

/// Four further components of the values of a node: one aligned load, as a NodeRecord.
struct alignas(32) ValueRecord {
    std::array<double, 4> value;
};

/// What is read of a node: its coordinates and component 0 side by side, then components in fours.
struct NodeValues {
    const locate::NodeRecord* first = nullptr;
    /// Component c >= 1 of a node: more[(c - 1) / 4 * node_count + node], (c - 1) % 4.
    const ValueRecord* more = nullptr;
    std::size_t node_count = 0;
    std::size_t components = 0;  ///< at least 1
};

/// Points in their cells. Component c of the value of a point goes to out[stride * number + c], with the number in the
/// record of the point.
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
