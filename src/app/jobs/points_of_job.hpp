/// The points of a job that samples at points.
#pragma once

#include <memory>

#include "barycert/point_files.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/table.hpp"

namespace barycert::jobs {

/// Opens the points of the job, from its file or on its line, with the columns to keep. Throws an Exception if they
/// cannot be read, or have another dimension.
std::unique_ptr<PointSource> points_of(const SampleJob& job, int dimension, NonfinitePoints nonfinite);

}  // namespace barycert::jobs
