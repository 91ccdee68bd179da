// ExactEnvironment itself: sets what must hold, puts back what was there, also by exceptions, in threads and within
// oneTBB.
#include "barycert/environment.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/core/same_everywhere.hpp"

namespace barycert {
namespace {

using testing_environments::all_environments;
using testing_environments::Changed;
using testing_environments::Controls;

const Controls initial = Controls::now();

TEST(ExactEnvironment, SetsWhatHoldsAtTheStartOfAProcessAndPutsBackWhatWasThere) {
    for (const auto& e : all_environments()) {
        Controls before, within, after, thrown;
        bool found = false, held = false;
        barycert::Environment measured;
        {
            const Changed changed(e);
            before = Controls::now();
            found = rounds_correctly();
            {
                const ExactEnvironment exact;
                within = Controls::now();
                held = rounds_correctly();
                measured = measure_environment();
                const ExactEnvironment again;
            }
            after = Controls::now();
            try {
                const ExactEnvironment exact;
                throw std::runtime_error("out");
            } catch (const std::runtime_error&) {
                thrown = Controls::now();
            }
        }
        EXPECT_EQ(found, e.is_default) << e.name;
        EXPECT_TRUE(held) << e.name;
        EXPECT_TRUE(within == initial) << e.name;
        EXPECT_TRUE(after == before) << e.name;
        EXPECT_TRUE(thrown == before) << e.name;
        EXPECT_TRUE(check_environment(measured)) << e.name;
    }
    EXPECT_TRUE(Controls::now() == initial);
}

TEST(ExactEnvironment, RenewEndsWhatForeignCodeLeaves) {
    for (const auto& e : all_environments()) {
        Controls renewed, after;
        const Controls before = Controls::now();
        {
            const ExactEnvironment exact;
            std::fesetround(e.rounding);
#ifdef __SSE2__
            _mm_setcsr(_mm_getcsr() | e.flags);
#endif
            ExactEnvironment::renew();
            renewed = Controls::now();
        }
        after = Controls::now();
        EXPECT_TRUE(renewed == initial) << e.name;
        EXPECT_TRUE(after == before) << e.name;
    }
}

#ifdef __SSE2__
// Each register alone, and traps: catches one that is looked at only where the other says so.
TEST(ExactEnvironment, EachRegisterCountsAndExceptionsAreMasked) {
    const auto set_x87 = [](std::uint16_t word) { __asm__ volatile("fldcw %0" : : "m"(word)); };
    const std::uint32_t sse[] = {0x1f00, 0x0f80, 0x1f80 & ~0x1000U, 0x1f80 | 0x2000, 0x1f80 | 0x8000, 0x1f80 | 0x40};
    for (const std::uint32_t word : sse) {
        _mm_setcsr(word);
        const bool found = rounds_correctly();
        bool held = false;
        {
            const ExactEnvironment exact;
            volatile double zero = 0, one = 1, three = 3;
            zero = one / zero + one / three;  // traps where exceptions are not masked
            held = rounds_correctly();
        }
        const std::uint32_t after = _mm_getcsr();
        _mm_setcsr(0x1f80);
        EXPECT_FALSE(found) << std::hex << word;
        EXPECT_TRUE(held) << std::hex << word;
        EXPECT_EQ(after, word) << std::hex << word;
    }
    for (const int word : {0x027f, 0x0b7f, 0x077f, 0x0f7f, 0x035f}) {
        set_x87(static_cast<std::uint16_t>(word));
        const bool found = rounds_correctly();
        bool held = false;
        {
            const ExactEnvironment exact;
            volatile long double zero = 0, one = 1, three = 3;
            zero = one / zero + one / three;
            held = rounds_correctly();
        }
        const std::uint16_t after = Controls::now().x87;
        set_x87(0x037f);
        EXPECT_FALSE(found) << std::hex << word;
        EXPECT_TRUE(held) << std::hex << word;
        EXPECT_EQ(after, word) << std::hex << word;
    }
}
#endif

/// How many of 64 tasks find another environment than the exact one.
int tasks_that_find_another() {
    std::atomic<int> count{0};
    tbb::parallel_for(0, 64, [&](int) {
        count += rounds_correctly() ? 0 : 1;
        std::this_thread::sleep_for(std::chrono::microseconds(300));  // for other threads to take a part
    });
    return count;
}

// The library relies on this: an arena takes over the environment in which it is made, whoever asks later; a thread,
// that of its maker. It must not rely on the caller's own arena.
TEST(ExactEnvironment, ArenasAndThreadsTakeOverTheEnvironmentInWhichTheyAreMade) {
    for (const auto& e : all_environments()) {
        int callers = 0, own = 0, nested = 0, in_group = 0, in_thread = 0;
        Controls before, after;
        // In a thread of its own, for the arena of a thread is made once.
        std::thread([&] {
            const Changed changed(e);
            before = Controls::now();
            callers = tasks_that_find_another();
            {
                const ExactEnvironment exact;
                tbb::task_arena arena(2);
                arena.execute([&] { own = tasks_that_find_another(); });
                std::thread([&] { in_thread = rounds_correctly() ? 0 : 1; }).join();
            }
            tbb::parallel_for(0, 4, [&](int i) {
                const ExactEnvironment exact;
                tbb::task_arena arena(2);
                arena.execute([&] {
                    const int found = tasks_that_find_another();
                    if (i == 0) nested = found;
                    std::atomic<int> count{0};
                    tbb::task_group group;
                    group.run([&] { count += rounds_correctly() ? 0 : 1; });
                    group.wait();
                    if (i == 0) in_group = count;
                });
            });
            after = Controls::now();
        }).join();
        EXPECT_EQ(callers, e.is_default ? 0 : 64) << e.name;
        EXPECT_EQ(own, 0) << e.name;
        EXPECT_EQ(nested, 0) << e.name;
        EXPECT_EQ(in_group, 0) << e.name;
        EXPECT_EQ(in_thread, 0) << e.name;
        EXPECT_TRUE(before == after) << e.name;
    }
}

}  // namespace
}  // namespace barycert
