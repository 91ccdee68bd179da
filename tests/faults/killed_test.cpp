// SIGKILL at random moments of every command: each file is the old one or the new one, whole. BARYCERT_KILLS=N kills
// each command N times.

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "undisturbed.hpp"

namespace barycert::faults {
namespace {

class Killed : public ::testing::TestWithParam<Command> {};

TEST_P(Killed, LeavesWholeFiles) {
    const char* const number = std::getenv("BARYCERT_KILLS");
    const int kills = number == nullptr ? 6 : std::atoi(number);
    const Undisturbed undisturbed(GetParam());
    std::mt19937_64 random(7);
    // A process that has ended is a zombie until it is waited for: a signal that comes too late harms nobody.
    std::uniform_int_distribution<long> moment(1, undisturbed.time().count() * 11 / 10);
    int killed = 0;
    for (int i = 0; i < kills; ++i) {
        const test::Scratch folder;
        undisturbed.prepare(folder);
        const std::chrono::microseconds after(moment(random));
        const cli_test::Ended r = undisturbed.run(folder, {.kill_after = after});
        std::size_t old = 0;
        EXPECT_EQ(undisturbed.wrong_files(folder, old, true), "") << "killed after " << after.count() << " us";
        if (r.signal == SIGKILL)
            ++killed;
        else
            EXPECT_EQ(old, 0U) << "it has ended, but files are missing";
    }
    std::printf("%-16s %d of %d killed\n", GetParam().name.c_str(), killed, kills);
    EXPECT_GT(killed, 0);
}

INSTANTIATE_TEST_SUITE_P(commands, Killed, ::testing::ValuesIn(commands()),
                         [](const auto& command) { return command.param.name; });

}  // namespace
}  // namespace barycert::faults
