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

/// As many pairs as there are lanes.
template <class D>
struct Pairs {
    using M = hn::Mask<D>;

    Facets<D> f, g;
    M same[3][3];  ///< corner j of f is corner k of g

    HWY_INLINE Pairs(D tag, const PlacedFacet* facets, const FacetPair* pairs)
        : f(
              tag, [=](std::size_t l) HWY_ATTR -> auto& { return facets[pairs[l].first]; }),
          g(
              tag, [=](std::size_t l) HWY_ATTR -> auto& { return facets[pairs[l].second]; }) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 3; ++k) same[j][k] = hn::RebindMask(tag, hn::Eq(f.node[j], g.node[k]));
        }
    }

    M of_f(std::size_t k) const { return hn::Or(same[0][k], hn::Or(same[1][k], same[2][k])); }
    M of_g(std::size_t j) const { return hn::Or(same[j][0], hn::Or(same[j][1], same[j][2])); }
    M of_same_nodes() const { return hn::And(of_g(0), hn::And(of_g(1), of_g(2))); }
};

/// The plane of one facet has all corners of the other, but for common ones, on one side.
template <class D>
HWY_INLINE hn::Mask<D> plane_separates(D tag, const Pairs<D>& pairs) {
    const PlaneOf<hn::Vec<D>> plane_of_f(pairs.f.corner), plane_of_g(pairs.g.corner);
    Sides<D> sides_of_f(tag), sides_of_g(tag);
    for (std::size_t k = 0; k < 3; ++k) {
        sides_of_f.add(tag, plane_of_f, pairs.g.corner[k], pairs.of_f(k));
        sides_of_g.add(tag, plane_of_g, pairs.f.corner[k], pairs.of_g(k));
    }
    return hn::Or(sides_of_f.all_on_one(), sides_of_g.all_on_one());
}

/// The sign of orient2d where it is certain, by its bound (predicates.cpp): 1 or -1, else 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V side_of_line(D tag, const V* a, const V* b, const V* p) {
    const V u[2] = {a[0] - p[0], a[1] - p[1]}, v[2] = {b[0] - p[0], b[1] - p[1]};
    const V extent[2] = {max_magnitude(u[0], v[0]), max_magnitude(u[1], v[1])};
    const V value = cross(u, v), bound = hn::Set(tag, 8.5 * filter_epsilon) * (extent[0] * extent[1]);
    const auto certain = hn::And(all_within(tag, extent, 0x1p-300, 0x1p300), hn::Gt(hn::Abs(value), bound));
    return hn::IfThenElseZero(certain, hn::CopySign(hn::Set(tag, 1.0), value));
}

/// A side of f has f on one side and all corners of g, but for common ones at its ends, on the other. Then what both
/// have in common lies on its line, where g has the hull of these corners alone. same(j, k) as in Pairs.
template <class D, class V, class Same>
HWY_INLINE hn::Mask<D> line_separates(D tag, const V (&f)[3][2], const V (&g)[3][2], Same same) {
    const V outer = hn::Neg(side_of_line(tag, f[1], f[2], f[0]));
    hn::Mask<D> any = hn::FirstN(tag, 0);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
        hn::Mask<D> all = hn::Ne(outer, hn::Zero(tag));
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at_end = hn::Or(same(a, k), same(b, k));
            all = hn::And(all, hn::Or(at_end, hn::Eq(side_of_line(tag, f[a], f[b], g[k]), outer)));
        }
        any = hn::Or(any, all);
    }
    return any;
}

/// Facets of one plane, of which flat sides of a boundary are full, are apart in a projection: without the axis along
/// which the normal of f is longest.
template <class D>
HWY_INLINE hn::Mask<D> projection_separates(D tag, const Pairs<D>& pairs) {
    using V = hn::Vec<D>;
    const PlaneOf<V> plane(pairs.f.corner);
    const V x = hn::Abs(plane.normal[0]), y = hn::Abs(plane.normal[1]), z = hn::Abs(plane.normal[2]);
    const auto along_x = hn::And(hn::Ge(x, y), hn::Ge(x, z)), along_y = hn::Ge(y, z);
    V f[3][2], g[3][2];
    const auto project = [&](const V* from, V* to) HWY_ATTR {
        to[0] = hn::IfThenElse(along_x, from[1], hn::IfThenElse(along_y, from[2], from[0]));
        to[1] = hn::IfThenElse(along_x, from[2], hn::IfThenElse(along_y, from[0], from[1]));
    };
    for (std::size_t k = 0; k < 3; ++k) project(pairs.f.corner[k], f[k]), project(pairs.g.corner[k], g[k]);
    return hn::Or(line_separates(tag, f, g, [&](std::size_t j, std::size_t k) HWY_ATTR { return pairs.same[j][k]; }),
                  line_separates(tag, g, f, [&](std::size_t j, std::size_t k) HWY_ATTR { return pairs.same[k][j]; }));
}

/// Moves those pairs to the front that separates(tag, pairs) does not tell apart; returns how many they are.
template <class Separates>
HWY_INLINE std::size_t keep_others(const PlacedFacet* facets, FacetPair* pairs, std::size_t count,
                                   Separates separates) {
    const hn::CappedTag<double, 8> tag;
    constexpr std::size_t width = hn::MaxLanes(tag);
    std::size_t kept = 0;
    for (std::size_t first = 0; first < count; first += width) {
        FacetPair some[width];
        const std::size_t here = std::min(width, count - first);
        for (std::size_t l = 0; l < width; ++l) some[l] = pairs[first + std::min(l, here - 1)];
        const Pairs of_lanes(tag, facets, some);
        const auto apart = hn::AndNot(of_lanes.of_same_nodes(), separates(tag, of_lanes));
        const std::uint32_t bits = mask_bits(tag, apart);
        for (std::size_t l = 0; l < here; ++l) {
            pairs[kept] = some[l];
            kept += ~bits >> l & 1U;
        }
    }
    return kept;
}

std::size_t keep_doubtful(const PlacedFacet* facets, FacetPair* pairs, std::size_t count) {
    count = keep_others(facets, pairs, count, [](auto tag, auto& of) HWY_ATTR { return plane_separates(tag, of); });
    return keep_others(facets, pairs, count, [](auto tag, auto& of) HWY_ATTR { return projection_separates(tag, of); });
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
