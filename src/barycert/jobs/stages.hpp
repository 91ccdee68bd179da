/// Reading, work and writing at the same time, block after block.
#pragma once

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "barycert/base/arena.hpp"
#include "barycert/environment.hpp"
#include "barycert/jobs/job_files.hpp"
#include "barycert/locate/batch.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// Points of a block at most, on meshes of up to two million cells.
inline constexpr std::size_t block_of_points = std::size_t{1} << 17;

/// How many points a block has: few enough that all of `threads` threads (0: as many as the machine has) have some,
/// enough that sorting them brings near ones together. `count`: of all, if that is known. `cells`: of the mesh, 0 where
/// none are looked for.
inline std::size_t block_size(std::optional<std::uint64_t> count, int threads, std::size_t cells) {
    constexpr std::uint64_t min = std::uint64_t{1} << 12, blocks_a_thread = 4, cells_a_point = 16;
    const std::uint64_t max = std::max<std::uint64_t>(block_of_points, cells / cells_a_point);
    if (!count) return static_cast<std::size_t>(max);
    const int workers = base::threads_of(threads);
    return static_cast<std::size_t>(
        std::clamp<std::uint64_t>(*count / (blocks_a_thread * static_cast<std::uint64_t>(workers)), min, max));
}

/// Three stages at once: blocks are read one after the other, worked on side by side, and written in the order in which
/// they were read. At most one block a thread, and two more, are in memory. The first error in the order of blocks ends
/// it all. A block has `size`, the rows that were read: 0 at the end.
template <class Block>
class Stages {
public:
    Stages() = default;
    virtual ~Stages() = default;
    Stages(const Stages&) = delete;
    Stages& operator=(const Stages&) = delete;

protected:
    /// Fills the next block, which may have been another one before.
    virtual Status read(Block& block) = 0;
    virtual Status work(Block& block) const = 0;
    virtual Status write(Block& block) = 0;

    /// Reads the first block before the rest: it tells how to go on.
    Status read_first() {
        first_.emplace();
        return read(*first_);
    }
    const Block& first() const { return *first_; }

    /// All three, to the end. `threads`: 0 for as many as the machine has.
    Status run(int threads) {
        threads_ = base::threads_of(threads);
        base::in_arena(threads_, std::numeric_limits<std::size_t>::max(), [this] {
            tbb::parallel_pipeline(
                static_cast<std::size_t>(threads_) + 2,
                tbb::make_filter<void, OnTheWay*>(tbb::filter_mode::serial_in_order,
                                                  [this](tbb::flow_control& control) { return next(control); }) &
                    tbb::make_filter<OnTheWay*, OnTheWay*>(tbb::filter_mode::parallel,
                                                           [this](OnTheWay* b) { return done(b); }) &
                    tbb::make_filter<OnTheWay*, void>(tbb::filter_mode::serial_in_order,
                                                      [this](OnTheWay* b) { put(b); }));
        });
        if (error_) return *error_;
        return Done{};
    }

    /// Of the work on all blocks, divided by the threads.
    double seconds() const { return seconds_ / threads_; }

private:
    struct OnTheWay {
        Block block;
        std::optional<Error> error;
        double seconds = 0;
    };

    OnTheWay* next(tbb::flow_control& control) {
        const ExactEnvironment of_task;  // the arena is the caller's
        if (ended_ || stopped_) {
            control.stop();
            return nullptr;
        }
        OnTheWay* const b = take();
        b->error.reset();
        if (first_) {
            b->block = std::move(*first_);
            first_.reset();
        } else if (Status done = read(b->block); !done) {
            b->error = done.error();
        }
        ended_ = b->error || b->block.size == 0;
        return b;
    }

    OnTheWay* done(OnTheWay* b) {
        const ExactEnvironment of_task;
        if (b->error || b->block.size == 0 || stopped_) return b;
        Stopwatch watch;
        if (Status done = work(b->block); !done) b->error = done.error();
        b->seconds = watch.lap();
        return b;
    }

    void put(OnTheWay* b) {
        const ExactEnvironment of_task;
        if (!stopped_ && !b->error && b->block.size != 0) {
            seconds_ += b->seconds;
            if (Status done = write(b->block); !done) b->error = done.error();
        }
        if (!stopped_ && b->error) {
            error_ = std::move(b->error);
            stopped_ = true;
        }
        const std::lock_guard lock(mutex_);
        free_.push_back(b);
    }

    OnTheWay* take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return &blocks_.emplace_back();
        OnTheWay* const b = free_.back();
        free_.pop_back();
        return b;
    }

    int threads_ = 1;
    double seconds_ = 0;  // of the writing stage alone
    std::mutex mutex_;
    std::deque<OnTheWay> blocks_;
    std::vector<OnTheWay*> free_;
    std::optional<Block> first_;        // of the reading stage alone
    bool ended_ = false;                // likewise
    std::atomic<bool> stopped_{false};  // by the writing stage
    std::optional<Error> error_;
};

}  // namespace barycert::jobs
