#include <algorithm>
#include <cmath>

#include "barycert/check/surface/parts.hpp"

namespace barycert::check {
namespace {

/// The lowest node at the place of each.
std::vector<Mesh::Index> lowest_nodes(SurfaceParts& s, const std::vector<std::uint8_t>& used) {
    Mesh places;
    places.points = s.surface.points;
    std::vector<Mesh::Index> nodes, lowest(used.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
        lowest[i] = static_cast<Mesh::Index>(i);
        const double* const p = &s.surface.points[3 * i];
        const bool finite = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
        if (used[i] == 0) s.defects.add(DefectKind::unused_node, {.nodes = {lowest[i], -1, -1}});
        if (!finite) s.defects.add(DefectKind::not_finite, {.nodes = {lowest[i], -1, -1}});
        if (finite && used[i] != 0) nodes.push_back(lowest[i]);
        if (!finite) lowest[i] = -1;
    }
    for (const auto& [first, second] : coincident_nodes(places, nodes)) {
        s.defects.add(DefectKind::coincident_nodes, {.nodes = {first, second, -1}});
        lowest[static_cast<std::size_t>(second)] = first;
    }
    return lowest;
}

}  // namespace

bool place_triangles(SurfaceParts& s) {
    const Surface& surface = s.surface;
    const std::size_t points = surface.point_count(), count = surface.cell_count();
    std::vector<std::uint8_t> used(points, 0);
    const auto is_node = [&](Mesh::Index i) { return i >= 0 && static_cast<std::size_t>(i) < points; };
    for (const Mesh::Index i : surface.cells) {
        if (is_node(i)) used[static_cast<std::size_t>(i)] = 1;
    }
    const std::vector<Mesh::Index> lowest = lowest_nodes(s, used);
    std::vector<Mesh::Index> corners;
    corners.reserve(surface.cells.size());
    std::vector<Mesh::Index> triangle;
    triangle.reserve(count);
    for (std::size_t c = 0; c < count; ++c) {
        const auto cell = static_cast<Mesh::Index>(c);
        const Mesh::Index* const n = &surface.cells[3 * c];
        if (!std::all_of(n, n + 3, is_node)) {
            s.defects.add_marked(DefectKind::index_out_of_range, {.cells = {cell, -1}});
            continue;
        }
        std::array<Mesh::Index, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = lowest[static_cast<std::size_t>(n[k])];
        if (at[0] < 0 || at[1] < 0 || at[2] < 0) continue;  // its node is told
        if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) {
            s.defects.add_marked(DefectKind::repeated_node, {.cells = {cell, -1}, .nodes = {n[0], n[1], n[2]}});
            continue;
        }
        corners.insert(corners.end(), at.begin(), at.end());
        triangle.push_back(cell);
    }
    s.index = make_triangle_index(surface.points, corners);
    const std::size_t placed_count = s.index.cell_count();
    s.facets.resize(placed_count);
    s.odd.resize(placed_count);
    s.triangle.resize(placed_count);
    std::vector<std::uint8_t> bad(placed_count, 0);  // degenerate
    base::parallel_for_each(placed_count, 2048, [&](std::size_t i) {
        PlacedFacet& f = s.facets[i];
        std::copy_n(s.index.cells[i].node.begin(), 3, f.nodes.begin());
        unsigned swaps = 0;
        for (const auto& [a, b] : {std::pair(0U, 1U), {1U, 2U}, {0U, 1U}}) {
            if (f.nodes[b] < f.nodes[a]) std::swap(f.nodes[a], f.nodes[b]), ++swaps;
        }
        for (std::size_t k = 0; k < 3; ++k) f.at[k] = s.index.nodes[static_cast<std::size_t>(f.nodes[k])].at.data();
        s.odd[i] = swaps % 2;
        s.triangle[i] = triangle[static_cast<std::size_t>(s.index.original[i])];
        bad[i] = proper(3, f) ? 0 : 1;
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < placed_count; ++i) {
        if (bad[i] == 1)
            s.defects.add_marked(DefectKind::degenerate_triangle, {.cells = {s.triangle[i], -1}, .nodes = s.nodes(i)});
        if (bad[i] != 0) continue;
        s.facets[kept] = s.facets[i];
        s.odd[kept] = s.odd[i];
        s.triangle[kept++] = s.triangle[i];
    }
    s.facets.resize(kept);
    s.odd.resize(kept);
    s.triangle.resize(kept);
    s.found.places = s.index.original_node.size();
    return kept != 0;
}

std::vector<CellPair> find_intersections(SurfaceParts& s) {
    const std::size_t limit = s.options.verdict_only ? 1 : std::max(pair_limit, s.options.examples);
    const std::vector<FacetPair> pairs = conflicting_pairs(s.index, s.facets, limit);
    std::vector<CellPair> cells;
    std::vector<HangingNode> hanging;
    for (std::size_t i = 0; i < std::min(pairs.size(), limit); ++i) {
        const auto& [first, second] = pairs[i];
        const Mesh::Index a = s.triangle[first], b = s.triangle[second];
        cells.push_back({std::min(a, b), std::max(a, b)});
        const bool swap = a > b;
        if (s.facets[first].nodes == s.facets[second].nodes) {
            s.defects.add_marked(DefectKind::duplicate_triangle,
                                 {.cells = {cells.back()[1], cells.back()[0]}, .nodes = s.nodes(first)});
            cells.pop_back();
            continue;
        }
        s.defects.add_marked(DefectKind::self_intersection, {.cells = cells.back(),
                                                             .nodes = s.nodes(swap ? second : first),
                                                             .other_nodes = s.nodes(swap ? first : second)});
        for (const auto& [of, on] : {pairs[i], FacetPair{second, first}}) {
            const PlacedFacet &f = s.facets[of], &g = s.facets[on];
            for (std::size_t k = 0; k < 3; ++k) {
                const auto face = face_around(3, g, f.at[k]);
                if (face[1] < 0) continue;
                HangingNode node{s.node(f.nodes[k]), face, s.triangle[on]};
                for (Mesh::Index& n : node.face) n = n < 0 ? n : s.node(n);
                hanging.push_back(node);
            }
        }
    }
    if (pairs.size() > limit) {
        for (const DefectKind kind : {DefectKind::self_intersection, DefectKind::duplicate_triangle})
            s.defects[kind].at_least = s.defects[kind].count != 0;
    }
    sort_hanging(hanging);
    for (const HangingNode& h : hanging)
        s.defects.add_marked(DefectKind::hanging_node,
                             {.cells = {h.cell, -1}, .nodes = {h.node, -1, -1}, .other_nodes = h.face});
    return cells;
}

}  // namespace barycert::check
