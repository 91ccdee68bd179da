// Laws S1, S2 and E of predicates.hpp, against determinants of exact rationals.
#include "barycert/predicates.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "tests/core/environments.hpp"
#include "tests/core/rational.hpp"
#include "tests/core/sphere_cases.hpp"

namespace barycert {
namespace {

using testing_environments::all_environments;
using testing_environments::Changed;
using testing_rational::infinity;
using testing_rational::max;
using testing_rational::Q;
using testing_spheres::ask;
using testing_spheres::describe;
using testing_spheres::for_hard_points;
using testing_spheres::Points;

Sign opposite(Sign s) {
    return static_cast<Sign>(-static_cast<int>(s));
}

/// Sign of the determinant of the rows (x, |x|^2, 1), by elimination and without differences: nothing in common with
/// the formula of the library. For points in space it is negative inside a positive simplex.
Sign expected(const Points& p) {
    const std::size_t n = p.count();
    std::vector<std::vector<Q>> row(n);
    for (std::size_t i = 0; i < n; ++i) {
        Q square = 0;
        for (std::size_t k = 0; k < p.axes(); ++k) {
            row[i].emplace_back(p.at[i][k]);
            square += row[i][k] * row[i][k];
        }
        row[i].push_back(square);
        row[i].emplace_back(1);
    }
    int sign = p.d == 2 ? 1 : -1;
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        while (pivot < n && row[pivot][k] == 0) ++pivot;
        if (pivot == n) return Sign::zero;
        if (pivot != k) {
            std::swap(row[pivot], row[k]);
            sign = -sign;
        }
        sign *= sgn(row[k][k]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const Q f = row[i][k] / row[k][k];
            for (std::size_t j = k; j < n; ++j) row[i][j] -= f * row[k][j];
        }
    }
    return static_cast<Sign>(sign);
}

void multiply_by_power(Points& p, int shift) {
    for (auto& x : p.at) {
        for (double& c : x) c = std::ldexp(c, shift);
    }
}

TEST(LawS1, SidesOfSpheresAreThoseOfRationals) {
    std::array<int, 3> seen{};
    for_hard_points("sides", 250, [&](const Points& p, base::Random&) {
        const Sign right = expected(p);
        EXPECT_EQ(ask(p), right) << describe(p);
        ++seen[static_cast<std::size_t>(static_cast<int>(right) + 1)];
    });
    for (const int count : seen) EXPECT_GT(count, 2000);
}

// Extents about 2^-180 and 2^200, where the filter stops; 2^-208 to 2^-216, where the polynomial and its bound would be
// subnormal; and where products leave the doubles. All axes alike or not.
TEST(LawS1, SidesOfSpheresAboutTheLimitsOfTheFilter) {
    for_hard_points("limits", 100, [](Points p, base::Random& r) {
        if (std::any_of(p.at.begin(), p.at.end(), [](const auto& x) {
                return std::any_of(x.begin(), x.end(), [](double c) { return std::fabs(c) > 0x1p60; });
            }))
            return;
        const int limits[] = {-1040, -540, -340, -216, -212, -208, -181, -180, 0, 199, 200, 216, 340, 900};
        const bool alike = r.coin();
        int shift = limits[r.below(14)];
        for (std::size_t k = 0; k < p.axes(); ++k) {
            if (!alike) shift = limits[r.below(14)];
            for (auto& x : p.at) x[k] = std::ldexp(x[k], shift);
        }
        EXPECT_EQ(ask(p), expected(p)) << describe(p);
    });
}

// Cospherical, where the polynomial is subnormal: rounding makes it some units of 2^-1074, and its bound none. Catches
// a range that goes down too far.
TEST(LawS1, SidesOfSpheresWherePolynomialsUnderflow) {
    for (const int d : {2, 3}) {
        for (std::uint64_t k = 0; k < 1000 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(static_cast<std::uint64_t>(d), base::hash64("underflow"), k);
            Points p = testing_spheres::box(r, d, testing_cases::Kind::ordinary);
            multiply_by_power(p, d == 2 ? r.integer(-268, -255) : r.integer(-215, -204));
            EXPECT_EQ(ask(p), Sign::zero) << describe(p);
        }
    }
}

// Catches a filter that counts on rounding to nearest, or on gradual underflow.
TEST(LawS1, SidesOfSpheresAreTheSameInEveryEnvironment) {
    for_hard_points("environments", 60, [](const Points& p, base::Random&) {
        const Sign right = expected(p);
        for (const auto& environment : all_environments()) {
            Sign got = Sign::zero;
            {
                const Changed changed(environment);
                got = ask(p);
            }
            ASSERT_EQ(got, right) << environment.name << '\n' << describe(p);
        }
    });
}

// Coordinates as large as one limb, two limbs, allow, in a unit that a coordinate of 1 determines: sums at the ends of
// their range. Catches a threshold that leaves too little room.
TEST(LawS1, SidesOfSpheresAboutTheWidthsOfIntegers) {
    for (const int d : {2, 3}) {
        for (const int width : {59, 60, 61, 62, 63, 64, 65, 123, 124, 125, 126, 127, 128, 129}) {
            for (std::uint64_t k = 0; k < 400 && !HasFailure(); ++k) {
                base::Random r = base::Random::stream(static_cast<std::uint64_t>(width), base::hash64("widths"), k);
                Points p{d};
                for (auto& x : p.at) {
                    for (std::size_t axis = 0; axis < p.axes(); ++axis)
                        x[axis] = (r.coin() ? 1 : -1) * std::ldexp(0x1.fffffffffffffp-1, width);
                }
                const int small = r.integer(1, 3);
                for (int i = 0; i < small; ++i) p.at[r.below(p.count())][r.below(p.axes())] = r.integer(-3, 3);
                p.at[r.below(p.count())][r.below(p.axes())] = r.coin() ? 1 : -1;
                EXPECT_EQ(ask(p), expected(p)) << describe(p);
            }
        }
    }
}

// The widest integers there are: the largest doubles beside the least.
TEST(LawS1, SidesOfSpheresOfTheWidestNumbers) {
    for (const int d : {2, 3}) {
        for (std::uint64_t k = 0; k < 300 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(1, base::hash64("widest"), k);
            Points p{d};
            const double numbers[] = {max, -max, 0x1p-1074, -0x1p-1074, 1e300, -1e-300, 1.7e308, 1};
            for (auto& x : p.at) {
                for (double& c : x) c = numbers[r.below(r.coin() ? 8 : 3)];
            }
            EXPECT_EQ(ask(p), expected(p)) << describe(p);
        }
    }
}

TEST(LawS2, EvenPermutationsKeepASideOddOnesFlip) {
    for_hard_points("orders", 12, [](const Points& p, base::Random&) {
        const Sign original = ask(p);
        std::vector<std::size_t> order(p.count());
        std::iota(order.begin(), order.end(), std::size_t{0});
        do {
            bool odd = false;
            Points image{p.d};
            for (std::size_t i = 0; i < p.count(); ++i) {
                image.at[i] = p.at[order[i]];
                for (std::size_t j = 0; j < i; ++j) odd ^= order[j] > order[i];
            }
            ASSERT_EQ(ask(image), odd ? opposite(original) : original) << describe(image);
        } while (std::next_permutation(order.begin(), order.end()));
    });
}

// To the ends of the range. Numbers of few bits, so that subnormals hold them.
TEST(LawS2, PowersOfTwoChangeNoSide) {
    int done = 0;
    for_hard_points("powers", 30, [&](Points p, base::Random& r) {
        for (auto& x : p.at) {
            for (double& c : x) c = std::fabs(c) < 0x1p60 && std::fabs(c) > 0x1p-60 ? static_cast<float>(c) : 0;
        }
        const Sign original = ask(p);
        for (const int range : {40, 220, 940}) {
            Points image = p;
            multiply_by_power(image, r.integer(-range, range));
            EXPECT_EQ(ask(image), original) << describe(p) << describe(image);
            ++done;
        }
    });
    EXPECT_GT(done, 3000);
}

TEST(LawE, SidesOfWhatIsNoNumber) {
    for (const int d : {2, 3}) {
        const Points good{d, {{{0, 0, 0}, {8, 1, 0}, {1, 9, 0}, {0, 1, 7}, {1, 1, 1}}}};
        ASSERT_EQ(ask(good), expected(good));
        for (const double bad : {infinity, -infinity, std::nan("")}) {
            for (std::size_t i = 0; i < good.count(); ++i) {
                for (std::size_t k = 0; k < good.axes(); ++k) {
                    Points p = good;
                    p.at[i][k] = bad;
                    const auto got = checked_ask(p);
                    ASSERT_FALSE(got);
                    EXPECT_EQ(got.error().what, "coordinate " + std::to_string(k) + " of point " + std::to_string(i));
                    for (std::size_t j = 0; j < i; ++j) {
                        p.at[j][k] = bad;  // differences are NaN
                        EXPECT_FALSE(checked_ask(p));
                    }
                }
            }
        }
    }
}

// The convention, by hand: both orientations, in integers and off the lattice.
TEST(Sides, ByHand) {
    const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0, 1, 0}, d[3] = {0, 0, 1};
    const double inside[3] = {.5, .25, .25}, corner[3] = {1, 1, 1}, flat_corner[2] = {1, 1};
    const double outside[3] = {1, 1.1, 1}, just_outside[3] = {1, 1, 1 + 0x1p-52}, just_inside[3] = {1, 1, 1 - 0x1p-53};
    EXPECT_EQ(incircle(a, b, c, inside), Sign::positive);
    EXPECT_EQ(incircle(b, a, c, inside), Sign::negative);
    EXPECT_EQ(incircle(a, b, c, outside), Sign::negative);
    EXPECT_EQ(incircle(a, b, c, flat_corner), Sign::zero);
    EXPECT_EQ(insphere(a, b, c, d, inside), Sign::positive);
    EXPECT_EQ(insphere(b, a, c, d, inside), Sign::negative);
    EXPECT_EQ(insphere(a, b, c, d, outside), Sign::negative);
    EXPECT_EQ(insphere(b, a, c, d, outside), Sign::positive);
    EXPECT_EQ(insphere(a, b, c, d, just_outside), Sign::negative);
    EXPECT_EQ(insphere(a, b, c, d, just_inside), Sign::positive);
    for (const double* const p : {corner, a, b, c, d}) EXPECT_EQ(insphere(a, b, c, d, p), Sign::zero);
}

// The statements of predicates.hpp about these: the product with the orientation is zero, the sign alone tells sides of
// a line or plane, if anything.
TEST(Sides, OfFlatSimplices) {
    const double a[2] = {0, 0}, b[2] = {1, 1}, c[2] = {3, 3}, above[2] = {0, 1}, below[2] = {1, 0}, on[2] = {7, 7};
    const Sign side = incircle(a, b, c, above);
    EXPECT_NE(side, Sign::zero);
    EXPECT_EQ(incircle(a, b, c, below), opposite(side));
    EXPECT_EQ(incircle(a, b, c, on), Sign::zero);
    EXPECT_EQ(incircle(a, b, b, above), Sign::zero);

    const double o[3] = {0, 0, 0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, xy[3] = {1, 1, 0}, z[3] = {3, 5, 1},
                 far[3] = {5, 6, 0}, under[3] = {2, -7, -1}, level[3] = {.5, .25, 0};
    const Sign half = insphere(o, x, y, far, z);
    EXPECT_NE(half, Sign::zero);
    EXPECT_EQ(insphere(o, x, y, far, under), opposite(half));
    EXPECT_EQ(insphere(o, x, y, far, level), Sign::zero);
    EXPECT_EQ(orient3d(o, x, y, far), Sign::zero);
    EXPECT_EQ(insphere(o, x, y, xy, z), Sign::zero);  // on one circle
    EXPECT_EQ(insphere(o, x, x, y, z), Sign::zero);
}

}  // namespace
}  // namespace barycert
