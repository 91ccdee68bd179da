#include "barycert/audit/thresholds.hpp"

#include <gtest/gtest.h>

#include "audit_helpers.hpp"

namespace barycert::audit {
namespace {

Rule rule(const std::string& text) {
    return parse_rule(text).value();
}

TEST(Thresholds, NamesAndLimits) {
    EXPECT_EQ(rule("opposite_sign").limit, 0);
    EXPECT_EQ(rule("opposite_sign>12").limit, 12);
    EXPECT_EQ(rule("worst_weight_ulp>1.5").limit, 1.5);
    for (const std::string& name : rule_names()) EXPECT_EQ(rule(name).name, name);
}

TEST(Thresholds, WhatIsNoRule) {
    for (const char* text : {"", "nonsense", "opposite_sign>", "opposite_sign>x", "opposite_sign>-1",
                             "opposite_sign>nan", "opposite_sign=3", ">3"})
        EXPECT_FALSE(parse_rule(text)) << text;
}

TEST(Thresholds, OnlyWhatExceedsTheLimitIsBroken) {
    const Report r = audit_of({kernel_named("tetrahedron.unsigned-volume"), kernel_named("tetrahedron.signed-volume")},
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

}  // namespace
}  // namespace barycert::audit
