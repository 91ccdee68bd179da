#include "barycert/check/near_nodes.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "barycert/base/disjoint_sets.hpp"
#include "barycert/check/names.hpp"
#include "barycert/check/pairs.hpp"
#include "barycert/index/box_tree.hpp"

namespace barycert::check {
namespace {

std::array<double, 3> node_place(const Mesh& mesh, Mesh::Index node) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::array<double, 3> at{0, 0, 0};
    std::copy_n(&mesh.points[static_cast<std::size_t>(node) * d], d, at.begin());
    return at;
}

/// The nodes of the boundary, those to be merged as one.
class Cracks {
public:
    Cracks(const Mesh& mesh, const std::vector<BoundaryFacet>& facets, double near)
        : mesh_(mesh),
          d_(static_cast<std::size_t>(mesh.dimension)),
          facets_(facets),
          near_(near),
          same_(mesh.point_count()),
          shortest_(mesh.point_count(), no_edge),
          merged_(mesh.point_count(), 0) {
        for (const BoundaryFacet& f : facets) {
            for (std::size_t i = 0; i + 1 < d_; ++i) {
                for (std::size_t j = i + 1; j < d_; ++j) add_edge(f.nodes[i], f.nodes[j]);
            }
        }
        std::vector<Mesh::Index> nodes;
        for (const BoundaryFacet& f : facets)
            nodes.insert(nodes.end(), f.nodes.begin(), f.nodes.begin() + mesh.dimension);
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        for (const auto& [first, second] : coincident_nodes(mesh, nodes)) {
            double& kept = shortest_[index(first)];
            kept = std::min(kept, shortest_[index(second)]);
            merge(first, second);
        }
        for (const Mesh::Index node : nodes) {
            if (of(node) == node) places_.push_back(node);
        }
    }

    /// The near ones, of no common cell: merging would make it collapse.
    std::vector<NearPair> find_near(const std::vector<std::uint8_t>& usable) {
        std::vector<double> radius;
        radius.reserve(places_.size());
        for (const Mesh::Index node : places_) {
            const double edge = shortest_[index(node)];
            radius.push_back(edge == no_edge ? 0 : near_ * edge);
        }
        std::vector<NearPair> pairs = near_pairs(mesh_, places_, radius, 100 * pair_limit);
        std::vector<std::uint8_t> apart(pairs.size(), 1);
        for (std::size_t i = 0; !pairs.empty() && i < mesh_.cells.size(); ++i) {
            const std::size_t cell = i / mesh_.corners();
            for (std::size_t j = i + 1; usable[cell] != 0 && j < (cell + 1) * mesh_.corners(); ++j) {
                const auto [a, b] = std::minmax({of(mesh_.cells[i]), of(mesh_.cells[j])});
                const auto pair = std::lower_bound(pairs.begin(), pairs.end(), std::tuple(a, b), before);
                if (pair != pairs.end() && pair->first == a && pair->second == b)
                    apart[static_cast<std::size_t>(pair - pairs.begin())] = 0;
            }
        }
        std::vector<NearPair> near;
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            if (apart[i] != 0) near.push_back(pairs[i]);
        }
        return near;
    }

    double relative(const NearPair& p) const {
        return p.distance / std::min(shortest_[index(p.first)], shortest_[index(p.second)]);
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
            std::sort(key.begin(), key.end());
            if (some && std::adjacent_find(key.begin(), key.end()) == key.end()) keys.emplace_back(key, f);
        }
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = 1; i < keys.size(); ++i) {
            if (keys[i - 1].first == keys[i].first) found(facets_[keys[i - 1].second], facets_[keys[i].second]);
        }
    }

private:
    static constexpr double no_edge = std::numeric_limits<double>::infinity();

    static std::size_t index(Mesh::Index node) { return static_cast<std::size_t>(node); }
    static bool before(const NearPair& p, const std::tuple<Mesh::Index, Mesh::Index>& q) {
        return std::tuple(p.first, p.second) < q;
    }

    void add_edge(Mesh::Index a, Mesh::Index b) {
        const double length = node_distance(mesh_, a, b);
        if (length == 0) return;
        for (const Mesh::Index n : {a, b}) shortest_[index(n)] = std::min(shortest_[index(n)], length);
    }

    const Mesh& mesh_;
    std::size_t d_;
    const std::vector<BoundaryFacet>& facets_;
    double near_;
    base::DisjointSets same_;
    std::vector<double> shortest_;  ///< of the boundary's edges at each node
    std::vector<std::uint8_t> merged_;
    std::vector<Mesh::Index> places_;  ///< of nodes at one place the lowest
};

}  // namespace

double node_distance(const Mesh& mesh, Mesh::Index a, Mesh::Index b) {
    const auto p = node_place(mesh, a), q = node_place(mesh, b);
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

std::vector<std::array<Mesh::Index, 2>> coincident_nodes(const Mesh& mesh, const std::vector<Mesh::Index>& nodes) {
    struct PlacedNode {
        std::array<double, 3> at;
        Mesh::Index node;
    };
    std::vector<PlacedNode> placed;
    placed.reserve(nodes.size());
    for (const Mesh::Index n : nodes) placed.push_back({node_place(mesh, n), n});
    tbb::parallel_sort(placed.begin(), placed.end(), [](const PlacedNode& a, const PlacedNode& b) {
        return a.at != b.at ? a.at < b.at : a.node < b.node;
    });
    std::vector<std::array<Mesh::Index, 2>> pairs;
    for (std::size_t i = 1, first = 0; i < placed.size(); ++i) {
        if (placed[i].at != placed[first].at) {
            first = i;
        } else {
            pairs.push_back({placed[first].node, placed[i].node});
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
    return pairs;
}

std::vector<NearPair> near_pairs(const Mesh& mesh, const std::vector<Mesh::Index>& nodes,
                                 const std::vector<double>& radius, std::size_t limit) {
    std::vector<Box> boxes(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto at = node_place(mesh, nodes[i]);
        // Rounding keeps the order: no double within the radius is left out.
        for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k)
            boxes[i].low[k] = at[k] - radius[i], boxes[i].high[k] = at[k] + radius[i];
    }
    const BoxTree tree(std::move(boxes));
    std::vector<NearPair> all;
    in_waves(
        nodes.size(), 1024, [] { return std::vector<NearPair>(); },
        [&](std::size_t first, std::size_t last, std::vector<NearPair>& part) {
            for (std::size_t i = first; i < last; ++i) {
                const auto at = node_place(mesh, nodes[i]);
                tree.for_each(Box{at, at}, [&](std::uint32_t j) {
                    if (j <= i) return true;
                    const double apart = node_distance(mesh, nodes[i], nodes[j]);
                    if (apart <= std::min(radius[i], radius[j])) part.push_back({nodes[i], nodes[j], apart});
                    return part.size() <= limit;
                });
            }
        },
        [&](const std::vector<NearPair>& part) { all.insert(all.end(), part.begin(), part.end()); },
        [&] { return all.size() <= limit; });
    for (NearPair& p : all) {
        if (p.second < p.first) std::swap(p.first, p.second);
    }
    std::sort(all.begin(), all.end(), [](const NearPair& p, const NearPair& q) {
        return std::tie(p.first, p.second) < std::tie(q.first, q.second);
    });
    return all;
}

void find_cracks(const Mesh& mesh, const std::vector<std::uint8_t>& usable, const std::vector<BoundaryFacet>& facets,
                 double near, const std::vector<std::uint8_t>& in_contact, CellMeasures& measures,
                 DefectList& defects) {
    Cracks cracks(mesh, facets, near);
    const auto is_cause = [&](auto first, auto last) {
        return !in_contact.empty() && std::any_of(first, last, [&](Mesh::Index n) {
            return n >= 0 && in_contact[static_cast<std::size_t>(n)] != 0;
        });
    };
    if (near > 0) {
        for (const NearPair& p : cracks.find_near(usable)) {
            const DefectPlace place{
                .nodes = {p.first, p.second, -1}, .distance = p.distance, .relative = cracks.relative(p)};
            defects.add(DefectKind::near_nodes, place);
            if (is_cause(place.nodes.begin(), place.nodes.end())) defects.cause(DefectKind::near_nodes);
            cracks.merge(p.first, p.second);
        }
    }
    cracks.for_each_crack([&](const BoundaryFacet& f, const BoundaryFacet& g) {
        for (const Mesh::Index cell : {f.cell, g.cell})
            measures.defects[static_cast<std::size_t>(cell)] |= defect_bit(DefectKind::crack);
        defects.add(DefectKind::crack, {.cells = {f.cell, g.cell}, .nodes = f.nodes, .other_nodes = g.nodes});
        if (is_cause(f.nodes.begin(), f.nodes.end()) || is_cause(g.nodes.begin(), g.nodes.end()))
            defects.cause(DefectKind::crack);
    });
}

}  // namespace barycert::check
