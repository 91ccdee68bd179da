// Loops and arenas of oneTBB, whose headers take longer to compile than most sources.
#include "mesh/threads/arena.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>

namespace barycert::base {

int arena_threads() {
    return tbb::this_task_arena::max_concurrency();
}

int threads_of(int threads) {
    return threads > 0 ? std::min(threads, arena_threads()) : arena_threads();
}

void run_in_arena(int threads, std::size_t pieces, const std::function<void()>& work) {
    constexpr std::size_t pieces_a_thread = 1024;
    const std::size_t most = std::min<std::size_t>(1 + pieces / pieces_a_thread, std::numeric_limits<int>::max());
    tbb::task_arena arena(std::min(threads_of(threads), static_cast<int>(most)));
    arena.execute(work);
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work) {
    tbb::parallel_for(std::size_t{0}, count, work);
}

void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& work) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const auto& range) { work(range.begin(), range.end()); });
}

void isolated(const std::function<void()>& work) {
    tbb::this_task_arena::isolate(work);
}

}  // namespace barycert::base
