/// Points through the sampler, block by block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/map.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
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
                    std::uint64_t first, SampledBlock& block, SampleRun& run);

/// That "point 7" or the like, at `where`, is outside, and none may be.
Error outside_error(const std::string& what, std::span<const double> where, const std::string& file);

/// Adds how many values of rows inside are NaN.
void count_nan(std::span<const Mesh::Index> cells, std::span<const double> values, std::size_t columns,
               std::uint64_t& count);

/// Opens what takes the rows, when the columns are known.
using SinkFactory = std::function<Result<std::unique_ptr<points::Sink>>(const SamplingEngine&)>;

/// The sink of --output as rows.
SinkFactory rows_to_output(const SamplingArguments& arguments);

/// All points of the source into rows and, if `save_map` is not empty, into a map. Tells all of the run but what the
/// engine tells.
Status sample_stream(const SamplingArguments& arguments, SamplingEngine& engine, points::Source& source,
                     const SinkFactory& factory, const std::string& save_map, SampleRun& run, Progress& progress);

/// The rows of a map likewise; the engine is prepared for it.
Status sample_map(const SamplingArguments& arguments, SamplingEngine& engine, MapReader& map,
                  const SinkFactory& factory, SampleRun& run, Progress& progress);

}  // namespace barycert::cli
