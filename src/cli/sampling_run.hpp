/// Points through the sampler, block by block.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "barycert/core/result.hpp"
#include "barycert/points/source.hpp"
#include "barycert/report/sample_run.hpp"
#include "barycert/sample/sample.hpp"
#include "sampling.hpp"
#include "sampling_engine.hpp"

namespace barycert::cli {

/// Points at a time: what memory holds of them at most.
inline constexpr std::size_t block_of_points = std::size_t{1} << 20;

/// Rows of a block of points.
struct SampledBlock {
    std::vector<double> points;  ///< dimension a row
    Samples rows;
};

/// Samples `block.points` into `block.rows`; with run.all, there is a point for each row afterwards. `first`: how many
/// points came before. Adds to the counts of the run. Error besides those of the sampler: the policy is `error`, and a
/// point is outside; it names the point and `file`.
Status sample_block(const SamplingArguments& arguments, const SamplingEngine& engine, const std::string& file,
                    std::uint64_t first, SampledBlock& block, report::SampleRun& run);

/// All points of the source into a.output. Tells all of the run but what the engine tells.
Status sample_stream(const SamplingArguments& arguments, SamplingEngine& engine, points::Source& source,
                     report::SampleRun& run, Progress& progress);

}  // namespace barycert::cli
