/// Work on some of the machine's threads: those of the caller's arena, which take over its floating-point environment.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>

namespace barycert::base {

int arena_threads();

/// How many threads to use: those asked for, or all for 0; never more than the arena of the caller has.
int threads_of(int threads);

/// work() in an arena of threads_of(threads). To wake and await a thread costs as much as some thousand of `pieces`.
void run_in_arena(int threads, std::size_t pieces, const std::function<void()>& work);

/// The same, with what work() returns.
template <class Work>
auto in_arena(int threads, std::size_t pieces, Work&& work) {
    using Made = decltype(work());
    if constexpr (std::is_void_v<Made>) {
        run_in_arena(threads, pieces, [&] { work(); });
    } else {
        std::optional<Made> made;
        run_in_arena(threads, pieces, [&] { made.emplace(work()); });
        return std::move(*made);
    }
}

/// work(i) for each i below `count`, on all threads of the arena, in any order.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work);

/// work(begin, end) for ranges that together are [0, count), cut until they have at most `grain`.
void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& work);

/// work(i) for each i below `count`, up to `grain` of them in a row on one thread.
template <class Work>
void parallel_for_each(std::size_t count, std::size_t grain, const Work& work) {
    parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
        const Work own = work;  // what it refers to stays in registers, whatever it writes
        for (std::size_t i = begin; i != end; ++i) own(i);
    });
}

/// Joins the parts of such ranges by join(all, part); each part is made by work(begin, end, part) from a copy of
/// `empty`. Parts come in any order, which must not show in the result; joining `empty` changes nothing.
template <class Part, class Work, class Join>
Part parallel_reduce(std::size_t count, std::size_t grain, const Part& empty, Work work, Join join) {
    std::mutex mutex;
    Part all = empty;
    parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
        Part part = empty;
        work(begin, end, part);
        const std::lock_guard lock(mutex);
        join(all, part);
    });
    return all;
}

/// work(), during which this thread takes up nothing that is not part of it, not even while it waits for others.
void isolated(const std::function<void()>& work);

}  // namespace barycert::base
