// Values on isoparametric cells against Newton's method in 100 digits with shape functions written apart, and against
// rational numbers where the point of the reference cell is known.
#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/gradient.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/isoparametric/lanes.hpp"

#include <gtest/gtest.h>

#include <random>

namespace barycert::core::isoparametric {
namespace {

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

/// Corners of the unit cell.
std::vector<std::array<double, 3>> unit_cell(std::uint8_t type) {
    switch (type) {
        case 9:
            return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
        case 13:
            return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
        case 14:
            return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
        default:
            return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    }
}

template <class T>
std::vector<T> functions(std::uint8_t type, const T& r, const T& s, const T& t) {
    const T a = 1 - r, b = 1 - s, c = 1 - t;
    switch (type) {
        case 9:
            return {a * b, r * b, r * s, a * s};
        case 13:
            return {(a - s) * c, r * c, s * c, (a - s) * t, r * t, s * t};
        case 14:
            return {a * b * c, r * b * c, r * s * c, a * s * c, t};
        default:
            return {a * b * c, r * b * c, r * s * c, a * s * c, a * b * t, r * b * t, r * s * t, a * s * t};
    }
}

struct Cell {
    std::uint8_t type;
    std::vector<std::array<double, 3>> at;
    std::vector<double> values;

    std::size_t dimension() const { return type == 9 ? 2 : 3; }
    Places places() const {
        Places p{};
        for (std::size_t i = 0; i < at.size(); ++i) p.at[i] = at[i].data();
        return p;
    }
    template <class T>
    std::array<T, 4> point_and_value(const T& r, const T& s, const T& t) const {
        const auto n = functions<T>(type, r, s, t);
        std::array<T, 4> sum{};
        for (std::size_t i = 0; i < n.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) sum[k] += n[i] * at[i][k];
            sum[3] += n[i] * values[i];
        }
        return sum;
    }
};

/// Solves d equations, a row each with the right side behind it.
template <class T>
std::array<T, 3> solved(std::array<std::array<T, 4>, 3> a, std::size_t d) {
    for (std::size_t c = 0; c < d; ++c) {
        std::size_t pivot = c;
        for (std::size_t i = c; i < d; ++i) pivot = abs(a[i][c]) > abs(a[pivot][c]) ? i : pivot;
        std::swap(a[pivot], a[c]);
        for (std::size_t i = 0; i < d; ++i) {
            if (i == c) continue;
            const T f = a[i][c] / a[c][c];
            for (std::size_t j = c; j <= d; ++j) a[i][j] -= f * a[c][j];
        }
    }
    std::array<T, 3> x{};
    for (std::size_t k = 0; k < d; ++k) x[k] = a[k][d] / a[k][k];
    return x;
}

/// Derivatives of the point and the value by each variable, which all are of degree 1: exact differences.
template <class T>
std::array<std::array<T, 4>, 3> derivatives(const Cell& cell, const std::array<T, 3>& x) {
    std::array<std::array<T, 4>, 3> by{};
    for (std::size_t j = 0; j < cell.dimension(); ++j) {
        auto low = x, high = x;
        low[j] = 0;
        high[j] = 1;
        const auto from = cell.point_and_value<T>(low[0], low[1], low[2]);
        const auto to = cell.point_and_value<T>(high[0], high[1], high[2]);
        for (std::size_t k = 0; k < 4; ++k) by[j][k] = to[k] - from[k];
    }
    return by;
}

/// The gradient at x: J^T g = f.
template <class T>
std::array<T, 3> gradient_at(const Cell& cell, const std::array<T, 3>& x) {
    auto rows = derivatives(cell, x);
    for (auto& row : rows) row[cell.dimension()] = row[3];
    return solved(rows, cell.dimension());
}

/// The reference coordinates of the point, in 100 digits.
std::array<Digits, 3> by_newton(const Cell& cell, const double* p, const std::array<double, 3>& about) {
    std::array<Digits, 3> x{about[0], about[1], about[2]};
    const std::size_t d = cell.dimension();
    for (int step = 0; step < 14; ++step) {
        const auto here = cell.point_and_value<Digits>(x[0], x[1], x[2]);
        const auto by = derivatives(cell, x);
        std::array<std::array<Digits, 4>, 3> a{};
        for (std::size_t k = 0; k < d; ++k) {
            for (std::size_t j = 0; j < d; ++j) a[k][j] = by[j][k];
            a[k][d] = Digits(p[k]) - here[k];
        }
        const auto moved = solved(a, d);
        for (std::size_t k = 0; k < d; ++k) x[k] += moved[k];
    }
    return x;
}

double value_by_newton(const Cell& cell, const double* p, double x0, double x1, double x2) {
    const auto x = by_newton(cell, p, {x0, x1, x2});
    return cell.point_and_value<Digits>(x[0], x[1], x[2])[3].convert_to<double>();
}

constexpr std::array<std::uint8_t, 4> types{9, 12, 13, 14};

class Isoparametric : public testing::TestWithParam<std::uint8_t> {
protected:
    std::mt19937_64 random{GetParam()};
    double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }

    Cell cell(double warp, double scale, double shift) {
        Cell c{GetParam(), unit_cell(GetParam()), {}};
        for (auto& p : c.at) {
            for (std::size_t k = 0; k < c.dimension(); ++k) p[k] = scale * (p[k] + uniform(-warp, warp)) + shift;
            c.values.push_back(uniform(-1, 1));
        }
        return c;
    }
    std::array<double, 3> reference_point() {
        std::array<double, 3> x{uniform(0, 1), uniform(0, 1), GetParam() == 9 ? 0 : uniform(0, 1)};
        if (GetParam() == 13 && x[0] + x[1] > 1) x = {1 - x[0], 1 - x[1], x[2]};
        return x;
    }
    static std::vector<double> tripled(std::vector<double> values) {
        for (double& v : values) v *= -3;
        return values;
    }
    static std::uint64_t all(const Cell& c) { return (std::uint64_t{1} << c.at.size()) - 1; }
};

TEST_P(Isoparametric, V1ValuesAreRoundedOnce) {
    std::size_t exact = 0;
    const Reference& reference = *linear_reference(GetParam());
    for (int i = 0; i < 1500; ++i) {
        const double scale = std::ldexp(1.0, i % 7 == 0 ? static_cast<int>(random() % 600) - 300 : 0);
        const Cell c = cell(0.15, scale, i % 5 == 0 ? 1000 * scale : 0);
        ASSERT_EQ(proved_orientation(reference, c.places()), 1);
        const auto x = reference_point();
        const auto at = c.point_and_value<double>(x[0], x[1], x[2]);
        double value = 0;
        const Evaluated found = evaluate(reference, c.places(), at.data(), all(c), c.values.data(), 1, &value);
        ASSERT_EQ(found.certainty, Certainty::proved);
        exact += found.tier == Tier::exact ? 1 : 0;
        ASSERT_EQ(value, value_by_newton(c, at.data(), x[0], x[1], x[2])) << i;
    }
    EXPECT_LT(exact, 10U);
}

// Coordinates and values of few bits: all is rational, and there are ties.
TEST_P(Isoparametric, V1TiesOnLatticesAreRoundedToEven) {
    const Reference& reference = *linear_reference(GetParam());
    std::size_t exact = 0, proper = 0;
    for (int i = 0; i < 4000; ++i) {
        Cell c = cell(0, 64, 0);
        const bool affine = i % 2 == 0;
        for (std::size_t node = 0; node < c.at.size(); ++node) {
            for (std::size_t k = 0; k < c.dimension(); ++k)
                c.at[node][k] += affine ? 0 : static_cast<double>(random() % 17) - 8;
            c.values[node] = 1 + std::ldexp(static_cast<double>(random() % 5), -52);
        }
        if (proved_orientation(reference, c.places()) != 1) continue;
        ++proper;
        std::array<double, 3> x{static_cast<double>(random() % 5) / 4, static_cast<double>(random() % 5) / 4,
                                GetParam() == 9 ? 0 : static_cast<double>(random() % 4) / 4};
        if (GetParam() == 13 && x[0] + x[1] > 1) x = {1 - x[0], 1 - x[1], x[2]};
        const auto sums = c.point_and_value<Rational>(Rational(x[0]), Rational(x[1]), Rational(x[2]));
        std::array<double, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = sums[k].convert_to<double>();
        double value = 0;
        const Evaluated found = evaluate(reference, c.places(), at.data(), all(c), c.values.data(), 1, &value);
        ASSERT_EQ(found.certainty, Certainty::proved) << i;
        exact += found.tier == Tier::exact ? 1 : 0;
        // Units of the last place above 1, rounded to even.
        const Rational units = (sums[3] - 1) * Rational(std::ldexp(1.0, 52));
        const double expected = std::nearbyint(units.convert_to<double>());
        ASSERT_EQ(std::ldexp(value - 1, 52), expected) << i;
    }
    EXPECT_GT(proper, 2000U);
    EXPECT_GT(exact, 200U);
}

TEST_P(Isoparametric, G1GradientsAreRoundedOnce) {
    const Reference& reference = *linear_reference(GetParam());
    for (int i = 0; i < 1000; ++i) {
        const double scale = std::ldexp(1.0, i % 7 == 0 ? static_cast<int>(random() % 600) - 300 : 0);
        const Cell c = cell(0.15, scale, i % 5 == 0 ? 1000 * scale : 0);
        const auto x = reference_point();
        const auto at = c.point_and_value<double>(x[0], x[1], x[2]);
        std::array<double, 3> g{};
        ASSERT_EQ(evaluate_gradients(reference, c.places(), at.data(), c.values.data(), 1, g.data()).certainty,
                  Certainty::proved);
        const auto expected = gradient_at(c, by_newton(c, at.data(), x));
        for (std::size_t k = 0; k < c.dimension(); ++k) ASSERT_EQ(g[k], expected[k].convert_to<double>()) << i;
        ASSERT_EQ(gradients_at_place(reference, c.places(), x, c.values.data(), 1, g.data()).certainty,
                  Certainty::proved);
        const auto there = gradient_at<Rational>(c, {Rational(x[0]), Rational(x[1]), Rational(x[2])});
        for (std::size_t k = 0; k < c.dimension(); ++k) ASSERT_EQ(g[k], there[k].convert_to<double>()) << i;
    }
}

// Of few bits all is rational; some derivatives are 0, and there are ties.
TEST_P(Isoparametric, G1GradientsOnLattices) {
    const Reference& reference = *linear_reference(GetParam());
    std::size_t zeros = 0, proper = 0;
    for (int i = 0; i < 2000; ++i) {
        Cell c = cell(0, 64, 0);
        const bool affine = i % 2 == 0;
        for (std::size_t node = 0; node < c.at.size(); ++node) {
            for (std::size_t k = 0; k < c.dimension(); ++k)
                c.at[node][k] += affine ? 0 : static_cast<double>(random() % 17) - 8;
            c.values[node] = static_cast<double>(random() % 3);
        }
        if (proved_orientation(reference, c.places()) != 1) continue;
        std::array<double, 3> x{static_cast<double>(random() % 5) / 4, static_cast<double>(random() % 5) / 4,
                                GetParam() == 9 ? 0 : static_cast<double>(random() % 4) / 4};
        if (GetParam() == 13 && x[0] + x[1] > 1) x = {1 - x[0], 1 - x[1], x[2]};
        const auto sums = c.point_and_value<Rational>(Rational(x[0]), Rational(x[1]), Rational(x[2]));
        std::array<double, 3> at{}, g{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = sums[k].convert_to<double>();
        ASSERT_EQ(evaluate_gradients(reference, c.places(), at.data(), c.values.data(), 1, g.data()).certainty,
                  Certainty::proved)
            << i;
        const auto expected = gradient_at<Rational>(c, {Rational(x[0]), Rational(x[1]), Rational(x[2])});
        for (std::size_t k = 0; k < c.dimension(); ++k) {
            ASSERT_EQ(g[k], expected[k].convert_to<double>()) << i;
            zeros += g[k] == 0 ? 1 : 0;
        }
        ++proper;
    }
    EXPECT_GT(proper, 1000U);
    EXPECT_GT(zeros, 50U);
}

// The gradient of an affine function is that function's everywhere, 0 by some coordinates, though x is no fraction.
TEST_P(Isoparametric, G1GradientsOfAffineFunctions) {
    const Reference& reference = *linear_reference(GetParam());
    for (int i = 0; i < 300; ++i) {
        Cell c = cell(0, 64, 0);
        for (auto& p : c.at) {
            for (std::size_t k = 0; k < c.dimension(); ++k) p[k] = std::nearbyint(p[k] + uniform(-9, 9));
        }
        std::array<double, 3> slope{};
        slope[static_cast<std::size_t>(i) % c.dimension()] = 3;
        for (std::size_t node = 0; node < c.at.size(); ++node) {
            c.values[node] = 7;
            for (std::size_t k = 0; k < 3; ++k) c.values[node] += slope[k] * c.at[node][k];
        }
        const auto x = reference_point();
        const auto at = c.point_and_value<double>(x[0], x[1], x[2]);
        std::array<double, 3> g{1, 1, 1};
        ASSERT_EQ(evaluate_gradients(reference, c.places(), at.data(), c.values.data(), 1, g.data()).certainty,
                  Certainty::proved);
        for (std::size_t k = 0; k < c.dimension(); ++k) ASSERT_EQ(g[k], slope[k]) << i;
    }
}

TEST(IsoparametricValues, G1NoGradientAtTheApexAndOfNaN) {
    Cell c{14, unit_cell(14), {1, 2, 3, 4, 5}};
    const Reference& reference = *linear_reference(14);
    std::array<double, 3> g{};
    EXPECT_EQ(evaluate_gradients(reference, c.places(), c.at[4].data(), c.values.data(), 1, g.data()).certainty,
              Certainty::not_found);
    EXPECT_EQ(gradients_at_place(reference, c.places(), {0.5, 0.5, 1}, c.values.data(), 1, g.data()).certainty,
              Certainty::not_found);
    c.values[3] = NAN;
    const std::array<double, 3> inside{0.5, 0.5, 0.25};
    EXPECT_EQ(evaluate_gradients(reference, c.places(), inside.data(), c.values.data(), 1, g.data()).certainty,
              Certainty::proved);
    for (const double x : g) EXPECT_TRUE(std::isnan(x));
}

// Near the apex r and s are told by the direction from there alone. With w = 1 - t, Newton's method in 100 digits on
// apex + w Q(r, s), where w and the point are scaled.
TEST(IsoparametricValues, V1PyramidsNearTheirApex) {
    std::mt19937_64 random(5);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const Reference& reference = *linear_reference(14);
    for (int i = 0; i < 400; ++i) {
        Cell c{14, unit_cell(14), {}};
        const bool at_origin = i % 2 == 0;
        for (std::size_t node = 0; node < 5; ++node) {
            for (std::size_t k = 0; k < 3; ++k) {
                c.at[node][k] += node < 4 ? uniform(-0.15, 0.15) : 0;
                if (at_origin) c.at[node][k] -= k == 2 ? 1 : 0.5;
            }
            c.values.push_back(node == 4 && i % 4 < 2 ? 0 : uniform(-1, 1));
        }
        ASSERT_NE(proved_orientation(reference, c.places()), 0);
        const int down = at_origin ? i : i % 45;
        const std::array<double, 3>& apex = c.at[4];
        std::array<double, 3> p{};
        const std::array<double, 2> start{uniform(0.1, 0.9), uniform(0.1, 0.9)};
        const auto base = [&](const Digits& r, const Digits& s, std::size_t k) {
            const std::array<Digits, 4> n{(1 - r) * (1 - s), r * (1 - s), r * s, (1 - r) * s};
            Digits sum = 0;
            for (std::size_t node = 0; node < 4; ++node) sum += n[node] * (Digits(c.at[node][k]) - Digits(apex[k]));
            return sum;
        };
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = Digits(apex[k] + ldexp(base(start[0], start[1], k), -down - 1)).convert_to<double>();
        if (p == apex) continue;
        // 2^down (p - apex) = w Q(r, s), by r, s and w.
        std::array<Digits, 3> x{start[0], start[1], 0.5};
        for (int step = 0; step < 200; ++step) {
            std::array<std::array<Digits, 4>, 3> rows;
            for (std::size_t k = 0; k < 3; ++k) {
                const Digits q = base(x[0], x[1], k);
                rows[k] = {x[2] * (base(1, x[1], k) - base(0, x[1], k)), x[2] * (base(x[0], 1, k) - base(x[0], 0, k)),
                           q, ldexp(Digits(Digits(p[k]) - Digits(apex[k])), down) - x[2] * q};
            }
            for (std::size_t k = 0; k < 3; ++k) {
                std::size_t pivot = k;
                for (std::size_t j = k; j < 3; ++j) pivot = abs(rows[j][k]) > abs(rows[pivot][k]) ? j : pivot;
                std::swap(rows[k], rows[pivot]);
                for (std::size_t j = 0; j < 3; ++j) {
                    if (j == k) continue;
                    const Digits factor = rows[j][k] / rows[k][k];
                    for (std::size_t m = 0; m < 4; ++m) rows[j][m] -= factor * rows[k][m];
                }
            }
            Digits moved = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const Digits by = rows[k][3] / rows[k][k];
                x[k] += by;
                moved += abs(by);
            }
            if (moved < 1e-90) break;
        }
        if (x[0] < 0 || x[0] > 1 || x[1] < 0 || x[1] > 1) continue;  // p was rounded
        const Digits w = ldexp(x[2], -down);
        const std::array<Digits, 4> n{(1 - x[0]) * (1 - x[1]), x[0] * (1 - x[1]), x[0] * x[1], (1 - x[0]) * x[1]};
        Digits sum = (1 - w) * c.values[4];
        for (std::size_t node = 0; node < 4; ++node) sum += w * n[node] * c.values[node];
        double value = 0;
        const Evaluated found = evaluate(reference, c.places(), p.data(), 31, c.values.data(), 1, &value);
        ASSERT_EQ(found.certainty, Certainty::proved) << i;
        ASSERT_EQ(value, sum.convert_to<double>()) << i;
        // The gradient is that at r, s on the base: it does not depend on w.
        std::array<double, 3> g{};
        ASSERT_EQ(evaluate_gradients(reference, c.places(), p.data(), c.values.data(), 1, g.data()).certainty,
                  Certainty::proved)
            << i;
        const auto expected = gradient_at<Digits>(c, {x[0], x[1], 0});
        for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(g[k], expected[k].convert_to<double>()) << i;
    }
}

// At r = s = 1/q the shape functions are (q - 1)^2, q - 1, 1 and q - 1, over q^2. With these values at nodes the value
// is 1 + 2^-53, between two doubles; 1/3 is looked for, 1/65537 is not.
TEST(IsoparametricValues, V1TiesThatNoPrecisionTellsHaveABound) {
    constexpr double q = 65537;
    const std::array<std::array<double, 2>, 4> nodes{{{0, 0}, {4 * q * q, 0}, {3 * q * q, 3 * q * q}, {0, 4 * q * q}}};
    constexpr std::array<double, 4> tie{1, 1 + (q + 3) * 0x1p-53, 1 - (2 * q - 3) * 0x1p-53, 1};
    Places places{};
    std::array<double, 8> values{};  // another component that is decided
    for (std::size_t i = 0; i < 4; ++i) {
        places.at[i] = nodes[i].data();
        values[2 * i] = tie[i];
        values[2 * i + 1] = nodes[i][0];
    }
    const std::array<double, 2> point{4 * q - 1, 4 * q - 1};
    std::array<double, 2> out{};
    const Evaluated found = evaluate(*linear_reference(9), places, point.data(), 0b1111, values.data(), 2, out.data());
    EXPECT_EQ(found.certainty, Certainty::undecided);
    EXPECT_EQ(found.tier, Tier::exact);
    EXPECT_EQ(found.off, 0x1p-52);
    EXPECT_TRUE(out[0] == 1 || out[0] == 1 + 0x1p-52) << out[0];
    EXPECT_EQ(out[1], point[0]);
}

TEST(IsoparametricValues, V1TiesAtFractionsAreRoundedToEven) {
    const std::array<std::array<double, 2>, 4> nodes{{{0, 0}, {36, 0}, {27, 27}, {0, 36}}};
    Places places{};
    for (std::size_t i = 0; i < 4; ++i) places.at[i] = nodes[i].data();
    const std::array<double, 2> point{11, 11};  // at r = s = 1/3: 4/9, 2/9, 1/9, 2/9
    // 1 + 2^-53 and 1 + 3 * 2^-53.
    const std::array<std::array<double, 4>, 2> values{
        {{1 + 0x1p-52, 1 + 0x1p-52, 1 - 3 * 0x1p-53, 1}, {1 + 0x1p-51, 1 + 0x1p-51, 1 - 0x1p-53, 1 + 0x1p-52}}};
    constexpr std::array<double, 2> even{1, 1 + 0x1p-51};
    for (std::size_t i = 0; i < 2; ++i) {
        double out = 0;
        const Evaluated found = evaluate(*linear_reference(9), places, point.data(), 0b1111, values[i].data(), 1, &out);
        EXPECT_EQ(found.certainty, Certainty::proved);
        EXPECT_EQ(out, even[i]);
    }
}

// The field 3 x at x = 1 + 2^-52, between two doubles, where reference coordinates are no fractions.
TEST(IsoparametricValues, V1AffineFunctionsAreRoundedToEven) {
    const std::array<std::array<double, 2>, 4> nodes{{{0, 0}, {4, 0}, {3, 3}, {0, 2}}};
    Places places{};
    std::array<double, 4> values{};
    for (std::size_t i = 0; i < 4; ++i) {
        places.at[i] = nodes[i].data();
        values[i] = 3 * nodes[i][0];
    }
    for (const double x : {1 + 0x1p-52, 1 + 0x1p-51 + 0x1p-52}) {
        const std::array<double, 2> point{x, 1};
        double out = 0;
        EXPECT_EQ(evaluate(*linear_reference(9), places, point.data(), 0b1111, values.data(), 1, &out).certainty,
                  Certainty::proved);
        EXPECT_EQ(out, 3 * x);  // rounded to even here, too
    }
}

TEST_P(Isoparametric, ValuesOfAllSizesAndKinds) {
    const Reference& reference = *linear_reference(GetParam());
    for (int i = 0; i < 400; ++i) {
        Cell c = cell(0.1, 1, 0);
        const int size = static_cast<int>(random() % 2000) - 1050;
        for (double& v : c.values) v = std::ldexp(v, size - static_cast<int>(random() % 40));
        const auto x = reference_point();
        const auto at = c.point_and_value<double>(x[0], x[1], x[2]);
        double value = 0;
        ASSERT_EQ(evaluate(reference, c.places(), at.data(), all(c), c.values.data(), 1, &value).certainty,
                  Certainty::proved);
        Cell near_one = c;
        for (double& v : near_one.values) v = std::ldexp(v, -size);
        const double expected = value_by_newton(near_one, at.data(), x[0], x[1], x[2]);
        if (std::abs(std::ldexp(expected, size)) > 0x1p-1000) {
            ASSERT_EQ(value, std::ldexp(expected, size));
        } else {
            ASSERT_NEAR(value, std::ldexp(expected, size), 5e-324);
        }
    }
    Cell c = cell(0.1, 1, 0);
    const auto at = c.point_and_value<double>(0.25, 0.25, GetParam() == 9 ? 0 : 0.25);
    std::array<double, 2> two{};
    std::vector<double> values;
    for (std::size_t i = 0; i < c.at.size(); ++i) values.insert(values.end(), {i == 1 ? NAN : 1.0, 2.5});
    ASSERT_EQ(evaluate(reference, c.places(), at.data(), all(c), values.data(), 2, two.data()).certainty,
              Certainty::proved);
    EXPECT_TRUE(std::isnan(two[0]));
    EXPECT_EQ(two[1], 2.5);
    evaluate(reference, c.places(), at.data(), all(c) & ~2ULL, values.data(), 2, two.data());
    EXPECT_FALSE(std::isnan(two[0]));
}

// As lanes have them: nearly all are proved, and all of these are right.
TEST_P(Isoparametric, V1LanesAreRoundedOnce) {
    if (GetParam() == 9) return;
    constexpr std::array<std::array<std::size_t, 8>, 3> corners{
        {{0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 2, 0, 3, 4, 5, 3}, {0, 1, 2, 3, 4, 4, 4, 4}}};
    const auto& corner = corners[GetParam() - 12U];
    const Reference& reference = *linear_reference(GetParam());
    std::size_t proved = 0, cases = 0;
    for (int round = 0; round < 200; ++round) {
        std::array<double, 24 * max_lanes> places{};
        std::array<double, 3 * max_lanes> points{};
        std::array<double, 16 * max_lanes> values{};
        std::array<double, 2 * max_lanes> out{};
        std::vector<Cell> cells;
        const std::size_t count = 1 + random() % max_lanes;
        const double scale = round % 3 == 0 ? std::ldexp(1.0, static_cast<int>(random() % 400) - 200) : 1;
        for (std::size_t lane = 0; lane < count; ++lane) {
            const Cell& c = cells.emplace_back(cell(0.15, scale, round % 4 == 0 ? 1000 * scale : 0));
            const auto x = reference_point();
            const auto at = c.point_and_value<double>(x[0], x[1], x[2]);
            for (std::size_t k = 0; k < 3; ++k) points[k * max_lanes + lane] = at[k];
            for (std::size_t i = 0; i < 8; ++i) {
                for (std::size_t k = 0; k < 3; ++k) places[(3 * i + k) * max_lanes + lane] = c.at[corner[i]][k];
                values[i * max_lanes + lane] = c.values[corner[i]];
                values[(8 + i) * max_lanes + lane] = -3 * c.values[corner[i]];
            }
        }
        const std::uint32_t bits =
            evaluate_lanes({count, GetParam() == 13 ? LaneElement::wedge : LaneElement::hexahedron, places.data(),
                            nullptr, points.data(), values.data(), 2, out.data()})
                .values;
        ASSERT_EQ(bits >> count, 0U);
        for (std::size_t lane = 0; lane < count; ++lane) {
            ++cases;
            if ((bits >> lane & 1U) == 0) continue;
            ++proved;
            const std::array<double, 3> at{points[lane], points[max_lanes + lane], points[2 * max_lanes + lane]};
            double value = 0;
            evaluate(reference, cells[lane].places(), at.data(), all(cells[lane]), cells[lane].values.data(), 1,
                     &value);
            ASSERT_EQ(out[lane], value);
            ASSERT_EQ(out[max_lanes + lane],
                      value_by_newton({cells[lane].type, cells[lane].at, tripled(cells[lane].values)}, at.data(), 0.3,
                                      0.3, 0.3));
        }
    }
    EXPECT_GT(proved, cases * 95 / 100) << "of " << cases;
}

TEST_P(Isoparametric, OrientationIsProvedAndFoldsAreNot) {
    const Reference& reference = *linear_reference(GetParam());
    std::size_t proved = 0, folded = 0;
    for (int i = 0; i < 3000; ++i) {
        const Cell c = cell(0.6, 1, 0);
        const int sign = proved_orientation(reference, c.places());
        // Jacobians by differences, at points of a grid.
        bool positive = false, negative = false;
        for (int k = 0; k < 343; ++k) {
            const double r = (k % 7) / 6.0, s = (k / 7 % 7) / 6.0, t = GetParam() == 9 ? 0 : (k / 49) / 6.0 * 0.999;
            if (GetParam() == 13 && r + s > 1) continue;
            std::array<std::array<double, 3>, 3> e{};
            for (std::size_t j = 0; j < c.dimension(); ++j) {  // linear in each coordinate
                const auto end = [&](double x) {
                    return c.point_and_value<double>(j == 0 ? x : r, j == 1 ? x : s, j == 2 ? x : t);
                };
                for (std::size_t m = 0; m < 3; ++m) e[j][m] = end(1)[m] - end(0)[m];
            }
            if (c.dimension() == 2) e[2] = {0, 0, 1};
            const double det = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                               e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                               e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
            positive |= det > 1e-12;
            negative |= det < -1e-12;
        }
        proved += sign != 0 ? 1 : 0;
        folded += positive && negative ? 1 : 0;
        if (positive && negative) {
            ASSERT_EQ(sign, 0);
        } else if (sign != 0) {
            ASSERT_TRUE(sign > 0 ? !negative : !positive);
        }
    }
    EXPECT_GT(proved, 100U);
    EXPECT_GT(folded, 100U);
}

INSTANTIATE_TEST_SUITE_P(types, Isoparametric, testing::ValuesIn(types));

}  // namespace
}  // namespace barycert::core::isoparametric
