// Internal: where each row of a grid enters and leaves a cell; and the values of a linear field at points of a grid in
// a cell, correctly rounded, from its refined gradient, or in plain double. Notation as in fill_box-inl.hpp.
//
// Included once per SIMD target.
#if defined(BARYCERT_SAMPLE_FILL_VALUES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_SAMPLE_FILL_VALUES_INL_HPP
#undef BARYCERT_SAMPLE_FILL_VALUES_INL_HPP
#else
#define BARYCERT_SAMPLE_FILL_VALUES_INL_HPP
#endif

#include "mesh/sample/grid/fill_box-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

// Rows. Along a row only w_x changes, as a real number: l_j = a_j + S_jx w_x up to E, so a point with a_j + S_jx w_x <
// -E for some j is certainly outside, and one with > E for all j certainly inside. Solved for the place along the row,
// t = (o_x + w_x - origin) / spacing, these are intervals, whose ends are off by less than raster.slack, for where
// |S_jx| X_x > E no end that matters is more than a few extents from the cell: so much is added outside and taken off
// inside. Where |S_jx| X_x <= E, the weight is a_j up to E along the row, and nothing is solved: certainly outside
// below -2 E, certainly inside above 2 E.

/// Coefficients of a plane, for each cell of a block: the weight along a row at (w_y, w_z) is a = constant + sy w_y +
/// sz w_z at w_x = 0. It bounds the row from below at t = lower - a * lower_factor -+ lower_width, from above likewise;
/// where it does not, the bound is far away and its factor 0.
/// 0. It bounds the row from below at t = lower - a * lower_factor -+ lower_width, from above likewise; where it does
/// not, the bound is far away and its factor 0.
struct PlaneBlock {
    HWY_ALIGN double constant[max_lanes], sy[max_lanes], sz[max_lanes];
    HWY_ALIGN double lower[max_lanes], lower_factor[max_lanes], lower_width[max_lanes];
    HWY_ALIGN double upper[max_lanes], upper_factor[max_lanes], upper_width[max_lanes];
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

/// The weights along rows, of the cells of a block.
template <int d>
using RowsBlock = PlaneBlock[d + 1];

template <int d, class D>
HWY_INLINE void set_planes(D tag, const Raster& raster, const CellBlock<d>& cell, const CellWeights<d, D>& w,
                           hn::Vec<D> extent, RowsBlock<d>& out) {
    const auto origin = hn::Load(tag, cell.origin[0]);
    for (int j = 0; j <= d; ++j) set_plane<d>(tag, raster, w.constant[j], w.slope[j], origin, extent, w.error, out[j]);
}

/// Rows of a cell, for several vectors: what was stored one by one is loaded as a vector only after a while, or the
/// processor would have to wait.
struct Rows {
    static constexpr std::size_t max = 8 * max_lanes;
    HWY_ALIGN double y[max], z[max];
    std::int32_t row[max], layer[max];
    std::size_t count;
};

/// Points that MaxLanes rows have in common with the cell.
struct RowBlock {
    HWY_ALIGN std::int32_t first[max_lanes], inner_first[max_lanes], inner_last[max_lanes], last[max_lanes];
    std::uint32_t with_points = 0;  ///< bits: rows with certain points
    std::uint32_t undecided = 0;    ///< bits: rows with others
};

template <int d, class D>
HWY_INLINE void find_intervals(D tag, const CellBlock<d>& cell, const RowsBlock<d>& planes, std::size_t l,
                               PlaceRange columns, const Rows& rows, std::size_t at, RowBlock& out) {
    using V = hn::Vec<D>;
    const V wy = hn::Load(tag, rows.y + at) - hn::Set(tag, cell.origin[1][l]);
    V wz = hn::Zero(tag);
    if constexpr (d == 3) wz = hn::Load(tag, rows.z + at) - hn::Set(tag, cell.origin[2][l]);
    V low = hn::Set(tag, -8 * far), high = hn::Set(tag, 8 * far), inner_low = low, inner_high = high;
    for (int j = 0; j <= d; ++j) {
        const PlaneBlock& p = planes[j];
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
    const V min = hn::Set(tag, columns.first), max = hn::Set(tag, columns.last), one = hn::Set(tag, 1);
    const auto clamp = [&](V x) HWY_ATTR { return hn::Min(hn::Max(x, min), max); };
    const hn::Rebind<std::int32_t, D> whole;
    const V first = clamp(hn::Ceil(low)), last = hn::Max(first, clamp(hn::Floor(high) + one));
    const V inner_first = hn::Min(clamp(hn::Ceil(inner_low)), last);
    const V inner_last = hn::Max(inner_first, hn::Min(clamp(hn::Floor(inner_high) + one), last));
    hn::Store(hn::DemoteTo(whole, first), whole, out.first);
    hn::Store(hn::DemoteTo(whole, last), whole, out.last);
    hn::Store(hn::DemoteTo(whole, inner_first), whole, out.inner_first);
    hn::Store(hn::DemoteTo(whole, inner_last), whole, out.inner_last);
    out.with_points = mask_bits(tag, hn::Lt(inner_first, inner_last));
    out.undecided = mask_bits(tag, hn::Or(hn::Ne(first, inner_first), hn::Ne(last, inner_last)));
}

// Values. V(p) = f_o + sum_k g_k (w_k + t_k), where p_k - o_k = w_k + t_k exactly and g_k = y_k + c_k up to eta_k
// (gradient-inl.hpp). Let M = |f_o| + sum |y_k| X_k, C = sum |c_k| X_k. The sum of f_o and the products y_k w_k runs
// through two_sum and two_product: 3 + 3 remainders of at most 1.001 u M and u M together; y_k t_k, in double, <= u M
// together, c_k w_k <= C: no one of them meets more than 8 additions, which round by at most 8 u (5.1 u M + C) 1.001,
// the products by u^2 M + u C, and c_k t_k, left out, is below u C. Adding the error in the end rounds by u (5.1 u M +
// C) once more, for each sign. So
//   error = 1.01 sum eta_k X_k + 80 u^2 M + 20 u C
// bounds all that is lost. Ranges: M <= 2^900, so nothing overflows; and error >= 2^-960, or M = C = 0, as
// underflow takes at most 2^-1070 in each of some 20 operations.
//
// The share of each axis is computed once a place, not once a point.

/// Lane l: table[index of lane l].
template <class D>
HWY_INLINE hn::Vec<D> look_up(D tag, const double (&table)[max_lanes], hn::Vec<hn::RebindToSigned<D>> index) {
    if constexpr (hn::MaxLanes(D()) == max_lanes)
        return hn::TableLookupLanes(hn::Load(tag, table), hn::IndicesFromVec(tag, index));
    return hn::GatherIndex(tag, table, index);
}

/// Numbers whose exact sum is sum + rest, up to the error that `error` of CorrectValues::Block bounds.
template <class V>
struct Partial {
    V sum, rest;
};
template <class V>
HWY_INLINE Partial<V> added(const Partial<V>& x, const Partial<V>& y) {
    const TwoTerms<V> s = two_sum(x.sum, y.sum);
    return {s.high, s.low + (x.rest + y.rest)};
}

template <int d>
struct CorrectValues {
    /// Coefficients of a component, by cell of a block.
    struct CellValues {
        HWY_ALIGN double at_origin[max_lanes], plain[d][max_lanes], correction[d][max_lanes], error[max_lanes];
        std::uint32_t valid;  ///< bits
    };

    template <class D, class V = hn::Vec<D>>
    static HWY_INLINE void set(D tag, const CellMatrix<d, D>& m, const V (&)[d + 1][d], const V (&extent)[d],
                               const V (&f)[d + 1], CellValues& out) {
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
        const auto valid = hn::And(
            hn::And(m.valid, g.valid),
            hn::And(hn::Le(size, hn::Set(tag, 0x1p900)), hn::Or(nothing, hn::Ge(error, hn::Set(tag, 0x1p-960)))));
        hn::Store(f[d], tag, out.at_origin);
        hn::Store(error, tag, out.error);
        out.valid = mask_bits(tag, valid);
    }

    /// The share of axis k in component `b` of cell l at places `at`; that of the second axis includes f_o.
    template <int k, class D, class V = hn::Vec<D>>
    static HWY_INLINE Partial<V> term(D tag, const CellBlock<d>& cell, const CellValues& b, std::size_t l, V at) {
        const TwoTerms<V> w = two_difference(at, hn::Set(tag, cell.origin[k][l]));
        const V plain = hn::Set(tag, b.plain[k][l]);
        const TwoTerms<V> p = two_product(plain, w.high);
        const Partial<V> out{p.high, p.low + (plain * w.low + hn::Set(tag, b.correction[k][l]) * w.high)};
        if constexpr (k != 1) return out;
        return added({hn::Set(tag, b.at_origin[l]), hn::Zero(tag)}, out);
    }

    /// The rounded value, and a bit where that is certain.
    template <class D, class V = hn::Vec<D>>
    static HWY_INLINE V rounded(D tag, const CellValues& b, std::size_t l, const Partial<V>& sum,
                                std::uint32_t& certain) {
        auto mask = hn::FirstN(tag, hn::MaxLanes(D()));
        const V out = rounded_if_certain<D>(sum.sum, sum.rest, hn::Set(tag, b.error[l]), mask) + hn::Zero(tag);
        certain = (b.valid >> l & 1) != 0 ? mask_bits(tag, mask) : 0;
        return out;
    }

    /// Terms by place of a box.
    struct Table {
        HWY_ALIGN double sum[d][max_lanes], rest[d][max_lanes];
    };
    template <int k, class D>
    static HWY_INLINE void set_axis(D tag, const Raster& raster, const CellBlock<d>& cell, const CellValues& b,
                                    std::size_t l, Table& out) {
        const double* const from = raster.at[k].data() + cell.first[k][l];
        const std::int32_t count = cell.last[k][l] - cell.first[k][l];
        constexpr auto width = static_cast<std::int32_t>(hn::MaxLanes(D()));
        for (std::int32_t i = 0; i < box_side; i += width) {
            const auto t = term<k>(tag, cell, b, l, load_some(tag, from + i, count - i));
            hn::Store(t.sum, tag, out.sum[k] + i);
            hn::Store(t.rest, tag, out.rest[k] + i);
        }
    }
    template <class D>
    static HWY_INLINE void set_table(D tag, const Raster& raster, const CellBlock<d>& cell, const CellValues& b,
                                     std::size_t l, Table& out) {
        set_axis<0>(tag, raster, cell, b, l, out);
        set_axis<1>(tag, raster, cell, b, l, out);
        if constexpr (d == 3) set_axis<2>(tag, raster, cell, b, l, out);
    }
    template <class D, class I, class V = hn::Vec<D>>
    static HWY_INLINE V at_places(D tag, const CellValues& b, std::size_t l, const Table& table, const I (&place)[d],
                                  std::uint32_t& certain) {
        const auto at = [&](int k) HWY_ATTR {
            return Partial<V>{look_up(tag, table.sum[k], place[k]), look_up(tag, table.rest[k], place[k])};
        };
        Partial<V> row = at(1);
        if constexpr (d == 3) row = added(row, at(2));
        return rounded(tag, b, l, added(row, at(0)), certain);
    }

    /// Terms by row.
    struct RowTerms {
        HWY_ALIGN double sum[max_lanes], rest[max_lanes];
    };
    template <class D>
    static HWY_INLINE void set_rows(D tag, const CellBlock<d>& cell, const CellValues& b, std::size_t l,
                                    const Rows& rows, std::size_t at, RowTerms& out) {
        auto t = term<1>(tag, cell, b, l, hn::Load(tag, rows.y + at));
        if constexpr (d == 3) t = added(t, term<2>(tag, cell, b, l, hn::Load(tag, rows.z + at)));
        hn::Store(t.sum, tag, out.sum);
        hn::Store(t.rest, tag, out.rest);
    }
    template <class D, class V = hn::Vec<D>>
    static HWY_INLINE V at_row(D tag, const CellBlock<d>& cell, const CellValues& b, std::size_t l,
                               const RowTerms& rows, std::size_t r, V x, std::uint32_t& certain) {
        const Partial<V> row{hn::Set(tag, rows.sum[r]), hn::Set(tag, rows.rest[r])};
        return rounded(tag, b, l, added(row, term<0>(tag, cell, b, l, x)), certain);
    }
};

/// In plain double, with the bits of those of points; as CorrectValues. Every value is certain, whatever it is.
template <int d>
struct PlainValues {
    struct CellValues {
        HWY_ALIGN double vertex[d + 1][d][max_lanes], value[d + 1][max_lanes];
    };

    template <class D, class V = hn::Vec<D>>
    static HWY_INLINE void set(D tag, const CellMatrix<d, D>&, const V (&v)[d + 1][d], const V (&)[d],
                               const V (&f)[d + 1], CellValues& out) {
        for (int i = 0; i <= d; ++i) {
            for (int k = 0; k < d; ++k) hn::Store(v[i][k], tag, out.vertex[i][k]);
            hn::Store(f[i], tag, out.value[i]);
        }
    }

    template <class D, class V = hn::Vec<D>>
    static HWY_INLINE V value(D tag, const CellValues& b, std::size_t l, const V (&p)[d]) {
        constexpr Simplex s = d == 3 ? Simplex::tetrahedron : Simplex::triangle;
        Relative<s, V> relative;
        for (int i = 0; i <= d; ++i) {
            for (int k = 0; k < d; ++k) relative.r[i][k] = hn::Set(tag, b.vertex[i][k][l]) - p[k];
        }
        return PlainWeights<s, D>(tag, relative).value(tag, [&](int i) HWY_ATTR {
            return hn::Set(tag, b.value[i][l]);
        });
    }

    struct Table {
        HWY_ALIGN double at[d][max_lanes];
    };
    template <class D>
    static HWY_INLINE void set_table(D tag, const Raster& raster, const CellBlock<d>& cell, const CellValues&,
                                     std::size_t l, Table& out) {
        constexpr auto width = static_cast<std::int32_t>(hn::MaxLanes(D()));
        for (int k = 0; k < d; ++k) {
            const double* const from = raster.at[static_cast<std::size_t>(k)].data() + cell.first[k][l];
            for (std::int32_t i = 0; i < box_side; i += width)
                hn::Store(load_some(tag, from + i, cell.last[k][l] - cell.first[k][l] - i), tag, out.at[k] + i);
        }
    }
    template <class D, class I, class V = hn::Vec<D>>
    static HWY_INLINE V at_places(D tag, const CellValues& b, std::size_t l, const Table& table, const I (&place)[d],
                                  std::uint32_t& certain) {
        V p[d];
        for (int k = 0; k < d; ++k) p[k] = look_up(tag, table.at[k], place[k]);
        certain = ~0U;
        return value(tag, b, l, p);
    }

    struct RowTerms {
        double y[max_lanes], z[max_lanes];
    };
    template <class D>
    static HWY_INLINE void set_rows(D, const CellBlock<d>&, const CellValues&, std::size_t, const Rows& rows,
                                    std::size_t at, RowTerms& out) {
        std::copy_n(rows.y + at, hn::MaxLanes(D()), out.y);
        std::copy_n(rows.z + at, hn::MaxLanes(D()), out.z);
    }
    template <class D, class V = hn::Vec<D>>
    static HWY_INLINE V at_row(D tag, const CellBlock<d>&, const CellValues& b, std::size_t l, const RowTerms& rows,
                               std::size_t r, V x, std::uint32_t& certain) {
        V p[d];
        p[0] = x;
        p[1] = hn::Set(tag, rows.y[r]);
        if constexpr (d == 3) p[2] = hn::Set(tag, rows.z[r]);
        certain = ~0U;
        return value(tag, b, l, p);
    }
};

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
