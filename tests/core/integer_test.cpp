// Integers of the last tier against GMP, at every length up to the capacity.
#include "core/integer.hpp"

#include "tests/core/rational.hpp"

namespace barycert::core {
namespace {

using testing_rational::awkward_integer;
using testing_rational::limbs;
using testing_rational::number;
using testing_rational::Z;

constexpr std::uint64_t ones = ~std::uint64_t{0};

Integer all_ones(int size, bool negative = false) {
    std::uint64_t words[Integer::capacity];
    std::fill_n(words, size, ones);
    return Integer(negative, {words, static_cast<std::size_t>(size)});
}

/// 2^(64 limb).
Integer power(int limb, bool negative = false) {
    return Integer(negative, 1, 64 * limb);
}

/// No leading zero limb, and the sign of the number it stands for.
void expect_trimmed(const Integer& x) {
    EXPECT_TRUE(x.magnitude().empty() || x.magnitude().back() != 0);
    EXPECT_EQ(x.sign(), sgn(number(x)));
}

TEST(Integer, FromMantissaAndShift) {
    for (const std::uint64_t m : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 63, ones, ones >> 11}) {
        for (const int shift : {0, 1, 11, 12, 63, 64, 65, 127, 128, 129, 2045, 2097, 64 * 166, 64 * 166 + 63}) {
            for (const bool negative : {false, true}) {
                const Integer x(negative, m, shift);
                const Z expected = (negative ? -1 : 1) * limbs(&m, 1) * (Z(1) << static_cast<unsigned>(shift));
                EXPECT_EQ(number(x), expected) << m << ' ' << shift;
                expect_trimmed(x);
            }
        }
    }
}

TEST(Integer, ZeroHasNoSign) {
    // A zero may be told negative when it is made: catches sign() that reads the flag alone.
    const std::uint64_t nothing[3] = {};
    for (const Integer& zero :
         {Integer(), Integer(true, 0, 100), Integer() - Integer(true, 0, 0), Integer(true, nothing),
          power(2) - power(2), Integer(true, 5, 0) * Integer(), all_ones(3) + all_ones(3, true)}) {
        EXPECT_EQ(zero.sign(), 0);
        EXPECT_TRUE(zero.magnitude().empty());
        // It takes no part in a sum, whichever flag it carries.
        for (const Integer& x : {power(1), power(1, true)}) {
            EXPECT_EQ(number(zero + x), number(x));
            EXPECT_EQ(number(x + zero), number(x));
            EXPECT_EQ(number(x - zero), number(x));
            EXPECT_EQ(number(zero - x), -number(x));
        }
        EXPECT_EQ((zero - zero).sign(), 0);
        EXPECT_EQ(Integer::compare_magnitudes(zero, power(0)), -1);
    }
}

// One carry, or borrow, that runs through every limb. Catches a carry that is dropped, or kept for one limb alone.
TEST(Integer, CarriesAndBorrowsRunThrough) {
    for (int size = 1; size <= Integer::capacity - 2; ++size) {
        const Integer one(false, 1, 0), full = all_ones(size), next = power(size);
        EXPECT_EQ(number(full + one), number(next)) << size;
        EXPECT_EQ(number(one + full), number(next)) << size;
        EXPECT_EQ(number(next - one), number(full)) << size;
        EXPECT_EQ(number(one - next), -number(full)) << size;
        EXPECT_EQ((full + one).magnitude().size(), static_cast<std::size_t>(size) + 1);
        EXPECT_EQ((next - full).magnitude().size(), 1U);
        EXPECT_EQ(Integer::compare_magnitudes(full, next), -1);
        EXPECT_EQ(Integer::compare_magnitudes(next, full), 1);
        EXPECT_EQ(Integer::compare_magnitudes(full, all_ones(size, true)), 0);
    }
}

TEST(Integer, SumsAndDifferencesEqualGmp) {
    for (int k = 0; k < 20000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("integer sums"), static_cast<std::uint64_t>(k));
        const int size = r.integer(0, k % 10 == 0 ? Integer::capacity - 1 : 5);
        const Integer x = awkward_integer(r, size);
        const Integer y = awkward_integer(r, r.coin() ? size : r.integer(0, Integer::capacity - 1));
        const Integer sum = x + y, difference = x - y;
        ASSERT_EQ(number(sum), number(x) + number(y));
        ASSERT_EQ(number(difference), number(x) - number(y));
        ASSERT_EQ(Integer::compare_magnitudes(x, y), sgn(Z(abs(number(x)) - abs(number(y)))));
        ASSERT_EQ(number(sum - y), number(x));  // leading limbs vanish
        expect_trimmed(sum);
        expect_trimmed(difference);
    }
}

// The largest product of two limbs with the largest carry and addend fills 128 bits: all-ones operands. Catches an
// accumulator that is too narrow, and a last carry that is not stored.
TEST(Integer, ProductsOfAllOnes) {
    for (int size = 1; size < Integer::capacity; size += size < 8 ? 1 : 13) {
        for (const int other : {1, 2, 3, size, Integer::capacity - size}) {
            if (size + other > Integer::capacity) continue;
            const Integer x = all_ones(size), y = all_ones(other, true);
            ASSERT_EQ(number(x * y), number(x) * number(y)) << size << ' ' << other;
            ASSERT_EQ(number(y * x), number(x) * number(y)) << size << ' ' << other;
        }
    }
}

// Zero limbs inside, which multiplication skips: catches a skipped row whose place for the carry is left unset.
TEST(Integer, ProductsEqualGmp) {
    for (int k = 0; k < 10000; ++k) {
        base::Random r = base::Random::stream(1, base::hash64("integer products"), static_cast<std::uint64_t>(k));
        const int size = r.integer(0, k % 10 == 0 ? Integer::capacity : 6);
        const Integer x = awkward_integer(r, size), y = awkward_integer(r, r.integer(0, Integer::capacity - size));
        const Integer product = x * y;
        ASSERT_EQ(number(product), number(x) * number(y)) << size;
        expect_trimmed(product);
    }
}

TEST(Integer, Copies) {
    base::Random r(1);
    for (const int size : {0, 1, 2, 167, Integer::capacity}) {
        const Integer x = awkward_integer(r, size);
        Integer copy(x), assigned = power(5);
        assigned = x;
        EXPECT_EQ(number(copy), number(x));
        EXPECT_EQ(number(assigned), number(x));
        const Integer& same = assigned;
        assigned = same;
        EXPECT_EQ(number(assigned), number(x));
    }
}

}  // namespace
}  // namespace barycert::core
