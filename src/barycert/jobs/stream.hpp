/// Points through the sampler into rows, block by block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/jobs/engine.hpp"
#include "barycert/jobs/run.hpp"
#include "barycert/map.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// The policy `error` is looked at where the point and its file are known: options without it.
SampleOptions without_refusal(SampleOptions options);

/// That `what` ("point 7"), at `where`, is outside, and none may be.
Error outside_error(const std::string& what, std::span<const double> where, const std::string& file);

/// The first row that the policy `error` refuses.
std::optional<std::size_t> first_outside(const Table& rows);

std::span<const double> point_of(const Table& rows, std::size_t row);

/// How many values of rows inside are NaN.
std::uint64_t count_nan(const TableView& rows);

/// Opens what takes the rows of that format, which is known when the engine is prepared.
using SinkFactory = std::function<Result<std::unique_ptr<TableSink>>(const TableFormat&)>;

/// Rows whose owners are known, to be sampled again: 29 bytes a row in 3D. Cells are those of the locator.
struct KnownRows {
    std::vector<double> points;
    std::vector<Mesh::Index> cells;
    std::vector<Feature> features;
    std::vector<Column> carried;
};

/// Where rows go.
struct StreamTargets {
    SinkFactory rows;            ///< may give nullptr: nowhere
    std::string map = {};        ///< a file, if not empty
    std::string weights = {};    ///< likewise
    KnownRows* known = nullptr;  ///< filled, if not nullptr
};

/// Reading, sampling and writing go on at the same time, block after block; rows come in the order of the points.
///
/// All points of the source into rows. Adds to the summary of the run. Error besides those of its parts: the policy is
/// `error`, and a point is outside; it names the point and the file.
Status sample_stream(Run& run, Engine& engine, PointSource& source, const StreamTargets& targets);

/// The rows of a map likewise; the engine is prepared for it.
Status sample_map(Run& run, Engine& engine, MapReader& map, const StreamTargets& targets);

/// Samples rows whose cells are known. The report counts them already: only NaN values and times are added to it.
Status sample_known(Run& run, Engine& engine, const KnownRows& known, const SinkFactory& factory);

/// That the mesh changes from step to step, and this output is of one mesh.
Error of_one_mesh(const std::string& option, const std::string& path);

/// All steps of the run but the first, each into the output of its name, which `sink_to` opens. Where the mesh has
/// become another one, `locate` finds the points in it; else they are the known ones.
Status sample_further_steps(Run& run, Engine& engine, KnownRows& known,
                            const std::function<SinkFactory(const std::string& output)>& sink_to,
                            const std::function<Status(const StreamTargets&)>& locate);

}  // namespace barycert::jobs
