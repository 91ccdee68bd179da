// barycert search: as a process; its files are read by replay; Ctrl-C ends it with what was found.

#include <csignal>

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"
#include "tests/sanitized.hpp"

namespace barycert::cli_test {
namespace {

using Json = nlohmann::json;

Words short_search(const Words& more) {
    Words words{"search", "triangle.signed-area", "--steps", "30000"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(Search, TableSaysTheWorstAndThePlainestAndHowToSeeIt) {
    const Scratch scratch;
    const std::string file = scratch.path("w.json");
    const Ended r = run(short_search({"--witnesses", file}));
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    EXPECT_TRUE(contains(r.out, "triangle.signed-area: 30000 cases in "));
    EXPECT_TRUE(contains(r.out, "opposite_sign"));
    EXPECT_TRUE(contains(r.out, "worst_weight_ulp"));
    for (const std::string& line : lines_of(r.out)) EXPECT_LE(line.size(), 120U) << line;
    const Json all = parse(read_file(file));
    std::size_t commands = 0;
    for (const std::string& line : lines_of(r.out)) {
        if (line.rfind("    barycert replay ", 0) != 0) continue;
        ++commands;
        const Ended shown = run_shell(line.substr(4), {});
        EXPECT_EQ(shown.code, 0) << line << '\n' << shown.err;
        EXPECT_EQ(shown.err, "");
    }
    EXPECT_EQ(commands, all["witnesses"].size());
    EXPECT_EQ(run({"replay", file}).code, 0);
}

TEST(Search, TheSameSeedFindsTheSameAndAnotherDoesNot) {
    const auto witnesses = [](const std::string& seed, const std::string& threads) {
        return run(short_search({"--seed", seed, "--threads", threads, "--witnesses", "-"})).out;
    };
    const std::string one = witnesses("1", "1");
    EXPECT_TRUE(parse(one)["witnesses"].size() > 4);
    EXPECT_EQ(witnesses("1", "2"), one);
    EXPECT_NE(witnesses("2", "2"), one);
}

TEST(Search, JsonIsReadByReplayAndAgreesWithTheWitnesses) {
    const Scratch scratch;
    const Ended r =
        run(short_search({"--quiet", "--json", scratch.path("s.json"), "--witnesses", scratch.path("w.json")}));
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out + r.err, "");
    const Json report = parse(read_file(scratch.path("s.json")));
    EXPECT_EQ(report["steps"], 30000);
    EXPECT_EQ(report["stopped"], false);
    EXPECT_EQ(report["witnesses"], parse(read_file(scratch.path("w.json")))["witnesses"]);
    EXPECT_EQ(report["finds"].size(), report["witnesses"].size());
    EXPECT_EQ(run({"replay", scratch.path("s.json")}).code, 0);
}

TEST(Search, AUsersKernelAndRules) {
    const Ended right =
        run({"search", "--kernel-library", BARYCERT_SWAPPED_KERNEL, "--steps", "5000", "--fail-on", "any"});
    EXPECT_EQ(right.code, 1);
    EXPECT_TRUE(contains(right.err, "fails: tetrahedron.user-swapped: any = ")) << right.err;
    EXPECT_TRUE(contains(right.out, "false_certificate"));
    const Ended exact =
        run({"search", "tetrahedron.exact", "--steps", "5000", "--fail-on", "any", "--fail-on", "worst_weight_ulp"});
    EXPECT_EQ(exact.code, 0) << exact.err;
    EXPECT_TRUE(contains(exact.out, "no fault and no error found"));
    EXPECT_EQ(
        run({"search", "triangle.bilinear", "--steps", "2000", "--quiet", "--fail-on", "worst_weight_ulp>1e300"}).code,
        0);
}

/// A search of a kernel that misbehaves, in a process of its own.
Ended search_of(const std::string& fault, const Words& more) {
    Words words{"search", "--kernel-library", BARYCERT_CLI_UNRULY_DIR "/cli-unruly-" + fault + ".so"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
}

TEST(Search, ACrashIsToldWithItsCaseAndTheSearchGoesOn) {
    const Scratch scratch;
    const std::string file = scratch.path("w.json");
    const Ended r = search_of("crash", {"--family", "mesh.*", "--family", "random.inside", "--steps", "3000",
                                        "--witnesses", file, "--fail-on", "crashed"});
    EXPECT_EQ(r.signal, 0);
    EXPECT_EQ(r.code, 1) << r.err;
    EXPECT_TRUE(contains(r.err, "fails: tetrahedron.unruly: crashed = ")) << r.err;
    EXPECT_TRUE(contains(r.out, "\ncrashed\n    SIGFPE (Floating point exception)\n")) << r.out;
    EXPECT_TRUE(contains(r.out, "worst_weight_ulp")) << "what it answers is searched as well";
    // The command shows the crash again.
    bool shown = false;
    for (const std::string& line : lines_of(r.out)) {
        if (line.rfind("    barycert replay ", 0) != 0 || !contains(line, "--reason crashed")) continue;
        const Ended again = run_shell(line.substr(4));
        EXPECT_EQ(again.code, 0) << again.err;
        EXPECT_TRUE(contains(again.out, "SIGFPE")) << again.out;
        shown = true;
    }
    EXPECT_TRUE(shown) << r.out;
    // In this process it is the search's own.
    const Ended ended = search_of("crash", {"--steps", "3000", "--in-process"});
    EXPECT_NE(testing::sanitized ? ended.code : ended.signal, 0);  // a sanitizer tells of the signal, and exits
}

TEST(Search, WhatHardlyAnswersIsGivenUp) {
    for (const auto& [fault, finding] : {std::pair("hang", "hung"), std::pair("crash", "crashed")}) {
        const Ended r = search_of(fault, {"--steps", "1000000", "--time-limit", "0.02", "--json", "-"});
        EXPECT_EQ(r.code, 0) << r.err;
        const Json report = parse(r.out);
        EXPECT_EQ(report["given_up"], true) << fault;
        EXPECT_LT(report["steps"], 100000) << fault;
        EXPECT_EQ(report["finds"][0]["reason"], finding);
        EXPECT_NE(report["finds"][0]["found"]["detail"], "");
    }
    EXPECT_TRUE(contains(search_of("hang", {"--time-limit", "0.02"}).out, "given up before 1000000 cases"));
}

// There is no error to measure, which is worse than any.
TEST(Search, AKernelThatNeverAnswersBreaksARuleOnErrors) {
    const Ended r = search_of("always", {"--steps", "5000", "--quiet", "--fail-on", "worst_weight_ulp>1e300"});
    EXPECT_EQ(r.code, 1);
    EXPECT_TRUE(contains(r.err, "worst_weight_ulp = inf, limit 1e+300")) << r.err;
}

TEST(Search, ApartOrNotAKernelThatBehavesShowsTheSame) {
    const auto witnesses = [](const Words& more) {
        return parse(search_of("quiet", plus({"--steps", "1000", "--witnesses", "-"}, more)).out)["witnesses"];
    };
    const Json apart = witnesses({});
    EXPECT_GT(apart.size(), 3U);
    EXPECT_EQ(apart, witnesses({"--in-process", "--threads", "1"}));
    for (const Json& w : apart) EXPECT_FALSE(w.contains("detail"));
}

TEST(Search, BadUsageIsTold) {
    const auto error = [](const Words& words) {
        const Ended r = run(words);
        EXPECT_EQ(r.code, 2);
        EXPECT_EQ(r.out, "");
        return r.err;
    };
    EXPECT_TRUE(contains(error({"search"}), "the name of one kernel, or --kernel-library FILE"));
    EXPECT_TRUE(contains(error({"search", "nobody"}), "\"nobody\""));
    EXPECT_TRUE(contains(error({"search", "triangle.*"}), " of them"));
    EXPECT_TRUE(contains(error(short_search({"--exponents", "x"})),
                         "expected LOW:HIGH, integers from -1074 to 1023, such as -10:10, found \"x\"\n"));
    EXPECT_TRUE(contains(error(short_search({"--exponents", "5"})), "LOW:HIGH"));
    EXPECT_TRUE(contains(error(short_search({"--exponents", "5:x"})), "LOW:HIGH"));
    EXPECT_TRUE(contains(error(short_search({"--exponents", "5:4"})), "LOW <= HIGH"));
    EXPECT_TRUE(contains(error(short_search({"--exponents", "-2000:4"})), "-1074"));
    EXPECT_TRUE(contains(error(short_search({"--fail-on", "worst_partition_residual"})), "does not measure"));
    EXPECT_TRUE(contains(error(short_search({"--steps", "0"})), "--steps"));
    EXPECT_TRUE(contains(error(short_search({"--seconds", "0"})), "--seconds"));
    EXPECT_TRUE(contains(error(short_search({"--json", "a.json", "--witnesses", "a.json"})), "a.json"));
}

// The line of progress tells that it has begun; a signal then ends the search and not the program.
TEST(Search, InterruptedItTellsWhatItFound) {
    const Scratch scratch;
    const Ended r =
        run({"search", "tetrahedron.cramer", "--steps", "1000000000", "--witnesses", scratch.path("w.json")},
            {.terminal = true, .kill_on = "Ctrl-C", .kill_with = SIGINT});
    EXPECT_EQ(r.signal, 0);
    EXPECT_EQ(r.code, 0) << r.out;
    EXPECT_TRUE(contains(r.out, "stopped before 1000000000 cases")) << r.out;
    EXPECT_FALSE(parse(read_file(scratch.path("w.json")))["witnesses"].empty());
}

TEST(Search, ATimeLimitEndsIt) {
    const Ended r = run({"search", "tetrahedron.cramer", "--steps", "1000000000", "--seconds", "0.2"});
    EXPECT_EQ(r.code, 0);
    EXPECT_TRUE(contains(r.out, "stopped before"));
}

}  // namespace
}  // namespace barycert::cli_test
