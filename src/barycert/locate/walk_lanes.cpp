#include "barycert/locate/walk_lanes.hpp"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/locate/walk_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/core/filter-inl.hpp"
#include "barycert/index/records-inl.hpp"
#include "barycert/locate/names.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::locate {
namespace HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;
using index::HWY_NAMESPACE::load_records;

using locate::CellRecord;
using locate::NodeRecord;
using locate::Place;
using locate::PointRecord;
using locate::Upcoming;
using locate::Walk;
using locate::WalkList;

struct StepTargets {
    std::uint64_t* going;
    WalkList* arrived;
    WalkList* stuck;
    std::size_t going_count;
};

template <class D, class M>
HWY_INLINE void append(D bits, hn::Vec<D> walks, M mask, WalkList& to) {
    to.count += hn::CompressStore(walks, mask, bits, reinterpret_cast<std::uint64_t*>(to.walks.data() + to.count));
}

/// Steps of the walks [at, at + width). What is proved is proved as in filter-inl.hpp. If all numerators are certainly
/// of one sign, so is the denominator, their exact sum.
template <Simplex s, bool fetch, class D>
HWY_INLINE void step(D tag, const CellRecord* cells, const NodeRecord* nodes, const PointRecord* points,
                     const Walk* walks, StepTargets& to) {
    using V = hn::Vec<D>;
    constexpr std::size_t width = hn::MaxLanes(D());
    constexpr int n = vertex_count(s), d = space_dimension(s);
    const hn::RebindToUnsigned<D> bits;
    const auto walk = hn::LoadU(bits, reinterpret_cast<const std::uint64_t*>(walks));
    V p[4];
    load_records(
        tag, [&](std::size_t l) HWY_ATTR { return points[walks[l].point].at.data(); }, p);
    Relative<s, V> c;
    for (int i = 0; i < n; ++i) {
        V v[4];
        load_records(
            tag,
            [&](std::size_t l) HWY_ATTR {
                const Place node = cells[walks[l].cell].node[static_cast<std::size_t>(i)];
                return nodes[node].at.data();
            },
            v);
        for (int k = 0; k < d; ++k) c.r[i][k] = v[k] - p[k];
    }
    Fractions<s, V> f;
    solve(c, hn::Zero(tag), f);
    const Bounds<D> bound = filter_bounds<s>(tag, c);

    const V flip = hn::And(f.denominator, hn::SignBit(tag));
    V lowest = hn::Xor(f.numerator[0], flip);
    auto face = hn::Zero(bits);
    for (int i = 1; i < n; ++i) {
        const V numerator = hn::Xor(f.numerator[i], flip);
        face = hn::IfThenElse(hn::RebindMask(bits, hn::Lt(numerator, lowest)), hn::Set(bits, i), face);
        lowest = hn::Min(lowest, numerator);
    }
    const auto inside = hn::RebindMask(bits, hn::And(bound.valid, hn::Gt(lowest, bound.numerator)));
    const auto beyond = hn::RebindMask(bits, hn::And(bound.valid, hn::Lt(lowest, hn::Neg(bound.numerator))));

    // Two neighbours are eight bytes, of which one half is the one asked for. Bits 32 to 63 of a walk are its cell.
    const auto cell = hn::ShiftRight<32>(walk), one = hn::Set(bits, 1);
    static_assert(sizeof(CellRecord) == 32 && offsetof(CellRecord, next) == 16 &&
                  std::endian::native == std::endian::little);
    const auto pair = hn::Add(hn::ShiftLeft<5>(cell), hn::ShiftLeft<2>(hn::AndNot(one, face)));
    const auto two = hn::GatherOffset(bits, reinterpret_cast<const std::uint64_t*>(cells[0].next.data()),
                                      hn::BitCast(hn::RebindToSigned<D>(), pair));
    const auto next = hn::ShiftLeft<32>(hn::Shr(two, hn::ShiftLeft<5>(hn::And(face, one))));
    const auto has_next = hn::Eq(hn::ShiftRight<63>(next), hn::Zero(bits));
    const auto goes_on = hn::And(beyond, has_next);
    const auto point = hn::And(walk, hn::Set(bits, 0xffffffffU));
    const std::size_t going = hn::CompressStore(hn::Or(point, next), goes_on, bits, to.going + to.going_count);
    if constexpr (fetch) {  // what they name is read in the next round
        for (std::size_t l = 0; l < going; ++l) __builtin_prefetch(&cells[to.going[to.going_count + l] >> 32]);
    }
    to.going_count += going;
    append(bits, walk, inside, *to.arrived);
    const auto others = hn::Not(hn::Or(inside, goes_on));
    if (HWY_UNLIKELY(!hn::AllFalse(bits, others))) {
        const auto outside = hn::IfThenElseZero(beyond, hn::Set(bits, 0xffffffff00000000U));
        append(bits, hn::Xor(walk, outside), others, *to.stuck);
    }
    static_cast<void>(width);
}

/// How many vectors ahead the nodes of cells are asked for.
constexpr std::size_t vectors_ahead = 4;

/// How many walks of the next chunk are found between steps.
constexpr std::size_t found_between = 4;

template <Simplex s, std::size_t width>
HWY_INLINE void fetch_nodes(const locate::CellIndex& index, const NodeRecord* nodes, const Walk* walks) {
    for (std::size_t l = 0; l < width; ++l) {
        const auto& node = index.cells[static_cast<std::size_t>(walks[l].cell)].node;
        for (std::size_t i = 0; i < vertex_count(s); ++i) __builtin_prefetch(&nodes[static_cast<std::size_t>(node[i])]);
    }
}

template <Simplex s, bool fetch>
std::size_t step_all(const locate::CellIndex& index, const NodeRecord* nodes, const PointRecord* points, Walk* walks,
                     std::size_t count, Upcoming& upcoming, WalkList& arrived, WalkList& stuck) {
    StepTargets to{reinterpret_cast<std::uint64_t*>(walks), &arrived, &stuck, 0};
    std::size_t at = 0;
    const auto run = [&](auto tag) HWY_ATTR {
        constexpr std::size_t width = hn::MaxLanes(decltype(tag)());
        // Copied before the walks that go on are moved over them.
        Walk block[width];
        for (; at + width <= count; at += width) {
            for (std::size_t l = 0; l < width; ++l) block[l] = walks[at + l];
            if (fetch && at + (vectors_ahead + 1) * width <= count)
                fetch_nodes<s, width>(index, nodes, walks + at + vectors_ahead * width);
            upcoming.find(found_between);
            step<s, fetch>(tag, index.cells.data(), nodes, points, block, to);
        }
    };
    run(hn::ScalableTag<double>());
    run(hn::CappedTag<double, 1>());
    return to.going_count;
}

std::size_t step_walks(const locate::CellIndex& index, const NodeRecord* nodes, const PointRecord* points, Walk* walks,
                       std::size_t count, bool fetch, Upcoming& upcoming, WalkList& arrived, WalkList& stuck) {
    const auto step = index.simplex == Simplex::triangle
                          ? fetch ? step_all<Simplex::triangle, true> : step_all<Simplex::triangle, false>
                      : fetch ? step_all<Simplex::tetrahedron, true>
                              : step_all<Simplex::tetrahedron, false>;
    return step(index, nodes, points, walks, count, upcoming, arrived, stuck);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::locate
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::locate {

HWY_EXPORT(step_walks);

std::size_t step_walks(const CellIndex& index, const NodeRecord* nodes, const PointRecord* points, Walk* walks,
                       std::size_t count, bool fetch, Upcoming& upcoming, WalkList& arrived, WalkList& stuck) {
    return HWY_DYNAMIC_DISPATCH(step_walks)(index, nodes, points, walks, count, fetch, upcoming, arrived, stuck);
}

}  // namespace barycert::locate
#endif
