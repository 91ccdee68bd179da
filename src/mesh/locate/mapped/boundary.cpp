#include "mesh/locate/mapped/boundary.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/cell_maps.hpp"
#include "mesh/locate/mapped/cell_sides.hpp"
#include "mesh/locate/mapped/square_parts.hpp"

namespace barycert::locate {
namespace {

struct KeyedFacet {
    std::array<Mesh::Index, 4> corners;
    MapBoundary::Facet facet;
    std::int8_t turn;  ///< on which side of it the cell is
};

/// Whether two cells have this facet, one on each side, and no other has.
bool is_within(const MapBoundary& boundary, std::span<const KeyedFacet> equal) {
    return equal.size() == 2 && equal[0].turn != equal[1].turn &&
           boundary.side(equal[0].facet).same(boundary.side(equal[1].facet));
}

}  // namespace

MapBoundary::MapBoundary(const Mesh& mesh, const mesh::CellMaps& maps, const std::vector<std::int8_t>& signs)
    : mesh_(mesh), maps_(maps), signs_(signs) {
    find_facets();
    std::vector<index::Box> boxes;
    for (const Facet& facet : facets_) boxes.push_back(box_of_patch(side(facet).patch));
    std::vector<std::uint32_t> order(facets_.size());
    std::iota(order.begin(), order.end(), 0);
    if (!order.empty()) group(0, order.size(), boxes, order);
    std::vector<Facet> sorted;
    for (const std::uint32_t i : order) sorted.push_back(facets_[i]);
    facets_ = std::move(sorted);

    std::vector<std::uint8_t> used(mesh.point_count(), 0);
    for (const Facet& facet : facets_) {
        for (const Mesh::Index node : side(facet).corners()) {
            if (node >= 0) used[static_cast<std::size_t>(node)] = 1;
        }
    }
    at_node_ = {mesh.point_count(), [&](const auto& add) {
                    for (std::size_t whole = 0; whole < signs.size(); ++whole) {
                        if (signs[whole] == 0) continue;
                        for (const Mesh::Index node : maps.nodes(whole).all()) {
                            if (used[static_cast<std::size_t>(node)] != 0)
                                add(static_cast<std::size_t>(node), static_cast<Mesh::Index>(whole));
                        }
                    }
                }};
}

CellSides MapBoundary::sides(Mesh::Index whole) const {
    const auto w = static_cast<std::size_t>(whole);
    return {maps_, w, mesh_.dimension, mesh_.shapes.types.empty() ? std::uint8_t{0} : mesh_.shapes.types[w]};
}

void MapBoundary::find_facets() {
    std::vector<KeyedFacet> all;
    for (std::size_t whole = 0; whole < signs_.size(); ++whole) {
        if (signs_[whole] == 0) continue;
        const CellSides sides = this->sides(static_cast<Mesh::Index>(whole));
        for (std::size_t i = 0; i < sides.facets(); ++i)
            all.push_back({sides.facet(i).corners(),
                           {static_cast<Mesh::Index>(whole), static_cast<std::uint8_t>(i)},
                           static_cast<std::int8_t>(sides.turn(i) * signs_[whole])});
    }
    std::ranges::stable_sort(all, {}, &KeyedFacet::corners);
    for (std::size_t first = 0; first < all.size();) {
        std::size_t last = first + 1;
        while (last < all.size() && all[last].corners == all[first].corners) ++last;
        const std::span<const KeyedFacet> equal(&all[first], last - first);
        if (!is_within(*this, equal)) {
            for (const KeyedFacet& one : equal) facets_.push_back(one.facet);
        }
        first = last;
    }
}

void MapBoundary::group(std::size_t first, std::size_t last, std::vector<index::Box>& boxes,
                        std::vector<std::uint32_t>& order) {
    constexpr std::size_t leaf = 4;
    const std::size_t own = groups_.size();
    groups_.push_back({index::empty_box, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first)});
    for (std::size_t i = first; i < last; ++i) groups_[own].box.add(boxes[order[i]]);
    if (last - first <= leaf) return;
    const index::Box& box = groups_[own].box;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        if (box.high[k] / 2 - box.low[k] / 2 > box.high[axis] / 2 - box.low[axis] / 2) axis = k;
    }
    const auto middle = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return order.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
        const double x = boxes[a].low[axis] / 2 + boxes[a].high[axis] / 2;
        const double y = boxes[b].low[axis] / 2 + boxes[b].high[axis] / 2;
        return x != y ? x < y : a < b;
    });
    group(first, middle, boxes, order);
    groups_[own].first = static_cast<std::uint32_t>(groups_.size());
    groups_[own].count = 0;
    group(middle, last, boxes, order);
}

bool MapBoundary::has(Mesh::Index whole, const Side& side) const {
    const CellSides sides = this->sides(whole);
    for (std::size_t i = 0; i < sides.facets(); ++i) {
        const Side facet = sides.facet(i);
        if (facet.same(side)) return true;
        for (const auto& parts : {vertices_of_side(facet), edges_of_side(facet)}) {
            if (std::ranges::any_of(parts, [&](const Side& part) { return part.same(side); })) return true;
        }
    }
    return false;
}

Mesh::Index MapBoundary::lowest_with(const Side& side) const {
    for (const Mesh::Index whole : at_node_[static_cast<std::size_t>(side.corners()[0])]) {
        if (has(whole, side)) return whole;
    }
    return -1;
}

}  // namespace barycert::locate
