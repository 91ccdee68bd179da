// Rows of a map, whose owners are known.
#include <algorithm>
#include <array>
#include <utility>

#include "barycert/base/finite.hpp"
#include "barycert/jobs/stages.hpp"
#include "barycert/jobs/stream.hpp"
#include "barycert/jobs/stream_output.hpp"

namespace barycert::jobs {
namespace {

/// Which rows of a map begin a point. Those of one point follow one another, their cells ascending.
class PointsOfRows {
public:
    void count(const TableView& rows, LocationCounts& counts) {
        const auto d = static_cast<std::size_t>(rows.dimension);
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            const double* const at = rows.points.data() + d * i;
            const bool same = cell_ >= 0 && rows.cells[i] > cell_ && std::equal(at, at + d, at_.begin());
            if (!same) counts.add(rows.features[i]);
            if (!same && !base::all_finite({at, d})) ++counts.not_finite;
            std::copy(at, at + d, at_.begin());
            cell_ = rows.cells[i];
        }
    }

private:
    Mesh::Index cell_ = -1;
    std::array<double, 3> at_{};
};

}  // namespace

Status sample_map(Run& run, Engine& engine, MapReader& map, const StreamTargets& targets) {
    SampleReport& summary = run.summary;
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
    const int threads = run.job.options.threads;
    const std::size_t size = block_size(map.rows(), threads, 0);
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
        block.outside = refuse ? first_outside(block.rows) : std::nullopt;
        if (block.outside) return Done{};
        if (Status done = engine.sampler().evaluate(block.rows.points, options, block.rows, block.first); !done)
            return done;
        block.nan_values = count_nan(block.rows.view());
        return writer.prepare(engine, run.job.options, block);
    };
    const auto write = [&](Block& block) -> Status {
        Stopwatch watch;
        if (block.outside)
            return outside_error("row " + std::to_string(block.first + *block.outside),
                                 point_of(block.rows, *block.outside), summary.points);
        summary.counts.add(block.rows.counts);
        points.count(block.rows.view(), locations);
        summary.nan_values += block.nan_values;
        summary.rows += block.size;
        Status written = writer.write(block);
        seconds.write += watch.lap();
        if (written) run.count("rows", summary.rows);
        return written;
    };
    Stages stages(threads);
    Status done = stages.run(read, work, write);
    seconds.sample += stages.seconds();
    if (!done) return done;
    summary.counts.locations = locations;
    Stopwatch watch;
    Status committed = writer.commit();
    seconds.write += watch.lap();
    return committed;
}

}  // namespace barycert::jobs
