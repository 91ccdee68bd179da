// Law D1 within one build: the same bits and counts on every SIMD target, on one thread and on two. See same_bytes.sh
// for other compilers.
#include <gtest/gtest.h>

#include "barycert/environment.hpp"
#include "barycert/weights.hpp"
#include "tests/core/answers.hpp"

namespace barycert {
namespace {

using testing_answers::hash_of_answers;
using testing_answers::pinned_cases;
using testing_answers::pinned_hash;

// Catches, among others, a remainder of a product that is not the same with and without fused multiply-add, and a
// minimum or maximum of lanes whose treatment of NaN shows.
TEST(LawD1, AnswersAndCountsAreTheSameOnEveryTargetAndAnyNumberOfThreads) {
    const std::vector<std::string> targets = simd_targets();
    ASSERT_FALSE(targets.empty());
#if defined(__aarch64__)
    EXPECT_EQ(targets, std::vector<std::string>{"NEON"});  // which every such processor has
#else
    EXPECT_TRUE(targets.back() == "scalar" || targets.back() == "SSE2") << targets.back();  // by Highway's version
#endif
    for (const std::string& target : targets) {
        ASSERT_TRUE(use_simd_target(target));
        ASSERT_EQ(simd_target(), target);
        for (const int threads : {1, 2}) {
            EXPECT_EQ(hash_of_answers(threads, pinned_cases), pinned_hash)
                << "on " << target << ", " << threads << " threads";
        }
    }
    EXPECT_TRUE(use_simd_target(""));
}

// Where an extent is near the largest double, Dekker's product overflows and the fused one does not. Catches a guard
// that lets such cases pass: one target would then give them to the integers and another not.
TEST(LawD1, TiersAgreeWhereOneOfTheProductsWouldOverflow) {
    const double triangle[] = {0x1p1000, .7, -0x1p1000, .6, 0, 0}, in_plane[] = {.1, .3};
    const double tetrahedron[] = {0x1p1000, .7, .1, -0x1p1000, .6, .9, .1, .3, -.8, 0, 0, 0}, in_space[] = {.1, .3, .2};
    const double values[] = {1.1, 2.3, 3.7, 4.1};
    for (const std::string& target : simd_targets()) {
        ASSERT_TRUE(use_simd_target(target));
        const auto tiers = [&](Simplex s, const double* vertices, const double* point) {
            EXPECT_EQ(barycentric_weights(s, vertices, point).value().tier, Tier::exact) << target;
            EXPECT_EQ(interpolate(s, vertices, point, values).value().tier, Tier::exact) << target;
        };
        tiers(Simplex::triangle, triangle, in_plane);
        tiers(Simplex::tetrahedron, tetrahedron, in_space);
    }
    EXPECT_TRUE(use_simd_target(""));
}

// Asking changes nothing. Catches Highway's list of targets, which in some versions restores the choice at start.
TEST(SimdTarget, StaysInUseUntilChanged) {
    const std::string at_start = simd_target();
    const std::vector<std::string> targets = simd_targets();
    EXPECT_EQ(at_start, targets.front());
    for (const std::string& target : targets) {
        ASSERT_TRUE(use_simd_target(target));
        EXPECT_EQ(simd_targets(), targets);
        EXPECT_EQ(simd_target(), target);
        EXPECT_FALSE(use_simd_target("no such target"));
        EXPECT_EQ(simd_target(), target);
    }
    EXPECT_TRUE(use_simd_target(""));
    EXPECT_EQ(simd_target(), at_start);
}

// The number itself sees a change: without this a hash of nothing would do.
TEST(LawD1, TheHashSeesEveryBit) {
    testing_answers::Hash a, b, c;
    a.add(1.0);
    b.add(std::nextafter(1.0, 2.0));
    EXPECT_NE(a.value(), b.value());
    a.add(TierCounts{.filter = 1});
    c.add(1.0);
    c.add(TierCounts{.exact = 1});
    EXPECT_NE(a.value(), c.value());
    // FNV-1a of eight zero bytes, from its definition.
    testing_answers::Hash zero;
    std::uint64_t expected = 0xcbf29ce484222325ULL;
    for (int i = 0; i < 8; ++i) expected *= 0x100000001b3ULL;
    zero.add(std::uint64_t{0});
    EXPECT_EQ(zero.value(), expected);
}

}  // namespace
}  // namespace barycert
