/// Many cells at once against the bins of points, on SIMD lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "barycert/locate/cells_at_points.hpp"
#include "barycert/mesh.hpp"

namespace barycert::locate {

/// Cells by their corners.
struct CellBlock {
    const Mesh::Index* corner;
    std::size_t count;
    std::size_t corners;                  ///< a cell: 3 or 4
    std::span<const std::int32_t> codes;  ///< bin of each node
};

/// A cell of a block and the bins that it reaches.
struct CellBins {
    std::uint32_t cell, low, high;
};

/// Writes the cells that may be near a bin with a point to `out`, ascending, and returns how many; all others are not.
/// Nothing if a corner is no node. `out` has room for all.
std::optional<std::size_t> find_near(const CellBlock& block, const PointBins& bins, CellBins* out);

}  // namespace barycert::locate
