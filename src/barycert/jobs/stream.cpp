#include "barycert/jobs/stream.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io/npz/weights_file.hpp"
#include "barycert/jobs/stages.hpp"
#include "barycert/map.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::jobs {
namespace {

/// Rows whose owners are known, to be sampled again: 29 bytes a row in 3D. Cells are those of the locator.
RowSource rows_again(const std::vector<Table>& known) {
    const auto read = [&known, next = std::size_t{0}](std::size_t, Block& block) mutable -> Status {
        block.size = next == known.size() ? 0 : known[next].row_count();
        if (block.size != 0) block.rows = known[next++];
        return Done{};
    };
    return {.located = true, .counted = true, .read = read};
}

/// What rows go into. A map and weights: a file, if not empty; `known`: filled, if not nullptr.
struct Targets {
    std::string path, map = {}, weights = {};
    std::vector<Table>* known = nullptr;
};

/// The rows of one mesh and step.
class RowStream {
public:
    RowStream(SampledMesh& mesh, const RowSource& source, const OpenRows& open, Targets targets)
        : mesh_(mesh),
          source_(source),
          open_(open),
          targets_(std::move(targets)),
          options_(without_refusal(mesh.job.options)) {
        options_.threads = 1;  // blocks go side by side
    }

    Status go() {
        const int threads = mesh_.job.options.threads;
        size_ = block_size(source_.count, threads, 0);
        std::optional<Block> first;
        if (!source_.located) {
            if (Status found = prepare(first.emplace(), threads); !found) return found;
        }
        Stopwatch watch;
        if (Status opened = open(); !opened) return opened;
        seconds_.write += watch.lap();
        if (targets_.weights.empty()) mesh_.let_go_of_mesh();
        Status done = in_stages<Block>(
            threads, std::move(first), [&](Block& block) { return read(block); },
            [&](Block& block) { return work(block); }, [&](Block& block) { return write(block); }, seconds_.sample);
        watch.lap();
        if (done && map_) done = map_->commit();
        if (done && weights_) done = weights_->commit();
        if (done && sink_) done = sink_->commit();
        seconds_.write += watch.lap();
        return done;
    }

private:
    /// The first block tells how to find its points, and all others.
    Status prepare(Block& first, int threads) {
        if (Status taken = read(first); !taken) return taken;
        Status ready = more_ ? mesh_.prepare() : mesh_.prepare_for_all(first.rows.points);
        if (!ready) return ready;
        const locate::LocatorData& data = locate::LocatorData::of(mesh_.locator());
        size_ = block_size(source_.count, threads, data.index.cell_count());
        // What pays for all points would not for one block.
        base::in_arena(threads, data.index.cell_count(),
                       [&] { data.prepare(std::max<std::uint64_t>(source_.count.value_or(0), taken_)); });
        return Done{};
    }

    Status open() {
        Status opened = into(sink_, open_(mesh_.format(), targets_.path));
        if (opened && !targets_.map.empty())
            opened = into(map_, MapWriter::open(targets_.map, mesh_.mesh(), mesh_.report.all));
        if (opened && !targets_.weights.empty())
            opened = into(weights_, io::WeightsFile::open(targets_.weights, mesh_.mesh().point_count()));
        return opened;
    }

    Status read(Block& block) {
        Stopwatch watch;
        block.first = taken_;
        block.size = 0;
        if (!more_) return Done{};
        Status read = source_.read(size_, block);
        seconds_.read += watch.lap();
        if (!read) return read;
        taken_ += block.size;
        // A map is read to its end, where it may have too much.
        more_ = source_.located || (block.size == size_ && source_.count != taken_);
        block.last = !more_;
        return Done{};
    }

    Status work(Block& block) const {
        Table& rows = block.rows;
        if (source_.located) look_outside(block);
        if (source_.located && block.outside) return Done{};
        Status sampled = source_.located    ? mesh_.sampler().evaluate(rows.points, options_, rows, block.first)
                         : mesh_.report.all ? sample_all(rows)
                                            : mesh_.sampler().sample(rows.points, options_, rows, block.first);
        if (!sampled) return sampled;
        if (block.locations) rows.counts.locations = *block.locations;
        if (targets_.known != nullptr) block.located = rows.cells;
        if (weights_) {
            if (Status weighed = into(block.weights, mesh_.weights_of(rows.view())); !weighed) return weighed;
        }
        mesh_.name_cells(rows);
        if (!source_.located) look_outside(block);
        block.nan_values = count_nan(rows.view());
        return Done{};
    }

    /// Each cell that holds a point has a row.
    Status sample_all(Table& rows) const {
        Result<Table> all = mesh_.locator().locate_all(rows.points, options_.threads, options_.nonfinite_points);
        if (!all) return all.error();
        for (const Column& column : rows.carried) all->carried.push_back(mesh::repeated(column, all->point_begin));
        rows = std::move(*all);
        const LocationCounts locations = rows.counts.locations;
        Status done = mesh_.sampler().evaluate(rows.points, options_, rows);
        rows.counts.locations = locations;
        return done;
    }

    void look_outside(Block& block) const {
        block.outside.reset();
        if (mesh_.job.options.outside.kind != Outside::error) return;
        const Table& rows = block.rows;
        block.outside = locate::first_outside(rows.cells, rows.points, static_cast<std::size_t>(rows.dimension));
    }

    Error refused(const Block& block) const {
        const Table& rows = block.rows;
        const auto& begin = rows.point_begin;
        const std::size_t row = *block.outside, d = static_cast<std::size_t>(rows.dimension);
        const std::size_t point =
            begin.empty()
                ? row
                : static_cast<std::size_t>(std::upper_bound(begin.begin(), begin.end(), row) - begin.begin()) - 1;
        return outside_error((source_.located ? "row " : "point ") + std::to_string(block.first + point),
                             std::span(rows.points).subspan(d * row, d), mesh_.report.points);
    }

    Status write(const Block& block) {
        Stopwatch time;
        if (block.outside) return refused(block);
        const TableView rows = block.rows.view();
        if (!source_.counted) {
            mesh_.report.counts.add(block.rows.counts);
            mesh_.report.rows += rows.row_count();
        }
        mesh_.report.nan_values += block.nan_values;
        Status written = map_ ? map_->write(rows) : Status(Done{});
        if (written && weights_) written = write_weights(block.weights, rows);
        if (written && targets_.known != nullptr) {
            Table& known = targets_.known->emplace_back();
            known.dimension = block.rows.dimension;
            known.points = block.rows.points;
            known.cells = block.located;
            known.features = block.rows.features;
            known.carried = block.rows.carried;
        }
        if (written && sink_) written = sink_->write(rows);
        seconds_.write += time.lap();
        if (written && !block.last) mesh_.tell(source_.located ? "rows" : "points", block.first + block.size);
        return written;
    }

    Status write_weights(const NodeWeights& weights, const TableView& rows) {
        std::vector<std::uint8_t> counts(weights.row_count());
        for (std::size_t i = 0; i < counts.size(); ++i)
            counts[i] = static_cast<std::uint8_t>(weights.begin[i + 1] - weights.begin[i]);
        // The cells as users know them.
        std::vector<Mesh::Index> cells(rows.cells.begin(), rows.cells.end());
        for (Mesh::Index& cell : cells) cell = mesh_.mesh().cell_number(cell);
        return weights_->write(counts, weights.nodes, weights.weights, cells);
    }

    SampledMesh& mesh_;
    const RowSource& source_;
    const OpenRows& open_;
    Targets targets_;
    SampleOptions options_;
    SampleSeconds& seconds_ = mesh_.report.seconds;
    std::uint64_t taken_ = 0;
    std::size_t size_ = 0;
    bool more_ = true;
    std::unique_ptr<TableSink> sink_;
    std::optional<MapWriter> map_;
    std::unique_ptr<io::WeightsFile> weights_;
};

}  // namespace

RowSource rows_of_points(std::unique_ptr<PointSource>& points) {
    const auto read = [&points](std::size_t most, Block& block) -> Status {
        block.rows.dimension = points->dimension();
        block.rows.points.clear();
        const Result<std::size_t> count = points->read(most, block.rows.points);
        if (!count) return count.error();
        points->take_carried(block.rows.carried);
        block.size = *count;
        return Done{};
    };
    return {.count = points->count(), .read = read};
}

Status sample_rows(SampledMesh& mesh, const RowSource& source, const OpenRows& open, const std::string& map) {
    const bool further = mesh.step_by_step() && mesh.steps.size() > 1;
    const std::string& weights = mesh.job.weights;
    if (further && !(weights.empty() && map.empty())) {
        Status same =
            weights.empty() ? mesh.check_one_mesh(map, "job.save_map") : mesh.check_one_mesh(weights, "job.weights");
        if (!same) return same;
    }
    std::vector<Table> known;
    return mesh.for_outputs([&](const std::string& output, bool first, bool anew) -> Status {
        Targets targets{output};
        if (first) targets.map = map, targets.weights = weights;
        if (anew && further) targets.known = &known;
        if (anew) known.clear();
        if (Status ready = anew && !first ? source.begin_again(mesh) : Status(Done{}); !ready) return ready;
        const RowSource again = rows_again(known);
        return RowStream(mesh, anew ? source : again, open, targets).go();
    });
}

SampleOptions without_refusal(SampleOptions options) {
    if (options.outside.kind == Outside::error) options.outside = {};
    return options;
}

Error outside_error(const std::string& what, std::span<const double> where, const std::string& file) {
    std::string at;
    for (const double x : where) at += (at.empty() ? "(" : ", ") + base::shortest(x);
    return refusal(file, what + ", counted from 0, is outside the mesh", "", at + ")",
                   "choose what points outside get: job.outside nan, fill=V, nearest or extrapolate");
}

std::uint64_t count_nan(const TableView& rows) {
    if (rows.row_count() == 0 || base::all_finite(rows.values)) return 0;
    const std::size_t columns = rows.values.size() / rows.row_count();
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        if (rows.cells[i] < 0) continue;
        for (std::size_t c = 0; c < columns; ++c) count += std::isnan(rows.values[columns * i + c]) ? 1 : 0;
    }
    return count;
}

}  // namespace barycert::jobs
