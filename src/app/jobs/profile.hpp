/// Plots of rows: values along the way from point to point, or over the times of a series.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/jobs/stream.hpp"
#include "barycert/point_files.hpp"
#include "barycert/sample_job.hpp"

namespace barycert::jobs {

/// The points of a line, from end to end.
std::unique_ptr<PointSource> points_on(const PointLine& line);

/// Rows go to `sink`, which may be none, and are kept; with the commit the plot is written.
Sink plotted(Sink sink, const SampleJob& job, std::vector<std::string> columns, const SampleReport& report);

}  // namespace barycert::jobs
