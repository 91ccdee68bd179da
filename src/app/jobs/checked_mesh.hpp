/// Steps of a check whose mesh is read, of whatever format.
#pragma once

#include <string>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/mesh.hpp"

namespace barycert::jobs {

/// The options of the job, which tell what is done.
CheckOptions told_options(const CheckJob& job);

/// Curved cells are checked as the job says. Throws an Exception if it refuses them.
void take_curved(const CheckJob& job, const Mesh& mesh, CheckOptions& options);

/// Checks checked.mesh, which users call `name`; `files`: those that it may be in.
void check_cells(const CheckJob& job, const std::vector<std::string>& files, std::string name,
                 const CheckOptions& options, CheckedMesh& checked);

}  // namespace barycert::jobs
