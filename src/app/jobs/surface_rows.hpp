/// Fields of a surface at the nearest points of its triangles.
#pragma once

#include "barycert/sample_job.hpp"
#include "barycert/surface.hpp"

namespace barycert::jobs {

/// Rows of the job's points, by the same pipeline as those of meshes. Throws an Exception. `seconds_to_read`: what the
/// surface took.
SampleReport sample_surface(const SampleJob& job, const Surface& surface, double seconds_to_read);

}  // namespace barycert::jobs
