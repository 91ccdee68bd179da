#include "barycert/jobs/stream.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "barycert/base/arena.hpp"
#include "barycert/base/finite.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/npz/weights_file.hpp"
#include "barycert/jobs/stages.hpp"
#include "barycert/map.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::jobs {
namespace {

/// Rows whose owners are known, to be sampled again: 29 bytes a row in 3D. Cells are those of the locator. The report
/// counts them already.
class KnownRows final : public RowSource {
public:
    explicit KnownRows(int dimension) : d_(static_cast<std::size_t>(dimension)) {}

    void add(const Block& block) {
        const Table& rows = block.rows;
        points_.insert(points_.end(), rows.points.begin(), rows.points.end());
        cells_.insert(cells_.end(), block.located.begin(), block.located.end());
        features_.insert(features_.end(), rows.features.begin(), rows.features.end());
        mesh::append(rows.carried, carried_);
    }
    void forget() { *this = KnownRows(static_cast<int>(d_)); }

    bool located() const override { return true; }
    std::optional<std::uint64_t> count() const override { return cells_.size(); }
    Status read(std::size_t most, Block& block) override {
        const std::size_t begin = taken_, end = std::min(begin + most, cells_.size());
        const auto part = [&](const auto& all, std::size_t per_row, auto& out) {
            out.assign(all.data() + per_row * begin, all.data() + per_row * end);
        };
        block.rows.dimension = static_cast<int>(d_);
        part(points_, d_, block.rows.points);
        part(cells_, 1, block.rows.cells);
        part(features_, 1, block.rows.features);
        block.rows.carried.clear();
        for (const Column& column : carried_) block.rows.carried.push_back(mesh::part_of(column, begin, end));
        block.size = end - begin;
        taken_ = end;
        return Done{};
    }
    Status begin_again(const SampledMesh&) override {
        taken_ = 0;
        return Done{};
    }
    void count(const Block&, SampleReport&) override {}

private:
    std::size_t d_, taken_ = 0;
    std::vector<double> points_;
    std::vector<Mesh::Index> cells_;
    std::vector<Feature> features_;
    std::vector<Column> carried_;
};

/// What rows go into. A map and weights: a file, if not empty; `known`: filled, if not nullptr.
struct Targets {
    RowsOutput* rows;
    std::string path, map, weights;
    KnownRows* known = nullptr;
};

/// The rows of one mesh and step.
class RowStream final : Stages<Block> {
public:
    RowStream(SampledMesh& mesh, RowSource& source, Targets targets)
        : mesh_(mesh), source_(source), targets_(std::move(targets)), options_(without_refusal(mesh.job.options)) {
        options_.threads = 1;  // blocks go side by side
    }

    Status go() {
        const int threads = mesh_.job.options.threads;
        size_ = block_size(source_.count(), threads, 0);
        if (!source_.located()) {
            if (Status found = prepare(threads); !found) return found;
        }
        Stopwatch watch;
        if (Status opened = open(); !opened) return opened;
        seconds_of_report().write += watch.lap();
        if (targets_.weights.empty()) mesh_.let_go_of_mesh();
        Status done = run(threads);
        seconds_of_report().sample += seconds();
        if (!done) return done;
        watch.lap();
        Status committed = commit();
        seconds_of_report().write += watch.lap();
        return committed;
    }

private:
    SampleSeconds& seconds_of_report() { return mesh_.report.seconds; }

    /// The first block tells how to find its points, and all others.
    Status prepare(int threads) {
        if (Status taken = read_first(); !taken) return taken;
        Status ready = more_ ? mesh_.prepare() : mesh_.prepare_for_all(first().rows.points);
        if (!ready) return ready;
        const locate::LocatorData& data = locate::LocatorData::of(mesh_.locator());
        size_ = block_size(source_.count(), threads, data.index.cell_count());
        // What pays for all points would not for one block.
        base::in_arena(threads, data.index.cell_count(),
                       [&] { data.prepare(std::max<std::uint64_t>(source_.count().value_or(0), taken_)); });
        return Done{};
    }

    Status open() {
        auto sink = targets_.rows->open(mesh_.format(), targets_.path);
        if (!sink) return sink.error();
        if (!targets_.map.empty()) {
            auto map = MapWriter::open(targets_.map, mesh_.mesh(), mesh_.report.all);
            if (!map) return map.error();
            map_.emplace(std::move(*map));
        }
        if (!targets_.weights.empty()) {
            auto weights = io::WeightsFile::open(targets_.weights, mesh_.mesh().point_count());
            if (!weights) return weights.error();
            weights_ = std::move(*weights);
        }
        sink_ = std::move(*sink);
        return Done{};
    }

    Status read(Block& block) override {
        Stopwatch watch;
        block.first = taken_;
        block.size = 0;
        if (!more_) return Done{};
        Status read = source_.read(size_, block);
        seconds_of_report().read += watch.lap();
        if (!read) return read;
        taken_ += block.size;
        // A map is read to its end, where it may have too much.
        more_ = source_.located() || (block.size == size_ && source_.count() != taken_);
        block.last = !more_;
        return Done{};
    }

    Status work(Block& block) const override {
        Table& rows = block.rows;
        if (source_.located()) look_outside(block);
        if (block.outside && source_.located()) return Done{};
        Status sampled = source_.located()  ? mesh_.sampler().evaluate(rows.points, options_, rows, block.first)
                         : mesh_.report.all ? sample_all(rows)
                                            : mesh_.sampler().sample(rows.points, options_, rows, block.first);
        if (!sampled) return sampled;
        if (targets_.known != nullptr) block.located = rows.cells;
        if (weights_) {
            Result<NodeWeights> weights = mesh_.weights_of(rows.view());
            if (!weights) return weights.error();
            block.weights = std::move(*weights);
        }
        mesh_.name_cells(rows);
        if (!source_.located()) look_outside(block);
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
        if (Status done = mesh_.sampler().evaluate(rows.points, options_, rows); !done) return done;
        rows.counts.locations = locations;
        return Done{};
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
        return outside_error((source_.located() ? "row " : "point ") + std::to_string(block.first + point),
                             std::span(rows.points).subspan(d * row, d), mesh_.report.points);
    }

    Status write(Block& block) override {
        Stopwatch time;
        if (block.outside) return refused(block);
        source_.count(block, mesh_.report);
        mesh_.report.nan_values += block.nan_values;
        Status written = write_rows(block);
        seconds_of_report().write += time.lap();
        if (written && !block.last) mesh_.tell(source_.located() ? "rows" : "points", block.first + block.size);
        return written;
    }

    Status write_rows(const Block& block) {
        const TableView rows = block.rows.view();
        if (map_) {
            if (Status written = map_->write(rows); !written) return written;
        }
        if (weights_) {
            if (Status written = write_weights(block.weights, rows); !written) return written;
        }
        if (targets_.known != nullptr) targets_.known->add(block);
        return sink_ ? sink_->write(rows) : Status(Done{});
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

    Status commit() {
        Status done = map_ ? map_->commit() : Status(Done{});
        if (done && weights_) done = weights_->commit();
        return done && sink_ ? sink_->commit() : done;
    }

    SampledMesh& mesh_;
    RowSource& source_;
    Targets targets_;
    SampleOptions options_;
    std::uint64_t taken_ = 0;
    std::size_t size_ = 0;
    bool more_ = true;
    std::unique_ptr<TableSink> sink_;
    std::optional<MapWriter> map_;
    std::unique_ptr<io::WeightsFile> weights_;
};

Error of_one_mesh(const std::string& member, const std::string& path) {
    return {.what = "the mesh changes from step to step, and " + member + " is of one mesh",
            .file = path,
            .remedy = "choose one step: job.step N"};
}

}  // namespace

Status PointRows::read(std::size_t most, Block& block) {
    block.rows.dimension = points_->dimension();
    block.rows.points.clear();
    const Result<std::size_t> count = points_->read(most, block.rows.points);
    if (!count) return count.error();
    points_->take_carried(block.rows.carried);
    block.size = *count;
    return Done{};
}

void PointRows::count(const Block& block, SampleReport& report) {
    report.counts.add(block.rows.counts);
    report.rows += block.rows.row_count();
}

Status sample_rows(SampledMesh& mesh, RowSource& source, RowsOutput& output, const std::string& map) {
    const SamplingJob& job = mesh.job;
    const bool by_step = mesh.step_by_step(), further = by_step && mesh.steps.size() > 1;
    KnownRows known(mesh.mesh().dimension);
    Targets targets{&output, by_step ? output_of_step(job.output, mesh.steps.front()) : job.output, map, job.weights,
                    further ? &known : nullptr};
    if (Status done = RowStream(mesh, source, targets).go(); !done) return done;
    for (std::size_t i = 1; further && i < mesh.steps.size(); ++i) {
        mesh.tell("steps", i);
        if (Status ready = mesh.go_to(mesh.steps[i]); !ready) return ready;
        const bool anew = mesh.is_another_mesh();
        if (anew && !job.weights.empty()) return of_one_mesh("job.weights", job.weights);
        if (anew && !map.empty()) return of_one_mesh("job.save_map", map);
        if (anew) known.forget();
        RowSource& from = anew ? source : known;
        if (Status ready = from.begin_again(mesh); !ready) return ready;
        targets = {&output, output_of_step(job.output, mesh.steps[i]), "", "", anew ? &known : nullptr};
        if (Status done = RowStream(mesh, from, std::move(targets)).go(); !done) return done;
    }
    return Done{};
}

SampleOptions without_refusal(SampleOptions options) {
    if (options.outside.kind == Outside::error) options.outside = {};
    return options;
}

Error outside_error(const std::string& what, std::span<const double> where, const std::string& file) {
    std::string at;
    for (const double x : where) at += (at.empty() ? "(" : ", ") + base::shortest(x);
    return {.what = what + ", counted from 0, is outside the mesh",
            .file = file,
            .found = at + ")",
            .remedy = "choose what points outside get: job.outside nan, fill=V, nearest or extrapolate"};
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
