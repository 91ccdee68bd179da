#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "core/base/disjoint_sets.hpp"
#include "core/base/lists.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/check/surface/parts.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/open_sheets.hpp"
#include "mesh/index/ridges.hpp"
#include "mesh/index/triangles.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::check {

void link_triangles(SurfaceParts& s) {
    s.edges = ridges_of(3, s.triangles.facets);
    const auto& facets = s.triangles.facets;
    const base::Lists<std::uint32_t> around(s.triangles.index.original_node.size(), [&](const auto& add) {
        for (std::size_t f = 0; f < facets.size(); ++f) {
            for (const Mesh::Index n : facets[f].nodes) add(static_cast<std::size_t>(n), static_cast<std::uint32_t>(f));
        }
    });
    std::vector<std::uint8_t> several(around.size(), 0);  // fans
    base::parallel_for(around.size(), 1024, [&](std::size_t first, std::size_t last) {
        std::vector<Mesh::Index> ring;  // the other nodes of triangles at the node, two each
        for (std::size_t n = first; n < last; ++n) {
            ring.clear();
            for (const std::uint32_t f : around[n]) {
                for (const Mesh::Index other : facets[f].nodes) {
                    if (other != static_cast<Mesh::Index>(n)) ring.push_back(other);
                }
            }
            // Triangles that have been reached come first.
            std::size_t reached = 2;
            for (std::size_t from = 0; from < reached && reached < ring.size(); ++from) {
                for (std::size_t i = reached; i < ring.size(); i += 2) {
                    if (ring[i] != ring[from] && ring[i + 1] != ring[from]) continue;
                    std::swap(ring[i], ring[reached]);
                    std::swap(ring[i + 1], ring[reached + 1]);
                    reached += 2;
                }
            }
            several[n] = reached < ring.size() ? 1 : 0;
        }
    });
    for (std::size_t n = 0; n < several.size(); ++n) {
        if (several[n] != 0) s.pinched.push_back({static_cast<Place>(n), static_cast<Place>(around[n].back())});
    }
}

void connect_triangles(SurfaceParts& s) {
    s.shells = base::DisjointSets(s.triangles.facets.size());
    s.sides = base::DisjointSets(2 * s.triangles.facets.size());
    s.found.closed = s.found.manifold = s.found.oriented = true;
    RidgeTurn turn(3, s.triangles.facets);
    for_each_ridge(s.edges, [&](std::span<const Ridge> edge) {
        ++s.found.edges;
        const auto ascending = static_cast<std::size_t>(
            std::ranges::count_if(edge, [&](const Ridge& r) { return s.triangles.ascends(r); }));
        if (edge.size() > 1 && 2 * ascending != edge.size()) s.found.oriented = false;
        if (2 * ascending != edge.size()) s.unbalanced.push_back(edge[0]);
        if (edge.size() == 1) {
            s.found.closed = false;
            s.open.push_back(edge[0]);
            s.defects.add_marked(DefectKind::open_edge, s.place_of(edge[0]));
        } else if (edge.size() > 2) {
            s.found.manifold = false;
            s.defects.add_marked(DefectKind::nonmanifold_edge, s.place_of(edge[0]));
        } else if (ascending != 1 && (!s.found.plc || s.options.turned_facets)) {
            DefectPlace place = s.place_of(edge[0]);
            place.cells[1] = s.triangles.number(edge[1].facet);
            s.defects.add_marked(DefectKind::misoriented_edge, place);
        }
        for (std::size_t i = 1; i < edge.size(); ++i) s.shells.join(edge[0].facet, edge[i].facet);
        if (!s.embedded) return;
        join_sides(s.triangles, turn.sorted(edge), s.sides);
    });
    for (const auto& [node, triangle] : s.pinched) {
        s.found.manifold = false;
        s.defects.add_marked(DefectKind::nonmanifold_node,
                             {.cells = {s.triangles.number(static_cast<std::size_t>(triangle)), -1},
                              .nodes = {s.triangles.node(node), -1, -1}});
    }
}

namespace {

/// The surface's own nodes of the edge of a triangle, the lower one first.
std::array<Mesh::Index, 2> own_ends(const SurfaceParts& s, const Ridge& edge) {
    const auto& facet = s.triangles.facets[edge.facet];
    const Mesh::Index* const corners = &s.surface.cells[3 * static_cast<std::size_t>(s.triangles.number(edge.facet))];
    std::array<Mesh::Index, 2> own{-1, -1};
    std::size_t found = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double* const p = &s.surface.points[3 * static_cast<std::size_t>(corners[c])];
        if (!std::equal(p, p + 3, facet.at[edge.other])) own[found++ % 2] = corners[c];
    }
    if (own[1] < own[0]) std::swap(own[0], own[1]);
    return own;
}

}  // namespace

std::vector<CellPair> find_passing_sheets(SurfaceParts& s) {
    std::vector<CellPair> pairs;
    if (!s.triangles.joined || !s.embedded) return pairs;
    RidgeTurn turn(3, s.triangles.facets);
    for_each_ridge(s.edges, [&](std::span<const Ridge> edge) {
        if (edge.size() < 4) return;
        const std::span<const Ridge> ring = turn.sorted(edge);
        // Sheets of two triangles, by where these are in the turn.
        std::map<std::array<Mesh::Index, 2>, std::vector<std::size_t>> places;
        for (std::size_t i = 0; i < ring.size(); ++i) places[own_ends(s, ring[i])].push_back(i);
        std::vector<std::array<std::size_t, 2>> sheets;
        for (const auto& [ends, at] : places) {
            if (at.size() == 2) sheets.push_back({at[0], at[1]});
        }
        std::ranges::sort(sheets);
        const auto lower = [&](const std::array<std::size_t, 2>& sheet) {
            const std::size_t a = ring[sheet[0]].facet, b = ring[sheet[1]].facet;
            return s.triangles.number(a) < s.triangles.number(b) ? a : b;
        };
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            for (std::size_t j = i + 1; j < sheets.size() && sheets[j][0] < sheets[i][1]; ++j) {
                if (sheets[j][1] < sheets[i][1]) continue;
                if (pairs.size() == pair_limit) {
                    s.defects[DefectKind::self_intersection].at_least = true;
                    return;
                }
                std::size_t first = lower(sheets[i]), second = lower(sheets[j]);
                if (s.triangles.number(second) < s.triangles.number(first)) std::swap(first, second);
                pairs.push_back({s.triangles.number(first), s.triangles.number(second)});
                s.defects.add_marked(DefectKind::self_intersection, {.cells = pairs.back(),
                                                                     .nodes = s.triangles.nodes(first),
                                                                     .other_nodes = s.triangles.nodes(second)});
            }
        }
    });
    return pairs;
}

}  // namespace barycert::check
