// Internal: error-free transforms on SIMD lanes, and double-double numbers on them, for the middle tier of simplices
// that are projected on.
//
// u = 2^-53, rounding to nearest, no contraction. Each returns fl(x op y) and the exact remainder, itself a double:
//   two_sum        (Knuth)            any x, y; exact unless it overflows: sums never underflow inexactly
//   two_difference the same for x - y
//   quick_two_sum  (Dekker)           needs |x| >= |y| or x = 0
//   two_product    (fused multiply-add, or Dekker with Veltkamp's split where the target has none)
//                                     exact if |x y| >= 2^-969 or x y = 0 (below, the remainder may lie under 2^-1074;
//                                     what is lost is then below 2^-1070), and |x|, |y| <= 2^995 for the split
// The two forms of two_product give the same remainder where it is exact, so results do not depend on the target. Where
// it is not, it lies so far below what it is added to, and below every error bound, that it changes neither.
//
// Double-double. A number is high + low with |low| <= u |high|, u = 2^-53. Errors, while nothing under- or overflows:
//   x + y   at most 4 u^2 (|x| + |y|): the remainder e of the leading sum is exact; adding x.low + y.low rounds by
//           u * u (|x| + |y|), adding e to it by u (u |x + y| + 2 u (|x| + |y|)); the last step is exact.
//   x * y   at most 9 u^2 |x y|: the product of the low parts, u^2, is left out; the two mixed products and their sum
//           round by u^2 + u^2 + 2 u^2, adding the remainder of the leading product by 3 u^2; 1 for terms of order u^3.
//
// Included once per SIMD target.
#if defined(BARYCERT_CORE_ERROR_FREE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_ERROR_FREE_INL_HPP
#undef BARYCERT_CORE_ERROR_FREE_INL_HPP
#else
#define BARYCERT_CORE_ERROR_FREE_INL_HPP
#endif

#include "core/simd_targets.hpp"
// After the targets.
#include <hwy/highway.h>

#include "core/base/strict_math.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct TwoTerms {
    V high, low;  ///< high = fl(high + low)
};

template <class V>
HWY_INLINE TwoTerms<V> two_sum(V x, V y) {
    const V s = x + y;
    const V y_part = s - x;
    const V x_part = s - y_part;
    return {s, (x - x_part) + (y - y_part)};
}

template <class V>
HWY_INLINE TwoTerms<V> two_difference(V x, V y) {
    const V s = x - y;
    const V y_part = x - s;
    const V x_part = s + y_part;
    return {s, (x - x_part) + (y_part - y)};
}

template <class V>
HWY_INLINE TwoTerms<V> quick_two_sum(V x, V y) {
    const V s = x + y;
    return {s, y - (s - x)};
}

/// x = high + low, both of at most 26 bits.
template <class V>
HWY_INLINE TwoTerms<V> split(V x) {
    const V scaled = hn::Set(hn::DFromV<V>(), 0x1p27 + 1) * x;
    const V high = scaled - (scaled - x);
    return {high, x - high};
}

template <class V>
HWY_INLINE TwoTerms<V> two_product(V x, V y) {
    const V p = x * y;
#if HWY_NATIVE_FMA
    return {p, hn::MulSub(x, y, p)};
#else
    const TwoTerms<V> a = split(x), b = split(y);
    return {p, ((a.high * b.high - p) + a.high * b.low + a.low * b.high) + a.low * b.low};
#endif
}

template <class V>
using DoubleDouble = TwoTerms<V>;

// Free templates, not friends: GCC gives friends the baseline's instruction set, and at -O0 their vectors get lost.
template <class V>
HWY_INLINE DoubleDouble<V> operator+(const DoubleDouble<V>& x, const DoubleDouble<V>& y) {
    const TwoTerms<V> s = two_sum(x.high, y.high);
    return two_sum(s.high, s.low + (x.low + y.low));  // not quick: s.high may have cancelled
}
template <class V>
HWY_INLINE DoubleDouble<V> operator-(const DoubleDouble<V>& x, const DoubleDouble<V>& y) {
    return x + DoubleDouble<V>{hn::Neg(y.high), hn::Neg(y.low)};
}
template <class V>
HWY_INLINE DoubleDouble<V> operator*(const DoubleDouble<V>& x, const DoubleDouble<V>& y) {
    const TwoTerms<V> p = two_product(x.high, y.high);
    return quick_two_sum(p.high, p.low + (x.high * y.low + x.low * y.high));
}

}  // namespace barycert::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
