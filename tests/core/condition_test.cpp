#include "barycert/weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/core/rational.hpp"

namespace barycert {
namespace {

using testing_rational::any_finite;
using testing_rational::infinity;
using testing_rational::max;
using testing_rational::Q;

using Cell = std::vector<double>;

double kappa(const Cell& c) {
    return condition_number(c.size() == 6 ? Simplex::triangle : Simplex::tetrahedron, c.data());
}

/// The definition, term by term; -1 for a degenerate cell.
Q exact_kappa(const Cell& c) {
    const int d = c.size() == 6 ? 2 : 3;
    const auto at = [&](int vertex, int axis) { return Q(c[static_cast<std::size_t>(d * vertex + axis)]); };
    std::vector<int> axes(static_cast<std::size_t>(d));
    Q det, box = 1;
    for (int k = 0; k < d; ++k) {
        axes[static_cast<std::size_t>(k)] = k;
        Q longest = 0;
        for (int i = 0; i <= d; ++i) {
            for (int j = 0; j < i; ++j) longest = std::max(longest, Q(abs(Q(at(i, k) - at(j, k)))));
        }
        box *= longest * (k + 1);  // d! in the end
    }
    do {
        Q product = 1;
        int inversions = 0;
        for (int i = 0; i < d; ++i) {
            const int axis = axes[static_cast<std::size_t>(i)];
            product *= at(i + 1, axis) - at(0, axis);
            for (int j = 0; j < i; ++j) inversions += axes[static_cast<std::size_t>(j)] > axis ? 1 : 0;
        }
        det += inversions % 2 == 0 ? product : Q(-product);
    } while (std::next_permutation(axes.begin(), axes.end()));
    return det == 0 ? Q(-1) : Q(box / abs(det));
}

::testing::AssertionResult right(const Cell& c) {
    const double k = kappa(c);
    const Q exact = exact_kappa(c);
    const bool good = exact < 0                                     ? k == infinity
                      : exact > Q(max)                              ? k == max
                      : !(k >= (c.size() == 6 ? 2 : 3) && k <= max) ? false
                                                                    : abs(Q(Q(k) - exact)) <= exact / 1024;
    if (good) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << k << " for " << exact.get_d() << " in " << ::testing::PrintToString(c);
}

TEST(Condition, KnownByHand) {
    EXPECT_EQ(kappa({0, 0, 1, 0, 0, 1}), 2);
    EXPECT_EQ(kappa({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}), 6);
    EXPECT_EQ(kappa({0, 0, 2, 0, 1, 2}), 2);  // box 2 x 2, area 2
    // Every second corner of a cube: a third of it, the largest share there is.
    EXPECT_EQ(kappa({0, 0, 0, 1, 1, 0, 1, 0, 1, 0, 1, 1}), 3);
    EXPECT_EQ(kappa({0, 0, 1, 1, 2, 1}), 4);  // box 2 x 1, area 1/2
}

TEST(Condition, LengthAlongAnAxisIsNotLoss) {
    for (const double h : {0x1p-1, 0x1p-52, 0x1p-1000, 0x1p1000}) {
        EXPECT_EQ(kappa({0, 0, 1, 0, 0, h}), 2) << h;
        EXPECT_EQ(kappa({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, h}), 6) << h;
    }
}

/// A sliver of height h on the diagonal: (1, 1), (1, 1 + h) from the first corner, in a box 1 x (1 + h).
TEST(Condition, GrowsAsASliverAskewGetsThin) {
    for (const double h : {0x1p-1, 0x1p-10, 0x1p-36, 0x1p-37, 0x1p-38, 0x1p-39, 0x1p-40, 0x1p-52}) {
        const double expected = 2 * (1 + h) / h;
        EXPECT_NEAR(kappa({0, 0, 1, 1, 1, 1 + h}), expected, expected / 1024) << h;
        EXPECT_NEAR(kappa({0, 0, 0, 1, 1, 0, 1, 1 + h, 0, 0, 0, 1}), 3 * expected, 3 * expected / 1024) << h;
    }
}

/// Opposite edges of length h along x and y, (1, 1, 1) apart: volume h^2 / 6 in a box (1 + 0) (1 + h) 1.
TEST(Condition, ANeedleAlongTheSpaceDiagonal) {
    const double h = 0x1p-10;
    const Cell needle{0, 0, 0, h, 0, 0, 1, 1, 1, 1, 1 + h, 1};
    EXPECT_TRUE(right(needle));
    EXPECT_NEAR(kappa(needle), 6 * (1 + h) / (h * h), 6 / (h * h) / 1024);
}

TEST(Condition, InfiniteExactlyIfDegenerate) {
    EXPECT_EQ(kappa({0, 0, 0, 0, 0, 0}), infinity);
    EXPECT_EQ(kappa({0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3}), infinity);
    EXPECT_EQ(kappa({0.1, 0.1, 0.2, 0.2, 0.7, 0.7}), infinity);
    EXPECT_EQ(kappa({-max, -max, max, max, 0, 0}), infinity);
    EXPECT_TRUE(right({0, 0, 1, 1, 2, std::nextafter(2, 3)}));
    EXPECT_TRUE(right({0, 0, max, max, max / 2, std::nextafter(max / 2, 0)}));
    EXPECT_TRUE(right({0, 0, 0, 0.1, 0.1, 0.1, 0.2, 0.2, 0.2, 0.3, std::nextafter(0.3, 1), std::nextafter(0.3, 0)}));
}

/// Not degenerate, and thin by thousands of bits: more than a double holds.
TEST(Condition, IsFiniteIfNotDegenerate) {
    EXPECT_EQ(kappa({0, 0, max, max, 0x1p-1074, 0}), max);
    EXPECT_EQ(kappa({0, 0, 0, max, max, max, 0x1p-1074, 0x1p-1074, 0, 1, std::nextafter(1, 2), 1}), max);
}

TEST(Condition, NaNWhereItHasNoMeaning) {
    const std::array<double, 9> c{0, 0, 0, 1, 0, 0, 0, 1, 0};
    EXPECT_TRUE(std::isnan(condition_number(Simplex::segment, c.data())));
    EXPECT_TRUE(std::isnan(condition_number(Simplex::triangle3d, c.data())));
    EXPECT_TRUE(std::isnan(kappa({0, 0, 1, 0, 0, infinity})));
    EXPECT_TRUE(std::isnan(kappa({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, std::nan("")})));
}

/// A cell of each sort in turn: ordinary, on lattices where many are degenerate, a few ulps from degenerate, with any
/// exponents.
Cell make(base::Random& r, int d, int sort) {
    Cell c(static_cast<std::size_t>(d * (d + 1)));
    for (double& x : c) {
        switch (sort) {
            case 0:
                x = r.uniform(-1, 1);
                break;
            case 1:
                x = static_cast<double>(r.integer(-2, 2)) * 0.1;
                break;
            case 2:
                x = 0x1p60 + 0x1p10 * static_cast<double>(r.integer(-2, 2));
                break;
            case 3:
                x = std::ldexp(r.uniform(-1, 1), r.integer(-200, 200));
                break;
            default:
                x = any_finite(r);
        }
    }
    if (sort == 0 && r.coin()) {  // the last corner into the plane of the others, as far as rounding goes
        const double a = r.uniform(0, 1), b = d == 2 ? 1 - a : r.uniform(0, 1);
        const auto n = static_cast<std::size_t>(d);
        for (std::size_t k = 0; k < n; ++k) {
            c[n * n + k] = a * c[k] + b * c[n + k];
            if (d == 3) c[n * n + k] += (1 - a - b) * c[2 * n + k];
        }
    }
    return c;
}

TEST(Condition, AgainstRationalNumbers) {
    base::Random r(7);
    for (int i = 0; i < 4000; ++i) {
        EXPECT_TRUE(right(make(r, 2, i % 5)));
        EXPECT_TRUE(right(make(r, 3, i % 5)));
    }
}

/// Beside what floating point decides, so that both ways are compared where they meet.
TEST(Condition, AroundTheLimitOfFloatingPoint) {
    base::Random r(8);
    for (int i = 0; i < 2000; ++i) {
        Cell c = make(r, 3, 0);
        const double h = std::ldexp(r.uniform(0.5, 1), -r.integer(30, 45));
        for (std::size_t k = 0; k < 3; ++k) c[9 + k] = (c[k] + c[3 + k] + c[6 + k]) / 3 + h * r.uniform(-1, 1);
        EXPECT_TRUE(right(c));
    }
}

TEST(Condition, ScalingAnAxisByAPowerOfTwoAndPermutingCornersChangeNothingThatMatters) {
    base::Random r(9);
    for (int i = 0; i < 2000; ++i) {
        for (const int d : {2, 3}) {
            const Cell c = make(r, d, i % 2);
            Cell scaled = c;
            for (int axis = 0; axis < d; ++axis) {
                const int e = r.integer(-900, 900);  // 2^-50 to 2^1: no bit is lost
                for (std::size_t k = static_cast<std::size_t>(axis); k < c.size(); k += static_cast<std::size_t>(d))
                    scaled[k] = std::ldexp(c[k], e);
            }
            const double k = kappa(c);
            if (std::isinf(k)) {
                EXPECT_EQ(kappa(scaled), k);
            } else {
                EXPECT_NEAR(kappa(scaled), k, k / 512);
            }
            Cell turned = c;
            std::rotate(turned.begin(), turned.begin() + d, turned.end());
            if (std::isinf(k)) {
                EXPECT_EQ(kappa(turned), k);
            } else {
                EXPECT_NEAR(kappa(turned), k, k / 512);
            }
        }
    }
}

TEST(Condition, AtTheEndsOfTheRange) {
    for (const double s : {1e300, 1e-300, 0x1p-1074, 0x1p1020}) {
        EXPECT_EQ(kappa({0, 0, s, 0, 0, s}), 2) << s;
        EXPECT_EQ(kappa({0, 0, 0, s, 0, 0, 0, s, 0, 0, 0, s}), 6) << s;
        EXPECT_EQ(kappa({0, 0, s, s, 2 * s, s}), 4) << s;
        EXPECT_EQ(kappa({0, 0, 0, s, s, s, 2 * s, 2 * s, 2 * s, 0, 0, s}), infinity) << s;
    }
}

}  // namespace
}  // namespace barycert
