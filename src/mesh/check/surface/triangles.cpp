#include "mesh/index/triangles.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "barycert/surface.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/check/surface/parts.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/open_sheets.hpp"

namespace barycert::check {

namespace {

/// Counts the places of nodes with finite coordinates. The places of the triangles' nodes are known.
std::uint64_t count_places(const SurfaceParts& s, const std::vector<std::uint8_t>& finite) {
    std::vector<std::uint8_t> known(finite.size(), 0);
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < s.triangles.same.size(); ++i) {
        known[static_cast<std::size_t>(s.triangles.node(static_cast<Place>(i)))] = 1;
        count += s.triangles.same[i] == static_cast<Place>(i) ? 1 : 0;
    }
    const auto at = [&](std::size_t n) {
        return std::array{s.surface.points[3 * n], s.surface.points[3 * n + 1], s.surface.points[3 * n + 2]};
    };
    std::vector<std::size_t> others;
    for (std::size_t n = 0; n < finite.size(); ++n) {
        if (finite[n] != 0 && known[n] == 0) others.push_back(n);
    }
    if (others.empty()) return count;
    std::ranges::sort(others, {}, at);
    others.erase(std::unique(others.begin(), others.end(), [&](auto a, auto b) { return at(a) == at(b); }),
                 others.end());
    count += others.size();
    // Leaves out places of triangles' nodes, once each: they are counted already.
    std::vector<std::array<double, 3>> met;
    for (std::size_t n = 0; n < finite.size(); ++n) {
        if (known[n] != 0 && std::ranges::binary_search(others, at(n), {}, at)) met.push_back(at(n));
    }
    std::ranges::sort(met);
    return count - static_cast<std::uint64_t>(std::unique(met.begin(), met.end()) - met.begin());
}

}  // namespace

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
    s.found.places = count_places(s, finite);
    for (std::size_t i = 0; i < s.triangles.same.size(); ++i) {
        const Place first = s.triangles.same[i];
        if (first == static_cast<Place>(i)) continue;
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
