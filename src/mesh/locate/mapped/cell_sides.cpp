#include "mesh/locate/mapped/cell_sides.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "core/isoparametric/patch.hpp"
#include "core/vtk_cell.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/index/cell_maps.hpp"

namespace barycert::locate {

namespace iso = core::isoparametric;
using iso::PatchKind;

namespace {

/// Sorts a few items: in the part of std::sort that is for more than 16, GCC 12 sees a read past the end.
template <class Iterator, class Less>
void sort_few(Iterator first, Iterator last, Less less) {
    for (Iterator i = first; i != last; ++i) {
        for (Iterator j = i; j != first && less(*j, *(j - 1)); --j) std::swap(*j, *(j - 1));
    }
}

/// Whether a node of a patch is its corner, and which: of a square in the order (0,0), (1,0), (0,1), (1,1).
std::optional<std::size_t> corner_of(const iso::Patch& patch, const iso::PatchNode& node) {
    if (patch.kind == PatchKind::square) return node.index[1] + 2U * node.index[2];
    for (std::size_t c = 0; c < 3; ++c) {
        if (node.index[c] == patch.order) return c;
    }
    if (patch.kind == PatchKind::point) return 0;
    return std::nullopt;
}

std::array<Mesh::Index, 4> corners_in_place(const Side& side) {
    std::array<Mesh::Index, 4> at{-1, -1, -1, -1};
    for (std::size_t i = 0; i < side.patch.count; ++i) {
        if (const auto corner = corner_of(side.patch, side.patch.nodes[i])) at[*corner] = side.nodes[i];
    }
    return at;
}

/// Turned and mirrored so that (0,0) has the lowest corner, and (1,0) the lower one of those beside it.
void arrange_square(Side& side) {
    const std::array<Mesh::Index, 4> at = corners_in_place(side);
    const auto low = static_cast<std::size_t>(std::ranges::min_element(at) - at.begin());
    const std::uint8_t flip_i = low & 1U, flip_j = low >> 1U & 1U;
    const bool swap = at[low ^ 1U] > at[low ^ 2U];
    for (std::size_t n = 0; n < 4; ++n) {
        auto& index = side.patch.nodes[n].index;
        index[1] ^= flip_i;
        index[2] ^= flip_j;
        if (swap) std::swap(index[1], index[2]);
    }
}

void arrange_simplex(Side& side) {
    const std::array<Mesh::Index, 4> at = corners_in_place(side);
    const std::size_t count = side.patch.kind == PatchKind::curve ? 2 : 3;
    std::array<std::size_t, 3> order{0, 1, 2};
    sort_few(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
             [&](std::size_t a, std::size_t b) { return at[a] < at[b]; });
    for (std::size_t n = 0; n < side.patch.count; ++n) {
        auto& index = side.patch.nodes[n].index;
        index = {index[order[0]], index[order[1]], index[order[2]]};
    }
}

}  // namespace

std::array<Mesh::Index, 4> Side::corners() const {
    std::array<Mesh::Index, 4> at = corners_in_place(*this);
    sort_few(at.begin(), at.end(), [](Mesh::Index a, Mesh::Index b) { return a >= 0 && (b < 0 || a < b); });
    return at;
}

void Side::arrange() {
    if (patch.kind == PatchKind::square) arrange_square(*this);
    if (patch.kind == PatchKind::curve || patch.kind == PatchKind::triangle) arrange_simplex(*this);
    std::array<std::size_t, iso::patch_nodes> order{};
    for (std::size_t i = 0; i < patch.count; ++i) order[i] = i;
    sort_few(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(patch.count),
             [&](std::size_t a, std::size_t b) { return patch.nodes[a].index > patch.nodes[b].index; });
    const Side before = *this;
    for (std::size_t i = 0; i < patch.count; ++i) {
        patch.nodes[i] = before.patch.nodes[order[i]];
        nodes[i] = before.nodes[order[i]];
    }
}

CellSides::CellSides(const mesh::CellMaps& maps, std::size_t whole, int dimension, std::uint8_t type)
    : reference_(*maps.reference(whole)),
      nodes_(maps.nodes(whole)),
      places_(maps.places(whole)),
      dimension_(static_cast<std::size_t>(dimension)),
      type_(mesh::numbered_round(type)) {}  // as CellMaps has the nodes

std::size_t CellSides::facets() const {
    if (reference_.is_simplex()) return dimension_ + 1;
    return dimension_ == 2 ? 4 : mesh::rings_of(type_).size();
}

std::array<std::size_t, 4> CellSides::ring(std::size_t i, std::size_t& count) const {
    std::array<std::size_t, 4> ring{};
    if (reference_.is_simplex()) {
        count = dimension_;
        const auto outward = mesh::outward_corners(static_cast<int>(dimension_), i);
        std::copy_n(outward.begin(), count, ring.begin());
        return ring;
    }
    const auto& rings = mesh::rings_of(type_);
    const std::vector<Mesh::Index>& of = dimension_ == 2 ? rings.front() : rings[i];
    count = dimension_ == 2 ? 2 : of.size();
    for (std::size_t k = 0; k < count; ++k)
        ring[k] = static_cast<std::size_t>(of[(k + (dimension_ == 2 ? i : 0)) % of.size()]);
    return ring;
}

Side CellSides::facet(std::size_t i) const {
    std::size_t count = 0;
    const std::array<std::size_t, 4> ring = this->ring(i, count);
    Side side;
    side.patch.dimension = dimension_;
    side.patch.kind = count == 2 ? PatchKind::curve : count == 3 ? PatchKind::triangle : PatchKind::square;
    const auto add = [&](std::size_t node, const std::array<std::uint8_t, 3>& index) {
        side.add(nodes_.at[node], {places_.at[node], places_.other[node], index});
    };
    if (reference_.is_simplex()) {
        side.patch.order = reference_.order;
        for (std::size_t n = 0; n < reference_.nodes; ++n) {
            const auto& of = reference_.indices[n];
            if (of[i] != 0) continue;
            std::array<std::uint8_t, 3> index{};
            for (std::size_t c = 0; c < count; ++c) index[c] = of[ring[c]];
            add(n, index);
        }
    } else if (count == 4) {
        constexpr std::array<std::array<std::uint8_t, 3>, 4> around{{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}};
        for (std::size_t c = 0; c < 4; ++c) add(ring[c], around[c]);
    } else {
        for (std::size_t c = 0; c < count; ++c) {
            std::array<std::uint8_t, 3> index{};
            index[c] = 1;
            add(ring[c], index);
        }
    }
    side.arrange();
    return side;
}

int CellSides::turn(std::size_t i) const {
    std::size_t count = 0;
    const std::array<std::size_t, 4> ring = this->ring(i, count);
    std::size_t low = 0;
    for (std::size_t c = 1; c < count; ++c) low = nodes_.at[ring[c]] < nodes_.at[ring[low]] ? c : low;
    const int outward =
        type_ == vtk_wedge && !reference_.is_simplex() ? -1 : 1;  // rings of wedges are seen from inside
    if (count == 2) return low == 0 ? 1 : -1;
    return nodes_.at[ring[(low + 1) % count]] < nodes_.at[ring[(low + count - 1) % count]] ? outward : -outward;
}

std::vector<Side> edges_of_side(const Side& side) {
    std::vector<Side> edges;
    const auto begin = [&](int order) -> Side& {
        Side& edge = edges.emplace_back();
        edge.patch.kind = PatchKind::curve;
        edge.patch.order = order;
        edge.patch.dimension = side.patch.dimension;
        return edge;
    };
    if (side.patch.kind == PatchKind::triangle) {
        for (std::size_t c = 0; c < 3; ++c) {
            Side& edge = begin(side.patch.order);
            for (std::size_t n = 0; n < side.patch.count; ++n) {
                iso::PatchNode node = side.patch.nodes[n];
                if (node.index[c] != 0) continue;
                node.index = {node.index[c == 0 ? 1 : 0], node.index[c == 2 ? 1 : 2], 0};
                edge.add(side.nodes[n], node);
            }
        }
    } else if (side.patch.kind == PatchKind::square) {
        for (const auto& [axis, at] : {std::pair{1, 0}, std::pair{1, 1}, std::pair{2, 0}, std::pair{2, 1}}) {
            Side& edge = begin(1);
            for (std::size_t n = 0; n < 4; ++n) {
                iso::PatchNode node = side.patch.nodes[n];
                if (node.index[static_cast<std::size_t>(axis)] != at) continue;
                const std::uint8_t along = node.index[static_cast<std::size_t>(3 - axis)];
                node.index = {static_cast<std::uint8_t>(1 - along), along, 0};
                edge.add(side.nodes[n], node);
            }
        }
    }
    for (Side& edge : edges) edge.arrange();
    return edges;
}

std::vector<Side> vertices_of_side(const Side& side) {
    std::vector<Side> vertices;
    for (std::size_t n = 0; n < side.patch.count; ++n) {
        if (!corner_of(side.patch, side.patch.nodes[n])) continue;
        Side& vertex = vertices.emplace_back();
        vertex.patch.dimension = side.patch.dimension;
        vertex.add(side.nodes[n], {side.patch.nodes[n].at, nullptr, {}});
    }
    return vertices;
}

Side straight_side(std::span<const Mesh::Index> nodes, const Mesh& mesh) {
    Side side;
    side.patch.dimension = static_cast<std::size_t>(mesh.dimension);
    side.patch.kind = static_cast<PatchKind>(nodes.size() - 1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::array<std::uint8_t, 3> index{};
        if (nodes.size() != 1) index[i] = 1;
        side.add(nodes[i], {mesh.point(nodes[i]), nullptr, index});
    }
    side.arrange();
    return side;
}

}  // namespace barycert::locate
