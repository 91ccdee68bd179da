#include "barycert/pipeline/stream.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "barycert/base/finite.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/npz/weights_file.hpp"
#include "barycert/locate/batch.hpp"
#include "barycert/mesh/columns.hpp"
#include "barycert/node_weights.hpp"
#include "barycert/pipeline/stages.hpp"

namespace barycert::pipeline {
namespace {

std::optional<std::size_t> first_outside(std::span<const Mesh::Index> cells) {
    const auto it = std::find(cells.begin(), cells.end(), -1);
    if (it == cells.end()) return std::nullopt;
    return static_cast<std::size_t>(it - cells.begin());
}

std::span<const double> point_of(const Table& rows, std::size_t row) {
    const auto d = static_cast<std::size_t>(rows.dimension);
    return std::span(rows.points).subspan(d * row, d);
}

/// Adds the values of columns to those of columns of the same formats, which are made where there are none.
void append(std::span<const Column> columns, std::vector<Column>& to) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (i == to.size()) to.push_back(empty_column({columns[i].name, columns[i].type()}));
        std::visit(
            [&](auto& values) {
                const auto& more = std::get<std::decay_t<decltype(values)>>(columns[i].values);
                values.insert(values.end(), more.begin(), more.end());
            },
            to[i].values);
    }
}

/// Values [begin, end) of a column.
Column part_of(const Column& column, std::size_t begin, std::size_t end) {
    return std::visit(
        [&](const auto& values) {
            const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
            return Column{column.name,
                          std::decay_t<decltype(values)>(first, first + static_cast<std::ptrdiff_t>(end - begin))};
        },
        column.values);
}

/// Where rows go: into a sink, a map, a matrix of weights, memory.
class StreamOutput {
public:
    explicit StreamOutput(const StreamTargets& targets) : targets_(targets) {}

    /// When the columns are known; a second call does nothing.
    Status open(const Engine& engine, bool all) {
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

    /// In the working stage, before cells get their names: what else is wanted of the rows.
    Status prepare(const Engine& engine, const SampleOptions& options, Block& block) const {
        if (targets_.known != nullptr) block.located = block.rows.cells;
        if (targets_.weights.empty()) return Done{};
        Result<NodeWeights> weights = engine.weights_of(block.rows.view(), options.outside);
        if (!weights) return weights.error();
        block.weights = std::move(*weights);
        return Done{};
    }

    Status write(const Block& block) {
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
            append(rows.carried, known->carried);
        }
        return sink_ ? sink_->write(rows) : Status(Done{});
    }
    Status commit() {
        if (map_) {
            if (Status done = map_->commit(); !done) return done;
        }
        if (weights_) {
            if (Status done = weights_->commit(); !done) return done;
        }
        return sink_ ? sink_->commit() : Status(Done{});
    }

private:
    Status write_weights(const NodeWeights& weights, const TableView& rows) {
        std::vector<std::uint8_t> counts(weights.row_count());
        for (std::size_t i = 0; i < counts.size(); ++i)
            counts[i] = static_cast<std::uint8_t>(weights.begin[i + 1] - weights.begin[i]);
        // The cells as users know them.
        std::vector<Mesh::Index> cells(rows.cells.begin(), rows.cells.end());
        for (Mesh::Index& cell : cells) cell = mesh_->cell_number(cell);
        weights_->write(counts, weights.nodes, weights.weights, cells);
        return weights_->status();
    }

    const StreamTargets& targets_;
    const Mesh* mesh_ = nullptr;
    bool opened_ = false;
    std::unique_ptr<TableSink> sink_;
    std::optional<MapWriter> map_;
    std::unique_ptr<io::WeightsFile> weights_;
};

/// Which rows of a map begin a point. Those of one point follow one another, their cells ascending.
class PointsOfRows {
public:
    void count(const TableView& rows, LocationCounts& counts) {
        const auto d = static_cast<std::size_t>(rows.dimension);
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            const double* const at = rows.points.data() + d * i;
            const bool same = cell_ >= 0 && rows.cells[i] > cell_ && std::equal(at, at + d, at_.begin());
            if (!same) counts.add(rows.features[i]);
            std::copy(at, at + d, at_.begin());
            cell_ = rows.cells[i];
        }
    }

private:
    Mesh::Index cell_ = -1;
    std::array<double, 3> at_{};
};

/// Samples rows.points; with `all`, each cell that holds a point has a row afterwards.
Status sample_block(const Run& run, const Engine& engine, Block& block) {
    SampleOptions options = without_refusal(run.job.options);
    options.threads = 1;  // blocks go side by side
    Table& rows = block.rows;
    if (run.summary.all) {
        Result<Table> all = engine.locator().locate_all(rows.points, options.threads);
        if (!all) return all.error();
        for (const Column& column : rows.carried) all->carried.push_back(mesh::repeated(column, all->point_begin));
        rows = std::move(*all);
        const LocationCounts locations = rows.counts.locations;
        if (Status done = engine.sampler().evaluate(rows.points, options, rows); !done) return done;
        rows.counts.locations = locations;
        return Done{};
    }
    return engine.sampler().sample(rows.points, options, rows, block.first);
}

}  // namespace

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
            .remedy = "choose what points outside get: --outside nan, fill=V, nearest or extrapolate"};
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

Status sample_stream(Run& run, Engine& engine, PointSource& source, const StreamTargets& targets) {
    SampleSummary& summary = run.summary;
    SampleSeconds& seconds = summary.seconds;
    const bool refuse = run.job.options.outside.kind == Outside::error;
    StreamOutput writer(targets);
    std::uint64_t taken = 0;
    std::size_t size = 0;
    bool more = true;
    const auto read_next = [&](Block& block) -> Status {
        Stopwatch watch;
        block.rows.dimension = source.dimension();
        block.rows.points.clear();
        block.first = taken;
        block.size = 0;
        if (!more) return Done{};
        const Result<std::size_t> count = source.read(size, block.rows.points);
        seconds.read += watch.lap();
        if (!count) return count.error();
        source.take_carried(block.rows.carried);
        taken += *count;
        more = *count == size && source.count() != taken;
        block.size = *count;
        block.last = !more;
        return Done{};
    };
    // The first block tells how to go on.
    Block first;
    const int threads = run.job.options.threads;
    locate::in_arena(threads, [&] { size = block_size(source.count()); });
    if (Status read = read_next(first); !read) return read;
    Status ready = more ? engine.prepare() : engine.prepare_for_all(first.rows.points);
    if (!ready) return ready;
    // What pays for all points would not for one block.
    locate::in_arena(
        threads, [&] { engine.locator().data().prepare(std::max<std::uint64_t>(source.count().value_or(0), taken)); });
    Stopwatch watch;
    if (Status opened = writer.open(engine, summary.all); !opened) return opened;
    seconds.write += watch.lap();
    if (targets.weights.empty()) engine.let_go_of_mesh();

    bool begun = false;
    const auto read = [&](Block& block) -> Status {
        if (begun) return read_next(block);
        begun = true;
        block = std::move(first);
        return Done{};
    };
    const auto work = [&](Block& block) -> Status {
        if (Status sampled = sample_block(run, engine, block); !sampled) return sampled;
        if (Status done = writer.prepare(engine, run.job.options, block); !done) return done;
        engine.name_cells(block.rows);
        block.outside = refuse ? first_outside(block.rows.cells) : std::nullopt;
        block.nan_values = count_nan(block.rows.view());
        return Done{};
    };
    double sampling = 0;
    const auto write = [&](Block& block) -> Status {
        Stopwatch time;
        const Table& rows = block.rows;
        if (block.outside) {
            const auto& begin = rows.point_begin;
            const std::size_t row = *block.outside;
            const std::size_t point =
                summary.all
                    ? static_cast<std::size_t>(std::upper_bound(begin.begin(), begin.end(), row) - begin.begin()) - 1
                    : row;
            return outside_error("point " + std::to_string(block.first + point), point_of(rows, row), summary.points);
        }
        summary.counts.add(rows.counts);
        summary.rows += rows.row_count();
        summary.nan_values += block.nan_values;
        sampling += block.seconds;
        Status written = writer.write(block);
        seconds.write += time.lap();
        if (written && !block.last) run.count("points", block.first + block.size);
        return written;
    };
    Status done = Done{};
    locate::in_arena(threads, [&] {
        Stages stages;
        done = stages.run(read, work, write);
        sampling /= tbb::this_task_arena::max_concurrency();
    });
    seconds.sample += sampling;
    if (!done) return done;
    watch.lap();
    Status committed = writer.commit();
    seconds.write += watch.lap();
    return committed;
}

Status sample_map(Run& run, Engine& engine, MapReader& map, const StreamTargets& targets) {
    SampleSummary& summary = run.summary;
    SampleSeconds& seconds = summary.seconds;
    SampleOptions options = without_refusal(run.job.options);
    options.threads = 1;
    const bool refuse = run.job.options.outside.kind == Outside::error;
    StreamOutput writer(targets);
    if (Status opened = writer.open(engine, map.all()); !opened) return opened;
    if (targets.weights.empty()) engine.let_go_of_mesh();
    PointsOfRows points;
    LocationCounts locations;
    std::uint64_t taken = 0;
    std::size_t size = 0;
    const auto read = [&](Block& block) -> Status {
        Stopwatch watch;
        const Result<std::size_t> count = map.read(size, block.rows);
        seconds.read += watch.lap();
        if (!count) return count.error();
        block.first = taken;
        block.size = *count;
        taken += *count;
        return Done{};
    };
    const auto work = [&](Block& block) -> Status {
        block.outside = refuse ? first_outside(block.rows.cells) : std::nullopt;
        if (block.outside) return Done{};
        if (Status done = engine.sampler().evaluate(block.rows.points, options, block.rows, block.first); !done)
            return done;
        block.nan_values = count_nan(block.rows.view());
        return writer.prepare(engine, run.job.options, block);
    };
    double sampling = 0;
    const auto write = [&](Block& block) -> Status {
        Stopwatch watch;
        if (block.outside)
            return outside_error("row " + std::to_string(block.first + *block.outside),
                                 point_of(block.rows, *block.outside), summary.points);
        summary.counts.add(block.rows.counts);
        points.count(block.rows.view(), locations);
        summary.nan_values += block.nan_values;
        summary.rows += block.size;
        sampling += block.seconds;
        Status written = writer.write(block);
        seconds.write += watch.lap();
        if (written) run.count("rows", summary.rows);
        return written;
    };
    Status done = Done{};
    locate::in_arena(run.job.options.threads, [&] {
        size = block_size(map.rows());
        Stages stages;
        done = stages.run(read, work, write);
        sampling /= tbb::this_task_arena::max_concurrency();
    });
    seconds.sample += sampling;
    if (!done) return done;
    summary.counts.locations = locations;
    Stopwatch watch;
    Status committed = writer.commit();
    seconds.write += watch.lap();
    return committed;
}

Status sample_known(Run& run, Engine& engine, const KnownRows& known, const SinkFactory& factory) {
    SampleSeconds& seconds = run.summary.seconds;
    SampleOptions options = without_refusal(run.job.options);
    options.threads = 1;
    const auto d = static_cast<std::size_t>(engine.mesh().dimension);
    Stopwatch watch;
    auto sink = factory(engine.format());
    if (!sink) return sink.error();
    seconds.write += watch.lap();
    std::size_t taken = 0, size = 0;
    const auto read = [&](Block& block) -> Status {
        const std::size_t begin = taken, end = std::min(begin + size, known.cells.size());
        const auto part = [&](const auto& all, std::size_t per_row, auto& out) {
            out.assign(all.data() + per_row * begin, all.data() + per_row * end);
        };
        block.rows.dimension = static_cast<int>(d);
        part(known.points, d, block.rows.points);
        part(known.cells, 1, block.rows.cells);
        part(known.features, 1, block.rows.features);
        block.rows.carried.clear();
        for (const Column& column : known.carried) block.rows.carried.push_back(part_of(column, begin, end));
        block.first = begin;
        block.size = end - begin;
        taken = end;
        return Done{};
    };
    const auto work = [&](Block& block) -> Status {
        if (Status done = engine.sampler().evaluate(block.rows.points, options, block.rows, block.first); !done)
            return done;
        engine.name_cells(block.rows);
        block.nan_values = count_nan(block.rows.view());
        return Done{};
    };
    double sampling = 0;
    const auto write = [&](Block& block) -> Status {
        Stopwatch time;
        run.summary.nan_values += block.nan_values;
        sampling += block.seconds;
        Status written = (*sink)->write(block.rows.view());
        seconds.write += time.lap();
        return written;
    };
    Status done = Done{};
    locate::in_arena(run.job.options.threads, [&] {
        size = block_size(known.cells.size());
        Stages stages;
        done = stages.run(read, work, write);
        sampling /= tbb::this_task_arena::max_concurrency();
    });
    seconds.sample += sampling;
    if (!done) return done;
    watch.lap();
    Status committed = (*sink)->commit();
    seconds.write += watch.lap();
    return committed;
}

Status sample_further_steps(Run& run, Engine& engine, const KnownRows& known,
                            const std::function<SinkFactory(const std::string& output)>& sink_to) {
    for (std::size_t i = 1; i < run.steps.size(); ++i) {
        run.count("steps", i);
        if (Status ready = engine.go_to(run.steps[i]); !ready) return ready;
        const SinkFactory factory = sink_to(output_of_step(run.job.output, run.steps[i]));
        if (Status done = sample_known(run, engine, known, factory); !done) return done;
    }
    return Done{};
}

}  // namespace barycert::pipeline
