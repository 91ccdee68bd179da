#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/facet_links.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/index/lanes.cpp"
#include "core/foreach_target.hpp"

#include "core/filter-inl.hpp"
#include "mesh/index/records-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::index::HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;

// Boxes that meet.

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

// Orientations of cells.

/// The determinant of the edges from the last vertex where its sign is certain, else 0: a numerator of filter-inl.hpp
/// with that vertex as its point, and with the bound of one.
template <Simplex s, class D, class Vertices, class V = hn::Vec<D>>
HWY_INLINE V determinant(D tag, const Vertices& v) {
    constexpr int d = space_dimension(s);
    V edge[d][d], extent[d], value, bound;
    for (int i = 0; i < d; ++i) {
        for (int k = 0; k < d; ++k) edge[i][k] = v[i][k] - v[d][k];
    }
    extents(edge, extent);
    if constexpr (d == 2) {
        bound = hn::Set(tag, 8.5 * filter_epsilon) * (extent[0] * extent[1]);
        value = cross(edge[0], edge[1]);
    } else {
        bound = hn::Set(tag, 49 * filter_epsilon) * (extent[0] * extent[1] * extent[2]);
        V normal[3];
        cross(edge[1], edge[0], normal);  // as orient3d: counter-clockwise seen from the last vertex
        value = dot(edge[2], normal);
    }
    const auto valid = all_within(tag, extent, 0x1p-300, 0x1p300);
    return hn::IfThenElseZero(hn::And(valid, hn::Gt(hn::Abs(value), bound)), value);
}

/// Sets, for a vector of cells, 1 or -1 for each that is certainly positive or negative, else 0.
template <Simplex s, class D>
HWY_INLINE void find_signs(D tag, const CellRecord* cells, const NodeRecord* nodes, std::int8_t* out) {
    using V = hn::Vec<D>;
    V v[4][4];
    for (int i = 0; i < vertex_count(s); ++i)
        load_records(
            tag, [&](std::size_t l) HWY_ATTR { return nodes[cells[l].node[static_cast<std::size_t>(i)]].at.data(); },
            v[i]);
    const V value = determinant<s>(tag, v);
    const std::uint32_t positive = mask_bits(tag, hn::Gt(value, hn::Zero(tag)));
    const std::uint32_t negative = mask_bits(tag, hn::Lt(value, hn::Zero(tag)));
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

// Facets that are apart.

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

/// The sign of orient2d where it is certain: 1 or -1, else 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V side_of_line(D tag, const V* a, const V* b, const V* p) {
    const V* const vertices[] = {a, b, p};
    const V value = determinant<Simplex::triangle>(tag, vertices);
    return hn::IfThenElseZero(hn::Ne(value, hn::Zero(tag)), hn::CopySign(hn::Set(tag, 1.0), value));
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

HWY_EXPORT(meeting_pairs);
HWY_EXPORT(filter_orientations);
HWY_EXPORT(keep_doubtful);

void BoxGroups::for_pairs(std::size_t g, const TakePairs& take) const {
    HWY_DYNAMIC_DISPATCH(meeting_pairs)(*this, g, take);
}

void find_orientations(const CellIndex& index, std::size_t first, std::size_t count, std::int8_t* out) {
    HWY_DYNAMIC_DISPATCH(filter_orientations)(index, first, count, out);
    for (std::size_t i = 0; i < count; ++i) {
        if (out[i] != 0) continue;
        const auto at = index.corner_points(static_cast<Place>(first + i));
        out[i] = static_cast<std::int8_t>(index.simplex == Simplex::triangle ? orient2d(at[0], at[1], at[2])
                                                                             : orient3d(at[0], at[1], at[2], at[3]));
    }
}

std::span<FacetPair> without_separated(std::span<const PlacedFacet> facets, std::span<FacetPair> pairs) {
    return pairs.first(HWY_DYNAMIC_DISPATCH(keep_doubtful)(facets.data(), pairs.data(), pairs.size()));
}

}  // namespace barycert::index
#endif
