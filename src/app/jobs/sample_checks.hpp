/// What can be known of a job that samples at points before its files are read.
#pragma once

#include <vector>

#include "app/jobs/job_files.hpp"
#include "barycert/sample_job.hpp"

namespace barycert::jobs {

/// Refuses a job that contradicts itself, or whose outputs cannot be written or are inputs.
void check_sample_job(const SampleJob& job, const std::vector<Step>& steps);

/// Refuses what a surface cannot give.
void refuse_what_is_of_meshes(const SampleJob& job);

}  // namespace barycert::jobs
