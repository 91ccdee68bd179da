#include "sampling_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "barycert/core/text.hpp"
#include "sampling_files.hpp"

namespace barycert::cli {
namespace {

/// The policy is `error`: the first point outside, if there is one.
Status refuse_outside(const std::vector<Mesh::Index>& cells, const std::vector<double>& points, std::size_t d,
                      const std::string& file, std::uint64_t first) {
    const auto it = std::find(cells.begin(), cells.end(), -1);
    if (it == cells.end()) return Done{};
    const auto i = static_cast<std::size_t>(it - cells.begin());
    std::string at;
    for (std::size_t k = 0; k < d; ++k) at += (k == 0 ? "(" : ", ") + shortest(points[d * i + k]);
    return Error{.what = "point " + std::to_string(first + i) + ", counted from 0, is outside the mesh",
                 .file = file,
                 .found = at + ")",
                 .remedy = "choose what points outside get: --outside nan, fill=V, nearest or extrapolate"};
}

/// A row for each cell that holds a point, and one for each point outside.
Status locate_all(const SamplingArguments& a, const SamplingEngine& engine, SampledBlock& block, AllLocations& rows,
                  LocationCounts& counts) {
    Result<AllLocations> all = engine.locator().locate_all(block.points, &counts, a.options.threads);
    if (!all) return all.error();
    const auto d = static_cast<std::size_t>(engine.mesh().dimension);
    const std::size_t count = all->begin.size() - 1;
    std::vector<double> points;
    points.reserve(block.points.size());
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t first = all->begin[i], last = std::max(all->begin[i + 1], first + 1);
        for (std::size_t row = first; row < last; ++row) {
            const bool outside = row == all->begin[i + 1];
            rows.cells.push_back(outside ? -1 : all->cells[row]);
            rows.features.push_back(outside ? Feature::outside : all->features[row]);
            for (std::size_t k = 0; k < d; ++k) points.push_back(block.points[d * i + k]);
        }
    }
    block.points = std::move(points);
    return Done{};
}

void count_nan(const Samples& rows, std::size_t columns, std::uint64_t& count) {
    for (std::size_t i = 0; i < rows.cells.size(); ++i) {
        if (rows.cells[i] < 0) continue;
        for (std::size_t c = 0; c < columns; ++c) count += std::isnan(rows.values[columns * i + c]) ? 1 : 0;
    }
}

}  // namespace

Status sample_block(const SamplingArguments& a, const SamplingEngine& engine, const std::string& file,
                    std::uint64_t first, SampledBlock& block, report::SampleRun& run) {
    const auto d = static_cast<std::size_t>(engine.mesh().dimension);
    SampleOptions options = a.options;
    const bool refuse = options.outside.kind == Outside::error;
    if (refuse) options.outside = {};
    SampleCounts counts;
    if (run.all) {
        AllLocations all;
        LocationCounts locations;
        const std::vector<double> points = refuse ? block.points : std::vector<double>();
        if (Status done = locate_all(a, engine, block, all, locations); !done) return done;
        if (refuse && locations.outside != 0) {
            std::vector<Mesh::Index> owner(points.size() / d);
            std::vector<Feature> features(owner.size());
            if (Status done = engine.locator().locate(points, owner, features); !done) return done;
            return refuse_outside(owner, points, d, file, first);
        }
        Status done = engine.sampler().evaluate(block.points, all.cells, all.features, options, block.rows, counts);
        if (!done) return done;
        counts.locations = locations;
    } else {
        Status done = engine.sampler().sample(block.points, options, block.rows, counts, first);
        if (!done) return done;
        if (refuse) {
            if (Status inside = refuse_outside(block.rows.cells, block.points, d, file, first); !inside) return inside;
        }
    }
    run.counts.add(counts);
    run.rows += block.rows.cells.size();
    count_nan(block.rows, engine.sampler().columns().size(), run.nan_values);
    return Done{};
}

Status sample_stream(const SamplingArguments& a, SamplingEngine& engine, points::Source& source, report::SampleRun& run,
                     Progress& progress) {
    std::unique_ptr<points::Sink> sink;
    SampledBlock block;
    std::uint64_t done = 0;
    for (bool more = true; more;) {
        Stopwatch watch;
        block.points.clear();
        progress.count("points", done);
        const Result<std::size_t> count = source.read(block_of_points, block.points);
        if (!count) return count.error();
        more = *count == block_of_points;
        run.seconds.read += watch.lap();
        const std::uint64_t known = std::max<std::uint64_t>(source.count().value_or(0), done + *count);
        if (Status ready = engine.prepare_for(known, more && !source.count(), progress); !ready) return ready;
        watch.lap();
        if (!sink) {
            auto opened =
                open_rows(a.output, source.dimension(), engine.fields(), engine.sampler().columns(), a.options.outside);
            if (!opened) return opened.error();
            sink = std::move(*opened);
        }
        run.seconds.write += watch.lap();
        if (Status sampled = sample_block(a, engine, run.points, done, block, run); !sampled) return sampled;
        run.seconds.sample += watch.lap();
        const Samples& r = block.rows;
        Status written = sink->write({source.dimension(), block.points, r.cells, r.features, r.values, r.distances});
        if (!written) return written;
        run.seconds.write += watch.lap();
        done += *count;
    }
    Stopwatch watch;
    Status committed = sink->commit();
    run.seconds.write += watch.lap();
    return committed;
}

}  // namespace barycert::cli
