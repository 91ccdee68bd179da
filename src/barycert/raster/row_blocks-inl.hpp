// The spans of a triangle, on lanes: the crossings of several rows at once, by the filter of edge.hpp; a row that it
// leaves undecided is asked exactly.
//
// Included once per SIMD target.
#if defined(BARYCERT_RASTER_ROW_BLOCKS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_RASTER_ROW_BLOCKS_INL_HPP
#undef BARYCERT_RASTER_ROW_BLOCKS_INL_HPP
#else
#define BARYCERT_RASTER_ROW_BLOCKS_INL_HPP
#endif

#include "barycert/core/simd_targets.hpp"
// After the targets.
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "barycert/raster/edge.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Rows that are prepared together.
using Doubles = hn::ScalableTag<double>;
struct RowBlock {
    static constexpr std::int32_t capacity = 16;
    std::int32_t first[capacity], last[capacity];  ///< pixels first, ..., last - 1
};

/// draw(row, block, size): the rows row, ..., row + size - 1 of the triangle, from the bottom.
template <class Draw>
HWY_INLINE void for_row_blocks(const SortedTriangle& t, std::int32_t width, Draw draw) {
    const Doubles tag;
    const hn::Rebind<std::int32_t, Doubles> itag;
    using V = hn::Vec<Doubles>;
    const auto n = static_cast<std::int32_t>(hn::Lanes(tag));
    const Edge whole(t.vertex[0], t.vertex[2]);
    Edge lower, upper;
    if (t.begin != t.middle) lower = Edge(t.vertex[0], t.vertex[1]);
    if (t.middle != t.end) upper = Edge(t.vertex[1], t.vertex[2]);
    if (t.begin == t.middle) lower = upper;
    if (t.middle == t.end) upper = lower;
    const auto half = hn::Set(tag, 0.5), zero = hn::Zero(tag), one = hn::Set(tag, 1);
    const auto limit = hn::Set(tag, static_cast<double>(width));
    RowBlock block;
    for (std::int32_t j = t.begin; j < t.end;) {
        const std::int32_t size = std::min(RowBlock::capacity, t.end - j);
        for (std::int32_t r = 0; r < size; r += n) {
            const auto row = hn::Add(hn::Set(tag, static_cast<double>(j + r)), hn::Iota(tag, 0));
            const auto y = hn::Add(row, half);
            const auto is_lower = hn::Lt(row, hn::Set(tag, static_cast<double>(t.middle)));
            const auto pick = [&](double p, double q)
                                  HWY_ATTR { return hn::IfThenElse(is_lower, hn::Set(tag, p), hn::Set(tag, q)); };
            const auto position = [&](V x0, V y0, V slope)
                                      HWY_ATTR { return hn::Sub(hn::Add(x0, hn::Mul(hn::Sub(y, y0), slope)), half); };
            const V s = position(hn::Set(tag, whole.lower[0]), hn::Set(tag, whole.lower[1]), hn::Set(tag, whole.slope));
            const V q = position(pick(lower.lower[0], upper.lower[0]), pick(lower.lower[1], upper.lower[1]),
                                 pick(lower.slope, upper.slope));
            const V s_up = hn::Ceil(s), q_up = hn::Ceil(q);
            const V s_error = hn::Set(tag, whole.error), q_error = pick(lower.error, upper.error);
            const auto far = [&](V x, V up, V error) HWY_ATTR {
                return hn::And(hn::Gt(hn::Sub(up, x), error), hn::Gt(hn::Sub(x, hn::Sub(up, one)), error));
            };
            V s_at = hn::Min(hn::Max(s_up, zero), limit), q_at = hn::Min(hn::Max(q_up, zero), limit);
            const auto decided = hn::And(far(s, s_up, s_error), far(q, q_up, q_error));
            const std::int32_t used = std::min(n, size - r);
            if (!hn::AllTrue(tag, hn::Or(decided, hn::Not(hn::FirstN(tag, static_cast<std::size_t>(used)))))) {
                HWY_ALIGN double s_fixed[hn::MaxLanes(Doubles())], q_fixed[hn::MaxLanes(Doubles())];
                hn::Store(s_at, tag, s_fixed);
                hn::Store(q_at, tag, q_fixed);
                for (std::int32_t l = 0; l < used; ++l) {
                    const std::int32_t at = j + r + l;
                    s_fixed[l] = crossing(whole, at, width);
                    q_fixed[l] = crossing(at < t.middle ? lower : upper, at, width);
                }
                s_at = hn::Load(tag, s_fixed);
                q_at = hn::Load(tag, q_fixed);
            }
            const V first = hn::Min(s_at, q_at);
            hn::StoreU(hn::DemoteTo(itag, first), itag, block.first + r);
            hn::StoreU(hn::DemoteTo(itag, hn::Max(s_at, q_at)), itag, block.last + r);
        }
        draw(j, block, size);
        j += size;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::raster
HWY_AFTER_NAMESPACE();
#endif
