/// The parts of `barycert resample`.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "sampling.hpp"
#include "sampling_engine.hpp"

namespace barycert::cli {

struct ResampleArguments : SamplingArguments {
    std::vector<std::int64_t> counts;  ///< of --grid
    std::vector<double> spacing;       ///< of --spacing: one for all axes, or one each
    std::vector<double> bounds;        ///< low and high, axis after axis; empty: the box of the cells
    std::string onto;
    std::optional<std::array<double, 2>> range;  ///< of the colours of a picture
};

/// What is wrong with the output of a grid, as far as its name and the fields tell.
Status check_grid_output(const ResampleArguments& arguments);

/// The fields at the points of a grid. Tells all of the run but what the engine tells.
Status resample_grid(const ResampleArguments& arguments, SamplingEngine& engine, SampleRun& run, Progress& progress);

/// The files that --onto writes; what is wrong with the output, as far as its name tells.
std::vector<std::string> files_of_onto(const ResampleArguments& arguments);
Status check_onto_output(const ResampleArguments& arguments);

/// The fields at the nodes of another mesh, likewise.
Status resample_onto(const ResampleArguments& arguments, SamplingEngine& engine, SampleRun& run, Progress& progress);

}  // namespace barycert::cli
