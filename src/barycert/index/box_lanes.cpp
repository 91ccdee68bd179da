#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "barycert/index/cell_tree.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/index/box_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/index/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::index::HWY_NAMESPACE {

void meeting_pairs(const BoxGroups& boxes, std::size_t g, const BoxGroups::TakePairs& take) {
    std::array<FacetPair, 256> pairs;
    std::size_t count = 0;
    const BoxGroup& mine = boxes.level(0)[g];
    const CellBox all = mine.box_of_all();
    const auto with_group = [&](std::size_t h) HWY_ATTR {
        // Few boxes of another group meet any of this one.
        const BoxGroup& other = boxes.level(0)[h];
        for (std::uint32_t theirs = meeting(other, all); theirs != 0; theirs &= theirs - 1) {
            const auto j = static_cast<std::size_t>(std::countr_zero(theirs));
            std::uint32_t met = meeting(mine, other.box(j));
            if (h == g) met &= (1U << j) - 1;
            if (count + 8 > pairs.size()) {
                take(std::span(pairs).first(count));
                count = 0;
            }
            for (; met != 0; met &= met - 1)
                pairs[count++] = {static_cast<std::uint32_t>(8 * g) + static_cast<std::uint32_t>(std::countr_zero(met)),
                                  static_cast<std::uint32_t>(8 * h + j)};
        }
    };
    if (boxes.levels() == 1) {
        with_group(0);
    } else {
        struct Open {
            std::size_t level, group;
        };
        std::array<Open, 8 * 12> stack;  // as in BoxGroups::for_each_meeting
        std::size_t top = 0;
        stack[top++] = {boxes.levels() - 1, 0};
        while (top > 0) {
            const Open open = stack[--top];
            for (std::uint32_t bits = meeting(boxes.level(open.level)[open.group], all); bits != 0; bits &= bits - 1) {
                const std::size_t i = 8 * open.group + static_cast<std::size_t>(std::countr_zero(bits));
                if ((i + 1) << 3 * (open.level - 1) <= g) continue;
                if (open.level > 1) {
                    stack[top++] = {open.level - 1, i};
                } else {
                    with_group(i);
                }
            }
        }
    }
    take(std::span(pairs).first(count));
}

}  // namespace barycert::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::index {

HWY_EXPORT(meeting_pairs);

void BoxGroups::for_pairs(std::size_t g, const TakePairs& take) const {
    HWY_DYNAMIC_DISPATCH(meeting_pairs)(*this, g, take);
}

}  // namespace barycert::index
#endif
