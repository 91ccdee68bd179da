/// Candidates for many points, on SIMD lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/index/cell_tree.hpp"
#include "barycert/locate/names.hpp"

namespace barycert::locate {

struct PointRecord;

struct Candidate {
    std::uint32_t point;
    Place cell;
};

/// Appends each cell whose box holds points[i], for i = which[0 .. count), to `out`, point by point. Cells that are not
/// named do not hold the point. Points must lie in the box of the mesh.
void find_candidates(const CellIndex& index, const CellTree& tree, const PointRecord* points,
                     const std::uint32_t* which, std::size_t count, std::vector<Candidate>& out);

}  // namespace barycert::locate
