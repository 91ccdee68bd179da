// The further steps of a series: points are located once.
#include <algorithm>
#include <utility>

#include "barycert/jobs/series.hpp"
#include "barycert/jobs/stages.hpp"
#include "barycert/jobs/stream.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::jobs {

Status sample_known(Run& run, Engine& engine, const KnownRows& known, const SinkFactory& factory) {
    SampleSeconds& seconds = run.summary.seconds;
    SampleOptions options = without_refusal(run.job.options);
    options.threads = 1;
    const auto d = static_cast<std::size_t>(engine.mesh().dimension);
    Stopwatch watch;
    auto sink = factory(engine.format());
    if (!sink) return sink.error();
    seconds.write += watch.lap();
    const int threads = run.job.options.threads;
    const std::size_t size = block_size(known.cells.size(), threads, 0);
    std::size_t taken = 0;
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
        for (const Column& column : known.carried) block.rows.carried.push_back(mesh::part_of(column, begin, end));
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
    const auto write = [&](Block& block) -> Status {
        Stopwatch time;
        run.summary.nan_values += block.nan_values;
        Status written = (*sink)->write(block.rows.view());
        seconds.write += time.lap();
        return written;
    };
    Stages stages(threads);
    Status done = stages.run(read, work, write);
    seconds.sample += stages.seconds();
    if (!done) return done;
    watch.lap();
    Status committed = (*sink)->commit();
    seconds.write += watch.lap();
    return committed;
}

Error of_one_mesh(const std::string& option, const std::string& path) {
    return {.what = "the mesh changes from step to step, and " + option + " is of one mesh",
            .file = path,
            .remedy = "choose one step: --step N"};
}

Status sample_further_steps(Run& run, Engine& engine, KnownRows& known,
                            const std::function<SinkFactory(const std::string& output)>& sink_to,
                            const std::function<Status(const StreamTargets&)>& locate) {
    for (std::size_t i = 1; i < run.steps.size(); ++i) {
        run.count("steps", i);
        if (Status ready = engine.go_to(run.steps[i]); !ready) return ready;
        const SinkFactory factory = sink_to(output_of_step(run.job.output, run.steps[i]));
        if (!engine.is_another_mesh()) {
            if (Status done = sample_known(run, engine, known, factory); !done) return done;
            continue;
        }
        known = {};
        if (Status done = locate({.rows = factory, .known = &known}); !done) return done;
    }
    return Done{};
}

}  // namespace barycert::jobs
