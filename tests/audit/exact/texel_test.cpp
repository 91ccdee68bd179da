// The oracle's texels against floors of GMP's rationals, and by hand.
#include <gmpxx.h>

#include <gtest/gtest.h>

#include "barycert/oracle.hpp"
#include "tests/audit/exact/cases.hpp"

namespace barycert::exact {
namespace {

std::int64_t floor_of(const mpq_class& x) {
    mpz_class q;
    mpz_fdiv_q(q.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
    return q.get_si();
}

/// The fraction of u first, so that all stays small; by definition of both wraps.
std::int64_t expected(double u, std::int64_t size, bool repeat) {
    mpq_class x(u);
    if (repeat) {
        mpz_class whole;
        mpz_fdiv_q(whole.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
        x -= whole;
    } else if (x < 0) {
        return 0;
    } else if (x >= 1) {
        return size - 1;
    }
    return floor_of(x * mpq_class(static_cast<long>(size)));
}

TEST(TexelOracle, ByHand) {
    for (const auto& [u, clamp, repeat] : {std::tuple{0.0, 0, 0},
                                           {0.25, 1, 1},
                                           {0.5, 2, 2},
                                           {0.75, 3, 3},
                                           {1.0, 3, 0},
                                           {1.25, 3, 1},
                                           {-0.25, 0, 3},
                                           {-1.0, 0, 0},
                                           {-0x1p-1074, 0, 3},
                                           {0x1p-1074, 0, 0},
                                           {1 - 0x1p-53, 3, 3},
                                           {-0.0, 0, 0}}) {
        EXPECT_EQ(oracle_texel(u, 4, false), clamp) << u;
        EXPECT_EQ(oracle_texel(u, 4, true), repeat) << u;
    }
    EXPECT_EQ(oracle_texel(0x1.fffffffffffffp+1023, 7, false), 6);
    EXPECT_EQ(oracle_texel(-0x1.fffffffffffffp+1023, 7, false), 0);
}

TEST(TexelOracle, EqualsTheDefinition) {
    for (std::uint64_t k = 0; k < 20000; ++k) {
        base::Random r = base::Random::stream(3, base::hash64("texel"), k);
        const auto size = 1 + static_cast<std::int64_t>(r.below(std::uint64_t{1} << r.integer(0, 31)));
        const double u = k % 3 == 0 ? testing_cases::finite_bits(r) : k % 3 == 1 ? r.uniform(-2, 2) : r.unit();
        for (const bool repeat : {false, true})
            ASSERT_EQ(oracle_texel(u, size, repeat), expected(u, size, repeat)) << u << ' ' << size << ' ' << repeat;
    }
}

}  // namespace
}  // namespace barycert::exact
