#include "barycert/jobs/stream.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "barycert/base/finite.hpp"
#include "barycert/base/text.hpp"
#include "barycert/jobs/stages.hpp"
#include "barycert/jobs/stream_output.hpp"
#include "barycert/locate/batch.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::jobs {
namespace {

/// Samples rows.points; with `all`, each cell that holds a point has a row afterwards.
Status sample_block(const Run& run, const Engine& engine, Block& block) {
    SampleOptions options = without_refusal(run.job.options);
    options.threads = 1;  // blocks go side by side
    Table& rows = block.rows;
    if (run.summary.all) {
        Result<Table> all = engine.locator().locate_all(rows.points, options.threads, options.nonfinite_points);
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

std::optional<std::size_t> first_outside(const Table& rows) {
    return locate::first_outside(rows.cells, rows.points, static_cast<std::size_t>(rows.dimension));
}

std::span<const double> point_of(const Table& rows, std::size_t row) {
    const auto d = static_cast<std::size_t>(rows.dimension);
    return std::span(rows.points).subspan(d * row, d);
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
    SampleReport& summary = run.summary;
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
    size = block_size(source.count(), threads, 0);
    if (Status read = read_next(first); !read) return read;
    Status ready = more ? engine.prepare() : engine.prepare_for_all(first.rows.points);
    if (!ready) return ready;
    size = block_size(source.count(), threads, engine.locator().mesh().cell_count());
    // What pays for all points would not for one block.
    locate::in_arena(threads, [&] {
        locate::LocatorData::of(engine.locator()).prepare(std::max<std::uint64_t>(source.count().value_or(0), taken));
    });
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
        block.outside = refuse ? first_outside(block.rows) : std::nullopt;
        block.nan_values = count_nan(block.rows.view());
        return Done{};
    };
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
        Status written = writer.write(block);
        seconds.write += time.lap();
        if (written && !block.last) run.count("points", block.first + block.size);
        return written;
    };
    Stages stages(threads);
    Status done = stages.run(read, work, write);
    seconds.sample += stages.seconds();
    if (!done) return done;
    watch.lap();
    Status committed = writer.commit();
    seconds.write += watch.lap();
    return committed;
}

}  // namespace barycert::jobs
