/// Integrals that show what becomes of cell fields that are sampled at the nodes of another mesh.
#pragma once

#include <functional>

#include "app/jobs/sampled_mesh.hpp"
#include "app/jobs/stream.hpp"
#include "barycert/mesh.hpp"

namespace barycert::jobs {

/// Gives the rows of all nodes of `other` to the sink that is opened, and does not read it from then on. Integrals of
/// cell fields sampled as they are go into the report: over the mesh, which is prepared, with the commit over `other`.
Sink with_integrals(SampledMesh& mesh, const Mesh& other, const std::function<Sink()>& open);

/// Notes in the report that cell fields, if there are some, become values at nodes, and which have no integrals.
void note_cell_fields(SampledMesh& mesh, bool of_series);

}  // namespace barycert::jobs
