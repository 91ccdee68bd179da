// Internal: some lanes of a vector from and to memory, of which nothing behind them is read or written.
//
// Highway's MaskedLoad and BlendedStore promise as much only where the processor has masks. Elsewhere they read all
// lanes, and write again what they have read: beyond the end of an array, or over what another thread writes there.
//
// Included once per SIMD target.
#if defined(BARYCERT_CORE_PARTIAL_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_PARTIAL_LANES_INL_HPP
#undef BARYCERT_CORE_PARTIAL_LANES_INL_HPP
#else
#define BARYCERT_CORE_PARTIAL_LANES_INL_HPP
#endif

#include "barycert/core/simd_targets.hpp"
// After the targets.
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// `count` numbers from `from` on, as many as a vector has at most; zeros behind them. None if the count is negative.
template <class D>
HWY_INLINE hn::Vec<D> load_some(D tag, const hn::TFromD<D>* from, std::int32_t count) {
    static_assert(sizeof(hn::TFromD<D>) >= 4);  // AVX2 has no masks for smaller ones
    const auto some = static_cast<std::size_t>(std::max(count, 0));
#if HWY_TARGET <= HWY_AVX2
    return hn::MaskedLoad(hn::FirstN(tag, some), tag, from);
#else
    HWY_ALIGN hn::TFromD<D> lanes[hn::MaxLanes(D())] = {};
    std::copy_n(from, std::min(some, hn::MaxLanes(D())), lanes);
    return hn::Load(tag, lanes);
#endif
}

/// Stores the first `count` lanes. Precondition: 0 <= count <= all.
template <class D>
HWY_INLINE void store_some(D tag, hn::Vec<D> value, hn::TFromD<D>* to, std::int32_t count) {
    static_assert(sizeof(hn::TFromD<D>) >= 4);
    const auto some = static_cast<std::size_t>(count);
#if HWY_TARGET <= HWY_AVX3
    hn::BlendedStore(value, hn::FirstN(tag, some), tag, to);
#else
    // With AVX2, too, where a store under a mask is slow on some processors.
    if (some >= hn::MaxLanes(D())) return hn::StoreU(value, tag, to);
    HWY_ALIGN hn::TFromD<D> lanes[hn::MaxLanes(D())];
    hn::Store(value, tag, lanes);
    std::copy_n(lanes, some, to);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();

#endif
