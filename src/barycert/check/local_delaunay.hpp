/// The test of every interior facet behind delaunay.hpp.
#pragma once

#include <vector>

#include "barycert/check.hpp"
#include "barycert/mesh.hpp"

namespace barycert::check {

/// `neighbours` as compute_neighbours gives them for the cells that have a place in space, `orientation` their exact
/// signs, 0 for all others. On all threads of the calling arena.
DelaunayReport check_delaunay(const Mesh& mesh, const std::vector<Mesh::Index>& neighbours,
                              const std::vector<std::int8_t>& orientation);

}  // namespace barycert::check
