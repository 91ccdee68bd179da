// Internal: the first tier of the signs. Determinants in double, each with a bound on its error.
//
// Let e = 2^-52. In every rounding mode, and also where products are fused or carry more bits, fl(x op y) =
// (x op y)(1 + t) with |t| <= e, as long as nothing underflows. So no assumption on the floating-point environment is
// made here: signs stay exact when somebody has changed it. (Carrying more bits rounds twice: e (1 + 2^-11).)
//
// A formula is a sum of products ("terms") of computed differences. If each term meets k roundings on its way, the
// result is off by at most (number of terms) * (largest product) * ((1+e)^k - 1), where the largest product is taken
// over the axes' extents: X = max |x-difference| and so on, as computed. Roundings counted from the formulas in
// numerators-inl.hpp:
//   tetrahedron, numerator    6 terms; 3 differences, 2 products, 1 + 2 sums      k = 8     6 * 8 = 48   times e X Y Z
//   tetrahedron, denominator  24 terms; two more sums                             k = 10   24 * 10 = 240
//   triangle, numerator       2 terms; 2 differences, 1 product, 1 sum            k = 4     2 * 4 = 8    times e X Y
//   triangle, denominator     6 terms; two more sums                              k = 6     6 * 6 = 36
//   segment                   terms bounded by P below; 2 differences, 1 product, 2 sums        k = 5
//   triangle3d                4 differences, 2 products and 2 sums in the crosses, 1 product, 2 sums   k = 11
// The constants used are larger by at least 2 %: that covers (1+e)^k - 1 > k e, true differences that exceed computed
// ones by (1+e), and the roundings of the bound itself, all together below 1 + 30 e.
// For the projected simplices, R the extents of r and E those of the edges:
//   segment     P = sum over axes of R_k E_k; the denominator is positive unless the ends coincide
//   triangle3d  P = 4 (E_y E_z R_y R_z + E_x E_z R_x R_z + E_x E_y R_x R_y), and Q likewise of E alone for N.N
//
// Underflow and overflow. A product or difference that underflows is off by up to 2^-1021 (operands
// and result flushed to zero). Outside these ranges the filter says "undecided":
//   tetrahedron, triangle   every extent in [2^-300, 2^300]. A lost difference counts 2^-1022 Y Z against e X Y Z with
//                           X >= 2^-300; a lost product of two 2^-1022 Z against e X Y Z; of three 2^-1022 against
//                           2^-52-900. All far below the 2 %. Largest value: 24 * 2^900. (It does not do to look for
//                           infinities instead: rounded toward zero, what overflows is the largest double.)
//   segment                 extents at most 2^300, sum of E_k^2 at least 2^-400: a loss of 2^-1022 * 2^300 against
//                           e P >= 2^-52-401, as 2 R_k >= E_k.
//   triangle3d              extents at most 2^100, Q at least 2^-600, hence P >= 2^-602, as 2 R_k >= E_k: a loss of
//                           2^-1022 * 2^300 in a difference, less elsewhere, against e P >= 2^-654.
// Comparisons are false for NaN. A NaN or infinite coordinate of the point is in every difference of its axis, hence in
// the extent (an infinite one) or in the numerators (NaN, all of them); one of a vertex is in the denominator. So all
// of them give "undecided", though maxima and minima may forget a NaN.
//
// Included once per SIMD target.
#if defined(BARYCERT_CORE_FILTER_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_FILTER_INL_HPP
#undef BARYCERT_CORE_FILTER_INL_HPP
#else
#define BARYCERT_CORE_FILTER_INL_HPP
#endif

#include "core/numerators-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr double filter_epsilon = 0x1p-52;

/// The max of |x| and |y|, and the min: in one instruction where there is one (AVX-512DQ). A NaN may be
/// forgotten.
template <class V>
HWY_INLINE V max_magnitude(V x, V y) {
#if HWY_TARGET == HWY_AVX3
    if constexpr (sizeof(V) == 64) return V{_mm512_range_pd(x.raw, y.raw, 0xb)};
#endif
    return hn::Max(hn::Abs(x), hn::Abs(y));
}
template <class V>
HWY_INLINE V min_magnitude(V x, V y) {
#if HWY_TARGET == HWY_AVX3
    if constexpr (sizeof(V) == 64) return V{_mm512_range_pd(x.raw, y.raw, 0xa)};
#endif
    return hn::Min(hn::Abs(x), hn::Abs(y));
}

/// Max |component| on each axis over `count` vectors.
template <int count, int d, class V>
HWY_INLINE void extents(const V (&vectors)[count][d], V (&out)[d]) {
    for (int k = 0; k < d; ++k) {
        if constexpr (count == 1) {
            out[k] = hn::Abs(vectors[0][k]);
        } else {
            out[k] = max_magnitude(vectors[0][k], vectors[1][k]);
            if constexpr (count == 3) out[k] = hn::Max(out[k], hn::Abs(vectors[2][k]));
            if constexpr (count == 4) out[k] = hn::Max(out[k], max_magnitude(vectors[2][k], vectors[3][k]));
        }
    }
}

/// x in [low, high].
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> within(D tag, V x, double low, double high) {
    return hn::And(hn::Ge(x, hn::Set(tag, low)), hn::Le(x, hn::Set(tag, high)));
}

/// Every x[k] in [low, high].
template <class D, int d, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> all_within(D tag, const V (&x)[d], double low, double high) {
    V min_x = x[0], max_x = x[0];
    for (int k = 1; k < d; ++k) {
        min_x = hn::Min(min_x, x[k]);
        max_x = hn::Max(max_x, x[k]);
    }
    return hn::And(hn::Ge(min_x, hn::Set(tag, low)), hn::Le(max_x, hn::Set(tag, high)));
}

/// E_y E_z R_y R_z + E_x E_z R_x R_z + E_x E_y R_x R_y.
template <class V>
HWY_INLINE V product_of_minors(const V (&e)[3], const V (&r)[3]) {
    const V x = e[0] * r[0], y = e[1] * r[1], z = e[2] * r[2];
    return y * z + x * z + x * y;
}

template <class D>
struct Bounds {
    hn::Vec<D> numerator, denominator;  ///< of the absolute errors
    hn::Mask<D> valid;                  ///< the ranges above hold
};

template <Simplex s, class D, class V = hn::Vec<D>>
HWY_INLINE Bounds<D> filter_bounds(D tag, const Relative<s, V>& c) {
    constexpr int d = space_dimension(s);
    V r[d];
    extents(c.r, r);
    const auto times = [&](double factor, V v) { return hn::Set(tag, factor * filter_epsilon) * v; };
    if constexpr (s == Simplex::tetrahedron) {
        const V product = r[0] * r[1] * r[2];
        return {times(49, product), times(245, product), all_within(tag, r, 0x1p-300, 0x1p300)};
    } else if constexpr (s == Simplex::triangle) {
        const V product = r[0] * r[1];
        return {times(8.5, product), times(37, product), all_within(tag, r, 0x1p-300, 0x1p300)};
    } else {
        V e[d];
        extents(c.e, e);
        const V maxima[] = {hn::Max(hn::Max(r[0], r[1]), r[2]), hn::Max(hn::Max(e[0], e[1]), e[2])};
        if constexpr (s == Simplex::segment) {
            const V p = r[0] * e[0] + r[1] * e[1] + r[2] * e[2];
            const V square = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
            const auto valid = hn::And(all_within(tag, maxima, 0, 0x1p300), hn::Ge(square, hn::Set(tag, 0x1p-400)));
            return {times(5.5, p), hn::Zero(tag), valid};
        } else {
            const V p = product_of_minors(e, r), q = product_of_minors(e, e);
            const auto valid = hn::And(all_within(tag, maxima, 0, 0x1p100), hn::Ge(q, hn::Set(tag, 0x1p-602)));
            return {times(4 * 11.5, p), times(4 * 11.5, q), valid};
        }
    }
}

/// Loads coordinates of the cases from `at` on, relative to their points.
template <Simplex s, class D, class V = hn::Vec<D>>
HWY_INLINE void load_relative(D tag, const double* const* vertices, const double* const* point, std::size_t at,
                              Relative<s, V>& c) {
    constexpr int n = vertex_count(s), d = space_dimension(s);
    for (int k = 0; k < d; ++k) {
        const V p = hn::LoadU(tag, point[k] + at);
        V first = p;
        for (int i = 0; i < n; ++i) {
            const V v = hn::LoadU(tag, vertices[d * i + k] + at);
            c.r[i][k] = v - p;
            if (i == 0) first = v;
            if constexpr (Relative<s, V>::projected) {
                if (i > 0) c.e[i - 1][k] = v - first;
            }
        }
    }
}

/// Packs the signs (see WeightSigns), where they are certain.
template <Simplex s, class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> filter(D tag, const Relative<s, V>& c, hn::Vec<hn::RebindToUnsigned<D>>& packed) {
    const hn::RebindToUnsigned<D> bits;
    Fractions<s, V> f;
    solve(c, hn::Zero(tag), f);
    const Bounds<D> bound = filter_bounds<s>(tag, c);
    const auto& n = f.numerator;
    V min_numerator = min_magnitude(n[0], n[1]);
    if constexpr (vertex_count(s) == 3) min_numerator = hn::Min(min_numerator, hn::Abs(n[2]));
    if constexpr (vertex_count(s) == 4) min_numerator = hn::Min(min_numerator, min_magnitude(n[2], n[3]));
    const auto certain = hn::And(hn::And(bound.valid, hn::Gt(min_numerator, bound.numerator)),
                                 hn::Gt(hn::Abs(f.denominator), bound.denominator));
    // Sign bits of the numerators to bits 0 to 3; if the denominator is negative all of them flip, and bit 8 is set.
    const auto sign_to_bit = [&](int i) HWY_ATTR {
        return hn::And(hn::ShiftRightSame(hn::BitCast(bits, f.numerator[i]), 63 - i), hn::Set(bits, 1u << i));
    };
    packed = hn::ShiftRight<63>(hn::BitCast(bits, f.numerator[0]));
    for (int i = 1; i < vertex_count(s); ++i) packed = hn::Or(packed, sign_to_bit(i));
    const hn::RebindToSigned<D> integers;
    const auto flip = hn::BitCast(bits, hn::BroadcastSignBit(hn::BitCast(integers, f.denominator)));
    constexpr std::uint64_t all = 0x100 | ((1u << vertex_count(s)) - 1);
    packed = hn::Xor(packed, hn::And(flip, hn::Set(bits, all)));
    return certain;
}

}  // namespace barycert::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
