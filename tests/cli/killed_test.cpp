// A run that is killed leaves the files of the run before as they were, and nothing of its own.

#include <csignal>

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

class Killed : public ::testing::TestWithParam<int> {};

TEST_P(Killed, in_the_middle_of_the_work) {
    const Scratch scratch;
    const std::string report = scratch.put("r.json", "old report"), witnesses = scratch.put("w.json", "old witnesses");
    // On a terminal the progress tells that the work has begun.
    const Ended r = run({"audit", "--count", "1000000000", "--json", report, "--witnesses", witnesses},
                        {.terminal = true, .kill_on = " %  ", .kill_with = GetParam()});
    EXPECT_EQ(r.signal, GetParam());
    EXPECT_EQ(read_file(report), "old report");
    EXPECT_EQ(read_file(witnesses), "old witnesses");
    EXPECT_EQ(scratch.names(), (Words{"r.json", "w.json"}));
}

INSTANTIATE_TEST_SUITE_P(signals, Killed, ::testing::Values(SIGKILL, SIGINT, SIGTERM, SIGHUP),
                         [](const auto& signal) { return "signal_" + std::to_string(signal.param); });

}  // namespace
}  // namespace barycert::cli_test
