/// Outputs of the values on a grid.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "app/jobs/stream.hpp"
#include "barycert/figure.hpp"
#include "barycert/grid.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/table_files.hpp"

namespace barycert::jobs {

/// Point i of the grid; in 2D without a third coordinate.
std::array<double, 3> point_of(const Grid& grid, std::uint64_t i);

/// A sink of the blocks of a grid, in order, whose views have no points: `path`, by its suffix. `picture` gets, with
/// the commit, what became of values. Refused: a format that cannot hold fields or grid.
Sink open_grid_sink(const ResampleJob& job, const std::string& path, const TableFormat& format, const Grid& grid,
                    std::optional<FigureCounts>& picture);

}  // namespace barycert::jobs
