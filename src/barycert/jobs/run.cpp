#include "barycert/jobs/run.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/jobs/engine.hpp"

namespace barycert::jobs {

Result<SampleReport> run_job(const std::string& command, const SamplingJob& job, std::vector<Step> steps,
                             const std::function<Status(Run&, Engine&)>& work) {
    const int threads = job.options.threads;
    std::optional<tbb::global_control> limit;
    if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    Stopwatch whole;
    Run run{job, std::move(steps)};
    SampleReport& summary = run.summary;
    summary.command = command;
    for (const Step& step : run.steps) {
        summary.steps.push_back(step.label);
        if (step.of_mesh) summary.times.push_back(base::parse_double(step.time).value_or(0));
    }
    summary.mesh = job.mesh;
    summary.output = job.output;
    summary.weights = job.weights;
    summary.rounding = job.options.rounding;
    summary.outside = job.options.outside;
    summary.threads = threads > 0 ? threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    auto engine = Engine::open(run);
    if (!engine) return engine.error();
    if (Status done = work(run, **engine); !done) return done.error();
    summary.seconds.total = whole.lap();
    return summary;
}

}  // namespace barycert::jobs
