#include "mesh/sample/points/value_lanes.hpp"
#include <cstddef>
#include <cstdint>
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/sample/points/value_lanes.cpp"
#include "core/foreach_target.hpp"

#include "core/lane_loop-inl.hpp"
#include "core/refinement-inl.hpp"
#include "mesh/index/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;
using namespace index::HWY_NAMESPACE;

template <class D>
HWY_INLINE void scatter(D tag, hn::Vec<D> v, double* const* to, std::size_t offset) {
    constexpr std::size_t width = hn::MaxLanes(D());
    HWY_ALIGN double lanes[width];
    hn::Store(v, tag, lanes);
    for (std::size_t l = 0; l < width; ++l) to[l][offset] = lanes[l];
}

/// Items [at, at + width). Returns the mask of those decided.
template <Simplex s, template <Simplex, class, class> class Values, class D>
HWY_INLINE hn::Mask<D> evaluate(D tag, const LanePoints& of, std::size_t at) {
    const auto* const cells = of.cells;
    const auto* const points = of.points;
    const auto* const items = of.items.data() + at;
    const NodeValues& nodes = of.nodes;
    using V = hn::Vec<D>;
    constexpr std::size_t width = hn::MaxLanes(D());
    constexpr int n = vertex_count(s), d = space_dimension(s);
    double* to[width];
    for (std::size_t l = 0; l < width; ++l) to[l] = of.out + of.stride * points[items[l].point].number;
    const auto node = [&](std::size_t l, int i) HWY_ATTR {
        return static_cast<std::size_t>(cells[items[l].cell].node[static_cast<std::size_t>(i)]);
    };
    Absolute<s, V> c;
    V p[4], f[n];
    load_records(
        tag, [&](std::size_t l) HWY_ATTR { return points[items[l].point].at.data(); }, p);
    for (int k = 0; k < d; ++k) c.p[k] = p[k];
    for (int i = 0; i < n; ++i) {
        V v[4];
        load_records(
            tag, [&](std::size_t l) HWY_ATTR { return nodes.first[node(l, i)].at.data(); }, v);
        for (int k = 0; k < d; ++k) c.v[i][k] = v[k];
        f[i] = v[3];
    }
    const Values<s, D, V> values(tag, c);
    hn::Mask<D> certain = values.certain();
    scatter(tag, values.at(tag, f, certain), to, 0);
    for (std::size_t first = 1; first < nodes.components; first += 4) {
        const sample::ValueRecord* const more = nodes.more + (first - 1) / 4 * nodes.node_count;
        V g[4][n];
        for (int i = 0; i < n; ++i) {
            V v[4];
            load_records(
                tag, [&](std::size_t l) HWY_ATTR { return more[node(l, i)].value.data(); }, v);
            for (int k = 0; k < 4; ++k) g[k][i] = v[k];
        }
        for (std::size_t k = 0; k < 4 && first + k < nodes.components; ++k)
            scatter(tag, values.at(tag, g[k], certain), to, first + k);
    }
    return certain;
}

template <template <Simplex, class, class> class Values, Simplex s>
std::size_t evaluate_all(const LanePoints& points, std::uint32_t* undecided) {
    return for_lanes(points.items.size(), undecided, [&](auto tag, std::size_t at) BARYCERT_LANE_LAMBDA {
        return evaluate<s, Values>(tag, points, at);
    });
}

std::size_t interpolate_lanes(const LanePoints& points, Rounding rounding, std::uint32_t* undecided) {
    const bool plain = rounding == Rounding::plain;
    if (points.simplex == Simplex::triangle)
        return plain ? evaluate_all<PlainValues, Simplex::triangle>(points, undecided)
                     : evaluate_all<RefinedValues, Simplex::triangle>(points, undecided);
    return plain ? evaluate_all<PlainValues, Simplex::tetrahedron>(points, undecided)
                 : evaluate_all<RefinedValues, Simplex::tetrahedron>(points, undecided);
}

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::sample {

HWY_EXPORT(interpolate_lanes);

std::size_t interpolate_lanes(const LanePoints& points, Rounding rounding, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(interpolate_lanes)(points, rounding, undecided);
}

}  // namespace barycert::sample
#endif
