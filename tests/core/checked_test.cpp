// The two forms of each predicate: the one that requires finite coordinates returns a Sign, the checked one a Result.
#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

#include "barycert/predicates.hpp"
#include "tests/core/extremes.hpp"
#include "tests/core/sphere_cases.hpp"

namespace barycert {
namespace {

using testing_cases::all_kinds;
using testing_cases::random_case;

static_assert(std::is_same_v<decltype(orient2d(nullptr, nullptr, nullptr)), Sign>);
static_assert(noexcept(insphere(nullptr, nullptr, nullptr, nullptr, nullptr)));
static_assert(std::is_same_v<decltype(weight_signs(Simplex::triangle, nullptr, nullptr)), WeightSigns>);
static_assert(std::is_same_v<decltype(checked_weight_signs(Simplex::triangle, nullptr, nullptr)), Result<WeightSigns>>);

TEST(Sign, ProductsAndNegation) {
    constexpr Sign all[] = {Sign::negative, Sign::zero, Sign::positive};
    for (const Sign x : all) {
        EXPECT_EQ(static_cast<int>(-x), -static_cast<int>(x));
        for (const Sign y : all) EXPECT_EQ(static_cast<int>(x * y), static_cast<int>(x) * static_cast<int>(y));
    }
}

TEST(Checked, SameSignsAsUnchecked) {
    testing_spheres::for_hard_points("checked", 60, [](const testing_spheres::Points& p, base::Random&) {
        const double* at[5];
        for (std::size_t i = 0; i < 5; ++i) at[i] = p.at[i].data();
        EXPECT_EQ(testing_spheres::checked_ask(p).value(), testing_spheres::ask(p));
        EXPECT_EQ(checked_orient2d(at[0], at[1], at[2]).value(), orient2d(at[0], at[1], at[2]));
        EXPECT_EQ(checked_orient3d(at[0], at[1], at[2], at[3]).value(), orient3d(at[0], at[1], at[2], at[3]));
        EXPECT_EQ(checked_det3d(at[0], at[1], at[2], at[3], at[4], at[0]).value(),
                  det3d(at[0], at[1], at[2], at[3], at[4], at[0]));
    });
}

TEST(Checked, SameWeightSignsAndCountsAsUnchecked) {
    for (const Simplex s : all_simplices) {
        for (const auto kind : all_kinds) {
            for (std::uint64_t k = 0; k < 100; ++k) {
                base::Random r = base::Random::stream(3, base::hash64("checked weights"), k);
                const Case c = random_case(r, s, kind);
                TierCounts plain, checked;
                EXPECT_EQ(checked_weight_signs(s, c.vertices.data(), c.point.data(), &checked).value(),
                          weight_signs(s, c.vertices.data(), c.point.data(), &plain));
                EXPECT_EQ(plain, checked);
                EXPECT_EQ(plain.cases(), 1U);
            }
        }
    }
}

TEST(Checked, AnErrorIsNotCounted) {
    const double vertices[] = {0, 0, 1, 0, 0, 1}, point[] = {std::numeric_limits<double>::quiet_NaN(), 0};
    TierCounts tiers;
    EXPECT_FALSE(checked_weight_signs(Simplex::triangle, vertices, point, &tiers));
    EXPECT_EQ(tiers, TierCounts{});
}

// NaN and infinity where finite numbers are required, beside numbers of every exponent: some sign, within the memory of
// the call (the sanitizers look), and in finite time. A library with assertions stops instead.
#ifdef NDEBUG
TEST(Unchecked, NoNumberGivesSomeSign) {
    constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    const auto some_sign = [](Sign s) { return s * s == Sign::zero || s * s == Sign::positive; };
    for (const testing_extremes::Extreme& e : testing_extremes::extremes(20)) {
        for (unsigned bad = 1; bad < 64; ++bad) {
            for (const double number : {nan, -nan, infinity, -infinity}) {
                double at[6][3];
                for (unsigned i = 0; i < 6; ++i) {
                    for (unsigned k = 0; k < 3; ++k)
                        at[i][k] = (bad >> i & 1) != 0 && (i + k) % 2 == 0 ? number : e.points[i][k];
                }
                EXPECT_TRUE(some_sign(orient2d(at[0], at[1], at[2])));
                EXPECT_TRUE(some_sign(orient3d(at[0], at[1], at[2], at[3])));
                EXPECT_TRUE(some_sign(det3d(at[0], at[1], at[2], at[3], at[4], at[5])));
                EXPECT_TRUE(some_sign(incircle(at[0], at[1], at[2], at[3])));
                EXPECT_TRUE(some_sign(insphere(at[0], at[1], at[2], at[3], at[4])));
                for (const Simplex s : all_simplices) {
                    const WeightSigns w = weight_signs(s, at[0], at[4]);
                    EXPECT_TRUE(some_sign(w.orientation()));
                    for (int i = 0; i < vertex_count(s); ++i) EXPECT_TRUE(some_sign(w.sign(i)));
                }
            }
        }
    }
}
#endif

}  // namespace
}  // namespace barycert
