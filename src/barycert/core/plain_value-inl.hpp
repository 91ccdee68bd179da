// Internal: the value of a linear field in plain double, on SIMD lanes. The one formula of batches, points and grids,
// so that a value has the same bits from each of them.
//
// Included once per SIMD target.
#if defined(BARYCERT_CORE_PLAIN_VALUE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_PLAIN_VALUE_INL_HPP
#undef BARYCERT_CORE_PLAIN_VALUE_INL_HPP
#else
#define BARYCERT_CORE_PLAIN_VALUE_INL_HPP
#endif

#include "barycert/core/simd_targets.hpp"
// After the targets.
#include <hwy/highway.h>

#include <limits>

#include "barycert/core/numerators-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <Simplex s, class D>
struct PlainWeights {
    using V = hn::Vec<D>;
    Fractions<s, V> f;
    V inverse;

    HWY_INLINE PlainWeights(D tag, const Relative<s, V>& relative) {
        solve(relative, hn::Zero(tag), f);
        inverse = hn::Set(tag, 1) / f.denominator;
    }

    /// nodal(i): the values at vertex i. There is one NaN: its sign and payload would tell in which order a compiler
    /// has the operands of a sum or product.
    template <class Nodal>
    HWY_INLINE V value(D tag, const Nodal& nodal) const {
        V sum = hn::Zero(tag);
        for (int i = 0; i < vertex_count(s); ++i) sum = sum + f.numerator[i] * nodal(i);
        const V value = sum * inverse;
        return hn::IfThenElse(hn::IsNaN(value), hn::Set(tag, std::numeric_limits<double>::quiet_NaN()), value);
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();
#endif
