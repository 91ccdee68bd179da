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

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/vectors.hpp"
#include "mesh/locate/near_feature.hpp"

namespace barycert::locate {

using Real = long double;
using Real3 = base::Vector3<Real>;
using base::dot;

inline Real3 minus(const Point3& x, const Point3& y) {
    return {static_cast<Real>(x[0]) - y[0], static_cast<Real>(x[1]) - y[1], static_cast<Real>(x[2]) - y[2]};
}

inline constexpr Real roundings = 16 * 0x1p-52L;
/// More than what vanishes in a few products. Not the least subnormal, with which processors are a hundred times
/// slower.
inline constexpr Real min = std::numeric_limits<Real>::min();

/// A sum of products of two factors an axis, each with its size.
struct Estimate {
    Real value = 0, error = 0;

    void add(Real x, Real size_x, Real y, Real size_y) {
        value += x * y;
        if (size_x > 0) error += size_x * size_y * roundings + min;
    }
    Real low() const { return value - error; }
    Real high() const { return value + error; }
};

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
            reach[k] = std::abs(d) + std::abs(from[k]);
        }
    }
};

/// |p - x|^2 - |p - o|^2, of the places as they are: corner plus offset, exactly. Zero without error if they are the
/// same corner.
inline Estimate farther(const NearPlace& x, const NearPlace& o) {
    Estimate sum;
    for (std::size_t k = 0; k < 3; ++k) {
        const Real d = static_cast<Real>(x.corner[k]) - o.corner[k];
        sum.add(d + (x.offset[k] - o.offset[k]), std::abs(d) + std::abs(x.offset[k]) + std::abs(o.offset[k]),
                x.away[k] + o.away[k], x.reach[k] + o.reach[k]);
    }
    return sum;
}

/// A place near the projection of p on a feature, and how far the two squares of distances can differ.
struct NearBest {
    NearPlace place;
    Real slack = 0;

    NearBest() = default;
    /// Weights are rounded once each, to nearest or by the least double if they vanish, so the place is off by at most
    /// 5 u sum w_i |e_i|, a rounding each of weight, edge, product and two of sums, and 2^-1074 sum |e_i|. As much in
    /// the square of the distance as (x - o).((x - p) + (o - p)) says. An axis on which all corners agree is not off.
    NearBest(const Point3& p, const NearFeature& f) {
        const std::array<double, 3> weights = weights_of(p, f);
        Real3 offset{}, size{}, span{};
        for (std::size_t i = 1; i < static_cast<std::size_t>(f.count); ++i) {
            const Real3 e = minus(f.at[i], f.at[0]);
            for (std::size_t k = 0; k < 3; ++k) {
                offset[k] += weights[i] * e[k];
                size[k] += std::abs(weights[i] * e[k]);
                span[k] += std::abs(e[k]);
            }
        }
        place = NearPlace(p, f.at[0], offset);
        for (std::size_t k = 0; k < 3; ++k) {
            if (span[k] == 0) continue;
            const Real off = roundings * size[k] + 4 * (0x1p-1074L * span[k] + min);
            slack += off * (2 * place.reach[k] + off) + min;
        }
    }
};

/// The vertex, edge or face whose computed projection is nearest, by squares of distances less that of corner 0. It may
/// be any for flat cells: a guess.
class Guess {
public:
    Guess(const NearCell& cell, const Point3& p) : cell_(cell), n_(static_cast<std::size_t>(cell.count)) {
        for (std::size_t i = 0; i < n_; ++i) {
            const Real3 e = minus(cell.at[i], cell.at[0]);
            away_[i] = minus(p, cell.at[i]);
            height_[i] = dot(e, e) - 2 * dot(e, away_[0]);
            take(height_[i], 1U << i, i, {});
        }
        for (std::size_t i = 0; i < n_; ++i) {
            for (std::size_t j = i + 1; j < n_; ++j) {
                try_edge(i, j);
                for (std::size_t k = j + 1; k < n_ && (n_ == 4 || cell.in_space); ++k) try_face(i, j, k);
            }
        }
    }

    unsigned mask = 0;
    std::size_t corner = 0;
    Real3 offset{};

private:
    void take(Real height, unsigned of, std::size_t i, const Real3& from) {
        if (mask != 0 && !(height < best_)) return;
        best_ = height;
        mask = of;
        corner = i;
        offset = from;
    }

    void try_edge(std::size_t i, std::size_t j) {
        const Real3 e = minus(cell_.at[j], cell_.at[i]);
        const Real t = dot(away_[i], e), square = dot(e, e);
        if (!(t > 0 && t < square)) return;
        const Real share = t / square;
        take(height_[i] - t * share, 1U << i | 1U << j, i, {share * e[0], share * e[1], share * e[2]});
    }

    void try_face(std::size_t i, std::size_t j, std::size_t k) {
        const Real3 e = minus(cell_.at[j], cell_.at[i]), f = minus(cell_.at[k], cell_.at[i]);
        const Real ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), we = dot(away_[i], e), wf = dot(away_[i], f);
        const Real det = ee * ff - ef * ef;
        Real beta = we * ff - wf * ef, gamma = wf * ee - we * ef;
        if (!(beta > 0 && gamma > 0 && beta + gamma < det)) return;
        beta /= det;
        gamma /= det;
        take(height_[i] - (beta * we + gamma * wf), 1U << i | 1U << j | 1U << k, i,
             {beta * e[0] + gamma * f[0], beta * e[1] + gamma * f[1], beta * e[2] + gamma * f[2]});
    }

    const NearCell& cell_;
    std::size_t n_;
    std::array<Real3, 4> away_{};  ///< p less the corner
    std::array<Real, 4> height_{};
    Real best_ = 0;
};

/// A guess of the feature of the cell that is nearest to p, a place of it, and a bound: no point of the cell is nearer
/// to p than by |p - place|^2 - `gap`, in squares. For with y = p - place and any x of the cell
///   |p - x|^2 >= |y|^2 - 2 y.(x - place), where a product is largest at a corner.
struct NearGuess {
    unsigned mask = 0;
    NearPlace place;
    Real gap = 0;
};
inline NearGuess guess_nearest(const NearCell& cell, const Point3& p) {
    const Guess found(cell, p);
    NearGuess guess{found.mask, NearPlace(p, cell.at[found.corner], found.offset), 0};
    for (std::size_t i = 0; i < static_cast<std::size_t>(cell.count); ++i) {
        Estimate sum;  // y.(x - place)
        for (std::size_t k = 0; k < 3; ++k) {
            const Real d = static_cast<Real>(cell.at[i][k]) - guess.place.corner[k];
            sum.add(guess.place.offset[k] - d, std::abs(d) + std::abs(guess.place.offset[k]), guess.place.away[k],
                    guess.place.reach[k]);
        }
        const Real max = sum.high();
        if (!(max <= 0)) guess.gap = std::max(guess.gap, 2 * max);
        if (std::isnan(max)) guess.gap = max;
    }
    return guess;
}

}  // namespace barycert::locate
