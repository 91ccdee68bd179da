// Internal: the double-double tier of perspective-correct interpolation, many points of one triangle on SIMD lanes.
//
// Notation of numerators-inl.hpp for the triangle in the window, w_i its depths; W_i = w_j w_k, exact in two doubles.
//   m_i = n_i W_i,  m = sum m_i,  d = sum n_i;  a weight is m_i / m, a value sum m_i f_i / m, the depth d w_0 W_0 / m.
//
// Bounds, u = 2^-53, errors of the operations as in error_free-inl.hpp: a product 9 u^2, a sum 4 u^2 of the
// magnitudes. R_x, R_y: the largest |v_i - p| along the axes, P = 2 R_x R_y >= the two products of a numerator.
//   n_i           2 products, 1 sum: (9 + 4) u^2 P             13 u^2 P
//   d             3 of them, 2 sums: 39 + 8 * 3                63 u^2 P
//   m_i           that of n_i and a product: 13 + 9            22 u^2 P W_i
//   m             three, 2 sums: 22 + 8                        30 u^2 P S,  S = sum W_i
//   sum m_i f_i   22 and a product 9, 2 sums 8                 39 u^2 P sum W_i |f_i|
//   d w_0 W_0     63 and two products of 3 P: 27 + 27          117 u^2 P w_0 W_0
// The quotient q of numerator and m, E their errors: s = fl(N.high / m.high) and the correction c = (N - s m) / m.high
// obey, as in refinement-inl.hpp (where c is derived for triangles in space),
//   |N / m - (s + c)| <= 1.01 (E_N + |s| E_m) / |m.high| + 25 u^2 |s|   if E_m <= 2^-10 |m.high|,
// of which 1.02 and 26 leave room for the roundings of the bound and for u^3. Then m is not zero, so that there are
// weights unless the area is zero, which does not show in m: that |d| > 65 u^2 P is asked for besides.
//
// Ranges; outside them nothing is certain: R_x, R_y in [2^-200, 2^200], depths in [2^-100, 2^100], the largest |f_i| in
// [2^-200, 2^200] or zero, |s| in [2^-800, 2^900] (or all f_i zero). So 2^-399 <= P <= 2^401, W_i in [2^-200, 2^200],
// and no product exceeds 2^807. Underflow loses at most 2^-1070 an operation, against 0.1 u^2 P W_i F >= 2^-909 (F the
// largest value); |m.high| >= 2^10 * 30 u^2 P S > 2^-691. N.high below 2^-969, where s m is not split exactly, is less
// than E_N unless all values are zero, so that the sign and with it the rounding are uncertain.
//
// Included once per SIMD target.
#if defined(BARYCERT_CORE_PERSPECTIVE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_PERSPECTIVE_INL_HPP
#undef BARYCERT_CORE_PERSPECTIVE_INL_HPP
#else
#define BARYCERT_CORE_PERSPECTIVE_INL_HPP
#endif

#include "core/refinement-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::HWY_NAMESPACE {

template <class D>
struct ProjectedLanes {
    using V = hn::Vec<D>;
    using Number = DoubleDouble<V>;
    Number numerator[3];       ///< m_i
    Number denominator, area;  ///< m, d
    V product[3];              ///< W_i, rounded
    V depth0;                  ///< w_0
    Number product0;           ///< W_0
    V p;                       ///< u^2 P
    V denominator_error, inverse;
    hn::Mask<D> valid;
};

/// `vertices` are x, y, w of three vertices.
template <class D, class V = hn::Vec<D>>
HWY_INLINE ProjectedLanes<D> project_lanes(D tag, const double* vertices, V x, V y) {
    constexpr double u = 0x1p-53;
    using Number = DoubleDouble<V>;
    const auto constant = [&](double a) { return hn::Set(tag, a); };
    ProjectedLanes<D> out;
    const V point[2] = {x, y};
    Relative<Simplex::triangle, Number> c;
    V extent[2];
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < 3; ++i) c.r[i][k] = two_difference(constant(vertices[3 * i + k]), point[k]);
        extent[k] = hn::Max(hn::Max(hn::Abs(c.r[0][k].high), hn::Abs(c.r[1][k].high)), hn::Abs(c.r[2][k].high));
    }
    Fractions<Simplex::triangle, Number> window;
    solve(c, Number{hn::Zero(tag), hn::Zero(tag)}, window);
    V sum = hn::Zero(tag);
    for (int i = 0; i < 3; ++i) {
        const Number both =
            two_product(constant(vertices[3 * ((i + 1) % 3) + 2]), constant(vertices[3 * ((i + 2) % 3) + 2]));
        if (i == 0) out.product0 = both;
        out.product[i] = both.high;
        out.numerator[i] = window.numerator[i] * both;
        sum = sum + both.high;
    }
    out.depth0 = constant(vertices[2]);
    out.area = window.denominator;
    out.denominator = out.numerator[0] + out.numerator[1] + out.numerator[2];
    out.p = constant(2 * u * u) * (extent[0] * extent[1]);
    out.denominator_error = constant(30) * (out.p * sum);
    out.inverse = constant(1) / out.denominator.high;
    out.valid = hn::And(within(tag, extent[0], 0x1p-200, 0x1p200), within(tag, extent[1], 0x1p-200, 0x1p200));
    out.valid = hn::And(out.valid, hn::Le(out.denominator_error, constant(0x1p-10) * hn::Abs(out.denominator.high)));
    out.valid = hn::And(out.valid, hn::Gt(hn::Abs(out.area.high), constant(65) * out.p));
    for (int i = 0; i < 3; ++i)
        out.valid = hn::And(out.valid, within(tag, constant(vertices[3 * i + 2]), 0x1p-100, 0x1p100));
    return out;
}

/// A quotient as plain + correction, no farther than `error` from the exact one where valid.
template <class D>
struct QuotientLanes {
    hn::Vec<D> plain, correction, error;
    hn::Mask<D> valid;
};

/// numerator / m. `error` is that of the numerator; `all_zero`: it is exactly zero.
template <class D, class V = hn::Vec<D>>
HWY_INLINE QuotientLanes<D> divided(D tag, const ProjectedLanes<D>& q, const DoubleDouble<V>& numerator, V error,
                                    hn::Mask<D> all_zero) {
    constexpr double u = 0x1p-53;
    const auto constant = [&](double a) { return hn::Set(tag, a); };
    QuotientLanes<D> out;
    out.plain = numerator.high / q.denominator.high;
    const TwoTerms<V> p = two_product(out.plain, q.denominator.high);
    const V rest = ((numerator.high - p.high) - p.low) + (numerator.low - out.plain * q.denominator.low);
    const V size = hn::Abs(out.plain);
    out.correction = rest * q.inverse;
    out.error =
        constant(1.02) * ((error + size * q.denominator_error) * hn::Abs(q.inverse)) + constant(26 * u * u) * size;
    out.valid = hn::And(q.valid, hn::Or(within(tag, size, 0x1p-800, 0x1p900), all_zero));
    return out;
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE QuotientLanes<D> perspective_weight(D tag, const ProjectedLanes<D>& q, int i) {
    return divided(tag, q, q.numerator[i], hn::Set(tag, 22) * (q.p * q.product[i]), hn::MaskFromVec(hn::Zero(tag)));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE QuotientLanes<D> perspective_depth(D tag, const ProjectedLanes<D>& q) {
    const DoubleDouble<V> numerator = (q.area * q.product0) * DoubleDouble<V>{q.depth0, hn::Zero(tag)};
    return divided(tag, q, numerator, hn::Set(tag, 117) * (q.p * (q.product[0] * q.depth0)),
                   hn::MaskFromVec(hn::Zero(tag)));
}

/// f: the values at the three vertices.
template <class D, class V = hn::Vec<D>>
HWY_INLINE QuotientLanes<D> perspective_value(D tag, const ProjectedLanes<D>& q, const V (&f)[3]) {
    const auto product = [&](int i) { return q.numerator[i] * DoubleDouble<V>{f[i], hn::Zero(tag)}; };
    const DoubleDouble<V> numerator = product(0) + product(1) + product(2);
    V sum = hn::Zero(tag), max = hn::Zero(tag);
    for (int i = 0; i < 3; ++i) {
        sum = sum + q.product[i] * hn::Abs(f[i]);
        max = hn::Max(max, hn::Abs(f[i]));
    }
    const auto zero = hn::Eq(max, hn::Zero(tag));
    QuotientLanes<D> out = divided(tag, q, numerator, hn::Set(tag, 39) * (q.p * sum), zero);
    out.valid = hn::And(out.valid, hn::Or(zero, within(tag, max, 0x1p-200, 0x1p200)));
    return out;
}

/// Correctly rounded, where certain. The correction less or plus the error rounds by u of both: 2 u of the first are
/// added to the error, 1.02 and 26 have room for the second.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V rounded_quotient(D tag, const QuotientLanes<D>& q, hn::Mask<D>& certain) {
    certain = hn::And(certain, q.valid);
    const V error = q.error + hn::Set(tag, 0x1p-52) * hn::Abs(q.correction);
    // + 0: an exact zero is positive.
    return rounded_if_certain<D>(q.plain, q.correction, error, certain) + hn::Zero(tag);
}

}  // namespace barycert::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
