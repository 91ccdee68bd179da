#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "app/jobs/job_files.hpp"
#include "app/jobs/stream.hpp"
#include "barycert/environment.hpp"
#include "barycert/locator.hpp"
#include "mesh/locate/locator_data.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::jobs {
namespace {

/// `cells`: of the mesh, 0 where none are looked for.
std::size_t size_of_blocks(std::optional<std::uint64_t> points, int threads, std::size_t cells) {
    // The most points of a block on meshes of up to two million cells, and on larger ones: see NOTES.md.
    constexpr std::uint64_t usual = std::uint64_t{1} << 17, cells_a_point = 16;
    // Threads have several blocks each, so that none waits long for the others; but not of very few points.
    constexpr std::uint64_t min = std::uint64_t{1} << 12, blocks_a_thread = 4;
    const std::uint64_t max = std::max<std::uint64_t>(usual, cells / cells_a_point);
    if (!points) return static_cast<std::size_t>(max);
    const auto workers = static_cast<std::uint64_t>(base::threads_of(threads));
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(*points / (blocks_a_thread * workers), min, max));
}

struct OnTheWay {
    BlockOfRows block;
    std::exception_ptr fault;
    double seconds = 0;

    bool goes_on() const { return !fault && block.size != 0; }

    template <class Stage>
    void run(const Stage& stage) {
        try {
            stage(block);
        } catch (...) {
            fault = std::current_exception();
        }
    }
};

}  // namespace

void BlockPipeline::read(BlockOfRows& block) {
    Stopwatch watch;
    block.first = taken_;
    block.size = 0;
    if (!more_) return;
    const std::size_t size = size_of_blocks(source_.count, threads_, cells_);
    source_.read(size, block);
    seconds_.read += watch.lap();
    taken_ += block.size;
    // A map is read to its end, where it may have too much.
    more_ = source_.located || (block.size == size && source_.count != taken_);
    block.last = !more_;
}

void BlockPipeline::locate_in(const Locator& locator) {
    const locate::LocatorData& data = locate::LocatorData::of(locator);
    cells_ = data.index.cell_count();
    // Prepares for all points: it would not pay for one block.
    base::in_arena(threads_, cells_,
                   [&] { data.policy.prepare(std::max<std::uint64_t>(source_.count.value_or(0), taken_)); });
}

void BlockPipeline::run(const Stage& work, const Stage& write) {
    const int workers = base::threads_of(threads_);
    // Blocks leave in the order in which they came: before one comes, the last but so many has left.
    std::vector<OnTheWay> ring(static_cast<std::size_t>(workers) + 2);
    std::size_t taken = 0;             // of the reading stage alone
    bool ended = false;                // likewise
    std::atomic<bool> stopped{false};  // by the writing stage
    std::exception_ptr fault;          // of the writing stage alone
    double seconds = 0;                // likewise
    const auto next = [&](tbb::flow_control& control) -> OnTheWay* {
        const ExactEnvironment of_task;  // the arena is the caller's
        if (ended || stopped) {
            control.stop();
            return nullptr;
        }
        OnTheWay& b = ring[taken++ % ring.size()];
        b.fault = nullptr;
        if (first_)
            b.block = *std::exchange(first_, std::nullopt);
        else
            b.run([&](BlockOfRows& block) { read(block); });
        ended = !b.goes_on();
        return &b;
    };
    const auto done = [&](OnTheWay* b) {
        const ExactEnvironment of_task;
        if (!b->goes_on() || stopped) return b;
        Stopwatch watch;
        b->run(work);
        b->seconds = watch.lap();
        return b;
    };
    const auto put = [&](OnTheWay* b) {
        const ExactEnvironment of_task;
        if (stopped) return;
        if (b->goes_on()) {
            seconds += b->seconds;
            b->run(write);
        }
        fault = b->fault;
        stopped = fault != nullptr;
    };
    base::in_arena(workers, std::numeric_limits<std::size_t>::max(), [&] {
        using tbb::filter_mode;
        tbb::parallel_pipeline(ring.size(), tbb::make_filter<void, OnTheWay*>(filter_mode::serial_in_order, next) &
                                                tbb::make_filter<OnTheWay*, OnTheWay*>(filter_mode::parallel, done) &
                                                tbb::make_filter<OnTheWay*, void>(filter_mode::serial_in_order, put));
    });
    seconds_.sample += seconds / workers;
    if (fault) std::rethrow_exception(fault);
}

}  // namespace barycert::jobs
