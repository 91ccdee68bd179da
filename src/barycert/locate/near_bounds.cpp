#include "barycert/locate/near_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace barycert::locate {
namespace {

Real3 minus(const Point3& x, const Point3& y) {
    return {static_cast<Real>(x[0]) - y[0], static_cast<Real>(x[1]) - y[1], static_cast<Real>(x[2]) - y[2]};
}
Real dot(const Real3& x, const Real3& y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

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
                for (std::size_t k = j + 1; k < n_ && n_ == 4; ++k) try_face(i, j, k);
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

}  // namespace

NearGuess guess_nearest(const NearCell& cell, const Point3& p) {
    const Guess found(cell, p);
    NearGuess guess{found.mask, NearPlace(p, cell.at[found.corner], found.offset), 0};
    for (std::size_t i = 0; i < static_cast<std::size_t>(cell.count); ++i) {
        Products sum;  // y.(x - place)
        for (std::size_t k = 0; k < 3; ++k) {
            const Real d = static_cast<Real>(cell.at[i][k]) - guess.place.corner[k];
            sum.add(guess.place.offset[k] - d, magnitude(d) + magnitude(guess.place.offset[k]), guess.place.away[k],
                    guess.place.reach[k]);
        }
        const Real max = sum.sum().high();
        if (!(max <= 0)) guess.gap = std::max(guess.gap, 2 * max);
        if (std::isnan(max)) guess.gap = max;
    }
    return guess;
}

/// Weights are rounded once each, to nearest or by the least double if they vanish, so the place is off by at most
/// 5 u sum w_i |e_i|, a rounding each of weight, edge, product and two of sums, and 2^-1074 sum |e_i|. As much in the
/// square of the distance as (x - o).((x - p) + (o - p)) says. An axis on which all corners agree is not off.
NearBest::NearBest(const Point3& p, const NearFeature& f) {
    const std::array<double, 3> weights = weights_of(p, f);
    Real3 offset{}, size{}, span{};
    for (std::size_t i = 1; i < static_cast<std::size_t>(f.count); ++i) {
        const Real3 e = minus(f.at[i], f.at[0]);
        for (std::size_t k = 0; k < 3; ++k) {
            offset[k] += weights[i] * e[k];
            size[k] += magnitude(weights[i] * e[k]);
            span[k] += magnitude(e[k]);
        }
    }
    place = NearPlace(p, f.at[0], offset);
    for (std::size_t k = 0; k < 3; ++k) {
        if (span[k] == 0) continue;
        const Real off = roundings * size[k] + 4 * (0x1p-1074L * span[k] + min);
        slack += off * (2 * place.reach[k] + off) + min;
    }
}

}  // namespace barycert::locate
