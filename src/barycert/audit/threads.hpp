/// The threads of an audit.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "barycert/base/workers.hpp"
#include "barycert/environment.hpp"

namespace barycert::audit {

class Threads {
public:
    explicit Threads(int wanted)
        : count(base::threads_for(wanted)),
          limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count)),
          arena_(count) {}

    const int count;

    /// work(i) for each i below `n`, on a thread `grain` at a time, in the exact environment.
    template <class Work>
    void each(std::uint64_t n, std::uint64_t grain, const Work& work) {
        arena_.execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, n, grain), [&](const auto& range) {
                const ExactEnvironment environment;
                for (std::uint64_t i = range.begin(); i != range.end(); ++i) work(i);
            });
        });
    }

private:
    tbb::global_control limit_;
    tbb::task_arena arena_;
};

}  // namespace barycert::audit
