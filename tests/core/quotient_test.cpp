// Quotients and integers rounded to doubles, held against the definition of rounding.
#include "core/integer.hpp"

#include "tests/core/rational.hpp"

namespace barycert::core {
namespace {

using testing_rational::awkward_integer;
using testing_rational::infinity;
using testing_rational::max;
using testing_rational::nearest;
using testing_rational::number;
using testing_rational::Q;
using testing_rational::scaled_by;
using testing_rational::Z;

/// A number from GMP, by its limbs.
Integer integer(const Z& z) {
    std::uint64_t words[Integer::capacity] = {};
    std::size_t count = 0;
    mpz_export(words, &count, -1, 8, 0, 0, z.get_mpz_t());
    return Integer(z < 0, {words, count});
}

/// The quotient of integers with signs.
double quotient(const Integer& n, const Integer& d, int exponent) {
    return round_quotient(n.sign() * d.sign() < 0, n.magnitude(), d.magnitude(), exponent);
}

Z power_of_two(int exponent) {
    return Z(1) << static_cast<unsigned>(exponent);
}

/// All four pairs of signs.
void expect_rounded(const Z& n, const Z& d, int exponent) {
    const Q exact = scaled_by(Q(n) / Q(d), exponent);
    const double r = quotient(integer(n), integer(d), exponent);
    EXPECT_TRUE(nearest(r, exact)) << n << " / " << d << " * 2^" << exponent;
    EXPECT_EQ(quotient(integer(-n), integer(-d), exponent), r);
    EXPECT_TRUE(nearest(quotient(integer(-n), integer(d), exponent), -exact)) << n << " / -" << d;
    EXPECT_TRUE(nearest(quotient(integer(n), integer(-d), exponent), -exact)) << n << " / -" << d;
    if (d == 1) {
        EXPECT_TRUE(nearest(round_integer(integer(n), exponent), exact)) << n << " * 2^" << exponent;
        EXPECT_TRUE(nearest(round_integer(integer(-n), exponent), -exact)) << n << " * 2^" << exponent;
    }
}

/// n / d with the numerator next to it on both sides. With d large, these are closest to n / d.
void expect_rounded_about(const Z& n, const Z& d, int exponent) {
    for (int beside = -1; beside <= 1; ++beside) expect_rounded(n + beside, d, exponent);
}

TEST(RoundQuotient, ByHand) {
    EXPECT_EQ(quotient(integer(1), integer(3), 0), 1.0 / 3.0);
    EXPECT_EQ(quotient(integer(-7), integer(10), 3), -5.6);
    EXPECT_EQ(round_integer(integer(-7), -1), -3.5);
    EXPECT_EQ(round_integer(integer(power_of_two(53) + 1), 0), 0x1p53);      // tie, to even
    EXPECT_EQ(round_integer(integer(power_of_two(53) + 3), 0), 0x1p53 + 4);  // tie, to even, upwards
    EXPECT_EQ(round_integer(integer(power_of_two(60) + 1), -60), 1);         // a rest that is no tie
    EXPECT_EQ(round_integer(integer(power_of_two(200) + power_of_two(147) + 1), -200),
              1 + 0x1p-52);  // a tie but for the last bit
}

TEST(RoundQuotient, ZeroIsPositiveAndUnderflowKeepsItsSign) {
    for (const int d : {-3, 3}) {
        for (const int exponent : {-5000, 0, 5000}) EXPECT_TRUE(nearest(quotient(Integer(), integer(d), exponent), 0));
    }
    EXPECT_TRUE(nearest(round_integer(Integer(), 7), 0));
    EXPECT_TRUE(nearest(round_integer(Integer(true, 0, 0), 7), 0));
    EXPECT_TRUE(nearest(quotient(Integer(true, 0, 0), integer(3), 7), 0));
    EXPECT_TRUE(std::signbit(round_integer(integer(-1), -1076)));
    EXPECT_TRUE(std::signbit(quotient(integer(1), integer(-3), -1080)));
    EXPECT_FALSE(std::signbit(quotient(integer(-1), integer(-3), -1080)));
}

// q odd or even, of one bit more than the result has: an exact tie q * d / d, and one unit of the numerator beside it.
// The leading limbs are the same for all three; the rest decides. Catches the rest ignored or of the wrong sign.
TEST(RoundQuotient, TiesAndTheirNeighbours) {
    for (int k = 0; k < 1500 && !::testing::Test::HasFailure(); ++k) {
        base::Random r = base::Random::stream(1, base::hash64("core ties"), static_cast<std::uint64_t>(k));
        const Z d = k % 5 == 0 ? Z(1) : Z(abs(number(awkward_integer(r, r.integer(1, 5)))) + 1);
        const int length = r.integer(1, 54);  // of the tie, its last bit the half
        const std::uint64_t leading = std::uint64_t{1} << (length - 1);
        const Z tie = 2 * Z(static_cast<unsigned long>(leading | (r.bits() & (leading - 1)))) + 1;
        // As a normal number the tie needs 53 bits before its half; as a subnormal any length will do.
        expect_rounded_about(tie * d, d, -1075);
        const Z full = 2 * Z(static_cast<unsigned long>(r.bits() >> 12 | std::uint64_t{1} << 52)) + 1;
        expect_rounded_about(full * d, d, r.integer(-1074, 970));
        expect_rounded_about((power_of_two(54) - 1) * d, d, r.integer(-1074, 960));  // carries to the next binade
    }
}

TEST(RoundQuotient, EndsOfTheRange) {
    for (const int extra : {0, 1, 64, 500, 10000}) {
        const Z d = power_of_two(extra);
        // The half-way point from the largest double to 2^1024, a tie to infinity; and twice that.
        const Z half_way = (power_of_two(54) - 1) * d;
        EXPECT_EQ(quotient(integer(half_way), integer(d), 970), infinity) << extra;
        if (extra > 0) {
            EXPECT_EQ(quotient(integer(half_way - 1), integer(d), 970), max) << extra;
            EXPECT_EQ(round_integer(integer(1 - half_way), 970 - extra), -max);
        }
        EXPECT_EQ(round_integer(integer(half_way), 970 - extra), infinity);
        expect_rounded_about(half_way, d, 970);
        expect_rounded_about(half_way, d, 971);
        expect_rounded(half_way, d, 100000);
        // Half of the smallest subnormal, a tie to zero; the largest subnormal, and what carries into the normals.
        EXPECT_EQ(quotient(integer(d), integer(d), -1075), 0) << extra;
        if (extra > 0) {
            EXPECT_EQ(quotient(integer(d + 1), integer(d), -1075), 0x1p-1074) << extra;
            EXPECT_EQ(quotient(integer(-d - 1), integer(d), -1075), -0x1p-1074) << extra;
            expect_rounded_about(d, d, -1075);
        }
        expect_rounded(3 * d, d, -1075);
        expect_rounded(3 * d, d, -1076);
        expect_rounded_about((power_of_two(53) - 1) * d, d, -1075);
        expect_rounded(d, d, -1076);
        expect_rounded(d, d, -1138);
        expect_rounded(d, d, -1139);
        expect_rounded(d, d, -100000);
    }
}

// Every length of one operand against every kind of length of the other, at numbers about powers of two: where the
// digit that is estimated is too large. Catches corrections of the digit left out, and shifts wrong at full limbs.
TEST(RoundQuotient, LengthsAboutTheLimbs) {
    const int lengths[] = {1, 2, 52, 53, 54, 62, 63, 64, 65, 126, 127, 128, 129, 191, 192, 193, 255, 256, 257, 640};
    for (const int n : lengths) {
        for (const int d : lengths) {
            for (int beside_n = -1; beside_n <= 1; ++beside_n) {
                for (int beside_d = -1; beside_d <= 1; ++beside_d)
                    expect_rounded(power_of_two(n) + beside_n, power_of_two(d) + beside_d, 0);
            }
            ASSERT_FALSE(HasFailure()) << n << ' ' << d;
        }
    }
}

// One limb against 160, and back, brought into the range of doubles by the exponent.
TEST(RoundQuotient, OperandsOfVeryDifferentLengths) {
    for (int k = 0; k < 600 && !::testing::Test::HasFailure(); ++k) {
        base::Random r = base::Random::stream(1, base::hash64("core lengths"), static_cast<std::uint64_t>(k));
        const int short_length = r.integer(1, 3), long_length = k % 2 == 0 ? 160 : r.integer(1, 164);
        const Z x = abs(number(awkward_integer(r, short_length))) + 1,
                y = abs(number(awkward_integer(r, long_length))) + 1;
        const int ratio =
            static_cast<int>(mpz_sizeinbase(y.get_mpz_t(), 2)) - static_cast<int>(mpz_sizeinbase(x.get_mpz_t(), 2));
        for (const int about : {-1075, -1040, 0, 1023}) {
            expect_rounded(x, y, about + ratio);
            expect_rounded(y, x, about - ratio);
        }
        expect_rounded(y, 1, r.integer(-1100, 1030) - static_cast<int>(mpz_sizeinbase(y.get_mpz_t(), 2)));
    }
}

// Two's complement gives magnitudes leading zero limbs. Catches lengths taken from the number of limbs.
TEST(RoundQuotient, LeadingZeroLimbsDoNotCount) {
    const std::uint64_t seven[6] = {7}, three[4] = {3}, nothing[3] = {};
    for (std::size_t i = 1; i <= 6; ++i) {
        for (std::size_t j = 1; j <= 4; ++j) {
            EXPECT_EQ(round_quotient(false, {seven, i}, {three, j}, 0), 7.0 / 3.0) << i << ' ' << j;
            EXPECT_EQ(round_quotient(true, {three, j}, {seven, i}, 0), -3.0 / 7.0) << i << ' ' << j;
        }
    }
    EXPECT_TRUE(nearest(round_quotient(true, nothing, three, 0), 0));
}

// Divisors and digits of all ones or a single one: where the estimate from the leading limbs is off by the most.
TEST(RoundQuotient, AwkwardLimbs) {
    for (int k = 0; k < 6000 && !::testing::Test::HasFailure(); ++k) {
        base::Random r = base::Random::stream(1, base::hash64("core awkward"), static_cast<std::uint64_t>(k));
        const Z d = abs(number(awkward_integer(r, r.integer(1, 6)))) + r.integer(0, 1);
        const Z n = abs(number(awkward_integer(r, r.integer(1, 6))));
        if (d != 0) expect_rounded(n, d, r.integer(-200, 200));
    }
}

}  // namespace
}  // namespace barycert::core
