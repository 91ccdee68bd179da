/// Points for incircle and insphere: exactly on one circle or sphere, an ulp off it, anywhere.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "barycert/predicates.hpp"
#include "tests/audit/exact/cases.hpp"

namespace barycert::testing_spheres {

using testing_cases::Kind;

/// d + 2 points of d coordinates, d = 2 or 3.
struct Points {
    int d;
    std::array<std::array<double, 3>, 5> at{};

    std::size_t count() const { return static_cast<std::size_t>(d) + 2; }
    std::size_t axes() const { return static_cast<std::size_t>(d); }
};

inline Sign ask(const Points& p) {
    const auto& x = p.at;
    return p.d == 2 ? incircle(x[0].data(), x[1].data(), x[2].data(), x[3].data())
                    : insphere(x[0].data(), x[1].data(), x[2].data(), x[3].data(), x[4].data());
}

inline Result<Sign> checked_ask(const Points& p) {
    const auto& x = p.at;
    return p.d == 2 ? checked_incircle(x[0].data(), x[1].data(), x[2].data(), x[3].data())
                    : checked_insphere(x[0].data(), x[1].data(), x[2].data(), x[3].data(), x[4].data());
}

inline std::string describe(const Points& p) {
    std::string text;
    for (std::size_t i = 0; i < p.count(); ++i) {
        for (std::size_t k = 0; k < p.axes(); ++k) text += ' ' + base::hexadecimal(p.at[i][k]);
        text += '\n';
    }
    return text;
}

/// Corners of a box between any two numbers on each axis: exactly on one circle or sphere, whatever the numbers.
inline Points box(base::Random& r, int d, Kind kind) {
    Points p{d};
    for (std::size_t k = 0; k < p.axes(); ++k) {
        const double low = testing_cases::number(r, kind, static_cast<int>(k));
        const double high = testing_cases::number(r, kind, static_cast<int>(k));
        for (auto& x : p.at) x[k] = r.coin() ? low : high;
    }
    return p;
}

/// Integers whose squares add up to 25 or, in space, to 81, off the origin by small integers, in any unit.
inline Points on_integer_sphere(base::Random& r, int d) {
    static constexpr std::array<std::array<int, 3>, 7> seeds{
        {{3, 4, 0}, {5, 0, 0}, {0, 5, 0}, {1, 4, 8}, {4, 4, 7}, {3, 6, 6}, {0, 0, 9}}};
    Points p{d};
    std::array<int, 3> offset{};
    for (int& o : offset) o = r.integer(-20, 20);
    const int shift = r.integer(-60, 60);
    for (auto& x : p.at) {
        auto seed = seeds[d == 2 ? r.below(3) : 3 + r.below(4)];
        const std::size_t turn = d == 2 ? 0 : r.below(3);
        std::rotate(seed.begin(), seed.begin() + static_cast<std::ptrdiff_t>(turn), seed.end());
        for (std::size_t k = 0; k < p.axes(); ++k)
            x[k] = std::ldexp(offset[k] + (r.coin() ? seed[k] : -seed[k]), shift);
    }
    return p;
}

/// Points of a sphere about the origin, or about a centre far away, rounded.
inline Points rounded_sphere(base::Random& r, int d) {
    Points p{d};
    const double offset = r.coin() ? 0 : std::ldexp(r.uniform(-1, 1), r.integer(0, 30));
    for (auto& x : p.at) {
        double square = 0;
        for (std::size_t k = 0; k < p.axes(); ++k) {
            x[k] = r.uniform(-1, 1);
            square += x[k] * x[k];
        }
        for (std::size_t k = 0; k < p.axes(); ++k) x[k] = offset + x[k] / std::sqrt(square);
    }
    return p;
}

/// Axes that differ by powers of two, an ulp more or less in one place, a point twice, or none of these.
inline void disturb(base::Random& r, Points& p) {
    const std::size_t i = r.below(p.count()), j = r.below(p.count()), axis = r.below(p.axes());
    const int shift = r.integer(-20, 20);
    constexpr double max = std::numeric_limits<double>::max();
    switch (r.integer(0, 5)) {
        case 0:
        case 1:
            p.at[i][axis] = std::nextafter(p.at[i][axis], r.coin() ? max : -max);
            break;
        case 2:
            for (auto& x : p.at) {
                const double scaled = std::ldexp(x[axis], shift);
                x[axis] = std::isfinite(scaled) ? scaled : x[axis];
            }
            break;
        case 3:
            p.at[i] = p.at[j];
            break;
        default:
            break;
    }
}

inline constexpr int recipes = 4;

inline Points hard_points(base::Random& r, int d, int recipe, Kind kind) {
    Points p{d};
    if (recipe == 0) {
        for (auto& x : p.at) {
            for (int k = 0; k < d; ++k) x[static_cast<std::size_t>(k)] = testing_cases::number(r, kind, k);
        }
    }
    if (recipe == 1) p = box(r, d, kind);
    if (recipe == 2) p = on_integer_sphere(r, d);
    if (recipe == 3) p = rounded_sphere(r, d);
    disturb(r, p);
    return p;
}

/// Calls use(points) for `count` cases of each recipe and kind.
template <class Use>
void for_hard_points(const char* stream, std::uint64_t count, Use use) {
    for (const int d : {2, 3}) {
        for (int recipe = 0; recipe < recipes; ++recipe) {
            for (const Kind kind : testing_cases::all_kinds) {
                for (std::uint64_t k = 0; k < count && !::testing::Test::HasFailure(); ++k) {
                    base::Random r =
                        base::Random::stream(static_cast<std::uint64_t>(10 * d + recipe), base::hash64(stream), k);
                    use(hard_points(r, d, recipe, kind), r);
                }
            }
        }
    }
}

}  // namespace barycert::testing_spheres
