// Internal: cells of a grid's mesh, a vector of them at a time: their boxes in points of the grid, and their weights.
//
// u = 2^-53, rounding to nearest. As in gradient-inl.hpp: o the last vertex, e_j = fl(v_j - o), X_k their extents,
// a_k = G / X_k, K = G / |d|, n_j the normals, inv = fl(1/d); the cell is not degenerate and K <= 2^36.
//
// Weight j < last of a point p in the cell's box, w = fl(p - o), is l_j = sum_k S_jk w_k with S_jk = fl(n_jk inv); the
// last is 1 + sum_k S_k w_k with S = -sum_j S_j. As |w_k| <= X_k there, refinement-inl.hpp bounds the error of l_j by
// u B(w)/|d| (98.1 K + 21) 1.002, and B(w)/|d| <= 3 K: 296 K^2 + 64 K, with the rounding of the difference w (2.0001 u
// B(w)/|d|) below u (300 K^2 + 75 K). For the last weight: three times that, and three roundings of sums of numbers
// that are below 3 * 3 K: u (900 K^2 + 300 K + 2). E = u (1000 K^2 + 400 K + 8) bounds all of them, however the sums
// are arranged, and also where nothing is rounded but S.
//
// Included once per SIMD target.
#if defined(BARYCERT_SAMPLE_FILL_BOX_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_SAMPLE_FILL_BOX_INL_HPP
#undef BARYCERT_SAMPLE_FILL_BOX_INL_HPP
#else
#define BARYCERT_SAMPLE_FILL_BOX_INL_HPP
#endif

#include "core/gradient-inl.hpp"
#include "core/lane_loop-inl.hpp"
#include "mesh/sample/grid/fill_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;

using sample::Raster;

constexpr std::size_t max_lanes = 8;

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
/// lies near a place of the grid, the coordinate of that is looked at; elsewhere rounding of places is no matter.
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

// Cells whose boxes hold few points of the grid: all of these are looked at, in single precision.
//
// Notation as above; v = 2^-24. Let f be the first point of the box by the spacing h, place by place
// fl(origin + first h), and w' = fl(f - o); point n = (n_0, ...) of the box, n_k < N_k, has the coordinates f_k + n_k
// h_k + d_k. `slack` bounds |d_k| / h_k, the roundings of f and w' included, many times over (Raster). With L
// the function constant + sum_k S_k (x_k - o_k), without roundings, weight l of the point is L up to E, and so
//     l = A + sum_k B_k n_k    up to 2 E + 1.01 slack sum_k |B_k|,    A = L(w') as computed, B_k = fl(S_k h_k):
// A is rounded six times at most, in sums of numbers below 9.1 K, which is less than E; B_k once, by u |B_k| n_k, of
// which the sum is far less than v M below. In single precision, M = |A| + sum_k |B_k| (N_k - 1): A is rounded once and
// goes through three sums; B_k is rounded once, as is its product with the small integer n_k, and goes through three
// sums or fewer. That is at most 5.01 v M. (Underflow, by 2^-149 each, is less than E.) So the bound
//     6 v M + 3 E + 2 slack sum_k |B_k|
// also covers its own evaluation and its rounding to single precision. A weight beyond it is positive; one below minus
// it is negative.

/// Points along each axis of a box at most; places in it are numbered by three bits an axis.
constexpr int box_bits = 3;
constexpr std::int32_t box_side = 1 << box_bits;
static_assert(box_side == max_lanes);

using BoxTag = hn::ScalableTag<float>;
constexpr std::size_t box_lanes = hn::MaxLanes(BoxTag());

/// By number of columns less one: columns and rows of the points on the lanes, as many whole rows as there is room for.
struct BoxPattern {
    HWY_ALIGN float column[box_lanes], row[box_lanes];
    HWY_ALIGN std::int32_t place[box_lanes];
    std::int32_t rows;
};
constexpr std::int32_t box_columns = std::min<std::int32_t>(box_side, box_lanes);
constexpr std::array<BoxPattern, box_side> make_box_patterns() {
    std::array<BoxPattern, box_side> all{};
    for (std::size_t columns = 1; columns <= box_side; ++columns) {
        BoxPattern& p = all[columns - 1];
        for (std::size_t l = 0; l < box_lanes; ++l) {
            const std::size_t column = l % columns, row = l / columns;
            p.column[l] = static_cast<float>(column);
            p.row[l] = static_cast<float>(row);
            p.place[l] = static_cast<std::int32_t>(column + (row << box_bits));
        }
        p.rows = static_cast<std::int32_t>(box_lanes / columns);
    }
    return all;
}
inline constexpr std::array<BoxPattern, box_side> box_patterns = make_box_patterns();

/// By cell of a block: its weights at the points of its box.
template <int d>
struct BoxBlock {
    HWY_ALIGN float first[d + 1][max_lanes], step[d + 1][d][max_lanes], error[max_lanes];
};

/// Returns bits: cells whose boxes are small enough, and whose error is.
template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE std::uint32_t set_boxes(D tag, const Raster& raster, const CellBlock<d>& cell, const CellWeights<d, D>& w,
                                   BoxBlock<d>& out) {
    const hn::Rebind<float, D> single;
    const hn::Rebind<std::int32_t, D> whole;
    V from[d], spacing[d], more[d];  // more: N - 1
    auto small = hn::FirstN(tag, hn::MaxLanes(D()));
    for (int k = 0; k < d; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const V first = hn::PromoteTo(tag, hn::Load(whole, cell.first[k]));
        const V last = hn::PromoteTo(tag, hn::Load(whole, cell.last[k]));
        spacing[k] = hn::Set(tag, raster.spacing[at]);
        more[k] = last - first - hn::Set(tag, 1);
        from[k] = hn::Set(tag, raster.origin[at]) + first * spacing[k] - hn::Load(tag, cell.origin[k]);
        small = hn::And(small, hn::Lt(more[k], hn::Set(tag, k == 0 ? box_columns : box_side)));
    }
    V error = hn::Zero(tag);
    for (int j = 0; j <= d; ++j) {
        V first = w.constant[j], steps = hn::Zero(tag), size = hn::Zero(tag);
        for (int k = 0; k < d; ++k) {
            const V step = w.slope[j][k] * spacing[k];
            first = first + w.slope[j][k] * from[k];
            steps = steps + hn::Abs(step);
            size = size + hn::Abs(step) * more[k];
            hn::Store(hn::DemoteTo(single, step), single, out.step[j][k]);
        }
        hn::Store(hn::DemoteTo(single, first), single, out.first[j]);
        error = hn::Max(error,
                        hn::Set(tag, 6 * 0x1p-24) * (hn::Abs(first) + size) + hn::Set(tag, 2 * raster.slack) * steps);
    }
    error = error + hn::Set(tag, 3) * w.error;
    hn::Store(hn::DemoteTo(single, error), single, out.error);
    return mask_bits(tag, hn::And(small, hn::Le(error, hn::Set(tag, 0x1p-7))));
}

/// Points of a box at most.
constexpr std::size_t box_points = box_side * box_side * box_side;

/// Places column + (row << box_bits) + (layer << 2 box_bits) of a box; there is room for box_lanes more.
struct BoxPlaces {
    std::int32_t* place;
    std::size_t count = 0;

    template <class D, class V, class M>
    HWY_INLINE void add(D tag, V places, M mask) {
        hn::StoreU(hn::Compress(places, mask), tag, place + count);
        count += hn::CountTrue(tag, mask);
    }
};

/// Calls visit(least weights, their places, first row, layer) for all points of the box of cell l, some vectors of
/// them: of whole rows. Weights on lanes without a point are far below zero.
template <int d, class Visit>
HWY_INLINE void visit_box(const CellBlock<d>& cell, const BoxBlock<d>& box, std::size_t l, Visit visit) {
    const BoxTag tag;
    const hn::RebindToSigned<BoxTag> whole;
    using V = hn::Vec<BoxTag>;
    const std::int32_t columns = cell.last[0][l] - cell.first[0][l], rows = cell.last[1][l] - cell.first[1][l];
    const std::int32_t layers = d == 3 ? cell.last[d - 1][l] - cell.first[d - 1][l] : 1;
    const BoxPattern& pattern = box_patterns[static_cast<std::size_t>(columns - 1)];
    const V column = hn::Load(tag, pattern.column), nowhere = hn::Set(tag, -0x1p100F);
    const auto next_layer = hn::Set(whole, 1 << 2 * box_bits);
    for (std::int32_t from = 0; from < rows; from += pattern.rows) {
        const V row = hn::Load(tag, pattern.row) + hn::Set(tag, static_cast<float>(from));
        V weight[d + 1];
        for (int j = 0; j <= d; ++j)
            weight[j] = hn::MulAdd(hn::Set(tag, box.step[j][1][l]), row,
                                   hn::MulAdd(hn::Set(tag, box.step[j][0][l]), column, hn::Set(tag, box.first[j][l])));
        const auto used = hn::FirstN(tag, static_cast<std::size_t>(std::min(pattern.rows, rows - from) * columns));
        weight[0] = hn::IfThenElse(used, weight[0], nowhere);
        auto place = hn::Load(whole, pattern.place) + hn::Set(whole, from << box_bits);
        V layer = hn::Zero(tag);
        for (std::int32_t n = 0; n < layers; ++n) {
            V min = weight[0];
            if constexpr (d == 3) min = hn::MulAdd(hn::Set(tag, box.step[0][d - 1][l]), layer, weight[0]);
            for (int j = 1; j <= d; ++j) {
                V here = weight[j];
                if constexpr (d == 3) here = hn::MulAdd(hn::Set(tag, box.step[j][d - 1][l]), layer, weight[j]);
                min = hn::Min(min, here);
            }
            visit(min, place, from, n);
            layer = layer + hn::Set(tag, 1.0F);
            place = place + next_layer;
        }
    }
}

/// Where the points of a box go: addresses, for what lies behind the end is fetched too, and bytes to the next row and
/// layer.
struct BoxTarget {
    std::uintptr_t values, owners;
    std::uintptr_t value_line, value_plane, owner_line, owner_plane;

    /// Fetches what most points of a vector are written to: early, as stores do it late, one after the other.
    HWY_INLINE void fetch(std::int32_t row, std::int32_t layer) const {
        const auto r = static_cast<std::uintptr_t>(row), n = static_cast<std::uintptr_t>(layer);
        // NOLINTBEGIN(performance-no-int-to-ptr): nothing is read or written through them
        for (std::uintptr_t i = 0; i < 4; ++i) {
            __builtin_prefetch(reinterpret_cast<const void*>(values + (r + i) * value_line + n * value_plane), 1);
            __builtin_prefetch(reinterpret_cast<const void*>(owners + (r + i) * owner_line + n * owner_plane), 1);
        }
        // NOLINTEND(performance-no-int-to-ptr)
    }
};

/// Adds the points of the box that are certainly in the interior. False if there are some of which it is open.
template <int d>
HWY_INLINE bool find_box_points(const CellBlock<d>& cell, const BoxBlock<d>& box, std::size_t l, BoxPlaces& out,
                                const BoxTarget& target) {
    const BoxTag tag;
    const hn::RebindToSigned<BoxTag> whole;
    const auto error = hn::Set(tag, box.error[l]);
    auto nearest = hn::Set(tag, 0x1p100F);
    BoxPlaces inside = out;
    visit_box<d>(cell, box, l, [&](auto min, auto place, std::int32_t row, std::int32_t layer) BARYCERT_LANE_LAMBDA {
        target.fetch(row, layer);
        inside.add(whole, place, hn::RebindMask(whole, hn::Gt(min, error)));
        nearest = hn::Min(nearest, hn::Abs(min));
    });
    out = inside;
    return hn::AllTrue(tag, hn::Gt(nearest, error));
}

/// Adds those that may be in the cell or not.
template <int d>
HWY_NOINLINE void find_open_points(const CellBlock<d>& cell, const BoxBlock<d>& box, std::size_t l, BoxPlaces& out) {
    const BoxTag tag;
    const hn::RebindToSigned<BoxTag> whole;
    const auto error = hn::Set(tag, box.error[l]);
    visit_box<d>(cell, box, l, [&](auto min, auto place, std::int32_t, std::int32_t) BARYCERT_LANE_LAMBDA {
        out.add(whole, place, hn::RebindMask(whole, hn::Le(hn::Abs(min), error)));
    });
}

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
