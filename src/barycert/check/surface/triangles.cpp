#include "barycert/check/surface/parts.hpp"

namespace barycert::check {

bool check_triangles(SurfaceParts& s) {
    const Surface& surface = s.surface;
    const std::size_t points = surface.point_count(), count = surface.cell_count();
    std::vector<std::uint8_t> used(points, 0);
    mark_used(surface.cells, used);
    const std::vector<std::uint8_t> finite = find_finite(surface.points, 3, used, s.defects);
    const auto is_finite = [&](Mesh::Index i) { return finite[static_cast<std::size_t>(i)] != 0; };
    const auto is_node = [&](Mesh::Index i) { return i >= 0 && static_cast<std::size_t>(i) < points; };
    std::vector<Mesh::Index> corners, numbers;
    corners.reserve(surface.cells.size());
    numbers.reserve(count);
    for (std::size_t c = 0; c < count; ++c) {
        const auto cell = static_cast<Mesh::Index>(c);
        const Mesh::Index* const n = &surface.cells[3 * c];
        if (!std::all_of(n, n + 3, is_node)) {
            s.defects.add_marked(DefectKind::index_out_of_range, {.cells = {cell, -1}});
            continue;
        }
        if (!std::all_of(n, n + 3, is_finite)) continue;  // its node is told
        if (n[0] == n[1] || n[1] == n[2] || n[2] == n[0]) {
            s.defects.add_marked(DefectKind::repeated_node, {.cells = {cell, -1}, .nodes = {n[0], n[1], n[2]}});
            continue;
        }
        corners.insert(corners.end(), n, n + 3);
        numbers.push_back(cell);
    }
    s.triangles = place_triangles(surface.points, corners, numbers);
    for (const Mesh::Index cell : s.triangles.degenerate) {
        const Mesh::Index* const n = &surface.cells[3 * static_cast<std::size_t>(cell)];
        s.defects.add_marked(DefectKind::degenerate_triangle, {.cells = {cell, -1}, .nodes = {n[0], n[1], n[2]}});
    }
    s.found.places = s.triangles.same.size();
    for (std::size_t i = 0; i < s.triangles.same.size(); ++i) {
        const Place first = s.triangles.same[i];
        if (first == static_cast<Place>(i)) continue;
        --s.found.places;
        const auto [low, high] = std::minmax({s.triangles.node(first), s.triangles.node(static_cast<Place>(i))});
        s.defects.add(DefectKind::coincident_nodes, {.nodes = {low, high, -1}});
    }
    return s.triangles.size() != 0;
}

std::vector<CellPair> find_intersections(SurfaceParts& s) {
    const std::size_t limit = s.options.verdict_only ? 1 : std::max(pair_limit, s.options.examples);
    const std::vector<FacetPair> pairs = conflicting_pairs(s.triangles.index, s.triangles.facets, limit);
    std::vector<CellPair> cells;
    std::vector<HangingNode> hanging;
    for (std::size_t i = 0; i < std::min(pairs.size(), limit); ++i) {
        auto [first, second] = pairs[i];
        if (s.triangles.number(first) > s.triangles.number(second)) std::swap(first, second);
        const Mesh::Index a = s.triangles.number(first), b = s.triangles.number(second);
        if (s.triangles.facets[first].nodes == s.triangles.facets[second].nodes) {
            s.defects.add_marked(DefectKind::duplicate_triangle, {.cells = {b, a}, .nodes = s.triangles.nodes(first)});
            continue;
        }
        cells.push_back({a, b});
        s.defects.add_marked(
            DefectKind::self_intersection,
            {.cells = {a, b}, .nodes = s.triangles.nodes(first), .other_nodes = s.triangles.nodes(second)});
        for (const auto& [of, on] : {FacetPair{first, second}, FacetPair{second, first}})
            add_hanging(3, s.triangles.facets[of], s.triangles.facets[on], s.triangles.number(on), hanging);
    }
    if (pairs.size() > limit) {
        for (const DefectKind kind : {DefectKind::self_intersection, DefectKind::duplicate_triangle})
            s.defects[kind].at_least = s.defects[kind].count != 0;
    }
    for (HangingNode& h : hanging) {  // of triangles that are not degenerate: now of the surface
        h.node = s.triangles.node(h.node);
        for (Mesh::Index& n : h.face) n = n < 0 ? n : s.triangles.node(n);
    }
    sort_hanging(hanging);
    for (const HangingNode& h : hanging)
        s.defects.add_marked(DefectKind::node_on_facet,
                             {.cells = {h.cell, -1}, .nodes = {h.node, -1, -1}, .other_nodes = h.face});
    return cells;
}

}  // namespace barycert::check
