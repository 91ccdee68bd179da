// Internal: the values of a linear field along the rows of a grid in a cell, from its refined gradient.
//
// Notation as in fill_rows-inl.hpp.
//
// Values. V(p) = f_o + sum_k g_k (w_k + t_k), where p_k - o_k = w_k + t_k exactly and g_k = y_k + c_k up to eta_k
// (gradient-inl.hpp). Let M = |f_o| + sum |y_k| X_k, C = sum |c_k| X_k. The sum of f_o and the products y_k w_k runs
// through two_sum and two_product: 3 + 3 remainders of at most 1.001 u M and u M together; y_k t_k, in double, <= u M
// together, c_k w_k <= C: their plain sum rounds by at most 11 u (5.1 u M + C) 1.001, the products by u^2 M + u C, and
// c_k t_k, left out, is below u C. Adding the error in the end rounds by u (5.1 u M + C) once more, for each sign. So
//   error = 1.01 sum eta_k X_k + 80 u^2 M + 20 u C
// bounds all that is lost. Ranges: M <= 2^900, so nothing overflows; and error >= 2^-960, or M = C = 0, as
// underflow takes at most 2^-1070 in each of some 20 operations.
//
// Included once per SIMD target.
#if defined(BARYCERT_SAMPLE_FILL_VALUES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_SAMPLE_FILL_VALUES_INL_HPP
#undef BARYCERT_SAMPLE_FILL_VALUES_INL_HPP
#else
#define BARYCERT_SAMPLE_FILL_VALUES_INL_HPP
#endif

#include "barycert/sample/grid/fill_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample {
namespace HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;

/// Of each component.
struct ValueBlock {
    HWY_ALIGN double at_origin[max_lanes], plain[3][max_lanes], correction[3][max_lanes], error[max_lanes];
    HWY_ALIGN double valid[max_lanes];  ///< 1 or 0
};

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

/// Of a component, by row.
struct RowTerms {
    HWY_ALIGN double sum[max_lanes], rest[max_lanes];
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
    HWY_ALIGN double lanes[max_lanes];
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

}  // namespace HWY_NAMESPACE
}  // namespace barycert::sample
HWY_AFTER_NAMESPACE();
#endif
