#include "barycert/locate/tree_lanes.hpp"
#include "barycert/locate/names.hpp"
#include "barycert/locate/walk_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/locate/tree_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::locate {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using locate::BoxGroup;
using locate::Candidate;
using locate::Place;

/// A bit for each of the eight boxes that hold q.
HWY_INLINE std::uint32_t boxes_holding(const BoxGroup& group, const std::int32_t (&q)[3]) {
    const hn::CappedTag<std::int32_t, 8> tag;
    constexpr std::size_t width = hn::MaxLanes(hn::CappedTag<std::int32_t, 8>());
    std::uint32_t found = 0;
    for (std::size_t at = 0; at < 8; at += width) {
        auto beyond = hn::MaskFromVec(hn::Zero(tag));
        for (std::size_t k = 0; k < 3; ++k) {
            const auto x = hn::Set(tag, q[k]);
            beyond = hn::Or(beyond, hn::Gt(hn::Load(tag, group.low[k].data() + at), x));
            beyond = hn::Or(beyond, hn::Lt(hn::Load(tag, group.high[k].data() + at), x));
        }
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(tag, hn::Not(beyond), bits);
        found |= static_cast<std::uint32_t>(bits[0] & ((1U << width) - 1)) << at;
    }
    return found;
}

void find_candidates(const locate::CellIndex& index, const locate::CellTree& tree, const locate::PointRecord* points,
                     const std::uint32_t* which, std::size_t count, std::vector<Candidate>& out) {
    struct Open {
        std::uint32_t level, group;
    };
    Open stack[8 * 12];  // 2^31 cells have 11 levels; each leaves at most 7 of its 8 behind
    for (std::size_t i = 0; i < count; ++i) {
        const auto& p = points[which[i]].at;
        std::int32_t q[3] = {};
        for (std::size_t k = 0; k < index.dimension(); ++k) q[k] = index.bins.quantizer().at(k, p[k]);
        std::size_t top = 0;
        stack[top++] = {static_cast<std::uint32_t>(tree.levels() - 1), 0};
        while (top > 0) {
            const Open open = stack[--top];
            std::uint32_t bits = boxes_holding(tree.level(open.level)[open.group], q);
            for (; bits != 0; bits &= bits - 1) {
                const std::uint32_t box = 8 * open.group + static_cast<std::uint32_t>(__builtin_ctz(bits));
                if (open.level == 0) {
                    out.push_back({which[i], static_cast<Place>(box)});
                } else {
                    stack[top++] = {open.level - 1, box};
                }
            }
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::locate
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::locate {

HWY_EXPORT(find_candidates);

void find_candidates(const CellIndex& index, const CellTree& tree, const PointRecord* points,
                     const std::uint32_t* which, std::size_t count, std::vector<Candidate>& out) {
    HWY_DYNAMIC_DISPATCH(find_candidates)(index, tree, points, which, count, out);
}

}  // namespace barycert::locate
#endif
