// Internal: cells of a grid's mesh, a vector of them at a time: their boxes in points of the grid, and their weights.
//
// u = 2^-53, rounding to nearest. As in gradient-inl.hpp: o the last vertex, e_j = fl(v_j - o), X_k their extents,
// a_k = G / X_k, K = G / |d|, n_j the normals, inv = fl(1/d); the cell is not degenerate and K <= 2^36.
//
// Weight j < last of a point p in the cell's box, w = fl(p - o), is l_j = sum_k S_jk w_k with S_jk = fl(n_jk inv); the
// last is 1 + sum_k S_k w_k with S = -sum_j S_j. As |w_k| <= X_k there, refinement-inl.hpp bounds the error of l_j by
// u B(w)/|d| (98.1 K + 21) 1.002, and B(w)/|d| <= 3 K: 296 K^2 + 64 K, with the rounding of the difference w (2.0001 u
// B(w)/|d|) below u (300 K^2 + 75 K). Of the last weight: three times that, and three roundings of sums of numbers that
// are below 3 * 3 K: u (900 K^2 + 300 K + 2). E = u (1000 K^2 + 400 K + 8) bounds all of them, however the sums are
// arranged, and also where nothing is rounded but S.
//
// Included once per SIMD target.
#if defined(BARYCERT_SAMPLE_FILL_BLOCK_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_SAMPLE_FILL_BLOCK_INL_HPP
#undef BARYCERT_SAMPLE_FILL_BLOCK_INL_HPP
#else
#define BARYCERT_SAMPLE_FILL_BLOCK_INL_HPP
#endif

#include <algorithm>
#include <cstdint>
#include <vector>

#include "barycert/core/gradient-inl.hpp"
#include "barycert/core/lane_loop-inl.hpp"
#include "barycert/sample/grid/raster_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;

using sample::Raster;

constexpr std::size_t max_lanes = 8;

struct PlaceRange {
    std::int32_t first, last;
};

/// By cell of a block: its last vertex, and the places along each axis that its box holds.
template <int d>
struct CellBlock {
    HWY_ALIGN double origin[d][max_lanes];
    HWY_ALIGN std::int32_t first[d][max_lanes], last[d][max_lanes];

    PlaceRange places(int k, std::size_t l) const { return {first[k][l], last[k][l]}; }
};

/// The weights of points in the boxes: constant + sum_k slope_k (p_k - o_k), up to `error`, where valid.
template <int d, class D>
struct CellWeights {
    hn::Vec<D> constant[d + 1], slope[d + 1][d], error;
    hn::Mask<D> valid;
};

template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE void set_weights(D tag, const CellMatrix<d, D>& m, const V (&extent)[d], CellWeights<d, D>& out) {
    constexpr double u = 0x1p-53;
    const V condition = m.reach[0] * extent[0];
    out.error =
        hn::Set(tag, 1000 * u) * condition * condition + hn::Set(tag, 400 * u) * condition + hn::Set(tag, 8 * u);
    for (int j = 0; j < d; ++j) {
        out.constant[j] = hn::Zero(tag);
        for (int k = 0; k < d; ++k) {
            const V slope = m.normal[j][k] * m.inverse;
            out.slope[j][k] = slope;
            out.slope[d][k] = j == 0 ? hn::Neg(slope) : out.slope[d][k] - slope;
        }
    }
    out.constant[d] = hn::Set(tag, 1);
    out.valid = hn::And(m.valid, hn::Le(out.error, hn::Set(tag, 0x1p-9)));
}

/// The places of an axis within [low, high], from guesses that are off by one at most.
HWY_INLINE PlaceRange places_between(const std::vector<double>& at, double first, double last, double low,
                                     double high) {
    const auto size = static_cast<std::int32_t>(at.size());
    const auto x = [&](std::int32_t i) { return at[static_cast<std::size_t>(i)]; };
    auto i = static_cast<std::int32_t>(first), j = static_cast<std::int32_t>(last);
    i -= i > 0 && x(i - 1) >= low ? 1 : 0;
    i += i < size && x(i) < low ? 1 : 0;
    j -= j > 0 && x(j - 1) > high ? 1 : 0;
    j += j < size && x(j) <= high ? 1 : 0;
    return {i, j};
}

/// Sets origin, first and last; these within layers [layers.first, layers.last) of the last axis. Where an end of a box
/// lies near a place of the grid, the coordinate of that is looked at; elsewhere the rounding of places does not
/// matter.
template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE void set_places(D tag, const Raster& raster, PlaceRange layers, const V (&v)[d + 1][d], CellBlock<d>& out) {
    const hn::Rebind<std::int32_t, D> whole;
    for (std::size_t k = 0; k < d; ++k) {
        const std::vector<double>& at = raster.at[k];
        V low = v[0][k], high = v[0][k];
        for (int i = 1; i <= d; ++i) {
            low = hn::Min(low, v[i][k]);
            high = hn::Max(high, v[i][k]);
        }
        const PlaceRange all = k + 1 == d ? layers : PlaceRange{0, static_cast<std::int32_t>(at.size())};
        const V origin = hn::Set(tag, raster.origin[k]), scale = hn::Set(tag, raster.scale[k]);
        const V from = (low - origin) * scale, to = (high - origin) * scale;
        const V min = hn::Set(tag, all.first), max = hn::Set(tag, all.last);
        const auto clamp = [&](V x) HWY_ATTR { return hn::Min(hn::Max(x, min), max); };
        const V first = hn::Ceil(from), last = hn::Floor(to) + hn::Set(tag, 1);
        hn::Store(v[d][k], tag, out.origin[k]);
        hn::Store(hn::DemoteTo(whole, clamp(first)), whole, out.first[k]);
        hn::Store(hn::DemoteTo(whole, clamp(last)), whole, out.last[k]);
        const V slack = hn::Set(tag, raster.slack);
        const auto near =
            hn::Or(hn::Le(hn::Abs(from - hn::Round(from)), slack), hn::Le(hn::Abs(to - hn::Round(to)), slack));
        if (HWY_LIKELY(hn::AllFalse(tag, near))) continue;
        HWY_ALIGN double lows[max_lanes], highs[max_lanes], firsts[max_lanes], lasts[max_lanes];
        hn::Store(low, tag, lows);
        hn::Store(high, tag, highs);
        const V size = hn::Set(tag, static_cast<double>(at.size()));
        hn::Store(hn::Min(hn::Max(first, hn::Zero(tag)), size), tag, firsts);
        hn::Store(hn::Min(hn::Max(last, hn::Zero(tag)), size), tag, lasts);
        for (std::size_t l = 0; l < hn::MaxLanes(D()); ++l) {
            const PlaceRange r = places_between(at, firsts[l], lasts[l], lows[l], highs[l]);
            out.first[k][l] = std::clamp(r.first, all.first, all.last);
            out.last[k][l] = std::clamp(r.last, all.first, all.last);
        }
    }
}

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
