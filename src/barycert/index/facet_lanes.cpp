#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "barycert/index/facet_contact.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/index/facet_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/core/filter-inl.hpp"
#include "barycert/index/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::index::HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;

/// The plane of a triangle: a corner, the edges from there to the others, and what a determinant needs of these.
template <class V>
struct PlaneOf {
    V base[3], normal[3], extent[3];

    template <class Corner>
    explicit PlaneOf(const Corner (&corners)[3]) {
        V u[3], v[3];
        for (int k = 0; k < 3; ++k) {
            base[k] = corners[0][k];
            u[k] = corners[1][k] - base[k];
            v[k] = corners[2][k] - base[k];
            extent[k] = max_magnitude(u[k], v[k]);
        }
        cross(v, u, normal);
    }
};

/// Points that are certainly on the positive and on the negative side, so far. A determinant and its bound are those
/// of orient3d (predicates.cpp).
template <class D, class V = hn::Vec<D>, class M = hn::Mask<D>>
struct Sides {
    M positive, negative;

    explicit Sides(D tag) : positive(hn::Eq(hn::Zero(tag), hn::Zero(tag))), negative(positive) {}

    /// Takes the point, but for lanes in which it is `common`: in the plane.
    void add(D tag, const PlaneOf<V>& plane, const V* point, M common) {
        V edge[3], extent[3];
        for (int k = 0; k < 3; ++k) {
            edge[k] = point[k] - plane.base[k];
            extent[k] = hn::Max(plane.extent[k], hn::Abs(edge[k]));
        }
        const V bound = hn::Set(tag, 49 * filter_epsilon) * (extent[0] * extent[1] * extent[2]);
        const V value = dot(edge, plane.normal);
        const M valid = all_within(tag, extent, 0x1p-300, 0x1p300);
        positive = hn::And(positive, hn::Or(common, hn::And(valid, hn::Gt(value, bound))));
        negative = hn::And(negative, hn::Or(common, hn::And(valid, hn::Lt(value, hn::Neg(bound)))));
    }
    M all_on_one() const { return hn::Or(positive, negative); }
};

/// One facet a lane.
template <class D>
struct Facets {
    using Integers = hn::RebindToSigned<D>;

    hn::Vec<D> corner[3][4];
    hn::Vec<Integers> node[3];

    template <class At>
    HWY_INLINE Facets(D tag, At at) {
        HWY_ALIGN std::int64_t nodes[hn::MaxLanes(D())];
        for (std::size_t k = 0; k < 3; ++k) {
            load_records(
                tag, [&](std::size_t l) HWY_ATTR { return at(l).at[k]; }, corner[k]);
            for (std::size_t l = 0; l < hn::MaxLanes(tag); ++l) nodes[l] = at(l).nodes[k];
            node[k] = hn::Load(Integers(), nodes);
        }
    }
};

/// Of as many pairs as there are lanes, a bit for each that a plane tells apart.
template <class D>
HWY_INLINE unsigned apart(D tag, const PlacedFacet* facets, const FacetPair* pairs) {
    const Facets<D> f(
        tag, [&](std::size_t l) HWY_ATTR -> auto& { return facets[pairs[l].first]; });
    const Facets<D> g(
        tag, [&](std::size_t l) HWY_ATTR -> auto& { return facets[pairs[l].second]; });
    hn::Mask<D> of_f[3], of_g[3];  // the corner is one of the other facet's, too
    for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto same = hn::RebindMask(tag, hn::Eq(f.node[j], g.node[k]));
            of_f[j] = k == 0 ? same : hn::Or(of_f[j], same);
            of_g[k] = j == 0 ? same : hn::Or(of_g[k], same);
        }
    }
    const PlaneOf<hn::Vec<D>> plane_of_f(f.corner), plane_of_g(g.corner);
    Sides<D> sides_of_f(tag), sides_of_g(tag);
    for (std::size_t k = 0; k < 3; ++k) {
        sides_of_f.add(tag, plane_of_f, g.corner[k], of_g[k]);
        sides_of_g.add(tag, plane_of_g, f.corner[k], of_f[k]);
    }
    const auto all_common = hn::And(of_f[0], hn::And(of_f[1], of_f[2]));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::AndNot(all_common, hn::Or(sides_of_f.all_on_one(), sides_of_g.all_on_one())), bits);
    return bits[0];
}

std::size_t keep_doubtful(const PlacedFacet* facets, FacetPair* pairs, std::size_t count) {
    const hn::CappedTag<double, 8> tag;
    constexpr std::size_t width = hn::MaxLanes(tag);
    std::size_t kept = 0;
    for (std::size_t first = 0; first < count; first += width) {
        FacetPair some[width];
        const std::size_t here = std::min(width, count - first);
        for (std::size_t l = 0; l < width; ++l) some[l] = pairs[first + std::min(l, here - 1)];
        const unsigned bits = apart(tag, facets, some);
        for (std::size_t l = 0; l < here; ++l) {
            pairs[kept] = some[l];
            kept += ~bits >> l & 1U;
        }
    }
    return kept;
}

}  // namespace barycert::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::index {

HWY_EXPORT(keep_doubtful);

std::span<FacetPair> without_separated(std::span<const PlacedFacet> facets, std::span<FacetPair> pairs) {
    return pairs.first(HWY_DYNAMIC_DISPATCH(keep_doubtful)(facets.data(), pairs.data(), pairs.size()));
}

}  // namespace barycert::index
#endif
