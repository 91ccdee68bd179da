#include "barycert/index/facet_links.hpp"
#include "barycert/predicates.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/index/orientation_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/core/filter-inl.hpp"
#include "barycert/index/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::index::HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;

/// The determinant of the edges from the last vertex: a numerator of filter-inl.hpp with that vertex as its point, and
/// with the bound of one.
template <Simplex s, class D, class V = hn::Vec<D>>
HWY_INLINE V determinant(D tag, const V (&v)[4][4], V& bound, hn::Mask<D>& valid) {
    constexpr int d = space_dimension(s);
    V edge[d][d], extent[d];
    for (int i = 0; i < d; ++i) {
        for (int k = 0; k < d; ++k) edge[i][k] = v[i][k] - v[d][k];
    }
    extents(edge, extent);
    valid = all_within(tag, extent, 0x1p-300, 0x1p300);
    if constexpr (d == 2) {
        bound = hn::Set(tag, 8.5 * filter_epsilon) * (extent[0] * extent[1]);
        return cross(edge[0], edge[1]);
    } else {
        bound = hn::Set(tag, 49 * filter_epsilon) * (extent[0] * extent[1] * extent[2]);
        V normal[3];
        cross(edge[1], edge[0], normal);  // as orient3d: counter-clockwise seen from the last vertex
        return dot(edge[2], normal);
    }
}

/// Of a vector of cells: 1 or -1 for each that is certainly positive or negative, else 0.
template <Simplex s, class D>
HWY_INLINE void find_signs(D tag, const CellRecord* cells, const NodeRecord* nodes, std::int8_t* out) {
    using V = hn::Vec<D>;
    V v[4][4], bound;
    hn::Mask<D> valid;
    for (int i = 0; i < vertex_count(s); ++i)
        load_records(
            tag, [&](std::size_t l) HWY_ATTR { return nodes[cells[l].node[static_cast<std::size_t>(i)]].at.data(); },
            v[i]);
    const V value = determinant<s>(tag, v, bound, valid);
    const std::uint32_t positive = mask_bits(tag, hn::And(valid, hn::Gt(value, bound)));
    const std::uint32_t negative = mask_bits(tag, hn::And(valid, hn::Lt(value, hn::Neg(bound))));
    for (std::size_t l = 0; l < hn::MaxLanes(D()); ++l)
        out[l] = static_cast<std::int8_t>((positive >> l & 1) - (negative >> l & 1));
}

template <Simplex s>
void filter_cells(const CellRecord* cells, const NodeRecord* nodes, std::size_t count, std::int8_t* out) {
    std::size_t at = 0;
    const auto run = [&](auto tag) HWY_ATTR {
        constexpr std::size_t width = hn::MaxLanes(decltype(tag)());
        for (; at + width <= count; at += width) find_signs<s>(tag, cells + at, nodes, out + at);
    };
    run(hn::ScalableTag<double>());
    run(hn::CappedTag<double, 1>());
}

void filter_orientations(const CellIndex& index, std::size_t first, std::size_t count, std::int8_t* out) {
    const CellRecord* const cells = index.cells.data() + first;
    index.simplex == Simplex::triangle ? filter_cells<Simplex::triangle>(cells, index.nodes.data(), count, out)
                                       : filter_cells<Simplex::tetrahedron>(cells, index.nodes.data(), count, out);
}

}  // namespace barycert::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::index {

HWY_EXPORT(filter_orientations);

void find_orientations(const CellIndex& index, std::size_t first, std::size_t count, std::int8_t* out) {
    HWY_DYNAMIC_DISPATCH(filter_orientations)(index, first, count, out);
    for (std::size_t i = 0; i < count; ++i) {
        if (out[i] != 0) continue;
        const auto at = index.corner_points(static_cast<Place>(first + i));
        out[i] = static_cast<std::int8_t>(index.simplex == Simplex::triangle ? orient2d(at[0], at[1], at[2])
                                                                             : orient3d(at[0], at[1], at[2], at[3]));
    }
}

}  // namespace barycert::index
#endif
