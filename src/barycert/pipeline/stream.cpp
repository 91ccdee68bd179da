#include "barycert/pipeline/stream.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "barycert/base/text.hpp"

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

/// Where rows go: into a sink and perhaps a map.
class StreamOutput {
public:
    StreamOutput(const SinkFactory& factory, const std::string& save_map) : factory_(factory), map_path_(save_map) {}

    /// When the columns are known; a second call does nothing.
    Status open(const Engine& engine, bool all) {
        if (sink_) return Done{};
        auto sink = factory_(engine.format());
        if (!sink) return sink.error();
        if (!map_path_.empty()) {
            auto map = MapWriter::open(map_path_, engine.mesh(), all);
            if (!map) return map.error();
            map_.emplace(std::move(*map));
        }
        sink_ = std::move(*sink);
        return Done{};
    }
    Status write(const TableView& rows) {
        if (map_) {
            if (Status written = map_->write(rows); !written) return written;
        }
        return sink_->write(rows);
    }
    Status commit() {
        if (map_) {
            if (Status done = map_->commit(); !done) return done;
        }
        return sink_->commit();
    }

private:
    const SinkFactory& factory_;
    std::string map_path_;
    std::unique_ptr<TableSink> sink_;
    std::optional<MapWriter> map_;
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

/// Samples rows.points; with `all`, each cell that holds a point has a row afterwards. `first`: how many points came
/// before.
Status sample_block(Run& run, const Engine& engine, std::uint64_t first, Table& rows) {
    const SampleOptions options = without_refusal(run.job.options);
    const bool refuse = run.job.options.outside.kind == Outside::error;
    if (run.summary.all) {
        Result<Table> all = engine.locator().locate_all(rows.points, options.threads);
        if (!all) return all.error();
        rows = std::move(*all);
        const LocationCounts locations = rows.counts.locations;
        if (Status done = engine.sampler().evaluate(rows.points, options, rows); !done) return done;
        rows.counts.locations = locations;
    } else {
        if (Status done = engine.sampler().sample(rows.points, options, rows, first); !done) return done;
    }
    if (const auto row = first_outside(rows.cells); refuse && row) {
        const auto& begin = rows.point_begin;
        const std::size_t point =
            run.summary.all
                ? static_cast<std::size_t>(std::upper_bound(begin.begin(), begin.end(), *row) - begin.begin()) - 1
                : *row;
        return outside_error("point " + std::to_string(first + point), point_of(rows, *row), run.summary.points);
    }
    run.summary.counts.add(rows.counts);
    run.summary.rows += rows.row_count();
    run.summary.nan_values += count_nan(rows.view());
    return Done{};
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
    if (rows.row_count() == 0) return 0;
    const std::size_t columns = rows.values.size() / rows.row_count();
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        if (rows.cells[i] < 0) continue;
        for (std::size_t c = 0; c < columns; ++c) count += std::isnan(rows.values[columns * i + c]) ? 1 : 0;
    }
    return count;
}

Status sample_stream(Run& run, Engine& engine, PointSource& source, const SinkFactory& factory,
                     const std::string& save_map) {
    StreamOutput writer(factory, save_map);
    SampleSeconds& seconds = run.summary.seconds;
    Table rows;
    rows.dimension = source.dimension();
    rows.points.reserve(std::min<std::uint64_t>(block_of_points, source.count().value_or(block_of_points)) *
                        static_cast<std::size_t>(source.dimension()));
    std::uint64_t done = 0;
    Stopwatch watch;
    for (bool more = true; more;) {
        rows.points.clear();
        if (done != 0) run.count("points", done);
        const Result<std::size_t> count = source.read(block_of_points, rows.points);
        if (!count) return count.error();
        more = *count == block_of_points;
        seconds.read += watch.lap();
        if (Status ready = engine.prepare(); !ready) return ready;
        watch.lap();
        if (Status opened = writer.open(engine, run.summary.all); !opened) return opened;
        seconds.write += watch.lap();
        if (Status sampled = sample_block(run, engine, done, rows); !sampled) return sampled;
        seconds.sample += watch.lap();
        if (Status written = writer.write(rows.view()); !written) return written;
        seconds.write += watch.lap();
        done += *count;
    }
    Status committed = writer.commit();
    seconds.write += watch.lap();
    return committed;
}

Status sample_map(Run& run, Engine& engine, MapReader& map, const SinkFactory& factory) {
    const SampleOptions options = without_refusal(run.job.options);
    const bool refuse = run.job.options.outside.kind == Outside::error;
    StreamOutput writer(factory, "");
    if (Status opened = writer.open(engine, map.all()); !opened) return opened;
    SampleSummary& summary = run.summary;
    PointsOfRows points;
    LocationCounts locations;
    Table rows;
    Stopwatch watch;
    for (;;) {
        if (summary.rows != 0) run.count("rows", summary.rows);
        const Result<std::size_t> count = map.read(block_of_points, rows);
        if (!count) return count.error();
        if (*count == 0) break;
        summary.seconds.read += watch.lap();
        if (const auto row = first_outside(rows.cells); row && refuse)
            return outside_error("row " + std::to_string(summary.rows + *row), point_of(rows, *row), summary.points);
        if (Status done = engine.sampler().evaluate(rows.points, options, rows, summary.rows); !done) return done;
        summary.counts.add(rows.counts);
        points.count(rows.view(), locations);
        summary.nan_values += count_nan(rows.view());
        summary.rows += *count;
        summary.seconds.sample += watch.lap();
        if (Status written = writer.write(rows.view()); !written) return written;
        summary.seconds.write += watch.lap();
    }
    summary.counts.locations = locations;
    Status committed = writer.commit();
    summary.seconds.write += watch.lap();
    return committed;
}

}  // namespace barycert::pipeline
