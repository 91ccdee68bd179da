/// CGAL's rationals for the judges of this folder.
#pragma once

#include <CGAL/Gmpq.h>

#include <cmath>

namespace barycert {

using Rational = CGAL::Gmpq;

inline Rational magnitude(const Rational& x) {
    return x < Rational(0) ? -x : x;
}

/// x is the double nearest to the exact number, ties to even. Requires: the exact number is below 2^1023.
inline bool is_nearest(double x, const Rational& exact) {
    if (!std::isfinite(x)) return false;
    const double below = std::nextafter(x, -HUGE_VAL), above = std::nextafter(x, HUGE_VAL);
    const Rational error = magnitude(Rational(x) - exact);
    bool even_wins = false;
    for (const double other : {below, above}) {
        if (!std::isfinite(other)) continue;
        const Rational other_error = magnitude(Rational(other) - exact);
        if (other_error < error) return false;
        even_wins = even_wins || other_error == error;
    }
    if (!even_wins) return true;
    int exponent = 0;  // of two neighbours one has an even significand
    const double significand = std::frexp(x, &exponent);
    return std::fmod(std::ldexp(std::fabs(significand), 53), 2) == 0;
}

}  // namespace barycert
