// When a node counts as being where a straight cell has it.

#include "mesh/straight_nodes.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

namespace barycert::mesh {
namespace {

using Rational = boost::multiprecision::cpp_rational;

StraightPlace middle(double a, double b) {
    StraightPlace place;
    place.add(a, 1);
    place.add(b, 1);
    return place;
}

Rational exact(const StraightPlace& place) {
    Rational sum = 0;
    for (std::size_t i = 0; i < place.count; ++i) sum += Rational(place.corners[i]) * place.times[i];
    return sum / place.over;
}

/// Whether no number of a type is nearer to x, but one; or to what x is when it moves by less than `excused`.
template <class Number>
bool is_one_of_two_nearest(double own, const Rational& x, const Rational& excused) {
    const auto number = static_cast<Number>(own);
    for (const Number beyond : {-std::numeric_limits<Number>::max(), std::numeric_limits<Number>::max()}) {
        const Number next = std::nextafter(number, beyond);
        const Rational moved = x + (beyond < 0 ? 1 : -1) * excused;
        const Rational farther = abs(moved - Rational(number)) - abs(moved - Rational(next));
        if (farther > 0 || (farther == 0 && excused != 0)) return false;
    }
    return true;
}

/// By how much the place may move when each corner does, by half the distance of floats of its size.
Rational moved_by_floats(const StraightPlace& place) {
    Rational sum = 0;
    for (std::size_t i = 0; i < place.count; ++i) {
        int exponent = 0;
        std::frexp(place.corners[i], &exponent);
        const int unit = place.corners[i] == 0 ? -149 : std::max(exponent - 24, -149);
        sum += Rational(std::ldexp(1.0, unit - 1)) * place.times[i];
    }
    return sum / place.over;
}

Straight expected(double own, const StraightPlace& place, bool single) {
    const Rational x = exact(place);
    if (x == Rational(own)) return Straight::exactly;
    if (is_one_of_two_nearest<double>(own, x, 0)) return Straight::rounded;
    return single && is_one_of_two_nearest<float>(own, x, moved_by_floats(place)) ? Straight::written : Straight::no;
}

TEST(StraightNodes, MiddlesOfDoublesAndFloats) {
    std::mt19937_64 random(1);
    const auto number = [&](int range, bool single) {
        const double x = std::ldexp(std::uniform_real_distribution(-1.0, 1.0)(random),
                                    std::uniform_int_distribution(-range, range)(random));
        return single ? static_cast<double>(static_cast<float>(x)) : x;
    };
    std::array<std::size_t, 4> seen{};
    for (int i = 0; i < 40000; ++i) {
        const bool single = i % 2 == 0;
        const int range = i % 3 == 0 ? 0 : i % 3 == 1 ? 4 : 40;
        const Written written{.single = single, .digits = 0, .lowest = 0};
        StraightPlace place;
        if (i % 5 < 3) {
            place = middle(number(range, single), number(range, single));
        } else {
            for (const int times : i % 5 == 3 ? std::vector{1, 2} : std::vector{1, 1, 2})
                place.add(number(range, single), times);
        }
        double own = exact(place).convert_to<double>();
        for (int step = std::uniform_int_distribution(-2, 2)(random); step != 0; step -= step > 0 ? 1 : -1)
            own = std::nextafter(own, step > 0 ? HUGE_VAL : -HUGE_VAL);
        if (single) {
            auto rounded = static_cast<float>(own);
            if (i % 7 == 0) rounded = std::nextafter(rounded, HUGE_VALF);
            own = rounded;
        }
        const Straight found = straightness(own, place, written);
        ASSERT_EQ(found, expected(own, place, single)) << i;
        ++seen[static_cast<std::size_t>(found)];
    }
    for (const std::size_t count : seen) EXPECT_GT(count, 1000U);
}

TEST(StraightNodes, ExtremeNumbers) {
    const double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
    const Written no{};
    EXPECT_EQ(straightness(most, middle(most, most), no), Straight::exactly);
    EXPECT_EQ(straightness(0, middle(most, -most), no), Straight::exactly);
    EXPECT_EQ(straightness(std::nextafter(most, 0), middle(most, most), no), Straight::no);
    EXPECT_EQ(straightness(2 * least, middle(least, 2 * least), no), Straight::rounded);
    EXPECT_EQ(straightness(least, middle(least, 2 * least), no), Straight::rounded);
    EXPECT_EQ(straightness(3 * least, middle(least, 2 * least), no), Straight::no);
    EXPECT_EQ(straightness(0.5, middle(1, least), no), Straight::rounded);
    EXPECT_EQ(straightness(0.5, middle(0, 1), no), Straight::exactly);
}

// Coordinates are whole numbers over a power of ten, as a text has them: whole numbers tell what is half a unit.
TEST(StraightNodes, DecimalNumbersOfAText) {
    std::mt19937_64 random(2);
    for (const int places : {0, 3, 6, 9}) {
        for (const std::int64_t limit : {std::int64_t{99999}, std::int64_t{9999999}}) {
            std::array<std::size_t, 4> seen{};
            for (int i = 0; i < 3000; ++i) {
                const auto any = [&] { return std::uniform_int_distribution<std::int64_t>(-limit, limit)(random); };
                const auto read = [&](std::int64_t n) {
                    return std::strtod((std::to_string(n) + "e-" + std::to_string(places)).c_str(), nullptr);
                };
                const std::int64_t a = any(), b = any(), m = (a + b) / 2 + std::uniform_int_distribution(-2, 2)(random);
                const Written written = how_written(std::vector{read(a), read(b), read(m), read(limit), read(1)});
                ASSERT_EQ(written.lowest, -places);
                const Straight found = straightness(read(m), middle(read(a), read(b)), written);
                const std::int64_t twice_off = std::abs(a + b - 2 * m);
                // The double of a decimal middle may be the middle of doubles, or one beside it.
                if (twice_off == 0) {
                    EXPECT_NE(found, Straight::no);
                } else {
                    // Together with half a unit of each corner less than a unit.
                    EXPECT_EQ(found, twice_off == 1 ? Straight::written : Straight::no) << a << ' ' << b << ' ' << m;
                }
                ++seen[static_cast<std::size_t>(std::min<std::int64_t>(twice_off, 3))];
            }
            for (const std::size_t count : seen) EXPECT_GT(count, 100U);
        }
    }
}

TEST(StraightNodes, HowCoordinatesWereWritten) {
    const auto written = [](const std::vector<double>& all) { return how_written(all); };
    EXPECT_TRUE(written({0, 1, 0.5, -0.25}).single);
    EXPECT_FALSE(written({0, 0.1}).single);
    EXPECT_TRUE(written({static_cast<double>(0.1F)}).single);
    // Fewer than five digits come from round numbers.
    EXPECT_EQ(written({0, 0.1, 0.1234}).digits, 0);
    EXPECT_EQ(written({0, 0.1, 0.12345}).digits, 5);
    EXPECT_EQ(written({0, 0.1, 0.12345}).lowest, -5);
    EXPECT_EQ(written({1e10, 123456}).digits, 6);
    EXPECT_EQ(written({1e10, 123456}).lowest, 0);
    EXPECT_EQ(written({0.1234567890123456}).digits, 16);
    EXPECT_EQ(written({0.12345, 0.1 + 0.2}).digits, 0);  // 0.30000000000000004
    EXPECT_EQ(written({}).digits, 0);
    // Coordinates that are not finite tell nothing.
    EXPECT_EQ(written({HUGE_VAL, 0.12345}).digits, 5);
}

// The digits of other coordinates tell what 0.5 was: a round number says nothing of itself.
TEST(StraightNodes, RoundNumbersAreAsExactAsTheirMesh) {
    const StraightPlace place = middle(0.4, 0.600002);
    EXPECT_EQ(straightness(0.5, place, {}), Straight::no);
    EXPECT_NE(straightness(0.500001, place, how_written(std::vector{0.4, 0.600002, 0.500001})), Straight::no);
    EXPECT_EQ(straightness(0.5, place, how_written(std::vector{0.4, 0.600002, 0.5})), Straight::no);
    EXPECT_EQ(straightness(0.5, middle(0.4, 0.600001), how_written(std::vector{0.4, 0.600001, 0.5})),
              Straight::written);
    EXPECT_EQ(straightness(0.500001, middle(0.4, 0.600001), how_written(std::vector{0.4, 0.600001, 0.500001})),
              Straight::written);
}

// Middles computed in double from corners that are written apart, as meshers do.
TEST(StraightNodes, MiddlesComputedInDoubleBeforeTheyAreWritten) {
    std::mt19937_64 random(4);
    for (const int digits : {12, 14, 15, 16}) {
        for (int i = 0; i < 20000; ++i) {
            const auto written_as = [&](double x) {
                std::array<char, 32> text{};
                std::snprintf(text.data(), text.size(), "%.*g", digits, x);
                return std::strtod(text.data(), nullptr);
            };
            const double a = std::uniform_real_distribution(-2.0, 2.0)(random);
            const double b = std::uniform_real_distribution(0.1, 1.1)(random), m = written_as((a + b) / 2);
            const Written written{.single = false, .digits = digits, .lowest = -digits - 2};
            ASSERT_NE(straightness(m, middle(written_as(a), written_as(b)), written), Straight::no) << a << ' ' << b;
            const double off = 4 * std::pow(10.0, 1 - digits);
            ASSERT_EQ(straightness(written_as(m + off), middle(written_as(a), written_as(b)), written), Straight::no);
        }
    }
}

// Numbers as %.6g writes them: a corner of 1 and more has a unit ten times that of a middle below 1.
TEST(StraightNodes, CornersRoundedToLargerUnitsThanTheMiddle) {
    std::mt19937_64 random(3);
    std::size_t beyond_half = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto written_as = [](double x) {
            std::array<char, 32> text{};
            std::snprintf(text.data(), text.size(), "%.6g", x);
            return std::strtod(text.data(), nullptr);
        };
        const double a = std::uniform_real_distribution(-0.9, -0.1)(random);
        const double b = std::uniform_real_distribution(1.0, 1.9)(random), m = written_as((a + b) / 2);
        const StraightPlace place = middle(written_as(a), written_as(b));
        const Written written = how_written(std::vector{0.123456, 1.23456, place.corners[0], place.corners[1], m});
        ASSERT_EQ(written.digits, 6);
        ASSERT_NE(straightness(m, place, written), Straight::no) << i;
        const double off = std::abs(m - (place.corners[0] + place.corners[1]) / 2);
        beyond_half += off > 0.6e-6 ? 1 : 0;
        ASSERT_EQ(straightness(m + (m > 0 ? 1e-5 : -1e-5), place, written), Straight::no);
    }
    EXPECT_GT(beyond_half, 1000U);
}

}  // namespace
}  // namespace barycert::mesh
