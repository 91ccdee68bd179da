// The stack that calls of the exact core need: that of a painted thread, at the full spread of exponents.
#include <pthread.h>
#include <sys/mman.h>

#include <cstring>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/core/extremes.hpp"

namespace barycert::testing_extremes {
namespace {

#if defined(__SANITIZE_ADDRESS__) || !defined(__OPTIMIZE__)
constexpr bool as_shipped = false;  // frames are several times larger
#else
constexpr bool as_shipped = true;
#endif

/// As barycert.hpp has it.
constexpr std::size_t max_stack = std::size_t{128} * 1024;

constexpr std::size_t stack_size = std::size_t{1} << 20;
constexpr unsigned char paint = 0xa5;

struct Job {
    const Call* call;
    const std::vector<Extreme>* cases;
    bool good = true;
};

void* run(void* argument) {
    Job& job = *static_cast<Job*>(argument);
    for (const Extreme& e : *job.cases) job.good = job.call->ask(e) && job.good;
    return nullptr;
}

void* run_nothing(void*) {
    return nullptr;
}

/// Bytes of its stack that a thread has written to.
std::size_t stack_of(void* (*work)(void*), void* argument) {
    auto* const stack = static_cast<unsigned char*>(
        ::mmap(nullptr, stack_size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0));
    std::memset(stack, paint, stack_size);
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    EXPECT_EQ(pthread_attr_setstack(&attributes, stack, stack_size), 0);
    pthread_t thread;
    EXPECT_EQ(pthread_create(&thread, &attributes, work, argument), 0);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
    std::size_t free = 0;
    while (free < stack_size && stack[free] == paint) ++free;  // it grows downwards
    ::munmap(stack, stack_size);
    return stack_size - free;
}

TEST(Stack, EveryCallStaysWithinTheBoundOfTheContract) {
    if (!as_shipped) GTEST_SKIP() << "for optimised builds without sanitizers";
    const std::vector<Extreme> cases = extremes(200);
    const std::size_t thread_alone = stack_of(run_nothing, nullptr);
    std::vector<Call> calls = single_calls();
    for (Call& call : batch_calls()) calls.push_back(std::move(call));
    std::size_t max = 0;
    for (const Call& call : calls) {
        Job job{&call, &cases};
        const std::size_t bytes = stack_of(run, &job) - thread_alone;
        EXPECT_TRUE(job.good) << call.name;
        EXPECT_LE(bytes, max_stack) << call.name;
        std::printf("    %7zu bytes  %s\n", bytes, call.name.c_str());
        max = std::max(max, bytes);
    }
    // The bound is not idle, and the measurement measures: the widest integers alone take half of it.
    EXPECT_GT(max, max_stack / 2);
    RecordProperty("bytes", std::to_string(max));
}

}  // namespace
}  // namespace barycert::testing_extremes
