/// Grids of values into files.
#pragma once

#include <memory>
#include <optional>

#include "barycert/grid.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "resample.hpp"
#include "sampling_engine.hpp"

namespace barycert::cli {

/// Takes the blocks of a grid in order. Without a commit() nothing appears.
class GridOutput {
public:
    virtual ~GridOutput() = default;
    virtual Status write(const GridBlock& block) = 0;
    virtual Status commit() = 0;

    /// After the commit of a picture, what became of the values.
    virtual std::optional<SliceCounts> picture() const { return std::nullopt; }
};

/// By the suffix of --output. Errors: a format that cannot hold these fields or that grid; a path that cannot be
/// written.
Result<std::unique_ptr<GridOutput>> open_grid_output(const ResampleArguments& arguments, const SamplingEngine& engine,
                                                     const Grid& grid);

}  // namespace barycert::cli
