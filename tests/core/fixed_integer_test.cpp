// Two's complement of fixed width against GMP, and doubles brought to a common unit.
#include "barycert/core/fixed_integer.hpp"

#include "barycert/core/scaled_double.hpp"
#include "core/rational.hpp"

namespace barycert {
namespace {

using testing_rational::any_finite;
using testing_rational::awkward_word;
using testing_rational::number;
using testing_rational::Q;
using testing_rational::scaled_by;
using testing_rational::Z;

template <int N>
Fixed<N> awkward(Random& r) {
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

TEST(FixedInteger, sums_and_differences) {
    for (const auto& x : corners<1>()) {
        for (const auto& y : corners<1>()) expect_sums(x, y);
    }
    for (const auto& x : corners<3>()) {
        for (const auto& y : corners<3>()) expect_sums(x, y);
    }
    Random r(1);
    for (int k = 0; k < 3000 && !::testing::Test::HasFailure(); ++k) {
        expect_sums(awkward<2>(r), awkward<2>(r));
        expect_sums(awkward<4>(r), awkward<4>(r));
        expect_sums(awkward<8>(r), awkward<8>(r));
    }
}

// Every pair of signs, the most negative numbers among them: catches either correction for a negative factor left out
// or made at the wrong limb.
TEST(FixedInteger, products) {
    for (const auto& x : corners<1>()) {
        for (const auto& y : corners<1>()) expect_product(x, y);
        for (const auto& y : corners<2>()) expect_product(x, y), expect_product(y, x);
    }
    for (const auto& x : corners<2>()) {
        for (const auto& y : corners<2>()) expect_product(x, y);
        for (const auto& y : corners<4>()) expect_product(x, y);
    }
    Random r(1);
    for (int k = 0; k < 3000 && !::testing::Test::HasFailure(); ++k) {
        expect_product(awkward<1>(r), awkward<1>(r));
        expect_product(awkward<1>(r), awkward<2>(r));
        expect_product(awkward<2>(r), awkward<2>(r));
        expect_product(awkward<2>(r), awkward<4>(r));
        expect_product(awkward<4>(r), awkward<4>(r));
    }
}

/// The largest and the least exponent field of a range from x to these.
ExponentRange range_of(double x, int least, int most) {
    ExponentRange range;
    range.add(x);
    range.least = std::min(range.least, least);
    range.largest = std::max(range.largest, most);
    return range;
}

/// The number aligned<T> gives, or that it says bits are lost exactly where the unit does not divide x.
template <class T>
void expect_aligned(double x, const ExponentRange& range) {
    std::uint64_t lost = 0;
    const Z got = number(aligned<T>(x, range, lost));
    const Q exact = scaled_by(Q(x), -aligned_unit<T>(range));
    EXPECT_EQ(lost == 0, exact.get_den() == 1) << hexadecimal(x) << ' ' << range.least << ' ' << range.largest;
    if (lost == 0) {
        EXPECT_EQ(Q(got), exact) << hexadecimal(x) << ' ' << range.least << ' ' << range.largest;
    }
    if constexpr (!std::is_same_v<T, Integer>) {
        // The room that sums of products rely on, and none of it given away.
        constexpr int n = std::is_same_v<T, Fixed<1>> ? 1 : 2;
        EXPECT_LT(abs(exact), Q(Z(1) << (64 * n - 3)));
        if (x != 0 && biased_exponent(x) == range.largest) {
            EXPECT_GE(abs(exact), Q(Z(1) << (64 * n - 4)));
        }
    }
    std::uint64_t before = 4;
    aligned<T>(x, range, before);
    EXPECT_NE(before, 0U);  // what was lost before stays lost
}

void expect_aligned_in_every_type(double x, int least, int most) {
    const ExponentRange range = range_of(x, least, most);
    expect_aligned<Fixed<1>>(x, range);
    expect_aligned<Fixed<2>>(x, range);
    expect_aligned<Integer>(x, range);
}

TEST(Aligned, every_distance_from_the_largest) {
    // One bit, all bits, the first and last bit, a short number; far enough for shifts by 64 and more.
    for (const double mantissa : {1.0, 0x1.fffffffffffffp0, 0x1.0000000000001p0, 1.5}) {
        for (int below = 0; below <= 200; ++below) {
            for (const double sign : {1.0, -1.0}) {
                const double x = sign * std::ldexp(mantissa, 40 - below);
                expect_aligned_in_every_type(x, 2047, 1023 + 40);
            }
        }
    }
}

// Subnormals have the exponent of the smallest normals, not one less: catches max(biased_exponent, 1) left out.
TEST(Aligned, subnormals_and_zeros) {
    for (const double x : {0.0, -0.0, 0x1p-1074, -0x1p-1074, 0x0.fffffffffffffp-1022, 0x1p-1022, -0x1.8p-1022,
                           0x1.fffffffffffffp-1022, 0x1p-1021}) {
        for (int exponent = biased_exponent(x); exponent < 140; ++exponent) {
            expect_aligned_in_every_type(x, 1, exponent);
        }
        if (x == 0) expect_aligned_in_every_type(x, 2047, 2046);  // nothing of a zero is lost, however far below
    }
}

TEST(Aligned, any_doubles) {
    Random r(1);
    for (int k = 0; k < 20000 && !::testing::Test::HasFailure(); ++k) {
        const double x = any_finite(r);
        const int exponent = std::min(biased_exponent(x) + (r.coin() ? r.integer(0, 140) : r.integer(0, 2046)), 2046);
        expect_aligned_in_every_type(x, r.coin() ? 2047 : r.integer(1, std::max(biased_exponent(x), 1)), exponent);
    }
}

TEST(ExponentRange, leaves_zeros_out_and_counts_subnormals_as_the_smallest_normals) {
    ExponentRange range;
    for (const double zero : {0.0, -0.0}) range.add(zero);
    EXPECT_EQ(range.largest, 1);
    EXPECT_GE(range.least, 2047);  // nothing there
    range.add(-3.0);
    EXPECT_EQ(range.least, 1024);
    EXPECT_EQ(range.largest, 1024);
    range.add(0.5);
    range.add(0.0);
    EXPECT_EQ(range.least, 1022);
    range.add(0x1p-1074);
    EXPECT_EQ(range.least, 1);
    ExponentRange other;
    other.add(0x1p1023);
    other.add(range);
    EXPECT_EQ(other.least, 1);
    EXPECT_EQ(other.largest, 2046);
}

}  // namespace
}  // namespace barycert
