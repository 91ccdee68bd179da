// Reports of check and verify to systems that run them: exit code, JUnit, SARIF and annotations tell the same.

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

using Json = nlohmann::json;

std::size_t times(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

/// One run's reports.
struct Reports {
    Ended ended;
    std::string junit;
    Json results;  ///< of SARIF
    Json rules;

    std::size_t errors() const {
        std::size_t n = 0;
        for (const Json& r : results) n += r["level"] == "error" ? 1U : 0U;
        return n;
    }
    /// The text of the result of that rule; empty if there is none.
    std::string text(const std::string& rule, const std::string& level) const {
        for (const Json& r : results) {
            if (r["ruleId"] == rule && r["level"] == level) return r["message"]["text"];
        }
        return {};
    }
};

Reports reports_of(const Words& command) {
    const Scratch scratch;
    Reports r;
    r.ended = run(plus(
        command, {"--quiet", "--annotations", "--junit", scratch.path("j.xml"), "--sarif", scratch.path("s.sarif")}));
    EXPECT_NE(r.ended.code, 2) << r.ended.err;
    r.junit = read_file(scratch.path("j.xml"));
    const Json sarif = parse(read_file(scratch.path("s.sarif")));
    r.results = sarif["runs"][0]["results"];
    r.rules = sarif["runs"][0]["tool"]["driver"]["rules"];
    // All say the same number of failures, and red is exit 1.
    EXPECT_EQ(times(r.junit, "<failure "), r.errors());
    EXPECT_EQ(times(r.ended.out, "::error "), r.errors());
    EXPECT_EQ(r.ended.code, r.errors() == 0 ? 0 : 1);
    for (const Json& result : r.results)
        EXPECT_EQ(r.rules[result["ruleIndex"].get<std::size_t>()]["id"], result["ruleId"]);
    return r;
}

TEST(CiCheck, APartitionPassesItsConditions) {
    const Reports r = reports_of({"check", mesh("bracket")});
    EXPECT_EQ(r.ended.code, 0);
    EXPECT_EQ(r.ended.out, "");
    EXPECT_TRUE(contains(r.junit, "name=\"P1: every cell has 4 different nodes")) << r.junit;
    EXPECT_TRUE(contains(r.junit, "name=\"P4: "));
}

TEST(CiCheck, DefectsFailByKindWithTheirCells) {
    const Scratch scratch;
    // Two cells on one side of their common face, the second of another orientation; a node of no cell.
    scratch.put("bad.node", "6 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0.2 0.2 0.2\n5 9 9 9\n");
    scratch.put("bad.ele", "2 4 0\n0 0 1 2 3\n1 1 2 3 4\n");
    const Json report = parse(run({"check", scratch.path("bad"), "--json", "-"}).out);
    const Reports r = reports_of({"check", scratch.path("bad")});
    EXPECT_EQ(r.ended.code, 1);
    std::size_t defects = 0;
    for (const Json& d : report["findings"]) {
        const std::string text = r.text(d["name"], d["breaks"] ? "error" : "note");
        ++defects;
        EXPECT_TRUE(contains(text, "bad: " + std::to_string(d["count"].get<int>()) + " ")) << d["name"] << text;
    }
    EXPECT_EQ(defects, r.results.size());
    EXPECT_GE(r.errors(), 2U);
    const std::string same_side = r.text("same_side", "error");
    EXPECT_TRUE(contains(same_side, "cells 0 and 1, nodes 1 2 3. Remedy: ")) << same_side;
    EXPECT_NE(r.text("unused_node", "note"), "");
    EXPECT_TRUE(contains(r.ended.out, "::error file=" + scratch.path("bad.node") + ",title=barycert check%3A "))
        << r.ended.out;
    EXPECT_TRUE(contains(r.junit, "<failure type=\"same_side\""));
    // A condition that is violated is no case that passes.
    EXPECT_FALSE(contains(r.junit, "name=\"P2: ")) << r.junit;
    EXPECT_TRUE(contains(r.junit, "name=\"P1: "));
}

TEST(CiCheck, WhatDoesNotBreakTheCertificatePasses) {
    const Reports r = reports_of({"check", mesh("bracket"), "--delaunay"});
    EXPECT_EQ(r.ended.code, 0);
    EXPECT_TRUE(r.text("not_delaunay", "error").empty());
    // Names may hold anything.
    const Scratch scratch;
    const std::string odd = put_two_cells(scratch, "a&b<c>,d");
    const Reports named = reports_of({"check", odd});
    EXPECT_TRUE(contains(named.junit, "a&amp;b&lt;c&gt;,d"));
}

class CiVerify : public ::testing::Test {
protected:
    const Scratch scratch_;
    const std::string two_ = put_two_cells(scratch_);
    const std::string bad_ = scratch_.put("bad.csv",
                                          "x,y,z,cell,attribute0\n"
                                          ".25,.25,.25,0,4.5\n"
                                          ".5,.5,.5,-1,nan\n"      // missed
                                          ".5,.5,0,1,4.0000001\n"  // wrong value
                                          ".1,.1,.1,1,2.4\n"       // wrong cell
                                          "2,2,2,1,0\n");          // invented
    const Words words_{"verify", two_, "--results", bad_};
};

TEST_F(CiVerify, KindsOfWrongRowsFailWithTheWorst) {
    const Reports r = reports_of(words_);
    EXPECT_EQ(r.ended.code, 1);
    EXPECT_EQ(r.errors(), 4U);
    for (const char* kind : {"missed", "invented", "wrong_cell", "wrong_value"}) {
        const std::string text = r.text(kind, "error");
        EXPECT_TRUE(contains(text, "bad.csv: 1 of 5 rows: ")) << kind << text;
        EXPECT_TRUE(contains(text, ". Worst: row ")) << kind << text;
        EXPECT_TRUE(contains(r.junit, std::string("<failure type=\"") + kind + '"'));
    }
    EXPECT_TRUE(contains(r.text("wrong_cell", "error"), "row 3, counted from 0: point (0.1,0.1,0.1)"));
    EXPECT_TRUE(contains(r.ended.out, "::error file=" + bad_ + ",title=barycert verify%3A " + bad_ + "::missed <= 0: "))
        << r.ended.out;
    EXPECT_EQ(r.ended.err, "") << "quiet, and no rule was given";
}

TEST_F(CiVerify, RulesSayWhatFailsAndTheRestIsNoted) {
    const Reports r = reports_of(plus(words_, {"--fail-on", "missed>1,wrong_value"}));
    EXPECT_EQ(r.errors(), 1U);
    EXPECT_NE(r.text("wrong_value", "error"), "");
    EXPECT_NE(r.text("invented", "note"), "");
    EXPECT_NE(r.text("wrong_cell", "note"), "");
    EXPECT_TRUE(contains(r.junit, "name=\"missed &lt;= 1\" time=\"0\"/>")) << r.junit;
    EXPECT_EQ(r.ended.err, "fails: " + bad_ + ": wrong_value = 1, limit 0\n");
    EXPECT_EQ(reports_of(plus(words_, {"--fail-on", "missed>1"})).ended.code, 0);
}

TEST_F(CiVerify, RightRowsPass) {
    const Reports r = reports_of({"verify", two_, "--results", scratch_.put("r.csv", six_rows)});
    EXPECT_EQ(r.ended.code, 0);
    EXPECT_EQ(r.results.size(), 0U);
    EXPECT_EQ(times(r.junit, "<testcase "), 4U);
}

// A rule that no row can break must not pass.
TEST_F(CiVerify, RulesOnWhatIsNotComparedAreRefused) {
    expect_error({"verify", two_, "--results", bad_, "--cell-column", "none", "--fail-on", "wrong_cell"},
                 "a rule that no row can break: wrong_cell");
    const std::string cells = scratch_.put("cells.csv", "x,y,z,cell\n.25,.25,.25,0\n");
    expect_error({"verify", two_, "--results", cells, "--fail-on", "wrong_value"}, "wrong_value");
    const Reports r = reports_of({"verify", two_, "--results", cells});
    EXPECT_EQ(r.ended.code, 0);
    EXPECT_EQ(times(r.junit, "<testcase "), 3U) << "values are not compared";
    for (const char* rule : {"bad", "missed=1", "missed>", "missed>-1", "missed>0.5", "missed>nan", "wrong-cell"})
        expect_error(plus(words_, {"--fail-on", rule}), "perhaps >COUNT");
}

}  // namespace
}  // namespace barycert::cli_test
