// Internal: error-free transforms on SIMD lanes.
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
// Included once per SIMD target.
#if defined(BARYCERT_CORE_ERROR_FREE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_ERROR_FREE_INL_HPP
#undef BARYCERT_CORE_ERROR_FREE_INL_HPP
#else
#define BARYCERT_CORE_ERROR_FREE_INL_HPP
#endif

#include "barycert/core/simd_targets.hpp"
// After the targets.
#include <hwy/highway.h>

#include "barycert/base/strict_math.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

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

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();
#endif
