/// Steps of many walks at once, on SIMD lanes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "barycert/locate/names.hpp"

namespace barycert::locate {

/// A point among others in the order of the bins. 2D: z = 0.
struct alignas(32) PointRecord {
    std::array<double, 3> at;
    std::uint32_t number;  ///< where its results go
    std::uint32_t bin;
};

/// Where a walk stands.
struct Walk {
    std::uint32_t point;
    Place cell;
};

/// One step of each of `count` walks. Where the point is certainly inside the cell, inside[point] = cell, and the walk
/// ends; where it is certainly beyond a facet that has a neighbour, it goes on there; these walks are moved to the
/// front of `walks`, and their number is returned. All others, on facets or at the end of the domain or in doubt, go to
/// `stuck`, with the cell where they stand, or ~cell if the point is certainly outside of it, and `stuck_count` is
/// raised; inside[point] is -1 for these. `stuck` needs room for one more than there may be.
std::size_t step_walks(const CellIndex& index, const PointRecord* points, Walk* walks, std::size_t count, Place* inside,
                       Walk* stuck, std::size_t& stuck_count);

}  // namespace barycert::locate
