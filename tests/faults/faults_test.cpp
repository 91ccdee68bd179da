// Any call of the system may fail: each command then ends with one clear error and leaves every file whole, or goes on
// as if nothing had failed. BARYCERT_FAULTS=N tries N failures of each kind and command, 0 every one there is.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "undisturbed.hpp"

namespace barycert::faults {
namespace {

using cli_test::Ended;
using test::Scratch;

std::size_t failures_to_try() {
    const char* const number = std::getenv("BARYCERT_FAULTS");
    const std::size_t n = number == nullptr ? 3 : std::strtoul(number, nullptr, 10);
    return n == 0 ? SIZE_MAX : n;
}

/// Numbers from 1 to `count`, all or evenly spread, the first and the last among them.
std::vector<long> spread(long count, std::size_t at_most) {
    std::vector<long> chosen;
    const auto all = static_cast<std::size_t>(count);
    const std::size_t n = std::min(all, at_most);
    for (std::size_t i = 0; i < n; ++i)
        chosen.push_back(1 + static_cast<long>(n == 1 ? 0 : static_cast<double>(i) * double(all - 1) / double(n - 1)));
    return chosen;
}

class Faults : public ::testing::TestWithParam<Command> {
protected:
    /// Says what is wrong about the end of a run with a failed call; empty if nothing.
    std::string wrong(const Ended& r, bool must_go_on) const {
        if (r.signal != 0) return "ended by signal " + std::to_string(r.signal);
        if (r.code == GetParam().code) {
            return without_numbers(r.out) == without_numbers(undisturbed_.out()) ? "" : "success with another output";
        }
        if (must_go_on) return "an error for what is none";
        if (r.code != 2) return "exit code " + std::to_string(r.code);
        std::size_t errors = 0;
        for (const std::string& line : cli_test::lines_of(r.err)) {
            if (!line.starts_with("error: ") && !line.starts_with("note: ")) return "a line that is no error";
            errors += line.starts_with("error: ") ? 1 : 0;
        }
        return errors == 1 ? "" : std::to_string(errors) + " errors";
    }

    void fails(const std::string& kind, const std::string& error, bool all_after) {
        const auto count = undisturbed_.calls().find(kind);
        ASSERT_NE(count, undisturbed_.calls().end());
        for (const long n : spread(count->second, failures_to_try())) {
            const Scratch folder, logs;
            undisturbed_.prepare(folder);
            const std::string fault = kind + ":" + std::to_string(n) + (all_after ? "+" : "");
            Words variables{"FAULT=" + fault, "FAULT_LOG=" + logs.path("log")};
            if (!error.empty()) variables.push_back("FAULT_ERROR=" + error);
            const Ended r = undisturbed_.run_with_shim(folder, variables);
            SCOPED_TRACE("FAULT=" + fault + " FAULT_ERROR=" + error + "\n" + r.err);
            EXPECT_EQ(wrong(r, error == "short" || error == std::to_string(EINTR)), "");
            std::size_t old = 0;
            EXPECT_EQ(undisturbed_.wrong_files(folder, old), "");
            EXPECT_TRUE(old == 0 || r.code == 2) << "success, but files are missing";
            ++tried_;
            failed_ += logs.names().empty() ? 0 : 1;
            ended_ += r.code == 2 ? 1 : 0;
            if (HasFailure()) return;  // one is enough to mend
        }
    }

    Undisturbed undisturbed_{GetParam()};
    std::size_t tried_ = 0, failed_ = 0, ended_ = 0;
};

TEST_P(Faults, LeaveWholeFilesAndOneError) {
    const auto begin = std::chrono::steady_clock::now();
    for (const auto& [kind, count] : undisturbed_.calls()) fails(kind, "", false);
    for (const std::string kind : {"read", "write"})
        for (const std::string& error : {std::string("short"), std::to_string(EINTR)}) fails(kind, error, false);
    for (const std::string kind : {"memory", "write", "open"}) fails(kind, "", true);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    std::printf("%-16s %6zu runs, %6zu with a failed call, %6zu ended with an error, %.1f s\n", GetParam().name.c_str(),
                tried_, failed_, ended_, seconds.count());
    // Numbers of calls vary a little from run to run, so that the last may not come; the shim must work all the same.
    EXPECT_GE(failed_ * 2, tried_);
    EXPECT_GT(ended_, 0U);
}

#ifdef BARYCERT_TETGEN_PROGRAM
// Libraries that promise to throw nothing need memory, too.
TEST(FaultsOfOptions, NoAllocationEndsTheProgramByASignal) {
    long failed = 0;
    for (long n = 1;; ++n) {
        const Scratch logs;
        const Ended r = cli_test::run(
            {"--version"}, {.environment = {"LD_PRELOAD=" BARYCERT_FAULT_LIBRARY, "FAULT=memory:" + std::to_string(n),
                                            "FAULT_LOG=" + logs.path("log")},
                            .program = BARYCERT_TETGEN_PROGRAM});
        if (logs.names().empty()) break;
        ++failed;
        EXPECT_EQ(r.signal, 0) << n;
        EXPECT_TRUE(r.code == 0 || (r.code == 2 && r.err.starts_with("error: out of memory"))) << n << ": " << r.err;
        if (HasFailure()) return;
    }
    EXPECT_GT(failed, 100);
}
#endif

INSTANTIATE_TEST_SUITE_P(commands, Faults, ::testing::ValuesIn(commands()),
                         [](const auto& command) { return command.param.name; });

}  // namespace
}  // namespace barycert::faults
