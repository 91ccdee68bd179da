// A user's kernel that misbehaves, as the user meets it: the audit survives, tells the case, and the command replays
// it.

#include <gtest/gtest.h>

#include <csignal>

#include "process.hpp"
#include "tests/processes.hpp"
#include "tests/sanitized.hpp"

namespace barycert::cli_test {
namespace {

using Json = nlohmann::json;

std::string unruly(const std::string& fault) {
    return std::string(BARYCERT_CLI_UNRULY_DIR) + "/cli-unruly-" + fault + ".so";
}

Words audit_of(const std::string& fault, Words more = {}) {
    Words words{"audit", "--kernel-library", unruly(fault), "--family", "mesh.inside", "--count", "300"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// The first line that begins with "    barycert replay" after the one of the finding.
std::string replay_command(const std::string& table, const std::string& finding) {
    bool found = false;
    for (const std::string& line : lines_of(table)) {
        found = found || line.rfind(finding + ": ", 0) == 0;
        if (found && line.rfind("    barycert replay ", 0) == 0) return line.substr(4);
    }
    return {};
}

TEST(Contained, AccidentsAreToldAndReplayed) {
    for (const auto& [fault, finding] : {std::pair("crash", "crashed"), std::pair("after", "out_of_bounds"),
                                         std::pair("round", "changed_environment"), std::pair("print", "printed")}) {
        SCOPED_TRACE(fault);
        const Ended r = run(audit_of(fault, {"--fail-on", finding}));
        EXPECT_EQ(r.code, 1);
        EXPECT_TRUE(contains(r.err, std::string("fails: tetrahedron.unruly: ") + finding + " = 9, limit 0")) << r.err;
        EXPECT_FALSE(contains(r.out, "point 1\n")) << "the kernel's own output";
        EXPECT_TRUE(contains(r.out, std::string("\n") + finding + ": 9 cases: ")) << r.out;
        EXPECT_TRUE(contains(r.out, "decided: "));
        const Ended again = run_shell(replay_command(r.out, finding));
        EXPECT_EQ(again.code, 0) << again.err;
        EXPECT_TRUE(contains(again.out, finding)) << again.out;
        EXPECT_TRUE(contains(again.out, "    cell ")) << again.out;
    }
}

TEST(Contained, AnAccidentThatDoesNotComeBackIsSaidNotTo) {
    const Scratch scratch;
    const Ended r = run(audit_of("later", {"--witnesses", scratch.path("w.json")}));
    EXPECT_EQ(r.code, 0) << r.err;
    ASSERT_TRUE(contains(r.out, "\ncrashed: ")) << r.out;
    for (const std::string& command :
         {replay_command(run(audit_of("later")).out, "crashed"),
          "barycert replay " + scratch.path("w.json") + " --reason crashed --kernel-library " + unruly("later")}) {
        const Ended again = run_shell(command);
        EXPECT_EQ(again.code, 1) << command << again.out;
        EXPECT_TRUE(
            contains(again.err, "not reproduced: crashed of tetrahedron.unruly: asked once more, the kernel did not"))
            << again.err;
    }
    const Ended wrong = run(
        {"replay", "--family", "huge", "--case", "1", "--kernel", "tetrahedron.exact", "--reason", "worst_weight_ulp"});
    EXPECT_EQ(wrong.code, 2);
    EXPECT_TRUE(contains(wrong.err, "expected a class of finding")) << wrong.err;
}

TEST(Contained, FamiliesThatWereNotRunAreSaidToBe) {
    const Scratch scratch;
    const auto with = [&](Words more) {
        Words words{"audit", "--kernel-library", unruly("always"), "--family",  "random", "--family",
                    "huge",  "--count",          "2000",           "--threads", "1"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    const Ended table = with({"--json", scratch.path("r.json"), "--html", scratch.path("r.html"), "--junit",
                              scratch.path("r.xml"), "--sarif", scratch.path("r.sarif")});
    EXPECT_EQ(table.code, 0) << table.err;
    EXPECT_TRUE(contains(table.out, "\nhuge        - not run ")) << table.out;
    EXPECT_TRUE(contains(table.out, "given up: ")) << table.out;
    EXPECT_TRUE(contains(with({"--wide"}).out, "0/1         -        -  not run\n"));
    const Json families = parse(read_file(scratch.path("r.json")))["kernels"][0]["families"];
    ASSERT_EQ(families.size(), 2U);
    EXPECT_EQ(families[0]["cases"].get<int>() + families[0]["not_run"].get<int>(), 2000);
    EXPECT_EQ(families[1]["cases"], 0);
    EXPECT_EQ(families[1]["not_run"], 2000);
    const std::string page = read_file(scratch.path("r.html"));
    EXPECT_TRUE(contains(page.substr(page.find(">huge</th>")), "<td class=\"n\" data-v=\"-1\">not run</td>"));
    for (const char* ci : {"r.xml", "r.sarif"})
        EXPECT_TRUE(contains(read_file(scratch.path(ci)), "cases were not run: the kernel had been given up")) << ci;
}

TEST(Contained, AHangIsEndedByTheTimeLimit) {
    const Ended r = run(audit_of("hang", {"--time-limit", "0.05", "--json", "-"}));
    EXPECT_EQ(r.code, 0) << r.err;
    const Json report = parse(r.out);
    EXPECT_EQ(report["kernels"][0]["hung"], 9);
    EXPECT_EQ(report["kernels"][0]["contained"], true);
    EXPECT_EQ(report["witnesses"][0]["detail"], "no answer within 0.05 s");
    EXPECT_TRUE(report["witnesses"][0]["cell"].is_number_unsigned());
}

TEST(Contained, ProcessesThatAKernelStartsEndWithTheAudit) {
    for (const char* fault : {"forks_always", "daemon"}) {
        const test::Orphanage orphanage;
        const Ended r = run(audit_of(fault, {"--json", "-"}));
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_GE(parse(r.out)["kernels"][0]["forked"], 9) << fault;
        EXPECT_EQ(orphanage.left_behind(), 0U) << fault;
        // Nor does anything remain where the audit itself is ended, in the middle of it.
        const Ended killed = run({"audit", "--kernel-library", unruly(fault), "--count", "100000000"},
                                 {.terminal = true, .kill_on = " %  ", .kill_with = SIGKILL});
        EXPECT_EQ(killed.signal, SIGKILL) << killed.out;
        EXPECT_EQ(orphanage.left_behind(), 0U) << fault;
    }
}

TEST(Contained, ALimitOfMemoryHoldsForAKernel) {
    if (testing::sanitized) GTEST_SKIP() << "the sanitizer takes terabytes of addresses";
    // It asks for a gibibyte, and does not look whether it got one.
    const Ended r = run_shell("ulimit -v 1000000; exec barycert audit --kernel-library " + unruly("leak") +
                              " --family mesh.inside --count 300 --threads 1 --json -");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(parse(r.out)["kernels"][0]["crashed"], 9);
}

TEST(Contained, GivenUpIsWorseThanABaselineAndNotOtherCases) {
    const Scratch scratch;
    const auto audit = [&](const std::string& fault, const Words& more) {
        // After 16 hangs it is not asked again.
        Words words{"audit", "--kernel-library", unruly(fault),  "--family", "mesh.inside", "--count",
                    "1000",  "--quiet",          "--time-limit", "0.02"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    const std::string sound = scratch.path("sound.json"), hangs = scratch.path("hangs.json");
    ASSERT_EQ(audit("quiet", {"--json", sound}).code, 0);
    const Ended worse = audit("hang", {"--baseline", sound, "--json", hangs, "--annotations"});
    EXPECT_EQ(worse.code, 1) << worse.err;
    EXPECT_TRUE(contains(worse.err, "worse: tetrahedron.unruly in mesh.inside: not_run 0 -> ")) << worse.err;
    EXPECT_TRUE(contains(worse.out, "::error ") && contains(worse.out, "not_run 0 -> ")) << worse.out;
    const Ended same = audit("hang", {"--baseline", hangs});
    EXPECT_EQ(same.code, 0) << same.err;
    EXPECT_TRUE(contains(same.err, "; in 1 pairs the kernel was given up")) << same.err;
    EXPECT_EQ(audit("quiet", {"--baseline", hangs}).code, 0);
}

TEST(Contained, ALibraryThatDiesWhileItIsLoadedIsAnError) {
    const Ended r = run(audit_of("loading"));
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(r.out, "");
    EXPECT_TRUE(contains(r.err, "its process ended while it was loaded: SIGABRT")) << r.err;
}

#if defined(__x86_64__)
TEST(Contained, ALibraryThatChangesTheEnvironmentWhenLoadedIsToldOf) {
    const Ended r = run(audit_of("loaded_flush", {"--quiet", "--fail-on", "any"}));
    EXPECT_EQ(r.code, 0);
    EXPECT_TRUE(contains(r.err, "note: ")) << r.err;
    EXPECT_TRUE(contains(r.err, "loading it changes the floating-point environment: subnormal results flushed to zero"))
        << r.err;
}
#endif

TEST(Contained, TheListOfKernelsLoadsItApartAsWell) {
    const Ended r = run({"kernels", "--kernel-library", unruly("loading")});
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(contains(r.err, "SIGABRT")) << r.err;
    EXPECT_TRUE(contains(run({"kernels", "--kernel-library", unruly("rule")}).out, "inside by a rule of its own"));
}

TEST(Contained, InProcessIsAsItWas) {
    const auto figures = [](Words more) {
        Json kernel = parse(run(audit_of("quiet", std::move(more))).out)["kernels"][0];
        for (const char* own : {"ns", "contained"}) kernel.erase(own);
        return kernel;
    };
    EXPECT_EQ(figures({"--json", "-"}), figures({"--json", "-", "--in-process"}));
    // In this process a crash is the audit's own.
    const Ended ended = run(audit_of("crash", {"--in-process"}));
    EXPECT_NE(testing::sanitized ? ended.code : ended.signal, 0);  // a sanitizer tells of the signal, and exits
}

TEST(Contained, ARuleOfItsOwnOrOfTheCommandLine) {
    const auto kernel = [](const std::string& fault, Words more) {
        Words words{"audit", "--kernel-library", unruly(fault), "--family", "random", "--count", "1000", "--json", "-"};
        words.insert(words.end(), more.begin(), more.end());
        return parse(run(words).out)["kernels"][0];
    };
    const Json plain = kernel("quiet", {}), tolerant = kernel("quiet", {"--class-tolerance", "0.25"}),
               own = kernel("rule", {}), both = kernel("rule", {"--class-tolerance", "0"});
    EXPECT_EQ(plain["region_rule"], "sign");
    EXPECT_EQ(plain["false_inside"], 0);
    EXPECT_EQ(tolerant["region_rule"], "tolerant");
    EXPECT_EQ(tolerant["tolerance"], 0.25);
    EXPECT_GT(tolerant["false_inside"], 10);
    EXPECT_EQ(own["region_rule"], "own");
    EXPECT_EQ(own["false_inside"], tolerant["false_inside"]) << "the library has the same rule";
    EXPECT_EQ(both["false_inside"], own["false_inside"]) << "its own rule stands";
}

TEST(Oracle, ChoicesAgreeAndAreTold) {
    const auto report = [](const Words& choice) {
        Words words{
            "audit",  "--kernel", "tetrahedron.inverse", "--family", "huge", "--family", "mesh.faces", "--count", "300",
            "--json", "-"};
        words.insert(words.end(), choice.begin(), choice.end());
        return parse(run(words).out);
    };
    const Json usual = report({});
    EXPECT_EQ(usual["oracles"]["choice"], "automatic");
    for (const char* choice : {"integers", "cgal", "both"}) {
        const Json other = report({"--oracle", choice});
        EXPECT_EQ(other["oracles"]["choice"], choice);
        // Who decided all of the cases; of two who disagree nothing would be told.
        EXPECT_EQ(other["cases"], 600);
        EXPECT_EQ(other["oracles"]["core"], 0);
        EXPECT_EQ(other["oracles"][choice == std::string("cgal") ? "cgal" : "integers"], 600);
        EXPECT_EQ(other["regions"], usual["regions"]);
        EXPECT_EQ(other["kernels"][0]["wrong_cases"], usual["kernels"][0]["wrong_cases"]);
        EXPECT_EQ(other["oracles"]["also_cgal"], std::string(choice) == "both" ? 600 : 0);
    }
    EXPECT_EQ(run({"audit", "--oracle", "coin"}).code, 2);
}

TEST(Gaps, ATableJsonAndLimits) {
    const Words base{"gaps",     mesh("bracket"),     "--kernel", "tetrahedron.unsigned-volume",
                     "--kernel", "tetrahedron.exact", "--count",  "500"};
    const auto with = [&](Words more) {
        more.insert(more.begin(), base.begin(), base.end());
        return run(more);
    };
    const Ended table = with({});
    EXPECT_EQ(table.code, 0) << table.err;
    EXPECT_TRUE(
        contains(table.out, "certified to be a partition; seed 1, 500 points on faces, edges and vertices each"));
    EXPECT_TRUE(contains(table.out, "exact arithmetic"));
    EXPECT_TRUE(contains(table.out, "made on the "));
    const Json report = parse(with({"--json", "-", "--rule", "exact"}).out);
    ASSERT_EQ(report["results"].size(), 3U);
    for (const Json& r : report["results"]) {
        EXPECT_EQ(r["inside"].get<int>() + r["outside"].get<int>(), 1500);
        EXPECT_EQ(r["features"].size(), 3U);
        if (r["kernel"].is_null() || r["kernel"] == "tetrahedron.exact") {
            EXPECT_EQ(r["gaps"], 0);
            EXPECT_EQ(r["wrong"], 0);
            EXPECT_EQ(r["several"], report["results"][0]["several"]);
        } else {
            EXPECT_GT(r["wrong"], 100);
        }
    }
    EXPECT_EQ(with({"--rule", "exact", "--fail-on", "gaps"}).code, 0);
    const Ended fails = with({"--fail-on", "wrong>10", "--quiet"});
    EXPECT_EQ(fails.code, 1);
    EXPECT_TRUE(contains(fails.err, "fails: tetrahedron.unsigned-volume, exact: wrong = "));
    EXPECT_EQ(with({"--fail-on", "zzz"}).code, 2);
    EXPECT_EQ(run({"gaps", mesh("plate"), "--kernel", "segment.*"}).code, 2);
    EXPECT_EQ(run({"gaps", "no-such-mesh"}).code, 2);
    // Neither kernel has a rule of its own: a limit on it could not be exceeded.
    const Ended own = with({"--rule", "own", "--fail-on", "gaps"});
    EXPECT_EQ(own.code, 2);
    EXPECT_EQ(own.out, "");
    EXPECT_TRUE(contains(own.err, "no kernel has a rule of its own")) << own.err;
    EXPECT_EQ(with({"--kernel", "tetrahedron.vtk-tolerance", "--rule", "own"}).code, 0);
    const Ended library = run({"gaps", mesh("bracket"), "--kernel-library", unruly("crash"), "--count", "50"});
    EXPECT_EQ(library.code, 0) << library.err;
    EXPECT_TRUE(contains(library.out, "tetrahedron.unruly"));
}

}  // namespace
}  // namespace barycert::cli_test
