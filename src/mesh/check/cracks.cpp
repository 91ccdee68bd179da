#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "core/base/disjoint_sets.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/check/surface/parts.hpp"
#include "mesh/index/ridges.hpp"

namespace barycert::check {
namespace {

/// The nodes of the boundary of a mesh, or of open edges of a surface, those to be merged as one.
class Cracks {
public:
    /// Each of the facets has d nodes.
    Cracks(const Mesh& mesh, const std::vector<BoundaryFacet>& facets, int d)
        : mesh_(mesh), facets_(facets), d_(static_cast<std::size_t>(d)) {
        std::vector<Mesh::Index> nodes;
        for (const BoundaryFacet& f : facets) {
            for (std::size_t i = 0; i < d_; ++i) {
                nodes.push_back(f.nodes[i]);
                for (std::size_t j = i + 1; j < d_; ++j) add_edge(f.nodes[i], f.nodes[j]);
            }
        }
        std::ranges::sort(nodes);
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        for (const auto& [first, second] : coincident_nodes(mesh, nodes)) {
            double& kept = shortest_[index(first)];
            kept = std::min(kept, shortest_[index(second)]);
            merge(first, second);
        }
        std::ranges::copy_if(nodes, std::back_inserter(places_), [&](Mesh::Index n) { return of(n) == n; });
    }

    /// Finds near_nodes, of no common cell of `usable`, which are merged: a cell would collapse. True if these are all.
    bool merge_near(DefectList& defects, double ratio, const std::vector<std::uint8_t>& usable) {
        std::vector<double> radius;
        for (const Mesh::Index node : places_) radius.push_back(reach(node, ratio));
        std::vector<NearPair> pairs;
        const bool complete =
            for_each_near(mesh_, places_, radius, 100 * pair_limit, [&](const NearPair& p) { pairs.push_back(p); });
        leave_out_of_cells(usable, pairs);
        for (const NearPair& p : pairs) {
            defects.add(DefectKind::near_nodes, {.nodes = {p.first, p.second, -1},
                                                 .distance = p.distance,
                                                 .relative = p.distance / shortest_edge(p.first, p.second)});
            merge(p.first, p.second);
        }
        if (!complete) defects[DefectKind::near_nodes].at_least = true;
        return complete;
    }

    /// At most so far from a node of the boundary what is near lies.
    double reach(Mesh::Index node, double ratio) const {
        const double edge = shortest_[index(node)];
        return edge == no_edge ? 0 : ratio * edge;
    }
    /// The same for edges and facets; of each node. Farther than a part of an edge away, most nodes of a boundary have
    /// the edges of their neighbours.
    std::vector<double> reach_of_faces(double ratio) const {
        std::vector<double> reaches(mesh_.point_count());
        for (std::size_t n = 0; n < reaches.size(); ++n)
            reaches[n] = reach(static_cast<Mesh::Index>(n), std::min(ratio, 0x1p-4));
        return reaches;
    }
    double shortest_edge(Mesh::Index a, Mesh::Index b) const {
        return std::min(shortest_[index(a)], shortest_[index(b)]);
    }

    /// The node is to be merged with one of the face.
    bool nearly_coincides(const HangingNode& h) {
        return std::ranges::any_of(h.face, [&](Mesh::Index n) { return n >= 0 && of(n) == of(h.node); });
    }

    void merge(Mesh::Index a, Mesh::Index b) {
        merged_[index(a)] = merged_[index(b)] = 1;
        same_.join(index(a), index(b));
    }
    Mesh::Index of(Mesh::Index node) { return static_cast<Mesh::Index>(same_.find(index(node))); }

    /// found(f, g) for facets that become one.
    template <class F>
    void for_each_crack(F&& found) {
        std::vector<std::pair<std::array<Mesh::Index, 3>, std::size_t>> keys;
        for (std::size_t f = 0; f < facets_.size(); ++f) {
            std::array<Mesh::Index, 3> key = facets_[f].nodes;
            bool some = false;
            for (std::size_t i = 0; i < d_; ++i) {
                some = some || merged_[index(key[i])] != 0;
                key[i] = of(key[i]);
            }
            std::ranges::sort(key);
            if (some && std::ranges::adjacent_find(key) == key.end()) keys.emplace_back(key, f);
        }
        std::ranges::sort(keys);
        for (std::size_t i = 1; i < keys.size(); ++i) {
            if (keys[i - 1].first == keys[i].first) found(facets_[keys[i - 1].second], facets_[keys[i].second]);
        }
    }

private:
    static constexpr double no_edge = std::numeric_limits<double>::infinity();

    static std::size_t index(Mesh::Index node) { return static_cast<std::size_t>(node); }

    /// Without those that one cell has.
    void leave_out_of_cells(const std::vector<std::uint8_t>& usable, std::vector<NearPair>& pairs) {
        if (usable.empty()) return;
        const auto nodes_of_pair = [](const NearPair& p) { return std::pair(p.first, p.second); };
        std::ranges::sort(pairs, {}, nodes_of_pair);
        constexpr double of_one_cell = -1;
        for (std::size_t cell = 0; !pairs.empty() && cell < usable.size(); ++cell) {
            const std::span nodes = mesh_.corners_of(cell);
            for (std::size_t i = 0; usable[cell] != 0 && i < nodes.size(); ++i) {
                for (std::size_t j = i + 1; j < nodes.size(); ++j) {
                    const std::pair<Mesh::Index, Mesh::Index> two = std::minmax({of(nodes[i]), of(nodes[j])});
                    const auto pair = std::ranges::lower_bound(pairs, two, {}, nodes_of_pair);
                    if (pair != pairs.end() && nodes_of_pair(*pair) == two) pair->distance = of_one_cell;
                }
            }
        }
        std::erase_if(pairs, [](const NearPair& p) { return p.distance == of_one_cell; });
    }

    void add_edge(Mesh::Index a, Mesh::Index b) {
        const double length = node_distance(mesh_, a, b);
        if (length == 0) return;
        for (const Mesh::Index n : {a, b}) shortest_[index(n)] = std::min(shortest_[index(n)], length);
    }

    const Mesh& mesh_;
    const std::vector<BoundaryFacet>& facets_;
    std::size_t d_;
    base::DisjointSets same_{mesh_.point_count()};
    /// The shortest edge of the boundary at each node.
    std::vector<double> shortest_ = std::vector<double>(mesh_.point_count(), no_edge);
    std::vector<std::uint8_t> merged_ = std::vector<std::uint8_t>(mesh_.point_count(), 0);
    std::vector<Mesh::Index> places_;  ///< of nodes at one place the lowest
};

}  // namespace

void find_cracks(Checked& c, const BoundaryContacts& touching, const std::vector<CellPair>& meeting) {
    const Mesh& mesh = c.mesh;
    DefectList& defects = c.defects;
    Cracks cracks(mesh, c.boundary, mesh.dimension);
    if (c.options.near > 0 && !cracks.merge_near(defects, c.options.near, c.usable))
        defects[DefectKind::crack].at_least = true;
    std::vector<HangingNode> hanging = touching.hanging, nearly;
    std::erase_if(hanging, [&](const HangingNode& h) { return cracks.nearly_coincides(h); });
    const auto tell = [&](const HangingNode& h, DefectKind kind) {
        defects.add_marked(kind, {.cells = {h.cell, -1},
                                  .nodes = {h.node, -1, -1},
                                  .other_nodes = h.face,
                                  .distance = h.distance,
                                  .relative = h.distance / cracks.shortest_edge(h.node, h.node)});
    };
    for (const HangingNode& h : hanging) tell(h, DefectKind::hanging_node);
    if (!touching.complete) defects[DefectKind::hanging_node].at_least = true;
    if (c.options.near > 0) {
        auto found = nearly_hanging(c, cracks.reach_of_faces(c.options.near), 10 * pair_limit);
        nearly = std::move(found.list);
        std::erase_if(nearly, [&](const HangingNode& h) {
            return cracks.nearly_coincides(h) || std::ranges::binary_search(hanging, h.node, {}, &HangingNode::node);
        });
        for (const HangingNode& h : nearly) tell(h, DefectKind::near_hanging);
        if (!found.complete) defects[DefectKind::near_hanging].at_least = true;
    }
    // Two cells that meet where they must not are explained if one has a node and the other its twin, or what it hangs
    // on.
    std::vector<std::uint8_t> twin(mesh.point_count(), 0);
    const auto find_cause = [&](Mesh::Index cell, Mesh::Index other) {
        const std::span others = mesh.corners_of(static_cast<std::size_t>(other));
        for (const Mesh::Index a : mesh.corners_of(static_cast<std::size_t>(cell))) {
            for (const Mesh::Index b : others) {
                if (a == b || cracks.of(a) != cracks.of(b)) continue;
                twin[static_cast<std::size_t>(a)] = twin[static_cast<std::size_t>(b)] = 1;
                if (node_distance(mesh, a, b) != 0) defects[DefectKind::near_nodes].cause = true;
            }
            const auto has = [&](Mesh::Index n) { return n < 0 || std::ranges::count(others, n) != 0; };
            auto h = std::ranges::lower_bound(nearly, a, {}, &HangingNode::node);
            for (; h != nearly.end() && h->node == a; ++h) {
                if (std::ranges::all_of(h->face, has)) defects[DefectKind::near_hanging].cause = true;
            }
        }
    };
    for (const CellPair& p : meeting) {
        find_cause(p[0], p[1]);
        find_cause(p[1], p[0]);
    }
    const auto is_twin = [&](Mesh::Index n) { return n >= 0 && twin[static_cast<std::size_t>(n)] != 0; };
    cracks.for_each_crack([&](const BoundaryFacet& f, const BoundaryFacet& g) {
        defects.add_marked(DefectKind::crack, {.cells = {f.cell, g.cell}, .nodes = f.nodes, .other_nodes = g.nodes});
        if (std::ranges::any_of(f.nodes, is_twin) || std::ranges::any_of(g.nodes, is_twin))
            defects[DefectKind::crack].cause = true;
    });
}

void find_surface_cracks(SurfaceParts& s) {
    if (s.open.empty() || s.options.near == 0) return;
    Mesh places;
    places.points = s.surface.points;
    std::vector<BoundaryFacet> edges;
    for (const Ridge& edge : s.open) edges.push_back({s.triangles.number(edge.facet), 0, s.place_of(edge).nodes});
    Cracks cracks(places, edges, 2);
    cracks.merge_near(s.defects, s.options.near, {});
    cracks.for_each_crack([&](const BoundaryFacet& f, const BoundaryFacet& g) {
        s.defects.add_marked(DefectKind::crack, {.cells = {f.cell, g.cell}, .nodes = f.nodes, .other_nodes = g.nodes});
    });
}

}  // namespace barycert::check
