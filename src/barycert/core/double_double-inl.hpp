// Internal: double-double numbers on SIMD lanes, for the middle tier of simplices that are projected on.
//
// A number is high + low with |low| <= u |high|, u = 2^-53. Errors, while nothing under- or overflows:
//   x + y   at most 4 u^2 (|x| + |y|): the remainder e of the leading sum is exact; adding x.low + y.low rounds by
//           u * u (|x| + |y|), adding e to it by u (u |x + y| + 2 u (|x| + |y|)); the last step is exact.
//   x * y   at most 9 u^2 |x y|: the product of the low parts, u^2, is left out; the two mixed products and their sum
//           round by u^2 + u^2 + 2 u^2, adding the remainder of the leading product by 3 u^2; 1 for terms of order u^3.
//
// Included once per SIMD target.
#if defined(BARYCERT_CORE_DOUBLE_DOUBLE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_DOUBLE_DOUBLE_INL_HPP
#undef BARYCERT_CORE_DOUBLE_DOUBLE_INL_HPP
#else
#define BARYCERT_CORE_DOUBLE_DOUBLE_INL_HPP
#endif

#include "barycert/core/error_free-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

template <class V>
struct DoubleDouble {
    V high, low;
};

// Free templates, not friends: GCC gives friends the baseline's instruction set, and at -O0 their vectors get lost.
template <class V>
HWY_INLINE DoubleDouble<V> operator+(const DoubleDouble<V>& x, const DoubleDouble<V>& y) {
    const TwoTerms<V> s = two_sum(x.high, y.high);
    const TwoTerms<V> r = two_sum(s.high, s.low + (x.low + y.low));  // not quick: s.high may have cancelled
    return {r.high, r.low};
}
template <class V>
HWY_INLINE DoubleDouble<V> operator-(const DoubleDouble<V>& x, const DoubleDouble<V>& y) {
    return x + DoubleDouble<V>{hn::Neg(y.high), hn::Neg(y.low)};
}
template <class V>
HWY_INLINE DoubleDouble<V> operator*(const DoubleDouble<V>& x, const DoubleDouble<V>& y) {
    const TwoTerms<V> p = two_product(x.high, y.high);
    const TwoTerms<V> r = quick_two_sum(p.high, p.low + (x.high * y.low + x.low * y.high));
    return {r.high, r.low};
}

/// x - y, exactly.
template <class V>
HWY_INLINE DoubleDouble<V> difference(V x, V y) {
    const TwoTerms<V> d = two_difference(x, y);
    return {d.high, d.low};
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();
#endif
