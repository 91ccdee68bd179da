/// Where the rows of a stream go: into a sink, a map, a matrix of weights, memory.
#pragma once

#include <memory>
#include <optional>

#include "barycert/io/npz/weights_file.hpp"
#include "barycert/jobs/stages.hpp"
#include "barycert/jobs/stream.hpp"
#include "barycert/map.hpp"

namespace barycert::jobs {

class StreamOutput {
public:
    explicit StreamOutput(const StreamTargets& targets) : targets_(targets) {}

    /// When the columns are known; a second call does nothing.
    Status open(const Engine& engine, bool all);

    /// In the working stage, before cells get their names: what else is wanted of the rows.
    Status prepare(const Engine& engine, const SampleOptions& options, Block& block) const;

    Status write(const Block& block);
    Status commit();

private:
    Status write_weights(const NodeWeights& weights, const TableView& rows);

    const StreamTargets& targets_;
    const Mesh* mesh_ = nullptr;
    bool opened_ = false;
    std::unique_ptr<TableSink> sink_;
    std::optional<MapWriter> map_;
    std::unique_ptr<io::WeightsFile> weights_;
};

}  // namespace barycert::jobs
