// States of the corners of cells, on SIMD lanes.
#include "barycert/surface/parts.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/surface/state_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include <hwy/highway.h>

#include <bit>

#include "barycert/surface/cell_cases.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::surface::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Of cells whose corners are all alike, none has a part of the cut. At the end, less than a vector of cells is left to
/// the caller.
template <std::size_t n>
std::size_t mixed(const Mesh::Index* corners, std::size_t count, const States& states, std::uint32_t* out) {
    const hn::ScalableTag<std::int32_t> tag;
    const hn::RebindToUnsigned<decltype(tag)> numbers;
    constexpr std::uint32_t first = std::endian::native == std::endian::little ? 0 : 3;  // of the bytes of a word
    const auto nodes = hn::Set(numbers, static_cast<std::uint32_t>(states.count));
    const std::size_t lanes = hn::Lanes(tag);
    std::size_t found = 0, cell = 0;
    for (; cell + lanes <= count; cell += lanes) {
        auto a = hn::Zero(tag), b = a, c = a, d = a;
        if constexpr (n == 4) {
            hn::LoadInterleaved4(tag, corners + n * cell, a, b, c, d);
        } else {
            hn::LoadInterleaved3(tag, corners + n * cell, a, b, c);
            d = c;
        }
        const auto last = [&](auto x, auto y)
                              HWY_ATTR { return hn::Max(hn::BitCast(numbers, x), hn::BitCast(numbers, y)); };
        if (!hn::AllTrue(numbers, hn::Lt(hn::Max(last(a, b), last(c, d)), nodes))) return no_node;
        const auto state = [&](auto node) HWY_ATTR {
            const auto byte = hn::And(hn::BitCast(numbers, node), hn::Set(numbers, 3));
            return hn::Shr(hn::GatherIndex(numbers, states.words.data(), hn::ShiftRight<2>(node)),
                           hn::ShiftLeft<3>(hn::Xor(byte, hn::Set(numbers, first))));
        };
        const auto sa = state(a), sb = state(b), sc = state(c), sd = state(d);
        const auto low = hn::Set(numbers, 3);
        const auto all = hn::And(hn::And(hn::And(sa, sb), hn::And(sc, sd)), low);
        const auto any = hn::And(hn::Or(hn::Or(sa, sb), hn::Or(sc, sd)), low);
        const auto mask = hn::Or(hn::Ne(all, any), hn::Eq(all, hn::Set(numbers, unknown)));
        found += hn::CompressStore(hn::Iota(numbers, static_cast<std::uint32_t>(cell)), mask, numbers, out + found);
    }
    if (!indices_fit({corners + n * cell, n * (count - cell)}, states.count)) return no_node;
    for (; cell < count; ++cell) out[found++] = static_cast<std::uint32_t>(cell);
    return found;
}

std::size_t find_mixed(const Mesh::Index* corners, std::size_t n, std::size_t count, const States& states,
                       std::uint32_t* out) {
    return n == 4 ? mixed<4>(corners, count, states, out) : mixed<3>(corners, count, states, out);
}

}  // namespace barycert::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::surface {

HWY_EXPORT(find_mixed);

std::size_t mixed_cells(const Mesh::Index* corners, std::size_t n, std::size_t count, const States& states,
                        std::uint32_t* out) {
    return HWY_DYNAMIC_DISPATCH(find_mixed)(corners, n, count, states, out);
}

}  // namespace barycert::surface
#endif
