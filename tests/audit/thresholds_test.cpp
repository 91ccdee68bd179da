#include "barycert/audit.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/gaps.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/mutants.hpp"
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

#include <limits>

#include "audit_helpers.hpp"

namespace barycert::audit {
namespace {

Threshold rule(const std::string& text) {
    return parse_threshold(text).value();
}

TEST(Thresholds, NamesAndLimits) {
    EXPECT_EQ(rule("opposite_sign").limit, 0);
    EXPECT_EQ(rule("opposite_sign>12").limit, 12);
    EXPECT_EQ(rule("worst_weight_ulp>1.5").limit, 1.5);
    for (const std::string& name : threshold_names()) EXPECT_EQ(rule(name).name, name);
}

TEST(Thresholds, WhatIsNoRule) {
    for (const char* text : {"", "nonsense", "opposite_sign>", "opposite_sign>x", "opposite_sign>-1",
                             "opposite_sign>nan", "opposite_sign=3", ">3"})
        EXPECT_FALSE(parse_threshold(text)) << text;
}

TEST(Thresholds, OnlyWhatExceedsTheLimitIsBroken) {
    const AuditReport r =
        audit_of({kernel_named("tetrahedron.unsigned-volume"), kernel_named("tetrahedron.signed-volume")},
                 {family_named("random")}, 1000);
    const auto wrong = static_cast<double>(r.kernels[0].total.wrong_cases);
    ASSERT_GT(wrong, 0);
    ASSERT_EQ(r.kernels[1].total.wrong_cases, 0U);
    const auto broken = violations(r, {{"any", 0}});
    ASSERT_EQ(broken.size(), 1U);
    EXPECT_EQ(broken[0].kernel, "tetrahedron.unsigned-volume");
    EXPECT_EQ(broken[0].value, wrong);
    EXPECT_TRUE(violations(r, {{"any", wrong}}).empty());
    EXPECT_EQ(violations(r, {{"any", wrong - 1}}).size(), 1U);
    EXPECT_EQ(violations(r, {{"any", 0}, {"false_inside", 0}, {"missed_degenerate", 0}}).size(), 2U);
}

int only_nan(const double*, const double*, double* w) {
    for (int i = 0; i < 4; ++i) w[i] = std::numeric_limits<double>::quiet_NaN();
    return 0;
}

int declares_everything(const double*, const double*, double*) {
    return 1;
}

// Without a measure there is no pass: a kernel that answers nothing is worse than any limit.
TEST(Thresholds, SilenceIsNotAccuracy) {
    for (const WeightsFunction mute : {only_nan, declares_everything}) {
        Kernel k = kernel_named("tetrahedron.kahan");
        k.weights = mute;
        const AuditReport r = audit_of({k}, {family_named("random.inside")}, 300);
        for (const char* name :
             {"worst_weight_ulp", "p999_weight_ulp", "worst_value_ulp", "worst_partition_residual"}) {
            EXPECT_EQ(violations(r, {{name, 1e300}}).size(), 1U) << name;
        }
    }
    // Nor is a process that ends in every case, for whatever reason, a pass.
    for (const Finding f : {Finding::crashed, Finding::raised, Finding::hung, Finding::out_of_bounds}) {
        AuditReport r = audit_of({kernel_named("tetrahedron.kahan")}, {family_named("random.inside")}, 1);
        KernelStatistics& s = r.kernels.at(0).total;
        s = {};
        Comparison c;
        c.weight_ulps.fill(-1);
        c.counts[static_cast<std::size_t>(f)] = 1;
        s.add(c, Region::interior, 0);
        EXPECT_EQ(violations(r, {{"worst_weight_ulp", 1e300}}).size(), 1U) << name(f);
        SearchReport search;
        search.finds.emplace_back().reason = name(f);
        EXPECT_EQ(violations(search, {{"worst_weight_ulp", 1e300}}).size(), 1U) << name(f);
    }
    // Nor is a kernel that was given up before its first case; parts are added.
    AuditReport r = audit_of({kernel_named("tetrahedron.kahan")}, {family_named("random.inside")}, 1);
    KernelStatistics part;
    part.not_run = 2;
    r.kernels.at(0).total = part;
    r.kernels[0].total.merge(part);
    EXPECT_EQ(r.kernels[0].total.not_run, 4U);
    EXPECT_EQ(violations(r, {{"worst_weight_ulp", 1e300}}).size(), 1U);
    EXPECT_EQ(violations(r, {{"any", 1e300}}).size(), 1U);
    // On degenerate simplices there is nothing to measure, and declaring them is right.
    Kernel k = kernel_named("tetrahedron.kahan");
    k.weights = declares_everything;
    EXPECT_TRUE(
        violations(audit_of({k}, {family_named("degenerate.plane")}, 300), {{"worst_weight_ulp", 0}, {"any", 0}})
            .empty());
}

}  // namespace
}  // namespace barycert::audit
