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

/// With the facets of g from number `first` on, one a lane.
template <class D>
HWY_INLINE void clear(D tag, std::span<const PlacedFacet> f, std::span<const PlacedFacet> g, std::size_t first,
                      std::array<std::uint8_t, 8>& bits) {
    using V = hn::Vec<D>;
    constexpr std::size_t width = hn::MaxLanes(D());
    constexpr unsigned lanes = (1U << width) - 1;
    const hn::RebindToSigned<D> integers;
    const auto facet = [&](std::size_t l) -> const PlacedFacet& { return g[std::min(first + l, g.size() - 1)]; };
    V corner[3][4];
    hn::Vec<decltype(integers)> node[3];
    for (std::size_t k = 0; k < 3; ++k) {
        load_records(
            tag, [&](std::size_t l) HWY_ATTR { return facet(l).at[k]; }, corner[k]);
        HWY_ALIGN std::int64_t nodes[width];
        for (std::size_t l = 0; l < width; ++l) nodes[l] = facet(l).nodes[k];
        node[k] = hn::Load(integers, nodes);
    }
    const PlaneOf<V> plane(corner);
    for (std::size_t i = 0; i < f.size(); ++i) {
        if ((bits[i] >> first & lanes) == 0) continue;
        V own[3][3];
        hn::Mask<D> common[3], own_common[3];
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t k = 0; k < 3; ++k) {
                own[j][k] = hn::Set(tag, f[i].at[j][k]);
                const auto same = hn::RebindMask(tag, hn::Eq(node[k], hn::Set(integers, f[i].nodes[j])));
                common[k] = j == 0 ? same : hn::Or(common[k], same);
                own_common[j] = k == 0 ? same : hn::Or(own_common[j], same);
            }
        }
        const PlaneOf<V> own_plane(own);
        Sides<D> theirs(tag), ours(tag);
        for (std::size_t k = 0; k < 3; ++k) {
            theirs.add(tag, own_plane, corner[k], common[k]);
            ours.add(tag, plane, own[k], own_common[k]);
        }
        const auto all_common = hn::And(common[0], hn::And(common[1], common[2]));
        std::uint8_t apart[8] = {};
        hn::StoreMaskBits(tag, hn::AndNot(all_common, hn::Or(theirs.all_on_one(), ours.all_on_one())), apart);
        bits[i] = static_cast<std::uint8_t>(bits[i] & ~((apart[0] & lanes) << first));
    }
}

void clear_all(std::span<const PlacedFacet> f, std::span<const PlacedFacet> g, std::array<std::uint8_t, 8>& bits) {
    const hn::CappedTag<double, 8> tag;
    for (std::size_t first = 0; first < g.size(); first += hn::MaxLanes(tag)) clear(tag, f, g, first, bits);
}

}  // namespace barycert::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::index {

HWY_EXPORT(clear_all);

void clear_separated(std::span<const PlacedFacet> f, std::span<const PlacedFacet> g,
                     std::array<std::uint8_t, 8>& bits) {
    HWY_DYNAMIC_DISPATCH(clear_all)(f, g, bits);
}

}  // namespace barycert::index
#endif
