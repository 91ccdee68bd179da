/// What becomes of cell fields that are sampled at the nodes of another mesh, and of their integrals.
#pragma once

#include <functional>
#include <memory>

#include "barycert/io.hpp"
#include "barycert/jobs/engine.hpp"
#include "barycert/jobs/run.hpp"

namespace barycert::jobs {

/// The sink that `open` opens for rows at the nodes of `other`. Of cell fields that are sampled as they are, the
/// integrals over the mesh of the engine go into the summary at once, those over `other` with the commit.
/// Preconditions: the engine is prepared, and has its mesh; one row a node.
Result<std::unique_ptr<TableSink>> with_integrals(Run& run, const Engine& engine, const Mesh& other,
                                                  const TableFormat& format,
                                                  const std::function<Result<std::unique_ptr<TableSink>>()>& open);

/// That cell fields become values at nodes, if there are some, and of which there are no integrals: a note of the run.
void note_cell_fields(Run& run, const Engine& engine, bool of_series);

}  // namespace barycert::jobs
