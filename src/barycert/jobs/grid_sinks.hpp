/// Grids of values into files.
#pragma once

#include <memory>
#include <string>

#include "barycert/grid.hpp"
#include "barycert/io.hpp"
#include "barycert/jobs.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// A sink of the blocks of a grid, in order; their views have no points.
struct GridOutput {
    std::unique_ptr<TableSink> sink;
    const SliceCounts* picture = nullptr;  ///< of a picture, after the commit: what became of the values
};

/// What is wrong with the output of a grid, as far as its name and the options tell.
Status check_grid_output(const ResampleJob& job);

/// The output `path` of the job, by its suffix. Errors: a format that cannot hold these fields or that grid; a path
/// that cannot be written.
Result<GridOutput> open_grid_sink(const ResampleJob& job, const std::string& path, const TableFormat& format,
                                  const Grid& grid);

}  // namespace barycert::jobs
