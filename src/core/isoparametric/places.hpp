/// Coordinates of the nodes of a cell: scaled, rational, whole.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/isoparametric/ball.hpp"
#include "core/isoparametric/inverse.hpp"
#include "core/shape_functions.hpp"
#include "core/whole_points.hpp"

namespace barycert::core::isoparametric {

template <class T>
using Vector = std::array<T, 3>;

inline double rounded(const Rational& x) {
    using boost::multiprecision::cpp_int;
    const cpp_int n = numerator(x), d = denominator(x);
    return rounded_quotient(n, d, 0);
}

/// Exponent e so that x is below 2^e.
inline int exponent_above(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return exponent;
}

/// The largest coordinate of places, without its sign.
inline double largest(const Reference& of, const Places& places) {
    double most = 0;
    for (std::size_t i = 0; i < of.nodes; ++i) {
        for (std::size_t k = 0; k < of.dimension(); ++k) {
            most = std::max(most, std::abs(places.at[i][k]));
            if (places.other[i] != nullptr) most = std::max(most, std::abs(places.other[i][k]));
        }
    }
    return most;
}

/// A power of two by which coordinates are below 1, but for the largest doubles.
inline double scale_of(const Reference& of, const Places& places) {
    return std::ldexp(1.0, std::clamp(-exponent_above(largest(of, places)), -1020, 1020));
}

/// Where a node is.
inline Rational exact_place(const Places& places, std::size_t node, std::size_t axis) {
    const Rational x(places.at[node][axis]);
    return places.other[node] == nullptr ? x : Rational((x + Rational(places.other[node][axis])) / 2);
}

/// Where nodes are, times one power of two: whole numbers.
class WholePlaces {
public:
    WholePlaces(const Reference& of, const Places& places) : places_(places), lowest_(2000) {
        for (std::size_t i = 0; i < of.nodes; ++i) {
            for (std::size_t k = 0; k < of.dimension(); ++k) {
                lowest_ = std::min(lowest_, last_bit(places.at[i][k]));
                if (places.other[i] != nullptr) lowest_ = std::min(lowest_, last_bit(places.other[i][k]));
            }
        }
    }
    Whole operator()(std::size_t node, std::size_t axis) const {
        const Whole x = whole(places_.at[node][axis]);
        return x + (places_.other[node] == nullptr ? x : whole(places_.other[node][axis]));
    }

private:
    static int last_bit(double x) { return x == 0 ? 2000 : exponent_above(std::abs(x)) - 53; }
    Whole whole(double x) const {
        if (x == 0) return 0;
        const int last = last_bit(x);
        return Whole(static_cast<std::int64_t>(std::ldexp(x, -last))) << static_cast<unsigned>(last - lowest_);
    }

    const Places& places_;
    int lowest_;  ///< exponent of the last bit of any
};

}  // namespace barycert::core::isoparametric
