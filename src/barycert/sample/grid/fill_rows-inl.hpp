// Internal: where each row of a grid enters and leaves a cell.
//
// Notation as in fill_box-inl.hpp. Along a row only w_x changes, as a real number: l_j = a_j + S_jx w_x up to E, so a
// point with a_j + S_jx w_x < -E for some j is certainly outside, and one with > E for all j certainly inside. Solved
// for the place along the row, t = (o_x + w_x - origin) / spacing, these are intervals, whose ends are off by less than
// raster.slack, for where |S_jx| X_x > E no end that matters is more than a few extents from the cell: so much is added
// outside and taken off inside. Where |S_jx| X_x <= E, the weight is a_j up to E along the row, and nothing is solved:
// certainly outside below -2 E, certainly inside above 2 E.
//
// Included once per SIMD target.
#if defined(BARYCERT_SAMPLE_FILL_ROWS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_SAMPLE_FILL_ROWS_INL_HPP
#undef BARYCERT_SAMPLE_FILL_ROWS_INL_HPP
#else
#define BARYCERT_SAMPLE_FILL_ROWS_INL_HPP
#endif

#include "barycert/sample/grid/fill_box-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

/// Of each plane, by cell of a block: the weight along a row at (w_y, w_z) is a = constant + sy w_y + sz w_z at w_x =
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

/// Of the cells of a block, the weights along rows.
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

/// What MaxLanes of them have in common with the cell.
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

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
