// Rounding by itself: quotients, scaled integers and roots against the definition.
#include "audit/exact/rounding.hpp"

#include "tests/audit/exact/checks.hpp"

namespace barycert::exact {
namespace {

using second_path::nearest;
using second_path::nearest_root;
using second_path::power_of_two;
using second_path::Q;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double max = std::numeric_limits<double>::max();

Q rational(const std::vector<std::uint64_t>& words) {
    mpz_class z;
    mpz_import(z.get_mpz_t(), words.size(), 1, 8, 0, 0, words.data());
    return Q(z);
}

template <class Integer>
Integer integer(const Q& x) {
    // Through decimal text: neither library's conversions are trusted by the other.
    return Integer(x.get_num().get_str());
}

Q word(std::uint64_t q) {
    return rational({q});
}

/// A word with `length` bits whose low part is often at, or next to, a tie or zero.
std::uint64_t near_a_tie(base::Random& r, int length) {
    std::uint64_t q = (r.bits() | (std::uint64_t{1} << 63)) >> (64 - length);
    const int low = r.integer(1, length - 1);
    const std::uint64_t mask = (std::uint64_t{1} << low) - 1;
    switch (r.integer(0, 3)) {
        case 0:
            return (q & ~mask) | (std::uint64_t{1} << (low - 1));
        case 1:
            return (q & ~mask) + (std::uint64_t{1} << (low - 1)) - 1;
        case 2:
            return q | mask;
        default:
            return q;
    }
}

TEST(RoundScaled, ByHand) {
    const std::uint64_t one = std::uint64_t{1} << 60;
    const auto round = [](std::uint64_t q, Tail tail, int exponent) { return *round_scaled(q, tail, exponent); };
    EXPECT_EQ(round(one, Tail::zero, -60), 1);
    EXPECT_EQ(round(one + 128, Tail::zero, -60), 1);                // tie, to even; catches > turned to >=
    EXPECT_EQ(round(one + 128, Tail::positive, -60), 1 + 0x1p-52);  // just beyond; catches a tail ignored
    EXPECT_EQ(round(one + 127, Tail::positive, -60), 1);            // just before
    EXPECT_EQ(round(one + 129, Tail::zero, -60), 1 + 0x1p-52);
    EXPECT_EQ(round(one + 384, Tail::zero, -60), 1 + 0x1p-51);  // tie, to even, upwards
    EXPECT_EQ(round(2 * one - 1, Tail::zero, -60), 2);          // carries into the next binade
    EXPECT_EQ(round_scaled(one + 128, Tail::unknown, -60), std::nullopt);
    EXPECT_EQ(round_scaled(one + 127, Tail::unknown, -60), 1);
    EXPECT_EQ(round_scaled(one + 129, Tail::unknown, -60), 1 + 0x1p-52);
}

TEST(RoundScaled, EndsOfTheRange) {
    const std::uint64_t one = std::uint64_t{1} << 63;
    const auto round = [](std::uint64_t q, Tail tail, int exponent) { return *round_scaled(q, tail, exponent); };
    // The largest double and half an ulp: a tie that goes to infinity.
    const std::uint64_t ones = ~std::uint64_t{0};
    EXPECT_EQ(round(ones << 11, Tail::zero, 960), max);
    EXPECT_EQ(round(ones << 10, Tail::zero, 960), infinity);
    EXPECT_EQ(round((ones << 10) - 1, Tail::positive, 960), max);
    EXPECT_EQ(round_scaled(ones << 10, Tail::unknown, 960), std::nullopt);
    EXPECT_EQ(round(one, Tail::zero, 961), infinity);
    EXPECT_EQ(round(one, Tail::zero, 100000), infinity);
    // Half the smallest subnormal: a tie that goes to zero. Catches an underflow cut off one binade too early.
    EXPECT_EQ(round(one, Tail::zero, -1075 - 63), 0);
    EXPECT_EQ(round(one, Tail::positive, -1075 - 63), 0x1p-1074);
    EXPECT_EQ(round(one + 1, Tail::zero, -1075 - 63), 0x1p-1074);
    EXPECT_EQ(round_scaled(one, Tail::unknown, -1075 - 63), std::nullopt);
    EXPECT_EQ(round(ones, Tail::positive, -1076 - 63), 0);
    EXPECT_EQ(round_scaled(ones, Tail::unknown, -1076 - 63), 0);
    EXPECT_EQ(round(one, Tail::zero, -100000), 0);
    // Ties among subnormals, and the carry into the smallest normal.
    EXPECT_EQ(round(one | one >> 1, Tail::zero, -1074 - 63), 0x1p-1073);  // 1.5 units: to 2
    EXPECT_EQ(round(one | one >> 2, Tail::zero, -1073 - 63), 0x1p-1073);  // 2.5 units: to 2
    EXPECT_EQ(round(ones, Tail::zero, -1023 - 63), 0x1p-1022);
}

TEST(RoundScaled, EqualsTheDefinitionInEveryRegime) {
    const Q third(1, 3);
    int open = 0;
    for (int k = 0; k < 20000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("scaled"), static_cast<std::uint64_t>(k));
        const int length = r.integer(55, 64);
        const std::uint64_t q = near_a_tie(r, length);
        const std::array<int, 4> regimes{r.integer(-1200, 1100), -1022 - r.integer(-2, 56), 1023 - r.integer(-1, 1),
                                         r.integer(-60, 60)};
        const int exponent = regimes[r.below(4)] - length + 1;
        const Q scale = power_of_two(exponent);
        const double exact = nearest(word(q) * scale), above = nearest((word(q) + third) * scale);
        EXPECT_EQ(*round_scaled(q, Tail::zero, exponent), exact) << q << ' ' << exponent;
        EXPECT_EQ(*round_scaled(q, Tail::positive, exponent), above) << q << ' ' << exponent;
        // An unknown tail may decline at a tie only, and must where the tail decides.
        const auto unknown = round_scaled(q, Tail::unknown, exponent);
        const bool tie = nearest((word(q) - third) * scale) != above;
        if (unknown) {
            EXPECT_EQ(*unknown, exact);
            EXPECT_EQ(*unknown, above);
        } else {
            EXPECT_TRUE(tie) << q << ' ' << exponent;
            ++open;
        }
        ASSERT_FALSE(HasFailure()) << k;
    }
    EXPECT_GT(open, 100);
}

/// n / d * 2^exponent by both integer types, where the narrow one can hold it, and every sign.
void check_quotient(const Q& n, const Q& d, int exponent) {
    const double expected = nearest(n / d * power_of_two(exponent));
    const auto wide_n = integer<BigInteger>(n), wide_d = integer<BigInteger>(d);
    EXPECT_EQ(round_quotient(wide_n, wide_d, exponent), expected);
    EXPECT_EQ(round_quotient(BigInteger(-wide_n), wide_d, exponent), -expected);
    EXPECT_EQ(round_quotient(wide_n, BigInteger(-wide_d), exponent), -expected);
    EXPECT_EQ(round_quotient(BigInteger(-wide_n), BigInteger(-wide_d), exponent), expected);
    const auto length = [](const Q& x) { return mpz_sizeinbase(x.get_num_mpz_t(), 2); };
    if (length(n) <= 315 && length(d) <= 252) {  // what oracle.cpp can make
        EXPECT_EQ(round_quotient(integer<FixedInteger>(n), integer<FixedInteger>(d), exponent), expected);
    }
}

// Quotients that lie on a tie or one unit of the numerator beside it: the leading bits cannot tell, the long division
// and its rest must. Catches the rest ignored, and a shortcut that trusts its bounds where they differ.
TEST(RoundQuotient, TiesAndTheirNeighbours) {
    for (int k = 0; k < 6000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("quotient"), static_cast<std::uint64_t>(k));
        std::vector<std::uint64_t> words(static_cast<std::size_t>(r.integer(1, 4)));
        for (auto& w : words) w = r.bits() >> r.integer(0, 30);
        words[0] |= 1;
        const Q d = rational(words);
        const Q q = word(near_a_tie(r, r.integer(53, 57)));
        const std::array<int, 3> exponents{0, -1080 - r.integer(0, 50), 968 + r.integer(-2, 4)};
        const int exponent = exponents[r.below(3)];
        for (int beside = -1; beside <= 1; ++beside) check_quotient(q * d + beside, d, exponent);
        check_quotient(q, d, exponent);
        ASSERT_FALSE(HasFailure()) << q << " * " << d;
    }
}

TEST(RoundQuotient, LengthsAboutTheLimbs) {
    // Numerators and denominators of every length about 63, 119 and 128 bits: all ones, a single one, and next to it.
    for (const int n_length : {1, 2, 53, 62, 63, 64, 65, 118, 119, 120, 127, 128, 129, 182, 183, 191, 192, 193, 256}) {
        for (const int d_length : {1, 2, 53, 62, 63, 64, 65, 118, 119, 127, 128, 129, 192, 193, 252}) {
            for (int n_beside = -1; n_beside <= 1; ++n_beside) {
                for (int d_beside = -1; d_beside <= 1; ++d_beside) {
                    const Q n = power_of_two(n_length) + n_beside, d = power_of_two(d_length) + d_beside;
                    check_quotient(n, d, 0);
                }
            }
            ASSERT_FALSE(HasFailure()) << n_length << ' ' << d_length;
        }
    }
}

TEST(RoundQuotient, ZeroIsPositive) {
    for (const int sign : {-1, 1}) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(round_quotient(BigInteger(0), BigInteger(sign))), 0U);
    }
    EXPECT_EQ(round_quotient(BigInteger(1), BigInteger(3)), 1.0 / 3.0);
    EXPECT_EQ(round_quotient(BigInteger(-7), BigInteger(10), 3), -5.6);
}

void check_root(const Q& n, const Q& d, int exponent) {
    const double expected = nearest_root(n / d * power_of_two(2 * exponent));
    EXPECT_EQ(round_root(integer<BigInteger>(n), integer<BigInteger>(d), exponent), expected)
        << n << " / " << d << " * 4^" << exponent;
}

// Squares of ties, and one unit beside them: catches the rest of the root or of the division ignored.
TEST(RoundRoot, SquaresOfTiesAndTheirNeighbours) {
    for (int k = 0; k < 4000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("root"), static_cast<std::uint64_t>(k));
        const Q root = word(near_a_tie(r, r.integer(54, 57)));
        const Q d = r.coin() ? Q(1) : word(r.bits() | 1);
        const std::array<int, 3> exponents{0, -1080 - r.integer(0, 50), 968 + r.integer(-2, 4)};
        const int exponent = exponents[r.below(3)];
        for (int beside = -1; beside <= 1; ++beside) {
            check_root(root * root * d * d + beside, d * d, exponent);
            check_root(root * root * d + beside, d, exponent);
        }
        check_root(word(r.bits() | 1), d, exponent);  // odd and even shifts
        check_root(word(r.bits() >> r.integer(0, 63) | 1), rational({r.bits() | 1, r.bits(), r.bits()}), exponent);
        ASSERT_FALSE(HasFailure()) << k;
    }
    EXPECT_EQ(round_root(0, 7), 0);
    EXPECT_EQ(round_root(2, 1), std::sqrt(2.0));
    EXPECT_EQ(round_root(1, 4, 5), 16);
    EXPECT_EQ(round_root(1, 1, -1075), 0);
    EXPECT_EQ(round_root(2, 1, -1075), 0x1p-1074);
    EXPECT_EQ(round_root(1, 1, 1024), infinity);
}

}  // namespace
}  // namespace barycert::exact
