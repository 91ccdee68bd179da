/// When points are so few that no index of the mesh is worth its while.
#pragma once

#include <cstddef>

namespace barycert::jobs {

/// Whether to look at each cell once instead (locate/cells_at_points.hpp), for so many points in so many cells. The
/// turning point was measured: see NOTES.md.
constexpr bool needs_no_index(std::size_t points, std::size_t cells) {
    return points != 0 && cells >= 20'000 && points <= cells / 100;
}

/// If more cells than these may hold a point, an index is made all the same.
constexpr std::size_t most_cells(std::size_t cells) {
    return cells / 8;
}

}  // namespace barycert::jobs
