// Two's complement of fixed width against GMP, and doubles brought to a common unit.
#include "core/integer.hpp"

#include "core/scaled_double.hpp"
#include "tests/core/rational.hpp"

namespace barycert::core {
namespace {

using testing_rational::any_finite;
using testing_rational::awkward_word;
using testing_rational::number;
using testing_rational::Q;
using testing_rational::scaled_by;
using testing_rational::Z;

template <int N>
Fixed<N> awkward(base::Random& r) {
    Fixed<N> x;
    for (auto& limb : x.limbs) limb = awkward_word(r);
    return x;
}

/// The ends of the range, about zero, and a carry in the middle.
template <int N>
std::vector<Fixed<N>> corners() {
    std::vector<Fixed<N>> all;
    for (const std::uint64_t low : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}, std::uint64_t{1} << 63,
                                    (std::uint64_t{1} << 63) - 1}) {
        for (const std::uint64_t high : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}, std::uint64_t{1} << 63,
                                         (std::uint64_t{1} << 63) - 1}) {
            Fixed<N> x;
            x.limbs.fill(low);
            x.limbs[N - 1] = high;
            all.push_back(x);
        }
    }
    return all;
}

/// z reduced to the range of N limbs.
template <int N>
Z wrapped(const Z& z) {
    const Z modulus = Z(1) << (64 * N), half = modulus / 2;
    Z r;
    mpz_fdiv_r(r.get_mpz_t(), Z(z + half).get_mpz_t(), modulus.get_mpz_t());
    return r - half;
}

/// Sums keep their width, and so wrap.
template <int N>
void expect_sums(const Fixed<N>& x, const Fixed<N>& y) {
    EXPECT_EQ(number(x + y), wrapped<N>(number(x) + number(y)));
    EXPECT_EQ(number(x - y), wrapped<N>(number(x) - number(y)));
    EXPECT_EQ(x.negative(), number(x) < 0);
}

template <int N, int M>
void expect_product(const Fixed<N>& x, const Fixed<M>& y) {
    const Fixed<N + M> product = x * y;
    EXPECT_EQ(number(product), number(x) * number(y)) << number(x) << " * " << number(y);
}

TEST(FixedInteger, SumsAndDifferences) {
    for (const auto& x : corners<1>()) {
        for (const auto& y : corners<1>()) expect_sums(x, y);
    }
    for (const auto& x : corners<3>()) {
        for (const auto& y : corners<3>()) expect_sums(x, y);
    }
    base::Random r(1);
    for (int k = 0; k < 3000 && !::testing::Test::HasFailure(); ++k) {
        expect_sums(awkward<2>(r), awkward<2>(r));
        expect_sums(awkward<4>(r), awkward<4>(r));
        expect_sums(awkward<8>(r), awkward<8>(r));
    }
}

// Every pair of signs, the most negative numbers among them: catches either correction for a negative factor left out
// or made at the wrong limb.
TEST(FixedInteger, Products) {
    for (const auto& x : corners<1>()) {
        for (const auto& y : corners<1>()) expect_product(x, y);
        for (const auto& y : corners<2>()) expect_product(x, y), expect_product(y, x);
    }
    for (const auto& x : corners<2>()) {
        for (const auto& y : corners<2>()) expect_product(x, y);
        for (const auto& y : corners<4>()) expect_product(x, y);
    }
    base::Random r(1);
    for (int k = 0; k < 3000 && !::testing::Test::HasFailure(); ++k) {
        expect_product(awkward<1>(r), awkward<1>(r));
        expect_product(awkward<1>(r), awkward<2>(r));
        expect_product(awkward<2>(r), awkward<2>(r));
        expect_product(awkward<2>(r), awkward<4>(r));
        expect_product(awkward<4>(r), awkward<4>(r));
    }
}

/// x = mantissa * 2^(exponent - 1074) with an odd mantissa, or zero.
TEST(ScaledDouble, IsTheNumberWithAnOddMantissa) {
    base::Random r(2);
    std::vector<double> numbers{0.0,
                                -0.0,
                                1.0,
                                -3.0,
                                0x1p-1074,
                                -0x1p-1074,
                                0x0.fffffffffffffp-1022,
                                0x1p-1022,
                                0x1.fffffffffffffp1023,
                                -0x1p1023,
                                0x1.0000000000001p0};
    for (int k = 0; k < 5000; ++k) numbers.push_back(any_finite(r));
    for (const double x : numbers) {
        const ScaledDouble s = scaled(x);
        if (x == 0) {
            EXPECT_EQ(s.mantissa, 0U);
            EXPECT_GT(s.exponent, 1023 + 1074);  // never the least exponent of several numbers
            continue;
        }
        EXPECT_EQ(s.mantissa % 2, 1U) << base::hexadecimal(x);
        EXPECT_EQ(s.negative, x < 0);
        const Q magnitude = scaled_by(Q(Z(std::to_string(s.mantissa))), s.exponent - 1074);
        EXPECT_EQ(Q(x), s.negative ? Q(-magnitude) : magnitude) << base::hexadecimal(x);
    }
}

/// Each number of a list as a multiple of their common unit.
template <class T>
void expect_multiples(const Unit& unit, const std::vector<double>& numbers) {
    for (const double x : numbers) {
        const Z got = number(unit.multiple<T>(scaled(x)));
        EXPECT_EQ(scaled_by(Q(got), unit.exponent - 1074), Q(x)) << base::hexadecimal(x);
    }
}

void expect_unit(const std::vector<double>& numbers) {
    Unit unit;
    for (const double x : numbers) unit.add(scaled(x));
    Z widest = 0;
    bool odd = false;
    for (const double x : numbers) {
        if (x == 0) continue;
        const Q multiple = scaled_by(Q(x), 1074 - unit.exponent);
        ASSERT_EQ(multiple.get_den(), 1) << base::hexadecimal(x);
        widest = std::max(widest, Z(abs(multiple.get_num())));
        odd = odd || mpz_odd_p(multiple.get_num().get_mpz_t()) != 0;
    }
    if (widest == 0) {
        EXPECT_LE(unit.bits(), 0);
    } else {
        EXPECT_TRUE(odd);  // the largest unit there is: catches a least exponent that is too small
        // Exactly the width: one less and sums of products would overflow, one more and the narrow type is given away.
        EXPECT_EQ(unit.bits(), static_cast<int>(mpz_sizeinbase(widest.get_mpz_t(), 2)));
    }
    if (unit.bits() <= 61) expect_multiples<Fixed<1>>(unit, numbers);
    if (unit.bits() <= 125) expect_multiples<Fixed<2>>(unit, numbers);
    expect_multiples<Integer>(unit, numbers);
}

TEST(Unit, EveryDistanceBetweenTwoNumbers) {
    // One bit, all bits, the first and last bit, a short number; far enough for shifts by 64 and more.
    for (const double mantissa : {1.0, 0x1.fffffffffffffp0, 0x1.0000000000001p0, 1.5}) {
        for (int below = 0; below <= 200; ++below) {
            expect_unit({0x1p40, std::ldexp(mantissa, 40 - below)});
            expect_unit({-std::ldexp(mantissa, 40 - below), -0x1.8p40, 0.0});
        }
    }
}

// Subnormals have the exponent of the smallest normals, not one less: catches max(biased, 1) left out.
TEST(Unit, SubnormalsAndZeros) {
    expect_unit({0.0, -0.0});
    for (const double x : {0x1p-1074, -0x1p-1074, 0x0.fffffffffffffp-1022, 0x1p-1022, -0x1.8p-1022,
                           0x1.fffffffffffffp-1022, 0x1p-1021}) {
        for (int exponent = -1074; exponent <= 1023; exponent += 7) expect_unit({x, 0.0, std::ldexp(1.0, exponent)});
        expect_unit({x});
        expect_unit({-0.0, x});
    }
}

TEST(Unit, AnyDoubles) {
    base::Random r(1);
    for (int k = 0; k < 5000 && !::testing::Test::HasFailure(); ++k) {
        std::vector<double> numbers;
        const int count = r.integer(1, 5);
        const bool near = r.coin();
        for (int i = 0; i < count; ++i) {
            const double x = any_finite(r);
            const int exponent = r.integer(0, 120);
            int ignored = 0;
            numbers.push_back(near && x != 0 ? std::ldexp(std::frexp(x, &ignored), exponent) : x);
        }
        expect_unit(numbers);
    }
}

// The units of several axes together: the least exponent and the highest top.
TEST(Unit, OfUnits) {
    Unit x, y;
    x.add(scaled(0x1p-30));
    y.add(scaled(0x1p70));
    x.add(y);
    EXPECT_EQ(x.exponent, 1074 - 30);
    EXPECT_EQ(x.bits(), 101);
    Unit nothing;
    x.add(nothing);
    EXPECT_EQ(x.bits(), 101);
}

}  // namespace
}  // namespace barycert::core
