/// Which of two places is nearer to a far or near point? In floating point, with a bound of the error.
///
/// For places x and o and a point p
///   |p - x|^2 - |p - o|^2 = (x - o).((x - p) + (o - p)),
/// in which p's own size, however large, stands in the second factor alone and an axis on which x and o agree counts
/// for nothing. The squares themselves would all round to the same number when p is far.
///
/// Errors. Let u = 2^-52, which no rounding mode exceeds. Places are sums of a corner and an offset, x = a + s, and
/// `reach` is |a - p| + |s|, axis by axis. A first factor takes three roundings of numbers below size = |a - a'| + |s|
/// + |s'|, so is off by at most 3 u size; a second one takes five of numbers below the sum of both reaches, 5 u of
/// that; product and sum of three add 4 u. So 12 u and terms of u^2: 16 u sum size (reach + reach') bounds it, itself
/// rounded. Numbers are long double for its range alone (x86: products of four doubles neither overflow nor vanish);
/// where it is no wider than double, infinity and NaN prove nothing, and what vanishes is below the least number, which
/// is added.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "barycert/locate/near_feature.hpp"

namespace barycert::locate {

using Real = long double;
using Real3 = std::array<Real, 3>;

struct Estimate {
    Real value = 0, error = 0;
    Real low() const { return value - error; }
    Real high() const { return value + error; }
};

inline constexpr Real roundings = 16 * 0x1p-52L;
/// More than what vanishes in a few products. Not the least subnormal, with which processors are a hundred times
/// slower.
inline constexpr Real min = std::numeric_limits<Real>::min();

/// A sum of products of two factors an axis, each with its size.
class Products {
public:
    void add(Real x, Real size_x, Real y, Real size_y) {
        sum_.value += x * y;
        if (size_x > 0) sum_.error += size_x * size_y * roundings + min;
    }
    Estimate sum() const { return sum_; }

private:
    Estimate sum_;
};

constexpr Real magnitude(Real x) {
    return x < 0 ? -x : x;
}

/// A place and where it lies from p.
struct NearPlace {
    Point3 corner{};
    Real3 offset{};  ///< of the place from the corner
    Real3 away{};    ///< the place less p
    Real3 reach{};   ///< |corner - p| + |offset|

    NearPlace() = default;
    NearPlace(const Point3& p, const Point3& at, const Real3& from) : corner(at), offset(from) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Real d = static_cast<Real>(at[k]) - p[k];
            away[k] = d + from[k];
            reach[k] = magnitude(d) + magnitude(from[k]);
        }
    }
};

/// |p - x|^2 - |p - o|^2, of the places as they are: corner plus offset, exactly. Zero without error if they are the
/// same corner.
inline Estimate farther(const NearPlace& x, const NearPlace& o) {
    Products sum;
    for (std::size_t k = 0; k < 3; ++k) {
        const Real d = static_cast<Real>(x.corner[k]) - o.corner[k];
        sum.add(d + (x.offset[k] - o.offset[k]), magnitude(d) + magnitude(x.offset[k]) + magnitude(o.offset[k]),
                x.away[k] + o.away[k], x.reach[k] + o.reach[k]);
    }
    return sum.sum();
}

/// A place near the projection of p on a feature, and how far the two squares of distances can differ.
struct NearBest {
    NearPlace place;
    Real slack = 0;

    NearBest() = default;
    NearBest(const Point3& p, const NearFeature& f);
};

/// What is likely the feature of the cell nearest to p, a place of it, and a bound: no point of the cell is nearer to p
/// than by |p - place|^2 - `gap`, in squares. For with y = p - place and any x of the cell
///   |p - x|^2 >= |y|^2 - 2 y.(x - place), where a product is largest at a corner.
struct NearGuess {
    unsigned mask = 0;
    NearPlace place;
    Real gap = 0;
};
NearGuess guess_nearest(const NearCell& cell, const Point3& p);

}  // namespace barycert::locate
