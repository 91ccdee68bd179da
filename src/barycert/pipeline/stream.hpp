/// Points through the sampler into rows, block by block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "barycert/io.hpp"
#include "barycert/map.hpp"
#include "barycert/pipeline/engine.hpp"
#include "barycert/pipeline/run.hpp"
#include "barycert/result.hpp"

namespace barycert::pipeline {

/// The policy `error` is looked at where the point and its file are known: options without it.
SampleOptions without_refusal(SampleOptions options);

/// That `what` ("point 7"), at `where`, is outside, and none may be.
Error outside_error(const std::string& what, std::span<const double> where, const std::string& file);

/// How many values of rows inside are NaN.
std::uint64_t count_nan(const TableView& rows);

/// Opens what takes the rows of that format, which is known when the engine is prepared.
using SinkFactory = std::function<Result<std::unique_ptr<TableSink>>(const TableFormat&)>;

/// Reading, sampling and writing go on at the same time, block after block; rows come in the order of the points.
///
/// All points of the source into rows and, if `save_map` is not empty, into a map. Adds to the summary of the run.
/// Error besides those of its parts: the policy is `error`, and a point is outside; it names the point and the file.
Status sample_stream(Run& run, Engine& engine, PointSource& source, const SinkFactory& factory,
                     const std::string& save_map);

/// The rows of a map likewise; the engine is prepared for it.
Status sample_map(Run& run, Engine& engine, MapReader& map, const SinkFactory& factory);

}  // namespace barycert::pipeline
