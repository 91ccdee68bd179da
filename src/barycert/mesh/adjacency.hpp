/// Which cells share a facet: edges between triangles, faces between tetrahedra.
#pragma once

#include <cstdint>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::mesh {

/// The cell across the facet opposite to each corner, dimension + 1 a cell; -1 where there is none. Facets are the same
/// if they have the same nodes; positions do not matter. Where more than two cells hold a facet, the two lowest are
/// neighbours and the others have none. Precondition: the indices of the cells are in range.
/// Time and memory O(cells + nodes) where the number of cells at a node is bounded; on all threads of the calling
/// arena.
std::vector<Mesh::Index> compute_neighbours(const Mesh& mesh);

/// The facets without a neighbour, each as cell * (dimension + 1) + corner, ascending. `neighbours` as above.
std::vector<std::int64_t> hull_facets(const Mesh& mesh, const std::vector<Mesh::Index>& neighbours);

}  // namespace barycert::mesh
