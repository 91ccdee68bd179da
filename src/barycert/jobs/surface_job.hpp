/// Surfaces where a mesh is asked for.
#pragma once

#include "barycert/jobs.hpp"
#include "barycert/jobs/job_files.hpp"

namespace barycert::jobs {

/// The fields of a surface at the nearest points of it. `seconds`: what reading it took.
SampleReport sample_surface(const SampleJob& job, const Surface& surface, double seconds);

}  // namespace barycert::jobs
