/// Pieces of work, shared among threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace barycert::base {

/// `threads`, or as many as the machine has if that is not positive.
inline int threads_for(int threads) {
    return threads > 0 ? threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Calls work(i) for each i below `count` until one returns false or throws; true if none did. This call throws on what
/// work() throws. The calling thread is one of those that work.
template <class Work>
bool share_work(int threads, std::size_t count, const Work& work) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> good{true}, thrown{false};
    std::exception_ptr exception;
    const auto take = [&] {
        try {
            for (std::size_t i = next++; i < count && good; i = next++) {
                if (!work(i)) good = false;
            }
        } catch (...) {
            good = false;
            if (!thrown.exchange(true)) exception = std::current_exception();
        }
    };
    const std::size_t wanted = std::min(static_cast<std::size_t>(threads_for(threads)), count);
    std::vector<std::thread> helpers;
    helpers.reserve(wanted);
    try {
        while (helpers.size() + 1 < wanted) helpers.emplace_back(take);
    } catch (const std::exception&) {
        // The system gives no more threads, or no memory for one: those at hand do it all.
    }
    take();
    for (std::thread& helper : helpers) helper.join();
    if (exception) std::rethrow_exception(exception);
    return good;
}

}  // namespace barycert::base
