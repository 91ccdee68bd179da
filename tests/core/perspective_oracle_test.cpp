// Core's integers and the oracle's, which share nothing, on many cases.
#include <gtest/gtest.h>

#include "barycert/oracle.hpp"
#include "barycert/perspective.hpp"
#include "tests/audit/exact/cases.hpp"

namespace barycert {
namespace {

using testing_cases::all_kinds;
using testing_cases::Kind;

void expect_same(double a, double b, const Case& c) {
    if (std::isnan(b)) {
        EXPECT_TRUE(std::isnan(a)) << testing_cases::describe(c);
    } else {
        EXPECT_EQ(testing_cases::bits(a), testing_cases::bits(b)) << testing_cases::describe(c);
    }
}

TEST(PerspectiveAgainstTheOracle, ThreeHundredThousandCases) {
    std::uint64_t proper = 0;
    for (const Kind kind : all_kinds) {
        const std::uint64_t count = kind == Kind::bit_patterns ? 4000 : 43000;
        for (std::uint64_t k = 0; k < count; ++k) {
            base::Random r = base::Random::stream(12, base::hash64(testing_cases::name(kind)), k);
            const Case c = testing_cases::random_perspective_case(r, kind);
            const OracleAnswer answer = ask_oracle(c);
            const auto w = perspective_weights(c.vertices.data(), c.point.data());
            const auto f = perspective_value(c.vertices.data(), c.point.data(), c.values.data());
            ASSERT_TRUE(w && f);
            ASSERT_EQ(w->degenerate, answer.region == Region::degenerate) << testing_cases::describe(c);
            for (std::size_t i = 0; i < 3; ++i) expect_same(w->weights[i], answer.weights[i], c);
            expect_same(f->value, answer.value, c);
            ASSERT_FALSE(HasFailure());
            proper += w->degenerate ? 0 : 1;
        }
    }
    EXPECT_GT(proper, 200000U);
}

}  // namespace
}  // namespace barycert
