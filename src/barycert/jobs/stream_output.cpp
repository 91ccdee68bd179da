#include "barycert/jobs/stream_output.hpp"

#include <utility>
#include <vector>

#include "barycert/mesh/columns.hpp"
#include "barycert/sampler.hpp"

namespace barycert::jobs {

Status StreamOutput::open(const Engine& engine, bool all) {
    if (opened_) return Done{};
    auto sink = targets_.rows(engine.format());
    if (!sink) return sink.error();
    if (!targets_.map.empty()) {
        auto map = MapWriter::open(targets_.map, engine.mesh(), all);
        if (!map) return map.error();
        map_.emplace(std::move(*map));
    }
    if (!targets_.weights.empty()) {
        auto weights = io::WeightsFile::open(targets_.weights, engine.mesh().point_count());
        if (!weights) return weights.error();
        weights_ = std::move(*weights);
    }
    sink_ = std::move(*sink);
    mesh_ = &engine.mesh();
    opened_ = true;
    return Done{};
}

Status StreamOutput::prepare(const Engine& engine, const SampleOptions& options, Block& block) const {
    if (targets_.known != nullptr) block.located = block.rows.cells;
    if (targets_.weights.empty()) return Done{};
    Result<NodeWeights> weights = engine.weights_of(block.rows.view(), options.outside);
    if (!weights) return weights.error();
    block.weights = std::move(*weights);
    return Done{};
}

Status StreamOutput::write(const Block& block) {
    const TableView rows = block.rows.view();
    if (map_) {
        if (Status written = map_->write(rows); !written) return written;
    }
    if (weights_) {
        if (Status written = write_weights(block.weights, rows); !written) return written;
    }
    if (KnownRows* const known = targets_.known) {
        known->points.insert(known->points.end(), rows.points.begin(), rows.points.end());
        known->cells.insert(known->cells.end(), block.located.begin(), block.located.end());
        known->features.insert(known->features.end(), rows.features.begin(), rows.features.end());
        mesh::append(rows.carried, known->carried);
    }
    return sink_ ? sink_->write(rows) : Status(Done{});
}

Status StreamOutput::commit() {
    if (map_) {
        if (Status done = map_->commit(); !done) return done;
    }
    if (weights_) {
        if (Status done = weights_->commit(); !done) return done;
    }
    return sink_ ? sink_->commit() : Status(Done{});
}

Status StreamOutput::write_weights(const NodeWeights& weights, const TableView& rows) {
    std::vector<std::uint8_t> counts(weights.row_count());
    for (std::size_t i = 0; i < counts.size(); ++i)
        counts[i] = static_cast<std::uint8_t>(weights.begin[i + 1] - weights.begin[i]);
    // The cells as users know them.
    std::vector<Mesh::Index> cells(rows.cells.begin(), rows.cells.end());
    for (Mesh::Index& cell : cells) cell = mesh_->cell_number(cell);
    return weights_->write(counts, weights.nodes, weights.weights, cells);
}

}  // namespace barycert::jobs
