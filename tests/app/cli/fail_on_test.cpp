// --fail-on: every rule, at its limit and over it.

#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

using Json = nlohmann::json;

const Words findings{"false_certificate", "false_declaration", "false_inside",  "false_outside", "missed_degenerate",
                     "opposite_sign",     "false_zero",        "false_nonzero", "not_finite"};
const Words figures{"wrong_cases",
                    "worst_weight_ulp",
                    "p999_weight_ulp",
                    "worst_value_ulp",
                    "p999_value_ulp",
                    "worst_partition_residual",
                    "worst_reproduction_residual"};

/// Kernels that between them break every rule there is, the one that certifies wrongly included.
Words audited(const Words& more) {
    Words arguments{"audit",
                    "--count",
                    "40",
                    "--family",
                    "*degenerate*",
                    "--family",
                    "mesh.faces*",
                    "--family",
                    "huge",
                    "--family",
                    "tiny",
                    "--kernel",
                    "tetrahedron.homogeneous",
                    "--kernel",
                    "tetrahedron.full-lu",
                    "--kernel-library",
                    BARYCERT_SWAPPED_KERNEL};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::set<std::string> failed_kernels(const std::string& err, const std::string& rule) {
    std::set<std::string> kernels;
    for (const std::string& line : lines_of(err)) {
        EXPECT_EQ(line.rfind("fails: ", 0), 0U) << line;
        EXPECT_TRUE(contains(line, ": " + rule + " = ")) << line;
        kernels.insert(line.substr(7, line.find(':', 7) - 7));
    }
    return kernels;
}

class FailOn : public ::testing::TestWithParam<std::string> {
protected:
    static const Json& report() {
        static const Json once = parse(run(audited({"--json", "-"})).out);
        return once;
    }
};

TEST_P(FailOn, ExceededIs1AndMetIs0) {
    const std::string rule = GetParam();
    double worst = -1;
    std::set<std::string> over;
    for (const Json& kernel : report()["kernels"]) {
        const Json& figure = kernel[rule == "any" ? "wrong_cases" : rule];
        const double value = figure.is_null() ? -1 : figure.get<double>();
        if (value > 0) over.insert(kernel["name"].get<std::string>());
        worst = std::max(worst, value);
    }
    ASSERT_FALSE(over.empty()) << "no kernel breaks the rule: the test would show nothing";

    const Ended exceeded = run(audited({"--quiet", "--fail-on", rule}));
    EXPECT_EQ(exceeded.code, 1);
    EXPECT_EQ(exceeded.out, "");
    EXPECT_EQ(failed_kernels(exceeded.err, rule), over);
    EXPECT_EQ(run(audited({"--quiet", "--fail-on", rule + ">0"})).code, 1);

    // "Beyond the threshold": at the limit itself the rule holds. The largest double stands for what is over it.
    const bool beyond_doubles = worst == std::numeric_limits<double>::max();
    const Ended met = run(audited({"--quiet", "--fail-on", rule + ">" + Json(worst).dump()}));
    EXPECT_EQ(met.code, beyond_doubles && contains(met.err, " = inf, limit ") ? 1 : 0) << met.err;
    EXPECT_EQ(met.err.empty(), met.code == 0);
}

Words all_rules() {
    Words rules = findings;
    rules.insert(rules.end(), figures.begin(), figures.end());
    rules.push_back("any");
    return rules;
}

INSTANTIATE_TEST_SUITE_P(rules, FailOn, ::testing::ValuesIn(all_rules()), [](const auto& rule) { return rule.param; });

TEST(FailOn, HelpListsTheseRulesAndNoOthers) {
    const std::string help = run({"audit", "--help"}).out;
    const std::string list = help.substr(help.find("RULE is one of: ") + 16);
    std::istringstream words(list.substr(0, list.find('\n')));
    std::set<std::string> listed;
    for (std::string word; words >> word;) listed.insert(word);
    Words rules = all_rules();
    // Rules for kernels in a process of their own: contained_test.cpp.
    rules.insert(rules.end(),
                 {"crashed", "raised", "hung", "out_of_bounds", "forked", "changed_environment", "printed"});
    EXPECT_EQ(listed, std::set<std::string>(rules.begin(), rules.end()));
}

TEST(FailOn, SeveralRulesEachTellAndTheFilesAreWrittenAllTheSame) {
    const Scratch scratch;
    const Ended r = run(audited({"--fail-on", "opposite_sign", "--fail-on", "any>1e9", "--fail-on", "false_certificate",
                                 "--json", scratch.path("r.json")}));
    EXPECT_EQ(r.code, 1);
    EXPECT_TRUE(contains(r.err, ": opposite_sign = "));
    EXPECT_TRUE(contains(r.err, "fails: tetrahedron.user-swapped: false_certificate = "));
    EXPECT_FALSE(contains(r.err, ": any = "));
    EXPECT_TRUE(contains(r.out, "tetrahedron.homogeneous"));
    EXPECT_EQ(parse(read_file(scratch.path("r.json")))["kernels"].size(), 3U);
}

}  // namespace
}  // namespace barycert::cli_test
