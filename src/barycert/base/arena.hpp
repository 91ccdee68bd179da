/// Work on some of the machine's threads.
#pragma once

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace barycert::base {

/// How many threads to use: those asked for, or all for 0; never more than the arena of the caller has.
inline int threads_of(int threads) {
    const int available = tbb::this_task_arena::max_concurrency();
    return threads > 0 ? std::min(threads, available) : available;
}

/// Returns work() on threads_of(threads) threads, which take over the floating-point environment of the caller. To wake
/// a thread, and to wait for it, takes as long as some thousand cells or points: `pieces` says how many there are.
template <class Work>
auto in_arena(int threads, std::size_t pieces, Work&& work) {
    constexpr std::size_t pieces_a_thread = 1024;
    const std::size_t most = std::min<std::size_t>(1 + pieces / pieces_a_thread, std::numeric_limits<int>::max());
    tbb::task_arena arena(std::min(threads_of(threads), static_cast<int>(most)));
    return arena.execute(std::forward<Work>(work));
}

}  // namespace barycert::base
