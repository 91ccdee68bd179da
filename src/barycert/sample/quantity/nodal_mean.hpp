/// Cell fields at nodes.
#pragma once

#include "barycert/mesh.hpp"

namespace barycert::sample {

/// At each node the mean of the field over all cells that have the node, mid-edge nodes included, weighted by their
/// volumes (areas in the plane; with straight sides): sum |V_c| f_c / sum |V_c|, exact and rounded once, to nearest,
/// ties to even. Cells may have any orientation and may overlap; degenerate ones weigh nothing. NaN where a value of a
/// cell that is not degenerate is not finite, and at nodes of no other cells. Without a name.
/// Preconditions: the mesh is consistent, and the field has values for its cells.
Field nodal_mean(const Mesh& mesh, const Field& of_cells);

}  // namespace barycert::sample
