// Which cells have corners in the set and outside. Indices are checked on SIMD lanes. Bits are loaded one by one:
// gathers are not faster, and one bit a node leaves most of them in the first cache.
#include "barycert/surface/parts.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/surface/state_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include <hwy/highway.h>

#include <algorithm>

#include "barycert/surface/cell_cases.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::surface::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Whether all are nodes: a negative index is a large one.
bool all_fit(const Mesh::Index* indices, std::size_t count, std::uint32_t nodes) {
    const hn::ScalableTag<std::int32_t> tag;
    const hn::RebindToUnsigned<decltype(tag)> numbers;
    const std::size_t lanes = hn::Lanes(tag);
    auto most = hn::Zero(numbers), next = most;
    std::size_t i = 0;
    for (; i + 2 * lanes <= count; i += 2 * lanes) {
        most = hn::Max(most, hn::BitCast(numbers, hn::LoadU(tag, indices + i)));
        next = hn::Max(next, hn::BitCast(numbers, hn::LoadU(tag, indices + i + lanes)));
    }
    return hn::AllTrue(numbers, hn::Lt(hn::Max(most, next), hn::Set(numbers, nodes))) &&
           indices_fit({indices + i, count - i}, nodes);
}

template <std::size_t n>
std::size_t mixed(const Mesh::Index* corners, std::size_t count, const States& states, std::uint32_t* out) {
    constexpr std::size_t at_a_time = 256;  // for a near cache
    const std::uint64_t* const in_set = states.in_set.data();
    const std::uint64_t every = states.all_known ? 0 : 1;
    std::size_t found = 0;
    for (std::size_t begin = 0; begin < count; begin += at_a_time) {
        const std::size_t end = std::min(count, begin + at_a_time);
        if (!all_fit(corners + n * begin, n * (end - begin), static_cast<std::uint32_t>(states.of.size())))
            return no_node;
        for (std::size_t cell = begin; cell < end; ++cell) {
            const Mesh::Index* const c = corners + n * cell;
            __builtin_prefetch(corners + n * std::min(cell + 2 * at_a_time, count - 1));
            const auto bit = [&](std::size_t i) {
                const auto node = static_cast<std::uint32_t>(c[i]);
                return in_set[node / 64] >> (node % 64);
            };
            const std::uint64_t first = bit(0);
            std::uint64_t differ = every;
            for (std::size_t i = 1; i < n; ++i) differ |= first ^ bit(i);
            out[found] = static_cast<std::uint32_t>(cell);
            found += differ & 1;
        }
    }
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
