// Texel addressing: the source's clamp reads past the end at u = 1, and is caught; the exact rules never do.

#include "barycert/audit_pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "barycert/oracle.hpp"
#include "core/base/random.hpp"

namespace barycert::audit {
namespace {

const TexelRule& rule_named(const std::string& name) {
    for (const TexelRule& r : texel_rules()) {
        if (r.name == name) return r;
    }
    ADD_FAILURE() << "no rule " << name;
    return texel_rules().front();
}

std::uint64_t count_of(const TexelResult& r, TexelFinding f) {
    return r.counts[static_cast<std::size_t>(f)];
}

// The corner of a 2x2 picture: its last texel is at 3 in memory, and the rule reads at 2 * 2 + 2.
TEST(Texels, TheRimIsReadPastTheEnd) {
    const auto offset = [](const char* rule) {
        const auto texel = rule_named(rule).texel;
        return texel(1.0, 2) * 2 + texel(1.0, 2);
    };
    EXPECT_EQ(offset("texture.clamp-to-w"), 6);
    EXPECT_EQ(offset("texture.clamp-to-last"), 3);
    EXPECT_EQ(offset("texture.exact-clamp"), 3);
    EXPECT_EQ(offset("texture.exact-repeat"), 0);
    EXPECT_EQ(rule_named("texture.fraction").texel(-0x1p-60, 2), 2);
    EXPECT_EQ(rule_named("texture.exact-repeat").texel(-0x1p-60, 2), 1);
}

TEST(Texels, TheAuditCatchesWhatEachRuleDoesWrong) {
    for (const TexelResult& r : audit_texels(texel_rules(), 20000)) {
        EXPECT_EQ(r.cases, 20000U);
        const std::string& name = r.rule.name;
        EXPECT_EQ(count_of(r, TexelFinding::before_start), 0U) << name;
        const bool leaves = name == "texture.clamp-to-w" || name == "texture.fraction";
        EXPECT_EQ(count_of(r, TexelFinding::past_end) > 100, leaves) << name;
        const bool exact = name.find("exact") != std::string::npos;
        EXPECT_EQ(count_of(r, TexelFinding::wrong_texel) > 0, !exact) << name;
        if (exact) {
            EXPECT_EQ(count_of(r, TexelFinding::past_end), 0U) << name;
        }
    }
}

TEST(Texels, WitnessesShowWhatTheySay) {
    for (const TexelResult& r : audit_texels(texel_rules(), 20000)) {
        for (std::size_t f = 0; f < r.counts.size(); ++f) {
            if (r.counts[f] == 0) continue;
            const TexelWitness& w = r.witnesses[f];
            EXPECT_EQ(r.rule.texel(w.u, w.size), w.texel) << r.rule.name;
            EXPECT_EQ(oracle_texel(w.u, w.size, r.rule.wrap == TexelWrap::repeat), w.exact) << r.rule.name;
            EXPECT_NE(w.texel, w.exact);
            EXPECT_EQ(w.texel >= w.size, f == 0) << r.rule.name;
        }
    }
}

// Every bit pattern that is a finite number is a coordinate.
TEST(Texels, TheExactRulesHoldForAnyFiniteCoordinate) {
    for (std::uint64_t k = 0; k < 200000; ++k) {
        base::Random r = base::Random::stream(5, 1, k);
        double u = std::bit_cast<double>(r.bits());
        if (!std::isfinite(u)) continue;
        if (k % 2 == 0) u = std::fmod(u, 4);
        const auto size = 1 + static_cast<std::int64_t>(r.below(std::uint64_t{1} << r.integer(0, 31)));
        ASSERT_EQ(rule_named("texture.exact-clamp").texel(u, size), oracle_texel(u, size, false)) << u << ' ' << size;
        ASSERT_EQ(rule_named("texture.exact-repeat").texel(u, size), oracle_texel(u, size, true)) << u << ' ' << size;
    }
}

TEST(Texels, RulesAreDescribed) {
    for (const TexelRule& r : texel_rules()) {
        EXPECT_TRUE(r.name.starts_with("texture."));
        for (const std::string* text : {&r.formula, &r.source, &r.fails}) EXPECT_FALSE(text->empty()) << r.name;
    }
}

}  // namespace
}  // namespace barycert::audit
