/// One run of a job: what it is asked for, what it has done, how it tells of its progress.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/jobs.hpp"
#include "barycert/jobs/series.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// Seconds since it was made or last asked.
class Stopwatch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> time = now - last_;
        last_ = now;
        return time.count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

struct Run {
    const SamplingJob& job;
    std::vector<Step> steps = {};  ///< of the series of the job
    SampleReport summary = {};

    /// Whether each step has outputs of its own.
    bool step_by_step() const { return !steps.empty() && has_step_place(job.output); }

    void stage(std::string_view text) const {
        if (job.progress) job.progress({.stage = text});
    }
    void count(std::string_view what, std::uint64_t done) const {
        if (job.progress) job.progress({.stage = what, .done = done});
    }
};

class Engine;

/// Does `work` with an engine on the mesh of the job, on no more threads than the job allows. `command`: of the
/// summary.
Result<SampleReport> run_job(const std::string& command, const SamplingJob& job, std::vector<Step> steps,
                             const std::function<Status(Run&, Engine&)>& work);

}  // namespace barycert::jobs
