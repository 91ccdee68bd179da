#include "barycert/base/lists.hpp"
#include "barycert/check/surface/parts.hpp"

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
        } else if (ascending != 1 && !s.found.plc) {
            DefectPlace place = s.place_of(edge[0]);
            place.cells[1] = s.triangles.number(edge[1].facet);
            s.defects.add_marked(DefectKind::misoriented_edge, place);
        }
        for (std::size_t i = 1; i < edge.size(); ++i) s.shells.join(edge[0].facet, edge[i].facet);
        if (!s.embedded) return;
        // Of a triangle that ascends, the side where its normal points looks forward in the turn.
        const std::span<const Ridge> ring = turn.sorted(edge);
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Ridge &a = ring[i], &b = ring[(i + 1) % ring.size()];
            s.sides.join(2 * std::size_t{a.facet} + (s.triangles.ascends(a) ? 0 : 1),
                         2 * std::size_t{b.facet} + (s.triangles.ascends(b) ? 1 : 0));
        }
    });
    for (const auto& [node, triangle] : s.pinched) {
        s.found.manifold = false;
        s.defects.add_marked(DefectKind::nonmanifold_node,
                             {.cells = {s.triangles.number(static_cast<std::size_t>(triangle)), -1},
                              .nodes = {s.triangles.node(node), -1, -1}});
    }
}

}  // namespace barycert::check
