#include "barycert/locate/cells_at_points_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/locate/cells_at_points_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include <algorithm>
#include <bit>

HWY_BEFORE_NAMESPACE();
namespace barycert::locate {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using locate::CellBins;
using locate::CellBlock;
using locate::PointBins;

/// A bit in `near` for each of the cells of these corners that may be near, and the codes of their lowest and highest
/// bins. False if a corner is no node.
template <std::size_t n, class D>
HWY_INLINE bool look(D tag, const Mesh::Index* corner, const CellBlock& block, const PointBins& bins, std::int32_t* low,
                     std::int32_t* high, std::uint64_t& near) {
    using V = hn::Vec<D>;
    V node[n], code[n];
    if constexpr (n == 4) {
        hn::LoadInterleaved4(tag, corner, node[0], node[1], node[2], node[3]);
    } else {
        hn::LoadInterleaved3(tag, corner, node[0], node[1], node[2]);
    }
    const V last = hn::Set(tag, static_cast<std::int32_t>(block.codes.size() - 1));
    auto wrong = hn::MaskFromVec(hn::Zero(tag));
    for (const V& v : node) wrong = hn::Or(wrong, hn::Or(hn::Lt(v, hn::Zero(tag)), hn::Gt(v, last)));
    if (!hn::AllFalse(tag, wrong)) return false;
    for (std::size_t i = 0; i < n; ++i) code[i] = hn::GatherIndex(tag, block.codes.data(), node[i]);

    const V byte = hn::Set(tag, 0xFF), one = hn::Set(tag, 1), thirty_one = hn::Set(tag, 31);
    V lowest[3], highest[3];
    for (int k = 0; k < 3; ++k) {
        V places[n];
        for (std::size_t i = 0; i < n; ++i) places[i] = hn::And(hn::ShiftRightSame(code[i], 8 * k), byte);
        lowest[k] = highest[k] = places[0];
        for (std::size_t i = 1; i < n; ++i) {
            lowest[k] = hn::Min(lowest[k], places[i]);
            highest[k] = hn::Max(highest[k], places[i]);
        }
    }
    // Where the cell spans at most two bins of a level an axis, the level has the answer; where none does, none.
    auto found = hn::MaskFromVec(hn::Zero(tag));
    auto open = hn::Not(found);
    for (std::size_t level = 0; level < PointBins::levels && !hn::AllFalse(tag, open); ++level) {
        const int bits = bins.bits(level);
        V number = hn::Zero(tag);
        auto fits = open;
        for (int k = 0; k < 3; ++k) {
            const V a = hn::ShiftRightSame(lowest[k], static_cast<int>(level));
            const V b = hn::ShiftRightSame(highest[k], static_cast<int>(level));
            fits = hn::And(fits, hn::Not(hn::Gt(hn::Sub(b, a), one)));
            number = hn::Or(number, hn::ShiftLeftSame(a, bits * k));
        }
        const V word = hn::GatherIndex(tag, bins.near(level), hn::ShiftRight<5>(number));
        const V bit = hn::And(word >> hn::And(number, thirty_one), one);
        found = hn::Or(found, hn::And(fits, hn::Eq(bit, one)));
        open = hn::AndNot(fits, open);
    }
    found = hn::Or(found, open);
    std::uint8_t mask[8] = {};
    hn::StoreMaskBits(tag, found, mask);
    near = 0;
    for (std::size_t i = 0; i < (hn::MaxLanes(tag) + 7) / 8; ++i) near |= static_cast<std::uint64_t>(mask[i]) << 8 * i;
    if constexpr (hn::MaxLanes(D()) < 8) near &= (1U << hn::MaxLanes(D())) - 1;
    if (near == 0) return true;
    const auto packed = [&](const V(&v)[3])
                            HWY_ATTR { return hn::Or(v[0], hn::Or(hn::ShiftLeft<8>(v[1]), hn::ShiftLeft<16>(v[2]))); };
    hn::Store(packed(lowest), tag, low);
    hn::Store(packed(highest), tag, high);
    return true;
}

template <std::size_t n>
std::optional<std::size_t> find_near_corners(const CellBlock& block, const PointBins& bins, CellBins* out) {
    const hn::ScalableTag<std::int32_t> tag;
    constexpr std::size_t width = hn::MaxLanes(hn::ScalableTag<std::int32_t>());
    HWY_ALIGN std::int32_t low[width], high[width];
    CellBins* const begin = out;
    for (std::size_t at = 0; at < block.count; at += width) {
        const std::size_t count = std::min(width, block.count - at);
        const Mesh::Index* corner = block.corner + n * at;
        Mesh::Index padded[n * width];
        if (count < width) {  // filled up with the first of them
            for (std::size_t i = 0; i < n * width; ++i) padded[i] = corner[i < n * count ? i : i % n];
            corner = padded;
        }
        std::uint64_t near = 0;
        if (!look<n>(tag, corner, block, bins, low, high, near)) return std::nullopt;
        if (count < width) near &= (std::uint64_t{1} << count) - 1;
        for (; near != 0; near &= near - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(near));
            *out++ = {static_cast<std::uint32_t>(at + lane), static_cast<std::uint32_t>(low[lane]),
                      static_cast<std::uint32_t>(high[lane])};
        }
    }
    return static_cast<std::size_t>(out - begin);
}

std::optional<std::size_t> find_near(const CellBlock& block, const PointBins& bins, CellBins* out) {
    return block.corners == 4 ? find_near_corners<4>(block, bins, out) : find_near_corners<3>(block, bins, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::locate
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::locate {

HWY_EXPORT(find_near);

std::optional<std::size_t> find_near(const CellBlock& block, const PointBins& bins, CellBins* out) {
    return HWY_DYNAMIC_DISPATCH(find_near)(block, bins, out);
}

}  // namespace barycert::locate
#endif
