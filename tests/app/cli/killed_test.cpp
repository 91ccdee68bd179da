// A run that a signal ends leaves the files of the run before as they were, and nothing of its own.

#include <unistd.h>

#include <csignal>

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

class Killed : public ::testing::TestWithParam<int> {};

TEST_P(Killed, InTheMiddleOfTheWork) {
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

/// The signal comes when the first bytes of an output have been written.
Words watched(int signal, bool names, bool parent = false) {
    Words environment{"LD_PRELOAD=" BARYCERT_WATCHED_FILES, "WATCHED_SIGNAL=" + std::to_string(signal),
                      // A sanitizer insists on being the first library.
                      "ASAN_OPTIONS=verify_asan_link_order=0"};
    if (names) environment.emplace_back("WATCHED_NAMES=1");
    if (parent) environment.emplace_back("WATCHED_PARENT=1");
    return environment;
}

TEST_P(Killed, InTheMiddleOfWriting) {
    for (const bool names : {false, true}) {
        // A name that has to exist is left by what no program can see coming.
        if (names && GetParam() == SIGKILL) continue;
        const Scratch scratch;
        const std::string old = scratch.put("old", "old"), out = scratch.path("c");
        const std::string points = scratch.put("p.csv", "0,0,0\n0.1,0.1,0.1\n");
        for (const Words& arguments :
             std::vector<Words>{{"audit", "--count", "5", "--kernel", "segment.*", "--json", old},
                                {"check", mesh("bracket"), "--html", old},
                                {"check", mesh("bracket"), "--fix-orientation", out},
                                {"sample", mesh("bracket"), "--points", points, "--output", old + ".npy"},
                                {"sample", mesh("bracket"), "--points", points, "--output", "-", "--save-map", out},
                                {"resample", mesh("bracket"), "--grid", "5x5x5", "--output", out + ".vti"},
                                {"render", "gradient", "--output", out + ".png"}}) {
            const Ended r = run(arguments, {.environment = watched(GetParam(), names)});
            EXPECT_EQ(r.signal, GetParam()) << ::testing::PrintToString(arguments) << r.err;
            EXPECT_EQ(scratch.names(), (Words{"old", "p.csv"})) << ::testing::PrintToString(arguments);
            EXPECT_EQ(read_file(old), "old");
        }
    }
}

#ifdef BARYCERT_TETGEN_PROGRAM
TEST_P(Killed, WhileTheMesherWrites) {
    const std::string cube = std::string(BARYCERT_DATA_DIR) + "/plc/cube-hole.poly";
    for (const bool names : {false, true}) {
        const Scratch scratch;
        const Ended r = run({cube, "--output", scratch.path("m")},
                            {.environment = watched(GetParam(), names, true), .program = BARYCERT_TETGEN_PROGRAM});
        EXPECT_EQ(r.signal, GetParam()) << r.err;
        // The process that writes outlives its parent by a moment.
        for (int i = 0; i < 100 && !scratch.names().empty(); ++i) ::usleep(50000);
        EXPECT_EQ(scratch.names(), Words{}) << names;
    }
}
#endif

INSTANTIATE_TEST_SUITE_P(signals, Killed, ::testing::Values(SIGKILL, SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE),
                         [](const auto& signal) { return "signal_" + std::to_string(signal.param); });

TEST(Killed, ASignalThatIsIgnoredStaysIgnored) {
    const Scratch scratch;
    const Ended r = run_shell(
        "trap '' HUP; barycert audit --quiet --count 20000 --kernel 'segment.*' --json r.json & "
        "sleep 0.2; kill -HUP $!; wait $!",
        {.folder = scratch.folder()});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(scratch.names(), Words{"r.json"});
}

// The bytes of a map wait in memory until there are enough; rows go to a reader that has stopped reading.
TEST(Killed, AReaderThatStopsReadingLeavesNoHalfMap) {
    for (const std::string names :
         {"", "WATCHED_NAMES=1 ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" BARYCERT_WATCHED_FILES " "}) {
        const Scratch scratch;
        const Ended made = run_shell(
            "seq -f '%.0f,%.0f,%.0f' 1 300000 > p.csv 2>/dev/null || "
            "awk 'BEGIN { for (i = 0; i < 300000; ++i) print i % 7 \",\" i % 5 \",\" i % 3 }' > p.csv",
            {.folder = scratch.folder()});
        ASSERT_EQ(made.code, 0) << made.err;
        const Ended r = run_shell("(" + names + "barycert sample " + mesh("bracket") +
                                      " --points p.csv --output - --save-map m; echo $? > code) | head -n 1",
                                  {.folder = scratch.folder()});
        EXPECT_EQ(read_file(scratch.path("code")), "141\n") << r.err;
        EXPECT_EQ(scratch.names(), (Words{"code", "p.csv"})) << names;
    }
}

TEST(Killed, WhereFilesNeedNamesAllWorksAsElsewhere) {
    const Scratch scratch;
    const How named{.environment = {"LD_PRELOAD=" BARYCERT_WATCHED_FILES, "WATCHED_NAMES=1",
                                    "ASAN_OPTIONS=verify_asan_link_order=0"}};
    for (const int round : {1, 2}) {  // made, then replaced
        EXPECT_EQ(run({"check", mesh("bracket"), "--quiet", "--fix-orientation", scratch.path("c")}, named).code, 0);
        EXPECT_EQ(
            run({"resample", mesh("bracket"), "--grid", "3x3x3", "--quiet", "--output", scratch.path("g.vti")}, named)
                .code,
            0)
            << round;
    }
    EXPECT_EQ(scratch.names(), (Words{"c.ele", "c.face", "c.neigh", "c.node", "g.vti"}));
    const Ended full = run({"check", mesh("bracket"), "--quiet", "--fix-orientation", scratch.path("d")},
                           {.environment = named.environment, .max_file = 60000});
    EXPECT_EQ(full.code, 2);
    EXPECT_EQ(scratch.names(), (Words{"c.ele", "c.face", "c.neigh", "c.node", "g.vti"}));
}

}  // namespace
}  // namespace barycert::cli_test
