// Checks the parts of a PLC that are no triangles: segments and nodes of its own, and how flat its facets are.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "barycert/plc.hpp"
#include "barycert/predicates.hpp"
#include "core/base/finite.hpp"
#include "mesh/check/plc_facet.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/check/surface/parts.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/ridges.hpp"

namespace barycert::check {
namespace {

using Segment = std::array<Mesh::Index, 2>;

/// The segments of a facet, the lower node first.
std::vector<Segment> segments_of(const PlcFacet& facet) {
    std::vector<Segment> all;
    for (const auto& polygon : facet.polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Mesh::Index a = polygon[i], b = polygon[(i + 1) % polygon.size()];
            if (a != b) all.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    return all;
}

/// Two segments in space have a point in common that is no common node. Then they lie in one plane, and so do their
/// projections along each axis; along one that is not in the plane, nothing else falls together.
bool segments_conflict(const PlacedFacet& f, const PlacedFacet& g) {
    if (orient3d(f.at[0], f.at[1], g.at[0], g.at[1]) != Sign::zero) return false;
    for (std::size_t dropped = 0; dropped < 3; ++dropped) {
        std::array<PlacedFacet, 2> flat{f, g};
        std::array<std::array<double, 2>, 4> at{};
        for (std::size_t i = 0; i < 4; ++i) {
            const double* const p = flat[i / 2].at[i % 2];
            at[i] = {p[dropped == 0 ? 1 : 0], p[dropped == 2 ? 1 : 2]};
            flat[i / 2].at[i % 2] = at[i].data();
        }
        if (proper(2, flat[0]) && proper(2, flat[1]) && !facets_conflict(2, flat[0], flat[1])) return false;
    }
    return true;
}

class Segments {
public:
    Segments(SurfaceParts& s, const Plc& plc) : s_(s), plc_(plc), place_(plc.point_count(), -1) {
        std::vector<Mesh::Index> same(plc.point_count());
        std::iota(same.begin(), same.end(), 0);
        for (std::size_t i = 0; i < s.triangles.same.size(); ++i) {
            const auto node = static_cast<std::size_t>(s.triangles.node(static_cast<Place>(i)));
            place_[node] = s.triangles.same[i];
            same[node] = s.triangles.node(place_[node]);
        }
        unite(same);
        for (std::size_t i = 0; i < plc.facets.size(); ++i) {
            for (Segment segment : segments_of(plc.facets[i])) {
                for (Mesh::Index& node : segment) node = same[static_cast<std::size_t>(node)];
                std::ranges::sort(segment);
                if (segment[0] != segment[1] && finite(segment[0]) && finite(segment[1])) facets_of_[segment].insert(i);
            }
        }
    }

    /// Polygons that name a node twice, one after the other. Triangles that do are told as such.
    void find_repeated() {
        for (std::size_t i = 0; i < plc_.facets.size(); ++i) {
            const auto& polygons = plc_.facets[i].polygons;
            for (const auto& polygon : polygons) {
                if (polygon.size() < 3 || (polygons.size() == 1 && polygon.size() == 3)) continue;
                for (std::size_t k = 0; k < polygon.size(); ++k) {
                    if (polygon[k] != polygon[(k + 1) % polygon.size()]) continue;
                    s_.defects.add_marked(DefectKind::repeated_node,
                                          {.cells = {triangle_of(i), -1}, .nodes = {polygon[k], -1, -1}});
                }
            }
        }
    }

    /// Segments that are edges of triangles inside facets that do not have them; others are forgotten.
    void find_inner() {
        for_each_ridge(s_.edges, [&](std::span<const Ridge> edge) {
            const auto [u, v] = s_.ends(edge[0]);
            const auto [low, high] = std::minmax({s_.triangles.node(u), s_.triangles.node(v)});
            const auto found = facets_of_.find({low, high});
            if (found == facets_of_.end()) return;
            for (const Ridge& r : edge) {
                const auto facet = static_cast<std::size_t>(s_.surface.facet(s_.triangles.number(r.facet)));
                if (found->second.contains(facet)) continue;
                s_.defects.add_marked(DefectKind::segment_in_facet,
                                      {.cells = {s_.triangles.number(r.facet), -1}, .nodes = {low, high, -1}});
                break;
            }
            facets_of_.erase(found);
        });
    }

    /// Segments of no triangle that meet one another.
    void find_meeting() {
        std::vector<PlacedFacet> all;
        std::vector<Box> of_all;
        for (const auto& entry : facets_of_) {
            all.push_back({{entry.first[0], entry.first[1], -1}, {point(entry.first[0]), point(entry.first[1])}});
            of_all.push_back(index::box_of(3, all.back().at.data(), 2));
        }
        const BoxTree tree(of_all);
        const std::size_t limit = s_.options.verdict_only ? 1 : pair_limit;
        Defect& found = s_.defects[DefectKind::segments_meet];
        for (std::size_t i = 0; i < all.size() && !found.at_least; ++i) {
            tree.for_each(of_all[i], [&](std::size_t j) {
                if (j <= i || !segments_conflict(all[i], all[j])) return true;
                found.at_least = found.count == limit;
                if (!found.at_least)
                    s_.defects.add(DefectKind::segments_meet, {.nodes = {all[i].nodes[0], all[i].nodes[1], -1},
                                                               .other_nodes = {all[j].nodes[0], all[j].nodes[1], -1}});
                return !found.at_least;
            });
        }
    }

    /// Segments and nodes of no triangle, on triangles or across them.
    void find_loose() {
        if (facets_of_.empty() && !have_loose_nodes()) return;
        const BoxGroups boxes = make_cell_tree(s_.triangles.index);
        for (const auto& entry : facets_of_) {
            const Segment& segment = entry.first;
            PlacedFacet f;
            for (std::size_t k = 0; k < 2; ++k) {
                const Place found = place_[static_cast<std::size_t>(segment[k])];
                f.nodes[k] = found < 0 ? -2 - static_cast<Mesh::Index>(k) : found;
                f.at[k] = point(segment[k]);
            }
            boxes.for_each_meeting(box_of(s_.triangles.index, f.at.data(), 2), [&](std::size_t t) {
                if (!segment_conflicts(f, s_.triangles.facets[t])) return true;
                s_.defects.add_marked(DefectKind::segment_in_facet,
                                      {.cells = {s_.triangles.number(t), -1}, .nodes = {segment[0], segment[1], -1}});
                return false;
            });
        }
        for (std::size_t n = 0; n < place_.size(); ++n) {
            const double* const p = point(static_cast<Mesh::Index>(n));
            if (place_[n] >= 0 || !s_.triangles.index.box_holds(p)) continue;
            boxes.for_each_meeting(box_of(s_.triangles.index, &p, 1), [&](std::size_t t) {
                const auto face = face_around(3, s_.triangles.facets[t], p);
                if (face[1] < 0) return true;  // at a node of it is a coincident node
                s_.defects.add_marked(DefectKind::node_on_facet, {.cells = {s_.triangles.number(t), -1},
                                                                  .nodes = {static_cast<Mesh::Index>(n), -1, -1}});
                return false;
            });
        }
    }

    void measure_planes() {
        const index::CellIndex& all = s_.triangles.index;
        double extent = 0;
        for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, all.high[k] / 2 - all.low[k] / 2);
        int exponent = 0;
        std::frexp(extent, &exponent);
        for (std::size_t i = 0; i < plc_.facets.size(); ++i) {
            const PlcFacet& facet = plc_.facets[i];
            if (facet.polygons.size() == 1 && facet.polygons[0].size() < 4) continue;
            const PlcRegion region(plc_, facet, exponent);
            if (!region.proper()) continue;
            double farthest = 0;
            bool flat = true;
            for (const double* const p : region.vertices()) {
                flat = flat && region.in_plane(p);
                farthest = std::max(farthest, region.distance(p));
            }
            if (flat) continue;
            ++s_.found.off_plane;
            const double distance = std::ldexp(farthest, exponent), relative = distance / 2 / extent;
            s_.found.max_off_plane = std::max(s_.found.max_off_plane, distance);
            s_.found.relative_off_plane = std::max(s_.found.relative_off_plane, relative);
            if (triangle_of(i) < 0) continue;
            s_.defects.add(DefectKind::facet_off_plane,
                           {.cells = {triangle_of(i), -1}, .distance = distance, .relative = relative});
        }
    }

private:
    /// The first of a facet; -1: it has none.
    Mesh::Index triangle_of(std::size_t facet) const {
        const auto number = static_cast<Mesh::Index>(facet);
        const std::vector<Mesh::Index>& facets = s_.surface.facets;
        if (facets.empty()) return facet < s_.surface.cell_count() ? number : -1;
        const auto triangle = std::ranges::lower_bound(facets, number);
        return triangle == facets.end() || *triangle != number ? -1
                                                               : static_cast<Mesh::Index>(triangle - facets.begin());
    }

    /// Loose nodes at one place with others are one: those of triangles if there are some, else the lowest.
    void unite(std::vector<Mesh::Index>& same) {
        if (!have_loose_nodes()) return;
        std::vector<Mesh::Index> order;
        for (std::size_t n = 0; n < same.size(); ++n) {
            if (finite(static_cast<Mesh::Index>(n))) order.push_back(static_cast<Mesh::Index>(n));
        }
        const auto before = [&](Mesh::Index a, Mesh::Index b) {
            return std::lexicographical_compare(point(a), point(a) + 3, point(b), point(b) + 3);
        };
        std::stable_partition(order.begin(), order.end(),
                              [&](auto n) { return place_[static_cast<std::size_t>(n)] >= 0; });
        std::ranges::stable_sort(order, before);
        for (std::size_t i = 1; i < order.size(); ++i) {
            const auto node = static_cast<std::size_t>(order[i]);
            if (place_[node] >= 0 || before(order[i - 1], order[i])) continue;
            const Mesh::Index first = same[node] = same[static_cast<std::size_t>(order[i - 1])];
            s_.defects.add(DefectKind::coincident_nodes,
                           {.nodes = {std::min(first, order[i]), std::max(first, order[i]), -1}});
        }
    }

    bool have_loose_nodes() const { return std::ranges::find(place_, -1) != place_.end(); }
    bool finite(Mesh::Index n) const { return base::all_finite({point(n), 3}); }
    const double* point(Mesh::Index n) const { return &s_.surface.points[3 * static_cast<std::size_t>(n)]; }

    SurfaceParts& s_;
    const Plc& plc_;
    std::vector<Place> place_;  ///< of nodes of triangles; -1 of loose ones
    std::map<Segment, std::set<std::size_t>> facets_of_;
};

}  // namespace

void check_segments(SurfaceParts& s, const Plc& plc) {
    Segments segments(s, plc);
    segments.find_repeated();
    segments.find_inner();
    segments.find_meeting();
    segments.find_loose();
    segments.measure_planes();
}

}  // namespace barycert::check
