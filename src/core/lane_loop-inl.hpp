// Internal: loops over cases on SIMD lanes, which list the cases that are left undecided; some lanes of a vector.
//
// Included once per SIMD target.
#if defined(BARYCERT_CORE_LANE_LOOP_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_LANE_LOOP_INL_HPP
#undef BARYCERT_CORE_LANE_LOOP_INL_HPP
#else
#define BARYCERT_CORE_LANE_LOOP_INL_HPP
#endif

#include "core/simd_targets.hpp"
// After the targets.
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

// A step must be inlined into its loop: as a function it would load every pointer and constant anew for each vector.
#undef BARYCERT_LANE_LAMBDA
#define BARYCERT_LANE_LAMBDA HWY_ATTR __attribute__((always_inline))

HWY_BEFORE_NAMESPACE();
namespace barycert::core::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A bit a lane, that of lane 0 the lowest.
template <class D, class M>
HWY_INLINE std::uint32_t mask_bits(D tag, M mask) {
    static_assert(hn::MaxLanes(D()) <= 16);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, mask, bits);
    return hn::MaxLanes(D()) <= 8 ? bits[0] : bits[0] | static_cast<std::uint32_t>(bits[1]) << 8;
}

/// Numbers of undecided cases, ascending.
struct UndecidedList {
    std::uint32_t* numbers;  ///< room for all cases
    std::size_t count = 0;

    /// Adds those of cases at ... at + used - 1, one a lane, that are not decided.
    template <class D>
    HWY_INLINE void add(D tag, hn::Mask<D> decided, std::size_t at, std::size_t used) {
        if (HWY_LIKELY(hn::AllTrue(tag, decided))) return;
        const std::uint32_t bits = mask_bits(tag, decided);
        for (std::size_t i = 0; i < used; ++i) {
            numbers[count] = static_cast<std::uint32_t>(at + i);
            count += (bits >> i & 1) == 0 ? 1 : 0;
        }
    }
};

/// Runs step(tag, at), which returns the mask of decided lanes, over all cases: whole vectors, then one by one. Lists
/// the undecided cases and returns how many they are.
template <class Step>
HWY_INLINE std::size_t for_lanes(std::size_t count, std::uint32_t* undecided, Step step) {
    UndecidedList list{undecided};
    std::size_t at = 0;
    const auto run = [&](auto tag) BARYCERT_LANE_LAMBDA {
        constexpr std::size_t width = hn::MaxLanes(decltype(tag)());
        for (; at + width <= count; at += width) list.add(tag, step(tag, at), at, width);
    };
    run(hn::ScalableTag<double>());
    run(hn::CappedTag<double, 1>());
    return list.count;
}

/// The same without a tail. Requires: what a step reads and writes has room for a multiple of 8 cases, or count is
/// 1.
template <class Step>
HWY_INLINE std::size_t for_padded_lanes(std::size_t count, std::uint32_t* undecided, Step step) {
    UndecidedList list{undecided};
    const auto run = [&](auto tag) BARYCERT_LANE_LAMBDA {
        constexpr std::size_t width = hn::MaxLanes(decltype(tag)());
        for (std::size_t at = 0; at < count; at += width) list.add(tag, step(tag, at), at, std::min(width, count - at));
    };
    if (count == 1) {
        run(hn::CappedTag<double, 1>());
    } else {
        run(hn::ScalableTag<double>());
    }
    return list.count;
}

/// out[stride * l] = lane l of v.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void store_strided(D tag, V v, double* out, std::size_t stride) {
    if (stride == 1) return hn::StoreU(v, tag, out);
    constexpr std::size_t width = hn::MaxLanes(D());
    HWY_ALIGN double buffer[width];
    hn::Store(v, tag, buffer);
    for (std::size_t l = 0; l < width; ++l) out[stride * l] = buffer[l];
}

// Some lanes of a vector from and to memory, of which nothing behind them is read or written. Highway's MaskedLoad and
// BlendedStore promise as much only where the processor has masks. Elsewhere they read all lanes, and write again what
// they have read: beyond the end of an array, or over what another thread writes there.

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

/// Stores the first `count` lanes. Requires: 0 <= count <= all.
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

}  // namespace barycert::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
