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

#include "barycert/environment.hpp"
#include "barycert/jobs/run.hpp"
#include "barycert/locate/batch.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"

namespace barycert::jobs {

/// Points of a block at most, on meshes of up to two million cells.
inline constexpr std::size_t block_of_points = std::size_t{1} << 17;

/// Rows on their way from the source to the sink, and what became of them.
struct Block {
    Table rows;
    std::vector<Mesh::Index> located;  ///< cells of the locator, where they are to be known again
    NodeWeights weights;               ///< where they are wanted
    std::uint64_t first = 0;           ///< points, or rows of a map, that came before
    std::uint64_t size = 0;            ///< points
    bool last = false;                 ///< as far as was known when it was read
    std::uint64_t nan_values = 0;
    std::optional<std::size_t> outside;  ///< the first row without a cell, where there may be none
    std::optional<Error> error;
    double seconds = 0;  ///< of the work
};

/// How many points a block has: few enough that all of `threads` threads (0: as many as the machine has) have some,
/// enough that sorting them brings near ones together. `count`: of all, if that is known. `cells`: of the mesh, 0 where
/// none are looked for.
inline std::size_t block_size(std::optional<std::uint64_t> count, int threads, std::size_t cells) {
    constexpr std::uint64_t min = std::uint64_t{1} << 12, blocks_a_thread = 4, cells_a_point = 16;
    const std::uint64_t max = std::max<std::uint64_t>(block_of_points, cells / cells_a_point);
    if (!count) return static_cast<std::size_t>(max);
    const int workers = locate::threads_of(threads);
    return static_cast<std::size_t>(
        std::clamp<std::uint64_t>(*count / (blocks_a_thread * static_cast<std::uint64_t>(workers)), min, max));
}

/// Three stages at once: blocks are read one after the other, worked on side by side, and written in the order in which
/// they were read. At most one block a thread, and two more, are in memory. A block has `size`, `error` and `seconds`
/// as Block has.
template <class Block>
class StagesOf {
public:
    /// `threads`: 0 for as many as the machine has.
    explicit StagesOf(int threads) : threads_(locate::threads_of(threads)) {}

    /// read(block) fills the next one, of which `size` > 0 unless it is the end; work(block) and write(block) follow.
    /// All tell errors by the block or by what they return. The first error in the order of blocks ends it all.
    template <class Read, class Work, class Write>
    Status run(Read read, Work work, Write write) {
        const auto reading = [&](tbb::flow_control& control) -> Block* {
            const ExactEnvironment of_task;  // the arena is the caller's
            if (ended_ || stopped_) {
                control.stop();
                return nullptr;
            }
            Block* const block = take();
            block->error.reset();
            if (Status done = read(*block); !done) block->error = done.error();
            ended_ = block->error || block->size == 0;
            return block;
        };
        const auto working = [&](Block* block) {
            const ExactEnvironment of_task;
            if (block->error || block->size == 0 || stopped_) return block;
            Stopwatch watch;
            if (Status done = work(*block); !done) block->error = done.error();
            block->seconds = watch.lap();
            return block;
        };
        const auto writing = [&](Block* block) {
            const ExactEnvironment of_task;
            if (!stopped_ && !block->error && block->size != 0) {
                seconds_ += block->seconds;
                if (Status done = write(*block); !done) block->error = done.error();
            }
            if (!stopped_ && block->error) {
                error_ = std::move(block->error);
                stopped_ = true;
            }
            put(block);
        };
        locate::in_arena(threads_, [&] {
            tbb::parallel_pipeline(static_cast<std::size_t>(threads_) + 2,
                                   tbb::make_filter<void, Block*>(tbb::filter_mode::serial_in_order, reading) &
                                       tbb::make_filter<Block*, Block*>(tbb::filter_mode::parallel, working) &
                                       tbb::make_filter<Block*, void>(tbb::filter_mode::serial_in_order, writing));
        });
        if (error_) return *error_;
        return Done{};
    }

    /// Of the work on all blocks, divided by the threads.
    double seconds() const { return seconds_ / threads_; }

private:
    Block* take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return &blocks_.emplace_back();
        Block* const block = free_.back();
        free_.pop_back();
        return block;
    }
    void put(Block* block) {
        const std::lock_guard lock(mutex_);
        free_.push_back(block);
    }

    int threads_;
    double seconds_ = 0;  // of the writing stage alone
    std::mutex mutex_;
    std::deque<Block> blocks_;
    std::vector<Block*> free_;
    bool ended_ = false;                // of the reading stage alone
    std::atomic<bool> stopped_{false};  // by the writing stage
    std::optional<Error> error_;
};

using Stages = StagesOf<Block>;

}  // namespace barycert::jobs
