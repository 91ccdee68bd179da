// Internal: records of four doubles into vectors, one record a lane; which boxes of a group meet another.
//
// Included once per SIMD target.
#if defined(BARYCERT_INDEX_RECORDS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_INDEX_RECORDS_INL_HPP
#undef BARYCERT_INDEX_RECORDS_INL_HPP
#else
#define BARYCERT_INDEX_RECORDS_INL_HPP
#endif

#include "core/simd_targets.hpp"
// After the targets.
#include <hwy/highway.h>

#include <cstddef>
#include <cstring>

#include "core/lane_loop-inl.hpp"
#include "mesh/index/cell_tree.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::index::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// out[k], lane l = address(l)[k]. Addresses are multiples of 32. A transpose: on most processors faster than gathers.
template <class D, class Address, class V = hn::Vec<D>>
HWY_INLINE void load_records(D tag, Address address, V (&out)[4]) {
    constexpr std::size_t width = hn::MaxLanes(D());
#if HWY_TARGET <= HWY_AVX2
    if constexpr (width == 8) {
        const hn::Half<D> row;
        const auto rows = [&](std::size_t l) HWY_ATTR {
            return hn::Combine(tag, hn::Load(row, address(l + 4)), hn::Load(row, address(l)));
        };
        const V r0 = rows(0), r1 = rows(1), r2 = rows(2), r3 = rows(3);
        const V low01 = hn::InterleaveLower(tag, r0, r1), high01 = hn::InterleaveUpper(tag, r0, r1);
        const V low23 = hn::InterleaveLower(tag, r2, r3), high23 = hn::InterleaveUpper(tag, r2, r3);
        out[0] = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(low23), low01);
        out[1] = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(high23), high01);
        out[2] = hn::OddEvenBlocks(low23, hn::SwapAdjacentBlocks(low01));
        out[3] = hn::OddEvenBlocks(high23, hn::SwapAdjacentBlocks(high01));
    } else if constexpr (width == 4) {
        const V r0 = hn::Load(tag, address(0)), r1 = hn::Load(tag, address(1));
        const V r2 = hn::Load(tag, address(2)), r3 = hn::Load(tag, address(3));
        const V low01 = hn::InterleaveLower(tag, r0, r1), high01 = hn::InterleaveUpper(tag, r0, r1);
        const V low23 = hn::InterleaveLower(tag, r2, r3), high23 = hn::InterleaveUpper(tag, r2, r3);
        out[0] = hn::ConcatLowerLower(tag, low23, low01);
        out[1] = hn::ConcatLowerLower(tag, high23, high01);
        out[2] = hn::ConcatUpperUpper(tag, low23, low01);
        out[3] = hn::ConcatUpperUpper(tag, high23, high01);
    } else
#endif
    {
        HWY_ALIGN double rows[4][width];
        for (std::size_t l = 0; l < width; ++l) {
            double from[4];
            std::memcpy(from, address(l), sizeof from);
            for (std::size_t k = 0; k < 4; ++k) rows[k][l] = from[k];
        }
        for (std::size_t k = 0; k < 4; ++k) out[k] = hn::Load(tag, rows[k]);
    }
}

/// BoxGroup::meeting, of vectors of the target.
HWY_INLINE std::uint32_t meeting(const BoxGroup& group, const CellBox& box) {
    const hn::CappedTag<std::int32_t, 8> tag;
    std::uint32_t bits = 0;
    for (std::size_t l = 0; l < 8; l += hn::MaxLanes(tag)) {
        auto apart = hn::Zero(tag);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto over = hn::Sub(hn::Set(tag, box.high[k]), hn::Load(tag, group.low[k].data() + l));
            const auto under = hn::Sub(hn::Load(tag, group.high[k].data() + l), hn::Set(tag, box.low[k]));
            apart = hn::Or(apart, hn::Or(over, under));
        }
        bits |= core::HWY_NAMESPACE::mask_bits(tag, hn::Gt(apart, hn::Set(tag, -1))) << l;
    }
    return bits;
}

}  // namespace barycert::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
