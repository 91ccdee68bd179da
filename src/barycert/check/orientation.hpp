/// A copy of a mesh whose cells are all ordered the same way.
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::check {

/// The mesh with the last two corners of each negative cell swapped, and with them its mid-edge nodes and its
/// neighbours; so volumes change their sign and nothing else. All else stays: points, the order of cells, fields,
/// markers, faces. `orientation`: the exact sign of each cell, as in Measures; a cell of 0 stays as it is.
Mesh with_positive_cells(const Mesh& mesh, const std::vector<std::int8_t>& orientation);

}  // namespace barycert::check
