// An audit against an earlier one: the same is the same, one wrong case more is told, other cases are not compared.

#include "barycert/baseline.hpp"
#include "barycert/audit.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "audit/recipes.hpp"
#include "barycert/audit_report.hpp"
#include "tests/audit/audit_helpers.hpp"

namespace barycert::audit {
namespace {

class BaselineFile : public testing::Test {
protected:
    ~BaselineFile() override { std::filesystem::remove(path_); }

    Baseline put(const std::string& text) const {
        std::ofstream(path_) << text;
        return read_baseline(path_).value();
    }
    Error error_of(const std::string& text) const {
        std::ofstream(path_) << text;
        const Result<Baseline> b = read_baseline(path_);
        EXPECT_FALSE(b);
        return b ? Error{.code = "internal.error", .what = "no error"} : b.error();
    }
    const std::string path_ = testing::TempDir() + "barycert_baseline_" + std::to_string(::getpid()) + ".json";
};

AuditReport audit(std::vector<Kernel> kernels, const std::string& families, std::uint64_t count = 300) {
    return audit_of(std::move(kernels), families_matching(families), count, own_meshes());
}

Kernel like_cramer(WeightsFunction weights) {
    Kernel k = kernel_named("tetrahedron.cramer");
    k.weights = weights;
    return k;
}

TEST_F(BaselineFile, TheSameAuditIsNeitherWorseNorBetter) {
    const AuditReport r = audit(kernels_matching("t*.*"), "*", 60);
    const BaselineComparison c = compare_with_baseline(r, put(audit_json(r))).value();
    EXPECT_TRUE(c.worse.empty());
    EXPECT_TRUE(c.better.empty());
    EXPECT_GT(c.compared, 500U);
    EXPECT_EQ(c.not_now + c.not_before, 0U);
}

TEST_F(BaselineFile, WhatGotWorseAndBetterIsToldWithItsFigures) {
    const AuditReport before = audit({kernel_named("tetrahedron.cramer")}, "offset.2^17");
    const AuditReport after = audit({like_cramer(kernel_named("tetrahedron.homogeneous").weights)}, "offset.2^17");
    const KernelStatistics& s = before.kernels[0].total;
    const KernelStatistics& t = after.kernels[0].total;
    ASSERT_GT(t.wrong_cases, s.wrong_cases);
    const BaselineComparison worse = compare_with_baseline(after, put(audit_json(before))).value();
    ASSERT_FALSE(worse.worse.empty());
    EXPECT_EQ(worse.worse[0].kernel, "tetrahedron.cramer");
    EXPECT_EQ(worse.worse[0].family, "offset.2^17");
    EXPECT_EQ(worse.worse[0].figure, "wrong_cases");
    EXPECT_EQ(worse.worse[0].before, static_cast<double>(s.wrong_cases));
    EXPECT_EQ(worse.worse[0].after, static_cast<double>(t.wrong_cases));
    const BaselineComparison better = compare_with_baseline(before, put(audit_json(after))).value();
    EXPECT_EQ(better.better.size(), worse.worse.size());
    EXPECT_EQ(better.worse.size(), worse.better.size());
}

// One case of all, by one ulp: an exact comparison sees it.
TEST_F(BaselineFile, OneWrongCaseMoreIsWorse) {
    AuditReport r = audit({kernel_named("tetrahedron.cramer")}, "random");
    const Baseline b = put(audit_json(r));
    ++r.kernels[0].families[0].statistics.wrong_cases;
    const BaselineComparison c = compare_with_baseline(r, b).value();
    ASSERT_EQ(c.worse.size(), 1U);
    EXPECT_EQ(c.worse[0].after, c.worse[0].before + 1);
}

/// As if the kernel had been given up after all but `left` cases.
AuditReport given_up(AuditReport r, std::uint64_t left) {
    KernelStatistics& s = r.kernels[0].families[0].statistics;
    s.not_run = s.cases - left;
    s.cases = left;
    s.confusion = {};
    s.confusion[0][0] = left;
    s.wrong_cases = left;
    s.counts[static_cast<std::size_t>(Finding::crashed)] = left;
    return r;
}

// Fewer cases are then no other cases, and figures of those that were asked say nothing of the others.
TEST_F(BaselineFile, AKernelThatIsGivenUpIsComparedByTheCasesThatItWasNotAsked) {
    const AuditReport sound = audit({kernel_named("tetrahedron.cramer")}, "random*");
    const AuditReport broken = given_up(sound, 20);
    const std::string family = broken.families[broken.kernels[0].families[0].family].name;
    const auto worse = compare_with_baseline(broken, put(audit_json(sound)));
    ASSERT_TRUE(worse) << worse.error().message();
    ASSERT_EQ(worse->worse.size(), 1U);
    EXPECT_EQ(worse->worse[0].figure, "not_run");
    EXPECT_EQ(worse->worse[0].family, family);
    EXPECT_EQ(worse->worse[0].before, 0);
    EXPECT_EQ(worse->worse[0].after, 280);
    EXPECT_TRUE(worse->better.empty());
    EXPECT_EQ(worse->compared, 2U);
    EXPECT_EQ(worse->given_up, 1U);
    const auto better = compare_with_baseline(sound, put(audit_json(broken)));
    ASSERT_TRUE(better) << better.error().message();
    ASSERT_EQ(better->better.size(), 1U);
    EXPECT_EQ(better->better[0].figure, "not_run");
    EXPECT_TRUE(better->worse.empty());
    // Given up on both sides, the number of cases depends on the threads.
    const auto both = compare_with_baseline(given_up(sound, 21), put(audit_json(broken)));
    ASSERT_TRUE(both) << both.error().message();
    EXPECT_TRUE(both->worse.empty() && both->better.empty());
    EXPECT_EQ(both->given_up, 1U);
}

TEST_F(BaselineFile, WhatOneSideLacksIsCounted) {
    const Baseline b =
        put(audit_json(audit({kernel_named("tetrahedron.cramer"), kernel_named("tetrahedron.kahan")}, "random*")));
    const BaselineComparison c =
        compare_with_baseline(
            audit({kernel_named("tetrahedron.cramer"), kernel_named("tetrahedron.inverse")}, "random"), b)
            .value();
    EXPECT_EQ(c.compared, 1U);    // cramer in random
    EXPECT_EQ(c.not_before, 1U);  // inverse in random
    EXPECT_EQ(c.not_now, 3U);     // kahan in both, cramer in random.inside
    EXPECT_FALSE(compare_with_baseline(audit({kernel_named("triangle.bilinear")}, "random"), b));
}

TEST_F(BaselineFile, OtherCasesAreNotCompared) {
    const AuditReport r = audit({kernel_named("tetrahedron.cramer")}, "mesh.faces");
    const Baseline b = put(audit_json(r));
    AuditOptions options;
    options.families = families_matching("mesh.faces");
    options.count = 300;
    EXPECT_TRUE(check_comparable(b, options, own_meshes()));
    EXPECT_FALSE(check_comparable(b, options, MeshSource()));
    options.seed = 2;
    const Status other_seed = check_comparable(b, options, own_meshes());
    ASSERT_FALSE(other_seed);
    EXPECT_NE(other_seed.error().message().find("seed 2 and 300 cases"), std::string::npos)
        << other_seed.error().message();
    options.seed = 1;
    options.count = 301;
    EXPECT_FALSE(check_comparable(b, options, own_meshes()));
    // The same names, another mesh: told by the exact regions.
    MeshSource moved;
    for (const auto& m : own_meshes().meshes())
        moved.add(m->name, read_tetgen(BARYCERT_DATA_DIR "/meshes/torus").value());
    const AuditReport others =
        audit_of({kernel_named("tetrahedron.cramer")}, families_matching("mesh.faces"), 300, moved);
    const auto compared = compare_with_baseline(others, b);
    ASSERT_FALSE(compared);
    EXPECT_NE(compared.error().message().find("not comparable"), std::string::npos);
}

TEST_F(BaselineFile, BadFilesAreRefusedWithTheirPlace) {
    EXPECT_NE(error_of("{").message().find("expected JSON"), std::string::npos);
    EXPECT_NE(error_of("{}").message().find("\"schema\""), std::string::npos);
    EXPECT_NE(error_of("{\"schema\": 9}").message().find("unknown schema"), std::string::npos);
    EXPECT_NE(error_of("{\"schema\": 1, \"seed\": -1}").message().find("seed"), std::string::npos);
    EXPECT_NE(error_of("{\"schema\": 1, \"witnesses\": []}").message().find("\"seed\""), std::string::npos);
    EXPECT_NE(
        error_of(R"({"schema": 1, "seed": 1, "count": 2, "meshes": [], "kernels": [{"name": "k", "families": [{}]}]})")
            .message()
            .find("a family of k"),
        std::string::npos);
    // Nested so deeply that to copy it, or to write it down, would take more than the stack.
    const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
    EXPECT_NE(error_of(deep).message().find("expected JSON"), std::string::npos);
    EXPECT_NE(error_of("{\"schema\": " + deep + "}").message().find("expected JSON"), std::string::npos);
    // Cut anywhere, a report is refused, and nothing else happens.
    const std::string whole = audit_json(audit({kernel_named("tetrahedron.cramer")}, "random", 20));
    for (std::size_t n = 0; n + 3 < whole.size(); n += 97) error_of(whole.substr(0, n));
    EXPECT_FALSE(read_baseline(testing::TempDir() + "no such file"));
}

}  // namespace
}  // namespace barycert::audit
