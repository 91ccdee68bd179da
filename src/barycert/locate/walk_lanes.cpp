#include "barycert/locate/walk_lanes.hpp"

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
using locate::Walk;

struct StepTargets {
    Place* inside;
    Walk* going;
    Walk* stuck;
    std::size_t going_count, stuck_count;
};

/// Steps of the walks [at, at + width). What is proved is proved as in filter-inl.hpp. If all numerators are certainly
/// of one sign, so is the denominator, their exact sum.
template <Simplex s, class D>
HWY_INLINE void step(D tag, const CellRecord* cells, const NodeRecord* nodes, const PointRecord* points,
                     const Walk* walks, StepTargets& to) {
    using V = hn::Vec<D>;
    constexpr std::size_t width = hn::MaxLanes(D());
    constexpr int n = vertex_count(s), d = space_dimension(s);
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
    V face = hn::Zero(tag);
    V numerator[n];
    numerator[0] = lowest;
    for (int i = 1; i < n; ++i) {
        numerator[i] = hn::Xor(f.numerator[i], flip);
        face = hn::IfThenElse(hn::Lt(numerator[i], lowest), hn::Set(tag, i), face);
        lowest = hn::Min(lowest, numerator[i]);
    }
    const auto inside = hn::And(bound.valid, hn::Gt(lowest, bound.numerator));
    const auto beyond = hn::And(bound.valid, hn::Lt(lowest, hn::Neg(bound.numerator)));
    std::uint8_t inside_bits[8] = {}, beyond_bits[8] = {};
    hn::StoreMaskBits(tag, inside, inside_bits);
    hn::StoreMaskBits(tag, beyond, beyond_bits);
    HWY_ALIGN double faces[width];
    hn::Store(face, tag, faces);
    // Without branches: nothing could predict them.
    for (std::size_t l = 0; l < width; ++l) {
        const Walk walk = walks[l];
        const Place next = cells[walk.cell].next[static_cast<std::size_t>(faces[l])];
        const std::size_t arrived = inside_bits[0] >> l & 1;
        const std::size_t goes_on = beyond_bits[0] >> l & (next >= 0 ? 1U : 0U);
        to.inside[walk.point] = arrived != 0 ? walk.cell : -1;
        __builtin_prefetch(&cells[next >= 0 ? next : 0]);  // what it names is read in the next round
        to.going[to.going_count] = {walk.point, next};
        to.going_count += goes_on;
        const bool outside_cell = (beyond_bits[0] >> l & 1) != 0;
        to.stuck[to.stuck_count] = {walk.point, outside_cell ? ~walk.cell : walk.cell};
        to.stuck_count += 1 - (arrived | goes_on);
    }
}

/// How many vectors ahead the nodes of cells are asked for.
constexpr std::size_t vectors_ahead = 4;

template <Simplex s, std::size_t width>
HWY_INLINE void fetch_nodes(const locate::CellIndex& index, const Walk* walks) {
    for (std::size_t l = 0; l < width; ++l) {
        const auto& node = index.cells[static_cast<std::size_t>(walks[l].cell)].node;
        for (std::size_t i = 0; i < vertex_count(s); ++i)
            __builtin_prefetch(&index.nodes[static_cast<std::size_t>(node[i])]);
    }
}

template <Simplex s>
std::size_t step_all(const locate::CellIndex& index, const PointRecord* points, Walk* walks, std::size_t count,
                     Place* inside, Walk* stuck, std::size_t& stuck_count) {
    StepTargets to{inside, walks, stuck, 0, stuck_count};
    std::size_t at = 0;
    const auto run = [&](auto tag) HWY_ATTR {
        constexpr std::size_t width = hn::MaxLanes(decltype(tag)());
        // Copied before the walks that go on are moved over them.
        Walk block[width];
        for (; at + width <= count; at += width) {
            for (std::size_t l = 0; l < width; ++l) block[l] = walks[at + l];
            if (at + (vectors_ahead + 1) * width <= count)
                fetch_nodes<s, width>(index, walks + at + vectors_ahead * width);
            step<s>(tag, index.cells.data(), index.nodes.data(), points, block, to);
        }
    };
    run(hn::ScalableTag<double>());
    run(hn::CappedTag<double, 1>());
    stuck_count = to.stuck_count;
    return to.going_count;
}

std::size_t step_walks(const locate::CellIndex& index, const PointRecord* points, Walk* walks, std::size_t count,
                       Place* inside, Walk* stuck, std::size_t& stuck_count) {
    return index.simplex == Simplex::triangle
               ? step_all<Simplex::triangle>(index, points, walks, count, inside, stuck, stuck_count)
               : step_all<Simplex::tetrahedron>(index, points, walks, count, inside, stuck, stuck_count);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::locate
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::locate {

HWY_EXPORT(step_walks);

std::size_t step_walks(const CellIndex& index, const PointRecord* points, Walk* walks, std::size_t count, Place* inside,
                       Walk* stuck, std::size_t& stuck_count) {
    return HWY_DYNAMIC_DISPATCH(step_walks)(index, points, walks, count, inside, stuck, stuck_count);
}

}  // namespace barycert::locate
#endif
