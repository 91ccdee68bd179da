/// Every way in which a child can end is told apart.
#include "app/tetgen/child.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace barycert::test {
namespace {

TEST(Child, ReturnsAnswersAndPrints) {
    const ChildOutcome outcome = run_in_child(
        [](const Answer& answer) {
            answer("one\n");
            std::printf("to stdout ");
            std::fflush(stdout);
            std::fprintf(stderr, "to stderr");
            answer("two\n");
        },
        10);
    EXPECT_EQ(outcome.answer, "one\ntwo\n");
    EXPECT_EQ(outcome.printed, "to stdout to stderr");
    EXPECT_EQ(outcome.exit_code, finished_code);
    EXPECT_FALSE(outcome.signal || outcome.timed_out);
    EXPECT_EQ(outcome.failure, "");
}

TEST(Child, LeavesByExit) {
    const ChildOutcome outcome = run_in_child([](const Answer&) { _exit(3); }, 0);
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.answer, "");
}

TEST(Child, DiesOfASignal) {
    for (const int signal : {SIGSEGV, SIGABRT, SIGKILL}) {
        const ChildOutcome outcome = run_in_child(
            [signal](const Answer&) {
                std::signal(signal, SIG_DFL);  // sanitizers would exit instead
                std::raise(signal);
            },
            0);
        EXPECT_EQ(outcome.signal, signal);
        EXPECT_FALSE(outcome.timed_out);
    }
}

TEST(Child, ThrowsWhatNobodyCatches) {
    EXPECT_EQ(run_in_child([](const Answer&) { throw 1; }, 0).signal, SIGABRT);
}

TEST(Child, RunsOutOfTime) {
    const ChildOutcome outcome = run_in_child([](const Answer&) { pause(); }, 0.05);
    EXPECT_TRUE(outcome.timed_out);
}

// The clock stops at the first answer: files that are being written are not cut short.
TEST(Child, IsNotStoppedAfterItsFirstAnswer) {
    const ChildOutcome outcome = run_in_child(
        [](const Answer& answer) {
            answer("meshed\n");
            usleep(200'000);
            answer("written\n");
        },
        0.1);
    EXPECT_FALSE(outcome.timed_out);
    EXPECT_EQ(outcome.answer, "meshed\nwritten\n");
}

}  // namespace
}  // namespace barycert::test
