/// Reading, work and writing at the same time, block after block.
#pragma once

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
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
/// they were read, on `threads` threads (0: as many as the machine has). At most one block a thread, and two more, are
/// in memory, and filled again. The first error in the order of blocks ends it all. A block has `size`, the rows that
/// were read: 0 at the end. `first` was read before. `busy` gets the seconds of the work, divided by the threads.
template <class Block, class Read, class Work, class Write>
Status in_stages(int threads, std::optional<Block> first, Read read, Work work, Write write, double& busy) {
    struct OnTheWay {
        Block block;
        Status state = Done{};
        double seconds = 0;
    };
    const int workers = base::threads_of(threads);
    // Blocks leave in the order in which they came: before one comes, the last but so many has left.
    std::vector<OnTheWay> ring(static_cast<std::size_t>(workers) + 2);
    std::size_t taken = 0;             // of the reading stage alone
    bool ended = false;                // likewise
    std::atomic<bool> stopped{false};  // by the writing stage
    Status all = Done{};               // of the writing stage alone
    double seconds = 0;                // likewise
    const auto next = [&](tbb::flow_control& control) -> OnTheWay* {
        const ExactEnvironment of_task;  // the arena is the caller's
        if (ended || stopped) {
            control.stop();
            return nullptr;
        }
        OnTheWay& b = ring[taken++ % ring.size()];
        b.state = Done{};
        if (first) {
            b.block = *std::exchange(first, std::nullopt);
        } else {
            b.state = read(b.block);
        }
        ended = !b.state || b.block.size == 0;
        return &b;
    };
    const auto done = [&](OnTheWay* b) {
        const ExactEnvironment of_task;
        if (!b->state || b->block.size == 0 || stopped) return b;
        Stopwatch watch;
        b->state = work(b->block);
        b->seconds = watch.lap();
        return b;
    };
    const auto put = [&](OnTheWay* b) {
        const ExactEnvironment of_task;
        if (stopped) return;
        if (b->state && b->block.size != 0) {
            seconds += b->seconds;
            b->state = write(b->block);
        }
        if (b->state) return;
        all = b->state;
        stopped = true;
    };
    base::in_arena(workers, std::numeric_limits<std::size_t>::max(), [&] {
        using tbb::filter_mode;
        tbb::parallel_pipeline(ring.size(), tbb::make_filter<void, OnTheWay*>(filter_mode::serial_in_order, next) &
                                                tbb::make_filter<OnTheWay*, OnTheWay*>(filter_mode::parallel, done) &
                                                tbb::make_filter<OnTheWay*, void>(filter_mode::serial_in_order, put));
    });
    busy += seconds / workers;
    return all;
}

}  // namespace barycert::jobs
