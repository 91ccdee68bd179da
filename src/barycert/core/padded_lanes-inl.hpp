// Internal: a loop over cases on SIMD lanes whose arrays are padded, so that it has no tail.
//
// Included once per SIMD target.
#if defined(BARYCERT_CORE_PADDED_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_PADDED_LANES_INL_HPP
#undef BARYCERT_CORE_PADDED_LANES_INL_HPP
#else
#define BARYCERT_CORE_PADDED_LANES_INL_HPP
#endif

#include "barycert/core/simd_targets.hpp"
// After the targets.
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace barycert {
namespace HWY_NAMESPACE {

/// Runs `step(tag, at)`, which returns the mask of decided lanes, over `count` cases, and lists those that are not
/// decided. Precondition: what a step reads and writes has room for a multiple of 8 cases, or count is 1.
template <class Step>
HWY_INLINE std::size_t for_padded_lanes(std::size_t count, std::uint32_t* undecided, Step step) {
    namespace hn = hwy::HWY_NAMESPACE;
    std::size_t found = 0;
    const auto run = [&](auto tag) HWY_ATTR __attribute__((always_inline)) {
        using D = decltype(tag);
        constexpr std::size_t width = hn::MaxLanes(D());
        static_assert(width <= 8);
        for (std::size_t at = 0; at < count; at += width) {
            const hn::Mask<D> decided = step(tag, at);
            if (HWY_LIKELY(hn::AllTrue(tag, decided))) continue;
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(tag, decided, bits);
            for (std::size_t i = 0; i < width && at + i < count; ++i) {
                undecided[found] = static_cast<std::uint32_t>(at + i);
                found += (bits[0] >> i & 1) == 0 ? 1 : 0;
            }
        }
    };
    if (count == 1) {
        run(hn::CappedTag<double, 1>());
    } else {
        run(hn::ScalableTag<double>());
    }
    return found;
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert
HWY_AFTER_NAMESPACE();
#endif
