// Cells against the points of a grid: where each row enters and leaves a cell, and the values between.
//
// u = 2^-53, rounding to nearest. As in gradient-inl.hpp: o the last vertex, e_j = fl(v_j - o), X_k their extents,
// a_k = G / X_k, K = G / |d|, n_j the normals, inv = fl(1/d); the cell is not degenerate and K <= 2^36.
//
// Inside or not. Weight j < last of a point p in the cell's box, w = fl(p - o), is l_j = sum_k S_jk w_k with
// S_jk = fl(n_jk inv); the last is 1 + sum_k S_k w_k with S = -sum_j S_j. As |w_k| <= X_k there, refinement-inl.hpp
// bounds the error of l_j by u B(w)/|d| (98.1 K + 21) 1.002, and B(w)/|d| <= 3 K: 296 K^2 + 64 K, with the rounding of
// the difference w (2.0001 u B(w)/|d|) below u (300 K^2 + 75 K). Of the last weight: three times that, and three
// roundings of sums of numbers that are below 3 * 3 K: u (900 K^2 + 300 K + 2). E = u (1000 K^2 + 400 K + 8) bounds all
// of them, however the sums are arranged. Along a row only w_x changes, as a real number: l_j = a_j + S_jx w_x, so a
// point with a_j + S_jx w_x < -E for some j is certainly outside, and one with > E for all j certainly inside. Solved
// for the place along the row, t = (o_x + w_x - origin) / spacing, these are intervals, whose ends are off by less than
// raster.slack: so much is added outside and taken off inside. Where |S_jx| X_x <= E, the weight is a_j up to E along
// the row, and nothing is solved: certainly outside below -2 E, certainly inside above 2 E.
//
// Values. V(p) = f_o + sum_k g_k (w_k + t_k), where p_k - o_k = w_k + t_k exactly and g_k = y_k + c_k up to eta_k
// (gradient-inl.hpp). Let M = |f_o| + sum |y_k| X_k, C = sum |c_k| X_k. The sum of f_o and the products y_k w_k runs
// through two_sum and two_product: 3 + 3 remainders of at most 1.001 u M and u M together; y_k t_k, in double, <= u M
// together, c_k w_k <= C: their plain sum rounds by at most 11 u (5.1 u M + C) 1.001, the products by u^2 M + u C, and
// c_k t_k, left out, is below u C. Adding the error in the end rounds by u (5.1 u M + C) once more, for each sign. So
//   error = 1.01 sum eta_k X_k + 80 u^2 M + 20 u C
// bounds all that is lost. Ranges: M <= 2^900, so nothing overflows; and error >= 2^-960, or M = C = 0, as
// underflow takes at most 2^-1070 in each of some 20 operations.
#include "barycert/sample/fill_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

// The targets are those of core/lanes.cpp.
#define HWY_DISABLED_TARGETS \
    (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/sample/fill_lanes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway wants it.
#include <hwy/highway.h>

#include "barycert/core/gradient-inl.hpp"
#include "barycert/core/strict_math.hpp"
#include "barycert/locate/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert {
namespace HWY_NAMESPACE {

using detail::FillTarget;
using detail::interior_without_value;
using detail::NodeValues;
using detail::Place;
using detail::Raster;
using detail::Span;

constexpr std::size_t most_lanes = 8;

/// Of each plane, by cell of a block: the weight along a row at (w_y, w_z) is a = constant + sy w_y + sz w_z at w_x =
/// 0. It bounds the row from below at t = lower - a * lower_factor -+ lower_width, from above likewise; where it does
/// not, the bound is far away and its factor 0.
struct PlaneBlock {
    HWY_ALIGN double constant[most_lanes], sy[most_lanes], sz[most_lanes];
    HWY_ALIGN double lower[most_lanes], lower_factor[most_lanes], lower_width[most_lanes];
    HWY_ALIGN double upper[most_lanes], upper_factor[most_lanes], upper_width[most_lanes];
};

/// Of each component.
struct ValueBlock {
    HWY_ALIGN double at_origin[most_lanes], plain[3][most_lanes], correction[3][most_lanes], error[most_lanes];
    HWY_ALIGN double valid[most_lanes];  ///< 1 or 0
};

template <int d>
struct CellBlock {
    HWY_ALIGN double origin[d][most_lanes], low[d][most_lanes], high[d][most_lanes];
    HWY_ALIGN double first[d][most_lanes], last[d][most_lanes];  ///< guesses of places
    HWY_ALIGN double valid[most_lanes];                          ///< 1 or 0
    PlaneBlock plane[d + 1];
};

/// Farther than any place along a row.
constexpr double far = 0x1p40;

template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE void set_plane(D tag, const Raster& raster, V constant, const V (&s)[d], V origin, V extent, V error,
                          PlaneBlock& out) {
    const V scale = hn::Set(tag, raster.scale[0]), zero = hn::Zero(tag);
    const V base = (origin - hn::Set(tag, raster.origin[0])) * scale;
    // t = far * -a / E, widened by 3 far: beyond all places below -3 E, before all of them above 3 E.
    const auto parallel = hn::Le(hn::Abs(s[0]) * extent, error);
    const auto rising = hn::Or(parallel, hn::Gt(s[0], zero));
    const V factor = hn::IfThenElse(parallel, hn::Set(tag, far) / error, scale / s[0]);
    const V width =
        hn::IfThenElse(parallel, hn::Set(tag, 3 * far), error * hn::Abs(factor) + hn::Set(tag, raster.slack));
    const V place = hn::IfThenElse(parallel, zero, base);
    const V none = hn::Set(tag, 4 * far);
    hn::Store(constant, tag, out.constant);
    hn::Store(s[1], tag, out.sy);
    if constexpr (d == 3) hn::Store(s[2], tag, out.sz);
    hn::Store(hn::IfThenElse(rising, place, hn::Neg(none)), tag, out.lower);
    hn::Store(hn::IfThenElse(rising, factor, zero), tag, out.lower_factor);
    hn::Store(hn::IfThenElse(rising, width, zero), tag, out.lower_width);
    hn::Store(hn::IfThenElse(rising, none, place), tag, out.upper);
    hn::Store(hn::IfThenElse(rising, zero, factor), tag, out.upper_factor);
    hn::Store(hn::IfThenElse(rising, zero, width), tag, out.upper_width);
}

template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE void set_values(D tag, const CellMatrix<d, D>& m, const V (&extent)[d], const V (&f)[d + 1],
                           ValueBlock& out) {
    constexpr double u = 0x1p-53;
    const RefinedGradient<d, D> g = refined_gradient<d>(tag, m, f);
    V size = hn::Abs(f[d]), corrections = hn::Zero(tag), eta = hn::Zero(tag);
    for (int k = 0; k < d; ++k) {
        size = size + hn::Abs(g.plain[k]) * extent[k];
        corrections = corrections + hn::Abs(g.correction[k]) * extent[k];
        eta = eta + g.error[k] * extent[k];
        hn::Store(g.plain[k], tag, out.plain[k]);
        hn::Store(g.correction[k], tag, out.correction[k]);
    }
    const V error = hn::Set(tag, 1.01) * eta + hn::Set(tag, 80 * u * u) * size + hn::Set(tag, 20 * u) * corrections;
    const auto nothing = hn::Eq(size + corrections, hn::Zero(tag));
    const auto valid =
        hn::And(hn::And(m.valid, g.valid),
                hn::And(hn::Le(size, hn::Set(tag, 0x1p900)), hn::Or(nothing, hn::Ge(error, hn::Set(tag, 0x1p-960)))));
    hn::Store(f[d], tag, out.at_origin);
    hn::Store(error, tag, out.error);
    hn::Store(hn::IfThenElse(valid, hn::Set(tag, 1), hn::Zero(tag)), tag, out.valid);
}

/// Cells [0, MaxLanes).
template <Simplex s, class D>
HWY_INLINE void set_block(D tag, const detail::CellIndex& index, const NodeValues& nodes, const Raster& raster,
                          const Place* cells, CellBlock<space_dimension(s)>& out, ValueBlock* values) {
    using V = hn::Vec<D>;
    constexpr int d = space_dimension(s), n = d + 1;
    constexpr double u = 0x1p-53;
    const auto node = [&](std::size_t l, int i) HWY_ATTR {
        return static_cast<std::size_t>(
            index.cells[static_cast<std::size_t>(cells[l])].node[static_cast<std::size_t>(i)]);
    };
    V v[n][d], f[n];
    for (int i = 0; i < n; ++i) {
        V row[4];
        load_records(
            tag, [&](std::size_t l) HWY_ATTR { return nodes.first[node(l, i)].at.data(); }, row);
        for (int k = 0; k < d; ++k) v[i][k] = row[k];
        f[i] = row[3];
    }
    const CellMatrix<d, D> m = cell_matrix<d>(tag, v);
    V extent[d];
    extents(m.edge, extent);
    for (int k = 0; k < d; ++k) {
        V low = v[0][k], high = v[0][k];
        for (int i = 1; i < n; ++i) {
            low = hn::Min(low, v[i][k]);
            high = hn::Max(high, v[i][k]);
        }
        const V origin = hn::Set(tag, raster.origin[k]), scale = hn::Set(tag, raster.scale[k]);
        const V most = hn::Set(tag, static_cast<double>(raster.at[static_cast<std::size_t>(k)].size()));
        const auto clamp = [&](V x) HWY_ATTR { return hn::Min(hn::Max(x, hn::Zero(tag)), most); };
        hn::Store(v[d][k], tag, out.origin[k]);
        hn::Store(low, tag, out.low[k]);
        hn::Store(high, tag, out.high[k]);
        hn::Store(clamp(hn::Ceil((low - origin) * scale)), tag, out.first[k]);
        hn::Store(clamp(hn::Floor((high - origin) * scale) + hn::Set(tag, 1)), tag, out.last[k]);
    }
    const V condition = m.reach[0] * extent[0];
    const V error =
        hn::Set(tag, 1000 * u) * condition * condition + hn::Set(tag, 400 * u) * condition + hn::Set(tag, 8 * u);
    V last[d];
    for (int j = 0; j < d; ++j) {
        V slope[d];
        for (int k = 0; k < d; ++k) {
            slope[k] = m.normal[j][k] * m.inverse;
            last[k] = j == 0 ? hn::Neg(slope[k]) : last[k] - slope[k];
        }
        set_plane<d>(tag, raster, hn::Zero(tag), slope, v[d][0], extent[0], error, out.plane[j]);
    }
    set_plane<d>(tag, raster, hn::Set(tag, 1), last, v[d][0], extent[0], error, out.plane[d]);
    const auto valid = hn::And(m.valid, hn::Le(error, hn::Set(tag, 0x1p-9)));
    hn::Store(hn::IfThenElse(valid, hn::Set(tag, 1), hn::Zero(tag)), tag, out.valid);

    set_values<d>(tag, m, extent, f, values[0]);
    for (std::size_t c = 1; c < nodes.components; ++c) {
        const detail::ValueRecord* const more = nodes.more + (c - 1) / 4 * nodes.node_count;
        for (int i = 0; i < n; ++i) {
            HWY_ALIGN double lanes[most_lanes];
            for (std::size_t l = 0; l < hn::MaxLanes(D()); ++l) lanes[l] = more[node(l, i)].value[(c - 1) % 4];
            f[i] = hn::Load(tag, lanes);
        }
        set_values<d>(tag, m, extent, f, values[c]);
    }
}

struct PlaceRange {
    std::int32_t first, last;
};

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

/// Rows of a cell, for several vectors: what was stored one by one is loaded as a vector only after a while, or the
/// processor would have to wait.
struct Rows {
    static constexpr std::size_t most = 8 * most_lanes;
    HWY_ALIGN double y[most], z[most];
    std::int32_t row[most], layer[most];
    std::size_t count;
};

/// What MaxLanes of them have in common with the cell.
struct RowBlock {
    HWY_ALIGN std::int32_t first[most_lanes], inner_first[most_lanes], inner_last[most_lanes], last[most_lanes];
    std::uint32_t with_points = 0;  ///< bits: rows with certain points
    std::uint32_t unsure = 0;       ///< bits: rows with others
};

template <int d, class D>
HWY_INLINE void find_intervals(D tag, const CellBlock<d>& cell, std::size_t l, PlaceRange columns, const Rows& rows,
                               std::size_t at, RowBlock& out) {
    using V = hn::Vec<D>;
    const V wy = hn::Load(tag, rows.y + at) - hn::Set(tag, cell.origin[1][l]);
    V wz = hn::Zero(tag);
    if constexpr (d == 3) wz = hn::Load(tag, rows.z + at) - hn::Set(tag, cell.origin[2][l]);
    V low = hn::Set(tag, -8 * far), high = hn::Set(tag, 8 * far), inner_low = low, inner_high = high;
    for (int j = 0; j <= d; ++j) {
        const PlaneBlock& p = cell.plane[j];
        V a = hn::Set(tag, p.constant[l]) + hn::Set(tag, p.sy[l]) * wy;
        if constexpr (d == 3) a = a + hn::Set(tag, p.sz[l]) * wz;
        const V lower = hn::Set(tag, p.lower[l]) - a * hn::Set(tag, p.lower_factor[l]);
        const V upper = hn::Set(tag, p.upper[l]) - a * hn::Set(tag, p.upper_factor[l]);
        const V lower_width = hn::Set(tag, p.lower_width[l]), upper_width = hn::Set(tag, p.upper_width[l]);
        low = hn::Max(low, lower - lower_width);
        inner_low = hn::Max(inner_low, lower + lower_width);
        high = hn::Min(high, upper + upper_width);
        inner_high = hn::Min(inner_high, upper - upper_width);
    }
    const V least = hn::Set(tag, columns.first), most = hn::Set(tag, columns.last), one = hn::Set(tag, 1);
    const auto clamp = [&](V x) HWY_ATTR { return hn::Min(hn::Max(x, least), most); };
    const hn::Rebind<std::int32_t, D> whole;
    const V first = clamp(hn::Ceil(low)), last = hn::Max(first, clamp(hn::Floor(high) + one));
    const V inner_first = hn::Min(clamp(hn::Ceil(inner_low)), last);
    const V inner_last = hn::Max(inner_first, hn::Min(clamp(hn::Floor(inner_high) + one), last));
    hn::Store(hn::DemoteTo(whole, first), whole, out.first);
    hn::Store(hn::DemoteTo(whole, last), whole, out.last);
    hn::Store(hn::DemoteTo(whole, inner_first), whole, out.inner_first);
    hn::Store(hn::DemoteTo(whole, inner_last), whole, out.inner_last);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Lt(inner_first, inner_last), bits);
    out.with_points = bits[0];
    hn::StoreMaskBits(tag, hn::Or(hn::Ne(first, inner_first), hn::Ne(last, inner_last)), bits);
    out.unsure = bits[0];
}

/// Of a component, by row.
struct RowTerms {
    HWY_ALIGN double sum[most_lanes], rest[most_lanes];
};

/// Numbers whose exact sum is sum + rest, up to the error that `error` of ValueBlock bounds.
template <class V>
struct Partial {
    V sum, rest;
};

/// What f_o and the terms of y and z give in each row.
template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE Partial<V> row_terms(D tag, const CellBlock<d>& cell, const ValueBlock& value, std::size_t l,
                                const Rows& rows, std::size_t at) {
    Accumulator<V> sum{hn::Set(tag, value.at_origin[l]), hn::Zero(tag), hn::Zero(tag)};
    for (int k = 1; k < d; ++k) {
        const TwoTerms<V> w =
            two_difference(hn::Load(tag, (k == 1 ? rows.y : rows.z) + at), hn::Set(tag, cell.origin[k][l]));
        const V plain = hn::Set(tag, value.plain[k][l]);
        sum.add_product(plain, w.high);
        sum.product_rest = sum.product_rest + (plain * w.low + hn::Set(tag, value.correction[k][l]) * w.high);
    }
    return {sum.sum, sum.sum_rest + sum.product_rest};
}

/// The terms of x in `width` columns.
template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE Partial<V> column_terms(D tag, const Raster& raster, const CellBlock<d>& cell, const ValueBlock& value,
                                   std::size_t l, std::int32_t column) {
    const auto at = static_cast<std::size_t>(column), size = raster.at[0].size();
    HWY_ALIGN double lanes[most_lanes];
    const double* from = raster.at[0].data() + at;
    if (at + hn::MaxLanes(D()) > size) {
        for (std::size_t i = 0; i < hn::MaxLanes(D()); ++i) lanes[i] = raster.at[0][std::min(at + i, size - 1)];
        from = lanes;
    }
    const V x = hn::LoadU(tag, from);
    const TwoTerms<V> w = two_difference(x, hn::Set(tag, cell.origin[0][l]));
    const V plain = hn::Set(tag, value.plain[0][l]);
    const TwoTerms<V> p = two_product(plain, w.high);
    return {p.high, p.low + (plain * w.low + hn::Set(tag, value.correction[0][l]) * w.high)};
}

/// The sum of a row and its columns, and a bit where its rounding is certain.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V value_of(D tag, const ValueBlock& value, std::size_t l, const RowTerms& terms, std::size_t r,
                      const Partial<V>& column, std::uint32_t& certain) {
    const TwoTerms<V> sum = two_sum(hn::Set(tag, terms.sum[r]), column.sum);
    auto mask = hn::Ne(hn::Set(tag, value.valid[l]), hn::Zero(tag));
    const V out = rounded_if_certain<D>(sum.high, sum.low + (column.rest + hn::Set(tag, terms.rest[r])),
                                        hn::Set(tag, value.error[l]), mask) +
                  hn::Zero(tag);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, mask, bits);
    certain &= bits[0];
    return out;
}

/// What the rows of a cell are filled with.
template <int d, class V>
struct CellFill {
    const CellBlock<d>& cell;
    const ValueBlock* values;
    std::size_t components, l;
    Mesh::Index id;
    std::int32_t first_column;
    const Partial<V>* known;  ///< the columns' terms if one vector holds them all, else nullptr
    RowTerms* terms;
};

/// Points [first, last) of the line that begins at point `at`, whatever the number of components and columns.
template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE void fill_row(D tag, const Raster& raster, const CellFill<d, V>& fill, std::size_t r, std::int32_t first,
                         std::int32_t last, std::size_t at, const FillTarget& target) {
    constexpr auto width = static_cast<std::int32_t>(hn::MaxLanes(D()));
    const auto kept = [&](std::size_t point) {
        return target.overlapping && target.owner[point] >= 0 && target.owner[point] < fill.id;
    };
    for (std::int32_t column = fill.known != nullptr ? fill.first_column : first; column < last; column += width) {
        const std::int32_t from = std::max(first, column), to = std::min(last, column + width);
        std::uint32_t certain = ~0U;
        for (std::size_t c = 0; c < fill.components; ++c) {
            const Partial<V> x = fill.known != nullptr
                                     ? fill.known[c]
                                     : column_terms<d>(tag, raster, fill.cell, fill.values[c], fill.l, column);
            HWY_ALIGN double lanes[most_lanes];
            hn::Store(value_of(tag, fill.values[c], fill.l, fill.terms[c], r, x, certain), tag, lanes);
            for (std::int32_t i = from; i < to; ++i) {
                const std::size_t point = at + static_cast<std::size_t>(i);
                if (!kept(point)) target.values[target.stride * point + c] = lanes[i - column];
            }
        }
        for (std::int32_t i = from; i < to; ++i) {
            const std::size_t point = at + static_cast<std::size_t>(i);
            if (kept(point)) continue;
            target.owner[point] = fill.id;
            target.feature[point] = (certain >> (i - column) & 1) != 0 ? Feature::interior : interior_without_value;
        }
    }
}

/// The eight bytes that begin at `at`: those of which the bit is set get `value`.
HWY_INLINE void set_bytes(Feature* at, std::uint32_t bits, Feature value) {
    static_assert(sizeof(Feature) == 1);
    // Each of the eight bits to the lowest of its byte, then to all of it.
    const std::uint64_t spread = (bits * 0x0101010101010101U & 0x8040201008040201U) + 0x7f7f7f7f7f7f7f7fU;
    const std::uint64_t mask = (spread >> 7 & 0x0101010101010101U) * 0xff;
    std::uint64_t bytes;
    std::memcpy(&bytes, at, 8);
    bytes = (bytes & ~mask) | (mask & static_cast<std::uint64_t>(value) * 0x0101010101010101U);
    std::memcpy(at, &bytes, 8);
}

/// The same without branches, for the usual case: one number a point, cells that do not overlap, one vector of columns.
template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE void fill_short_row(D tag, const CellFill<d, V>& fill, std::size_t r, std::int32_t first, std::int32_t last,
                               std::size_t at, const FillTarget& target) {
    std::uint32_t certain = ~0U;
    const V value = value_of(tag, fill.values[0], fill.l, fill.terms[0], r, fill.known[0], certain);
    const std::int32_t begin = fill.first_column;
    const std::size_t point = at + static_cast<std::size_t>(begin);
    const std::uint32_t bits = ((1U << (last - begin)) - 1) & ~((1U << (first - begin)) - 1);
    const std::uint8_t stored[8] = {static_cast<std::uint8_t>(bits)};
    hn::BlendedStore(value, hn::LoadMaskBits(tag, stored), tag, target.values + point);
    const hn::CappedTag<std::int32_t, most_lanes> whole;
    constexpr std::size_t width = hn::MaxLanes(hn::CappedTag<std::int32_t, most_lanes>());
    for (std::size_t i = 0; i < hn::MaxLanes(D()); i += width) {
        const std::uint8_t part[8] = {static_cast<std::uint8_t>(bits >> i)};
        hn::BlendedStore(hn::Set(whole, fill.id), hn::LoadMaskBits(whole, part), whole, target.owner + point + i);
    }
    set_bytes(target.feature + point, bits & certain, Feature::interior);
    if ((bits & ~certain) != 0) set_bytes(target.feature + point, bits & ~certain, interior_without_value);
}

template <Simplex s, class D>
HWY_INLINE void fill_cell(D tag, const Raster& raster, const CellBlock<space_dimension(s)>& cell,
                          const ValueBlock* values, std::size_t components, std::size_t l, Place place, Mesh::Index id,
                          const FillTarget& target, std::vector<Span>& unsure, RowTerms* terms) {
    using V = hn::Vec<D>;
    constexpr int d = space_dimension(s);
    constexpr std::size_t width = hn::MaxLanes(D());
    const auto range = [&](std::size_t k) {
        return places_between(raster.at[k], cell.first[k][l], cell.last[k][l], cell.low[k][l], cell.high[k][l]);
    };
    const PlaceRange columns = range(0);
    PlaceRange lines = range(1), layers{0, 1};
    if constexpr (d == 3) layers = range(2);
    PlaceRange& cut = d == 3 ? layers : lines;
    cut.first = std::max(cut.first, target.first_layer);
    cut.last = std::min(cut.last, target.last_layer);
    if (columns.first >= columns.last || lines.first >= lines.last || layers.first >= layers.last) return;

    constexpr std::size_t most_known = 4;
    Partial<V> known[most_known];
    const bool one_vector = static_cast<std::size_t>(columns.last - columns.first) <= width && components <= most_known;
    for (std::size_t c = 0; one_vector && c < components; ++c)
        known[c] = column_terms<d>(tag, raster, cell, values[c], l, columns.first);
    const CellFill<d, V> fill{cell, values, components, l, id, columns.first, one_vector ? known : nullptr, terms};
    const bool usual = one_vector && target.stride == 1 && components == 1 && !target.overlapping;

    Rows rows;
    rows.count = 0;
    const auto run = [&]() HWY_ATTR {
        for (std::size_t r = rows.count; r % width != 0; ++r) {  // lanes without a row repeat one
            rows.y[r] = rows.y[0];
            rows.z[r] = rows.z[0];
        }
        for (std::size_t at = 0; at < rows.count; at += width) {
            RowBlock block;
            find_intervals<d>(tag, cell, l, columns, rows, at, block);
            const std::uint32_t real = rows.count - at >= width ? ~0U : (1U << (rows.count - at)) - 1;
            for (std::uint32_t bits = block.unsure & real; bits != 0; bits &= bits - 1) {
                const auto r = static_cast<std::size_t>(__builtin_ctz(bits));
                unsure.push_back({place, rows.row[at + r], rows.layer[at + r], block.first[r], block.inner_first[r],
                                  block.inner_last[r], block.last[r]});
            }
            block.with_points &= real;
            if (block.with_points == 0) continue;
            for (std::size_t c = 0; c < components; ++c) {
                const Partial<V> t = row_terms<d>(tag, cell, values[c], l, rows, at);
                hn::Store(t.sum, tag, terms[c].sum);
                hn::Store(t.rest, tag, terms[c].rest);
            }
            for (std::uint32_t bits = block.with_points; bits != 0; bits &= bits - 1) {
                const auto r = static_cast<std::size_t>(__builtin_ctz(bits));
                const std::int32_t row = rows.row[at + r], layer = rows.layer[at + r];
                const auto line = static_cast<std::size_t>(d == 3 ? layer - target.first_layer : 0) * target.rows +
                                  static_cast<std::size_t>(d == 3 ? row : row - target.first_layer);
                if (usual) {
                    fill_short_row<d>(tag, fill, r, block.inner_first[r], block.inner_last[r], line * target.columns,
                                      target);
                } else {
                    fill_row<d>(tag, raster, fill, r, block.inner_first[r], block.inner_last[r], line * target.columns,
                                target);
                }
            }
        }
        rows.count = 0;
    };
    // One loop over both: nothing could predict where the inner one ends.
    const double* const y = raster.at[1].data();
    const double* const z = raster.at[2].data();
    std::int32_t row = lines.first, layer = layers.first;
    for (std::int64_t left = std::int64_t{lines.last - lines.first} * (layers.last - layers.first); left > 0; --left) {
        rows.y[rows.count] = y[row];
        rows.z[rows.count] = z[layer];
        rows.row[rows.count] = row;
        rows.layer[rows.count] = layer;
        ++row;
        layer += row == lines.last ? 1 : 0;
        row = row == lines.last ? lines.first : row;
        if (++rows.count == Rows::most) run();
    }
    if (rows.count != 0) run();
}

template <Simplex s>
void fill_all(const detail::CellIndex& index, const NodeValues& nodes, const Raster& raster, const Place* cells,
              std::size_t count, const FillTarget& target, std::vector<Span>& unsure, std::vector<Place>& hard) {
    const hn::ScalableTag<double> tag;
    constexpr std::size_t width = hn::MaxLanes(hn::ScalableTag<double>());
    CellBlock<space_dimension(s)> block;
    std::vector<ValueBlock> values(nodes.components);
    std::vector<RowTerms> terms(nodes.components);
    for (std::size_t at = 0; at < count; at += width) {
        Place some[width];
        for (std::size_t l = 0; l < width; ++l) some[l] = cells[std::min(at + l, count - 1)];
        set_block<s>(tag, index, nodes, raster, some, block, values.data());
        for (std::size_t l = 0; l < std::min(width, count - at); ++l) {
            if (block.valid[l] == 0) {
                hard.push_back(some[l]);
            } else {
                fill_cell<s>(tag, raster, block, values.data(), nodes.components, l, some[l],
                             index.original[static_cast<std::size_t>(some[l])], target, unsure, terms.data());
            }
        }
    }
}

void fill_cells(const detail::CellIndex& index, const NodeValues& nodes, const Raster& raster, const Place* cells,
                std::size_t count, const FillTarget& target, std::vector<Span>& unsure, std::vector<Place>& hard) {
    index.simplex == Simplex::triangle
        ? fill_all<Simplex::triangle>(index, nodes, raster, cells, count, target, unsure, hard)
        : fill_all<Simplex::tetrahedron>(index, nodes, raster, cells, count, target, unsure, hard);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert {

HWY_EXPORT(fill_cells);

void detail::fill_cells(const CellIndex& index, const NodeValues& nodes, const Raster& raster, const Place* cells,
                        std::size_t count, const FillTarget& target, std::vector<Span>& unsure,
                        std::vector<Place>& hard) {
    HWY_DYNAMIC_DISPATCH(fill_cells)(index, nodes, raster, cells, count, target, unsure, hard);
}

}  // namespace barycert
#endif
