/// Which bins a cell may touch.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

// A clear bit must be a proof.
//
// Let t(x) = (x / 2 - half_low) * scale, with the doubles of the quantizer and exact arithmetic, and u = t * 2^-shift,
// so that bin b of an axis is about b <= u < b + 1. For x in the box the quantizer rounds the difference and the
// product: t <= 2^31 is off by less than 2^-20, hence u by less than 2^-30, as shift >= 11. (Where halving x
// underflows, that is nothing beside half the length of the box, at least 2^-900 here.) The clamp at `max` moves t no
// further. Cutting off t and then its last bits is cutting off u. So a point whose bin is b has b - 2^-30 <= u <= b + 1
// + 2^-30, and the computed u of the corners of cells are off by as much.
//
// u is affine in x: a point of a closed cell has its u in the hull of those of the corners. A half-space that holds the
// computed corners holds the exact ones once it is moved outward by 2^-30 a coordinate. If it then misses the box of a
// bin, moved outward by as much, no point of the cell is in that bin. The half-spaces are those of the cell's box and
// of its facets. `margin` is for all these, and for the roundings of the box.
//
// What is rounded in the equation of a facet: coordinates are relative to the lowest bin of the cell (off by a further
// 2^-30), so that all are at most E_k + 2 on axis k, E_k the extent of the cell. The equation is a sum of at most 12
// products of such numbers, each with at most 10 roundings: it is off by less than 12 * 10 * 2 * 2^-53 P, P = prod (E_k
// + 2). `slack` is 2^-40 P. A facet whose opposite corner is not clearly on one side bounds nothing.

namespace barycert::locate {

/// A cell in bins, relative to the lowest one, and the half-spaces of its facets.
template <std::size_t d>
struct BinnedCell {
    static constexpr double margin = 0x1p-10;
    static constexpr double min_half = 0x1p-900;  ///< half the length of the box, on each axis

    std::array<std::array<double, d>, d + 1> corner;
    std::array<int, d> low, count;  ///< bins that its box touches

    struct HalfSpace {
        std::array<double, d> normal;  ///< inward
        double constant;
        double inverse;  ///< of normal[0]; zero if that is too small to bound anything along a row
        /// The greatest of normal.(u - a) over the bins of a row is normal[0] * column + rest.
        double rest(const std::array<int, d>& row) const {
            double sum = constant;
            for (std::size_t k = 1; k < d; ++k) sum += normal[k] * row[k];
            return sum;
        }
    };
    std::array<HalfSpace, d + 1> facet;
    std::size_t facets = 0;

    /// `corner` in bins; `bins`: how many there are on each axis.
    void set(const std::array<int, d>& bins, bool with_facets) {
        double product = 1;
        for (std::size_t k = 0; k < d; ++k) {
            double least = corner[0][k], most = least;
            for (const auto& c : corner) {
                least = std::min(least, c[k]);
                most = std::max(most, c[k]);
            }
            low[k] = std::clamp(static_cast<int>(std::floor(least - margin)), 0, bins[k] - 1);
            count[k] = std::clamp(static_cast<int>(std::floor(most + margin)), 0, bins[k] - 1) - low[k] + 1;
            for (auto& c : corner) c[k] -= low[k];
            product *= most - least + 2;
        }
        facets = 0;
        if (with_facets) set_facets(0x1p-40 * product);
    }

    void set_facets(double slack) {
        for (std::size_t i = 0; i <= d; ++i) {
            const auto &a = corner[(i + 1) % (d + 1)], &b = corner[(i + 2) % (d + 1)];
            std::array<double, d> n;
            if constexpr (d == 2) {
                n = {a[1] - b[1], b[0] - a[0]};
            } else {
                const auto& c = corner[(i + 3) % (d + 1)];
                const double x[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
                const double y[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
                n = {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
            }
            double side = 0;
            for (std::size_t k = 0; k < d; ++k) side += n[k] * (corner[i][k] - a[k]);
            if (!(std::abs(side) > slack)) continue;
            HalfSpace& h = facet[facets++];
            h.constant = slack;
            for (std::size_t k = 0; k < d; ++k) {
                h.normal[k] = side > 0 ? n[k] : -n[k];
                h.constant += h.normal[k] * (0.5 - a[k]) + (0.5 + margin) * std::abs(n[k]);
            }
            // Below 2^-100, times less than 2^21, it is far below the slack.
            h.inverse = std::abs(n[0]) > 0x1p-100 ? 1 / h.normal[0] : 0;
        }
    }

    /// use(first, last) for the bins of a row that the cell may touch, if there are any: columns relative to low[0].
    /// A column is bounded by -rest / normal[0]. Where that is one of the columns, it is off by less than the margin;
    /// where it is not, it is on the right side of them.
    template <class Use>
    void columns(const std::array<int, d>& row, Use use) const {
        double from = 0, to = count[0] - 1;
        for (std::size_t i = 0; i < facets; ++i) {
            const double rest = facet[i].rest(row), inverse = facet[i].inverse, zero = -rest * inverse;
            if (inverse > 0) {
                from = std::max(from, zero - margin);
            } else if (inverse < 0) {
                to = std::min(to, zero + margin);
            } else if (rest < 0) {
                return;
            }
        }
        if (!(from <= to)) return;
        const int first = static_cast<int>(std::ceil(from)), last = static_cast<int>(std::floor(to));
        if (first <= last) use(first, last);
    }
};

}  // namespace barycert::locate
