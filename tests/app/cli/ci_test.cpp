// Reports of the audit to systems that run it: exit code, JUnit, SARIF and annotations tell the same.

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

using Json = nlohmann::json;

Words audit_of(const std::string& kernel, const Words& more) {
    Words words{"audit", "--quiet", "--count", "200", "--kernel", kernel, "--family", "random*", "--family", "offset*"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

std::size_t count_in(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

/// A report in which the kernel is called otherwise: the next audit of that name is then held against it.
std::string renamed(const std::string& report, const std::string& from, const std::string& to) {
    Json j = parse(report);
    for (Json& kernel : j["kernels"]) {
        if (kernel["name"] == from) kernel["name"] = to;
    }
    return j.dump();
}

TEST(Ci, TheSameAuditIsNotWorse) {
    const Scratch scratch;
    const std::string file = scratch.path("b.json");
    ASSERT_EQ(run(audit_of("tetrahedron.*", {"--json", file})).code, 0);
    const Ended r = run(audit_of("tetrahedron.*", {"--baseline", file, "--annotations"}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out, "");
    EXPECT_TRUE(contains(r.err, ": 0 figures worse, 0 better, in ")) << r.err;
}

TEST(Ci, WhatGotWorseIsExit1AndToldEverywhere) {
    const Scratch scratch;
    const std::string sound = run(audit_of("tetrahedron.signed-volume", {"--json", "-"})).out;
    const std::string file =
        scratch.put("b.json", renamed(sound, "tetrahedron.signed-volume", "tetrahedron.homogeneous"));
    const Ended r =
        run(audit_of("tetrahedron.homogeneous", {"--baseline", file, "--annotations", "--junit", scratch.path("j.xml"),
                                                 "--sarif", scratch.path("s.sarif")}));
    EXPECT_EQ(r.code, 1);
    EXPECT_TRUE(contains(r.err, "worse: tetrahedron.homogeneous in offset.2^17: wrong_cases 0 -> ")) << r.err;
    EXPECT_TRUE(contains(r.out, "::error title=barycert audit%3A tetrahedron.homogeneous::baseline, offset.2^17: "))
        << r.out;
    const std::string junit = read_file(scratch.path("j.xml"));
    const std::size_t failures = count_in(junit, "<failure ");
    EXPECT_GT(failures, 0U);
    EXPECT_EQ(count_in(r.out, "::error "), failures);
    EXPECT_TRUE(contains(junit, "failures=\"" + std::to_string(failures) + "\""));
    const Json sarif = parse(read_file(scratch.path("s.sarif")));
    std::size_t errors = 0;
    for (const Json& result : sarif["runs"][0]["results"]) errors += result["level"] == "error" ? 1U : 0U;
    EXPECT_EQ(errors, failures);
}

TEST(Ci, ARuleFailsInAllThreeAndFindingsAlonePass) {
    const Scratch scratch;
    const Words reports{"--annotations", "--junit", scratch.path("j.xml"), "--sarif", scratch.path("s.sarif")};
    const Ended noted = run(audit_of("tetrahedron.homogeneous", reports));
    EXPECT_EQ(noted.code, 0);
    EXPECT_EQ(noted.out, "");
    EXPECT_FALSE(contains(read_file(scratch.path("j.xml")), "<failure"));
    EXPECT_TRUE(contains(read_file(scratch.path("j.xml")), "name=\"opposite_sign\""));
    Words with_rule = reports;
    with_rule.insert(with_rule.end(), {"--fail-on", "opposite_sign>3"});
    const Ended failed = run(audit_of("tetrahedron.homogeneous", with_rule));
    EXPECT_EQ(failed.code, 1);
    EXPECT_TRUE(contains(
        failed.out, "::error title=barycert audit%3A tetrahedron.homogeneous::opposite_sign <= 3: opposite_sign = "))
        << failed.out;
    EXPECT_TRUE(contains(read_file(scratch.path("j.xml")), "<failure type=\"opposite_sign\""));
    const Json sarif_run = parse(read_file(scratch.path("s.sarif")))["runs"][0];
    std::size_t errors = 0;
    for (const Json& result : sarif_run["results"]) {
        EXPECT_EQ(sarif_run["tool"]["driver"]["rules"][result["ruleIndex"].get<std::size_t>()]["id"], result["ruleId"]);
        if (result["level"] == "error") {
            ++errors;
            EXPECT_EQ(result["ruleId"], "opposite_sign");
        }
    }
    EXPECT_EQ(errors, 1U);
}

TEST(Ci, OtherCasesAreRefusedBeforeTheWork) {
    const Scratch scratch;
    const std::string file = scratch.path("b.json");
    ASSERT_EQ(run(audit_of("tetrahedron.cramer", {"--json", file})).code, 0);
    const Ended r = run(audit_of("tetrahedron.cramer", {"--baseline", file, "--seed", "7"}));
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(contains(r.err, "not comparable")) << r.err;
    EXPECT_TRUE(contains(r.err, "give --seed 1 --count 200")) << r.err;
    const Ended overwritten = run(audit_of("tetrahedron.cramer", {"--baseline", file, "--json", file}));
    EXPECT_EQ(overwritten.code, 2);
    EXPECT_EQ(run(audit_of("tetrahedron.cramer", {"--baseline", scratch.path("none")})).code, 2);
}

// Two reports on one stream would be none.
TEST(Ci, AnnotationsShareStdoutWithTheTableAlone) {
    const Scratch scratch;
    const std::string two = put_two_cells(scratch);
    const std::string rows = scratch.put("r.csv", six_rows);
    const Words audit = audit_of("triangle.exact", {}), check{"check", two}, verify{"verify", two, "--results", rows};
    for (const Words& command : {audit, check, verify}) {
        for (const char* report : {"--json", "--html", "--junit", "--sarif"})
            expect_error(plus(command, {report, "-", "--annotations"}), "--annotations");
        const Ended both = run(plus(command, {"--junit", "-", "--sarif", "-"}));
        EXPECT_EQ(both.code, 2);
        EXPECT_EQ(both.out, "");
    }
    for (const char* report : {"--witnesses", "--plot"})
        expect_error(plus(audit, {report, "-", "--annotations"}), "--annotations");
    const Ended table = run(plus(check, {"--annotations"}));
    EXPECT_EQ(table.code, 0) << table.err;
    EXPECT_TRUE(contains(table.out, "certified"));
}

TEST(Ci, AUsersLibraryIsThePlaceOfItsResults) {
    const Ended r = run({"audit", "--quiet", "--count", "50", "--family", "random", "--kernel-library",
                         BARYCERT_SWAPPED_KERNEL, "--sarif", "-"});
    EXPECT_EQ(r.code, 0) << r.err;
    const Json results = parse(r.out)["runs"][0]["results"];
    ASSERT_FALSE(results.empty());
    const std::string uri = results[0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"];
    EXPECT_TRUE(contains(uri, "user-swapped.so")) << uri;
}

TEST(Mutants, TheScoreIsShownAndEveryOneIsCaught) {
    const Scratch scratch;
    const Ended r = run({"audit", "--mutants", "--count", "1000", "--json", scratch.path("m.json")});
    EXPECT_EQ(r.code, 0) << r.out << r.err;
    const Json report = parse(read_file(scratch.path("m.json")));
    EXPECT_EQ(report["caught"], report["mutants"].size());
    for (const Json& m : report["mutants"]) EXPECT_TRUE(contains(r.out, m["name"].get<std::string>()));
    // Families that catch little leave mutants uncaught, and the exit code says so.
    const Ended few = run({"audit", "--mutants", "--count", "100", "--family", "random.inside"});
    EXPECT_EQ(few.code, 1);
    EXPECT_TRUE(contains(few.out, "not caught"));
}

TEST(Mutants, OptionsAboutOtherKernelsAreRefused) {
    for (const Words& more : {Words{"--kernel", "*"},
                              {"--fail-on", "any"},
                              {"--plot", "p.svg"},
                              {"--annotations"},
                              {"--class-tolerance", "1e-9"},
                              {"--time-limit", "1"},
                              {"--in-process"},
                              {"--wide"}}) {
        Words words{"audit", "--mutants"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended r = run(words);
        EXPECT_EQ(r.code, 2);
        EXPECT_TRUE(contains(r.err, "--mutants and " + more[0])) << r.err;
    }
}

TEST(Surfaces, RulesAreAuditedAloneAndAlike) {
    const Scratch scratch;
    const Ended r = run(
        {"audit", "--surfaces", "--count", "20", "--json", scratch.path("s.json"), "--html", scratch.path("s.html")});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "of 17 rules give wrong answers")) << r.out;
    EXPECT_TRUE(contains(read_file(scratch.path("s.html")), "inside.ray-along-x"));
    for (const Words& more : {Words{"--kernel", "*"}, {"--family", "*"}, {"--mutants"}, {"--oracle", "cgal"}}) {
        Words words{"audit", "--surfaces"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended refused = run(words);
        EXPECT_EQ(refused.code, 2);
        EXPECT_TRUE(contains(refused.err, " and ")) << refused.err;
    }
}

TEST(InverseMaps, RulesAreAuditedAloneAndAlike) {
    const Scratch scratch;
    const std::string json = scratch.path("i.json"), html = scratch.path("i.html");
    const Ended r = run({"audit", "--inverse-maps", "--count", "20", "--seed", "4", "--json", json, "--html", html});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "9 of 9 rules give wrong answers")) << r.out;
    EXPECT_TRUE(contains(r.out, "seed 4, 20 cases a family")) << r.out;
    EXPECT_TRUE(contains(read_file(html), "hexahedron.newton-1e-3"));
    EXPECT_TRUE(contains(read_file(json), "\"flat-corner\""));
    const Ended both = run({"audit", "--inverse-maps", "--surfaces"});
    EXPECT_EQ(both.code, 2);
    EXPECT_TRUE(contains(both.err, "--surfaces and --inverse-maps")) << both.err;
    // Who asks for them as kernels is told where they are.
    const Ended kernel = run({"audit", "--kernel", "hexahedron.*"});
    EXPECT_EQ(kernel.code, 2);
    EXPECT_TRUE(contains(kernel.err, "--inverse-maps")) << kernel.err;
}

}  // namespace
}  // namespace barycert::cli_test
