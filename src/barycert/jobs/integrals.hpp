/// What becomes of cell fields that are sampled at the nodes of another mesh, and of their integrals.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/jobs/sampled_mesh.hpp"

namespace barycert::jobs {

/// The columns of cell fields that are sampled as they are; their integrals over the mesh go into the report.
/// Precondition: the mesh is prepared.
std::vector<std::size_t> integrate_source(SampledMesh& mesh, const TableFormat& format);

/// Nodes and cells, of which integrals are made.
Mesh geometry_of(const Mesh& mesh);

/// Gives the rows of all nodes of `geometry` to the sink; with the commit, the integrals over it go into the report.
std::unique_ptr<TableSink> integrate_target(SampledMesh& mesh, Mesh geometry, const std::vector<std::size_t>& columns,
                                            std::unique_ptr<TableSink> sink);

/// That cell fields become values at nodes, if there are some, and of which there are no integrals: a note of the
/// report.
void note_cell_fields(SampledMesh& mesh, bool of_series);

}  // namespace barycert::jobs
