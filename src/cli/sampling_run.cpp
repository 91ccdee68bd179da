#include "sampling_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "barycert/base/text.hpp"
#include "sampling_files.hpp"

namespace barycert::cli {
namespace {

/// A row for each cell that holds a point, and one for each point outside.
Status locate_all(const SamplingArguments& a, const SamplingEngine& engine, SampledBlock& block, LocationCounts& counts,
                  std::optional<std::size_t>& first_outside) {
    Result<AllLocations> all = engine.locator().locate_all(block.points, &counts, a.options.threads);
    if (!all) return all.error();
    const auto d = static_cast<std::size_t>(engine.mesh().dimension);
    const std::size_t count = all->begin.size() - 1;
    std::vector<double> points;
    points.reserve(block.points.size());
    block.rows.cells.clear();
    block.rows.features.clear();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t first = all->begin[i], end = all->begin[i + 1];
        if (first == end && !first_outside) first_outside = i;
        for (std::size_t row = first; row < std::max(end, first + 1); ++row) {
            block.rows.cells.push_back(row == end ? -1 : all->cells[row]);
            block.rows.features.push_back(row == end ? Feature::outside : all->features[row]);
            for (std::size_t k = 0; k < d; ++k) points.push_back(block.points[d * i + k]);
        }
    }
    block.points = std::move(points);
    return Done{};
}

std::optional<std::size_t> first_outside(std::span<const Mesh::Index> cells) {
    const auto it = std::find(cells.begin(), cells.end(), -1);
    if (it == cells.end()) return std::nullopt;
    return static_cast<std::size_t>(it - cells.begin());
}

/// The policy is looked at here, where the point and its file are known.
SampleOptions without_refusal(SampleOptions options) {
    if (options.outside.kind == Outside::error) options.outside = {};
    return options;
}

/// What is sampled, into rows and perhaps a map.
class Rows {
public:
    Rows(const SinkFactory& factory, const std::string& save_map) : factory_(factory), map_path_(save_map) {}

    /// When the columns are known; a second call does nothing.
    Status open(const SamplingEngine& engine, bool all) {
        if (sink_) return Done{};
        auto sink = factory_(engine);
        if (!sink) return sink.error();
        if (!map_path_.empty()) {
            auto map = MapWriter::open(map_path_, engine.mesh(), all);
            if (!map) return map.error();
            map_.emplace(std::move(*map));
        }
        sink_ = std::move(*sink);
        return Done{};
    }
    Status write(int dimension, std::span<const double> points, std::span<const Mesh::Index> cells,
                 std::span<const Feature> features, const Samples& r) {
        if (map_) {
            if (Status written = map_->write(points, cells, features); !written) return written;
        }
        return sink_->write({dimension, points, cells, features, r.values, r.distances});
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
    std::unique_ptr<points::Sink> sink_;
    std::optional<MapWriter> map_;
};

/// Which rows of a map begin a point. Those of one point follow one another, their cells ascending.
class PointsOfRows {
public:
    void count(const LocationMap& rows, std::size_t d, LocationCounts& counts) {
        for (std::size_t i = 0; i < rows.cells.size(); ++i) {
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

}  // namespace

Error outside_error(const std::string& what, std::span<const double> where, const std::string& file) {
    std::string at;
    for (const double x : where) at += (at.empty() ? "(" : ", ") + shortest(x);
    return {.what = what + ", counted from 0, is outside the mesh",
            .file = file,
            .line = 0,
            .expected = {},
            .found = at + ")",
            .remedy = "choose what points outside get: --outside nan, fill=V, nearest or extrapolate"};
}

void count_nan(std::span<const Mesh::Index> cells, std::span<const double> values, std::size_t columns,
               std::uint64_t& count) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i] < 0) continue;
        for (std::size_t c = 0; c < columns; ++c) count += std::isnan(values[columns * i + c]) ? 1 : 0;
    }
}

SinkFactory rows_to_output(const SamplingArguments& a) {
    return [&a](const SamplingEngine& engine) {
        return open_rows(a.output, engine.mesh().dimension, engine.fields(), engine.sampler().columns(),
                         a.options.outside);
    };
}

Status sample_block(const SamplingArguments& a, const SamplingEngine& engine, const std::string& file,
                    std::uint64_t first, SampledBlock& block, SampleRun& run) {
    const auto d = static_cast<std::size_t>(engine.mesh().dimension);
    const bool refuse = a.options.outside.kind == Outside::error;
    const SampleOptions options = without_refusal(a.options);
    const Sampler& sampler = engine.sampler();
    SampleCounts counts;
    std::optional<std::size_t> outside;
    const std::vector<double> as_read = run.all && refuse ? block.points : std::vector<double>();
    if (run.all) {
        LocationCounts locations;
        if (Status done = locate_all(a, engine, block, locations, outside); !done) return done;
        const auto cells = block.rows.cells;
        const auto features = block.rows.features;
        if (Status done = sampler.evaluate(block.points, cells, features, options, block.rows, counts); !done)
            return done;
        counts.locations = locations;
    } else {
        if (Status done = sampler.sample(block.points, options, block.rows, counts, first); !done) return done;
        outside = first_outside(block.rows.cells);
    }
    if (refuse && outside)
        return outside_error("point " + std::to_string(first + *outside),
                             std::span(run.all ? as_read : block.points).subspan(d * *outside, d), file);
    run.counts.add(counts);
    run.rows += block.rows.cells.size();
    count_nan(block.rows.cells, block.rows.values, sampler.columns().size(), run.nan_values);
    return Done{};
}

Status sample_stream(const SamplingArguments& a, SamplingEngine& engine, points::Source& source,
                     const SinkFactory& factory, const std::string& save_map, SampleRun& run, Progress& progress) {
    Rows rows(factory, save_map);
    SampledBlock block;
    block.points.reserve(std::min<std::uint64_t>(block_of_points, source.count().value_or(block_of_points)) *
                         static_cast<std::size_t>(source.dimension()));
    std::uint64_t done = 0;
    Stopwatch watch;
    for (bool more = true; more;) {
        block.points.clear();
        if (done != 0) progress.count("points", done);
        const Result<std::size_t> count = source.read(block_of_points, block.points);
        if (!count) return count.error();
        more = *count == block_of_points;
        run.seconds.read += watch.lap();
        const std::uint64_t known = std::max<std::uint64_t>(source.count().value_or(0), done + *count);
        if (Status ready = engine.prepare_for(known, more && !source.count(), progress); !ready) return ready;
        watch.lap();
        if (Status opened = rows.open(engine, run.all); !opened) return opened;
        run.seconds.write += watch.lap();
        if (Status sampled = sample_block(a, engine, run.points, done, block, run); !sampled) return sampled;
        run.seconds.sample += watch.lap();
        const Samples& r = block.rows;
        if (Status written = rows.write(source.dimension(), block.points, r.cells, r.features, r); !written)
            return written;
        run.seconds.write += watch.lap();
        done += *count;
    }
    Status committed = rows.commit();
    run.seconds.write += watch.lap();
    return committed;
}

Status sample_map(const SamplingArguments& a, SamplingEngine& engine, MapReader& map, const SinkFactory& factory,
                  SampleRun& run, Progress& progress) {
    const auto d = static_cast<std::size_t>(engine.mesh().dimension);
    const SampleOptions options = without_refusal(a.options);
    Rows rows(factory, "");
    if (Status opened = rows.open(engine, map.all()); !opened) return opened;
    PointsOfRows points;
    LocationMap block;
    Samples out;
    LocationCounts locations;
    Stopwatch watch;
    for (;;) {
        if (run.rows != 0) progress.count("rows", run.rows);
        const Result<std::size_t> count = map.read(block_of_points, block);
        if (!count) return count.error();
        if (*count == 0) break;
        run.seconds.read += watch.lap();
        if (const auto row = first_outside(block.cells); row && a.options.outside.kind == Outside::error)
            return outside_error("row " + std::to_string(run.rows + *row), std::span(block.points).subspan(d * *row, d),
                                 run.points);
        Status done =
            engine.sampler().evaluate(block.points, block.cells, block.features, options, out, run.counts, run.rows);
        if (!done) return done;
        points.count(block, d, locations);
        count_nan(block.cells, out.values, engine.sampler().columns().size(), run.nan_values);
        run.rows += *count;
        run.seconds.sample += watch.lap();
        if (Status written = rows.write(engine.mesh().dimension, block.points, block.cells, block.features, out);
            !written)
            return written;
        run.seconds.write += watch.lap();
    }
    run.counts.locations = locations;
    Status committed = rows.commit();
    run.seconds.write += watch.lap();
    return committed;
}

}  // namespace barycert::cli
