#include "mesh/facets/facet_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "core/base/vectors.hpp"
#include "mesh/cell_types.hpp"

namespace barycert::surface {
namespace {

using Node = std::size_t;  ///< of the facet, in the order of the sweep
using DirectedEdge = std::pair<Node, Node>;
using Place = std::array<double, 2>;  ///< in the projection

int turn_of(const Place& a, const Place& b, const Place& c) {
    return static_cast<int>(orient2d(a.data(), b.data(), c.data()));
}

struct EdgeHash {
    std::size_t operator()(const DirectedEdge& e) const { return (e.first << 32 | e.second) * 0x9E3779B97F4A7C15U; }
};

/// The axis to project along.
class Projection {
public:
    Projection(std::span<const double> points, const std::vector<Mesh::Index>& nodes) : points_(points) {
        if (nodes.empty()) return;
        // From a node, in a unit in which nothing over- or underflows.
        const Vector o = at(nodes[0]);
        double extent = 0;
        for (const Mesh::Index n : nodes) {
            for (const double x : base::minus(at(n), o)) extent = std::max(extent, std::fabs(x));
        }
        if (extent == 0) return;
        const int unit = std::ilogb(extent);
        const auto from = [&](Mesh::Index n) {
            Vector v = base::minus(at(n), o);
            for (double& x : v) x = std::scalbn(x, -unit);
            return v;
        };
        const auto length = [](const Vector& v) { return std::hypot(v[0], v[1], v[2]); };
        const Vector a = from(*std::ranges::max_element(nodes, {}, [&](auto n) { return length(from(n)); }));
        Vector normal{};
        for (const Mesh::Index n : nodes) {
            const Vector other = base::cross(a, from(n));
            if (length(other) > length(normal)) normal = other;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::fabs(normal[k]) > std::fabs(normal[axis_])) axis_ = k;
        }
    }
    Place operator()(const double* p) const { return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]}; }
    Place operator()(Mesh::Index n) const { return (*this)(&points_[3 * static_cast<std::size_t>(n)]); }

private:
    using Vector = base::Vector3<double>;
    /// Halved, so that differences do not overflow.
    Vector at(Mesh::Index n) const {
        const double* const p = &points_[3 * static_cast<std::size_t>(n)];
        return {p[0] / 2, p[1] / 2, p[2] / 2};
    }
    std::span<const double> points_;
    std::size_t axis_ = 2;
};

/// Triangles by their directed edges: edge (a, b) and what lies to its left.
class Triangulation {
public:
    explicit Triangulation(std::vector<Place> at) : at_(std::move(at)), out_(at_.size(), 0) { sweep(); }

    bool flat() const { return apex_.empty(); }

    int turn(Node a, Node b, Node c) const { return turn_of(at_[a], at_[b], at_[c]); }

    /// Makes ab an edge. fault(kind, a, b, x, y) tells of a node x on it, or a segment xy that it crosses.
    template <class Fault>
    void insert(Node a, Node b, Fault fault) {
        while (a != b) {
            if (has(a, b)) {
                segments_.insert(ordered(a, b));
                return;
            }
            std::deque<DirectedEdge> crossed;
            const Node end = trace(a, b, crossed);
            if (end == at_.size()) return fault(FacetFault::Kind::crossing, a, b, crossed.back());
            if (end != b) fault(FacetFault::Kind::on_segment, a, b, DirectedEdge{end, end});
            uncross(a, end, crossed);
            segments_.insert(ordered(a, end));
            a = end;
        }
    }

    /// The triangles that cannot be reached from outside, or from a place in a hole, over no segment.
    std::vector<std::array<Node, 3>> region(const std::vector<Place>& holes) {
        std::vector<DirectedEdge> open;  // edges of triangles that go
        for (const auto& entry : apex_) {
            const DirectedEdge edge = entry.first;
            const Node apex = entry.second;
            const DirectedEdge back{edge.second, edge.first};
            if (!apex_.contains(back) && !segments_.contains(ordered(edge.first, edge.second))) open.push_back(edge);
            if (std::ranges::any_of(holes, [&](const auto& p) { return holds(edge, apex, p); })) open.push_back(edge);
        }
        while (!open.empty()) {
            const DirectedEdge edge = open.back();
            open.pop_back();
            const auto found = apex_.find(edge);
            if (found == apex_.end()) continue;
            const std::array<Node, 3> t{edge.first, edge.second, found->second};
            for (std::size_t k = 0; k < 3; ++k) {
                const Node a = t[k], b = t[(k + 1) % 3];
                apex_.erase({a, b});
                if (!segments_.contains(ordered(a, b))) open.emplace_back(b, a);
            }
        }
        std::vector<std::array<Node, 3>> all;
        for (const auto& [edge, apex] : apex_) {
            if (edge.first < edge.second && edge.first < apex) all.push_back({edge.first, edge.second, apex});
        }
        std::ranges::sort(all);
        return all;
    }

private:
    static DirectedEdge ordered(Node a, Node b) { return a < b ? DirectedEdge{a, b} : DirectedEdge{b, a}; }
    bool has(Node a, Node b) const { return apex_.contains({a, b}) || apex_.contains({b, a}); }

    void add(Node a, Node b, Node c) {
        apex_[{a, b}] = c;
        apex_[{b, c}] = a;
        apex_[{c, a}] = b;
        out_[a] = b, out_[b] = c, out_[c] = a;
    }

    bool holds(const DirectedEdge& edge, Node apex, const Place& p) const {
        const std::array<Node, 3> t{edge.first, edge.second, apex};
        for (std::size_t k = 0; k < 3; ++k) {
            if (turn_of(at_[t[k]], at_[t[(k + 1) % 3]], p) < 0) return false;
        }
        return true;
    }

    /// Each point in turn, all before it to its left or below it: with it and the edges of the hull that it sees.
    void sweep() {
        const std::size_t n = at_.size();
        std::size_t first = 2;  // not on a line with those before it
        while (first < n && turn(0, 1, first) == 0) ++first;
        if (first >= n) return;
        std::vector<Node> next(n), previous(n);  // counterclockwise around the hull
        const auto link = [&](Node a, Node b) { next[a] = b, previous[b] = a; };
        const bool left = turn(0, 1, first) > 0;
        for (Node i = 0; i + 1 < first; ++i) {
            left ? add(i, i + 1, first) : add(i + 1, i, first);
            left ? link(i, i + 1) : link(i + 1, i);
        }
        left ? (link(first - 1, first), link(first, 0)) : (link(0, first), link(first, first - 1));
        for (Node p = first + 1; p < n; ++p) {
            Node low = p - 1, high = p - 1;
            for (; turn(p, high, next[high]) < 0; high = next[high]) add(p, next[high], high);
            for (; turn(p, previous[low], low) < 0; low = previous[low]) add(p, low, previous[low]);
            link(low, p), link(p, high);
        }
    }

    /// f(x, y) for each triangle (a, x, y), until it returns true.
    template <class F>
    bool around(Node a, F f) const {
        const Node start = out_[a];
        for (Node x = start;;) {
            const auto found = apex_.find({a, x});
            if (found == apex_.end()) break;
            if (f(x, found->second)) return true;
            x = found->second;
            if (x == start) return false;
        }
        for (Node y = start;;) {
            const auto found = apex_.find({y, a});
            if (found == apex_.end()) return false;
            if (f(found->second, y)) return true;
            y = found->second;
        }
    }

    /// The edges between a and b; returns b, a node before it on ab, or no node at a segment, which is the last edge.
    Node trace(Node a, Node b, std::deque<DirectedEdge>& crossed) const {
        Node x = 0, y = 0, on = at_.size();
        around(a, [&](Node right, Node left) {
            const int r = turn(a, b, right), l = turn(a, b, left);
            for (const auto& [node, side] : {std::pair(right, r), {left, l}}) {
                if (side == 0 && (node > a) == (b > a)) on = node;  // they are in the order of their line
            }
            x = right, y = left;
            return on != at_.size() || (r < 0 && l > 0);
        });
        if (on != at_.size()) return on;
        for (;;) {
            crossed.emplace_back(x, y);
            if (segments_.contains(ordered(x, y))) return at_.size();
            const Node w = apex_.find({y, x})->second;
            const int side = w == b ? 0 : turn(a, b, w);
            if (side == 0) return w;
            (side > 0 ? y : x) = w;
        }
    }

    /// Flips the edges that cross ab until none does (S. W. Sloan, A fast algorithm for generating constrained Delaunay
    /// triangulations, 1993).
    void uncross(Node a, Node b, std::deque<DirectedEdge>& crossed) {
        while (!crossed.empty()) {
            const auto [x, y] = crossed.front();
            crossed.pop_front();
            const Node p = apex_.find({x, y})->second, q = apex_.find({y, x})->second;
            if (turn(p, q, x) * turn(p, q, y) >= 0) {
                crossed.emplace_back(x, y);
                continue;
            }
            apex_.erase({x, y});
            apex_.erase({y, x});
            add(p, x, q);
            add(q, y, p);
            const bool apart = p == a || p == b || q == a || q == b || turn(a, b, p) == turn(a, b, q);
            if (!apart) crossed.emplace_back(turn(a, b, p) < 0 ? DirectedEdge{p, q} : DirectedEdge{q, p});
        }
    }

    std::vector<Place> at_;
    std::vector<Node> out_;  ///< of each node: the end of an edge from it
    std::unordered_map<DirectedEdge, Node, EdgeHash> apex_;
    std::unordered_set<DirectedEdge, EdgeHash> segments_;
};

/// The polygon turns clockwise: so it does at its lowest corner, unless it is no simple one.
bool is_clockwise(const Projection& project, const std::vector<Mesh::Index>& ring) {
    const std::size_t n = ring.size();
    const auto corner = static_cast<std::size_t>(std::ranges::min_element(ring, {}, project) - ring.begin());
    return turn_of(project(ring[(corner + n - 1) % n]), project(ring[corner]), project(ring[(corner + 1) % n])) < 0;
}

/// Cuts a quadrilateral at a diagonal; false if neither leaves triangles that turn one way.
bool cut_in_two(const Projection& project, const std::vector<Mesh::Index>& ring, FacetTriangles& out) {
    const std::size_t lowest = static_cast<std::size_t>(std::ranges::min_element(ring) - ring.begin());
    for (const std::size_t first : {lowest, lowest + 1}) {
        const auto node = [&](std::size_t i) { return ring[(first + i) % 4]; };
        const auto turn = [&](std::size_t i) {
            return turn_of(project(node(0)), project(node(i)), project(node(i + 1)));
        };
        if (turn(1) == 0 || turn(1) != turn(2)) continue;
        out.triangles.push_back({node(0), node(1), node(2)});
        out.triangles.push_back({node(0), node(2), node(3)});
        return true;
    }
    return false;
}

}  // namespace

FacetTriangles triangles_of_facet(std::span<const double> points, std::span<const std::vector<Mesh::Index>> polygons,
                                  std::span<const double> holes) {
    FacetTriangles out;
    if (polygons.size() == 1 && polygons[0].size() == 3) {
        out.triangles.push_back({polygons[0][0], polygons[0][1], polygons[0][2]});
        return out;
    }
    std::vector<Mesh::Index> nodes;
    for (const auto& polygon : polygons) nodes.insert(nodes.end(), polygon.begin(), polygon.end());
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    Projection project(points, nodes);
    const bool plain = polygons.size() == 1 && holes.empty();
    if (plain && nodes.size() == 4 && polygons[0].size() == 4 && cut_in_two(project, polygons[0], out)) return out;
    if (nodes.size() < 3) return out;

    std::ranges::sort(nodes, {}, project);
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        if (project(nodes[i]) == project(nodes[i - 1]))
            out.faults.push_back({FacetFault::Kind::folded, {nodes[i - 1], nodes[i], -1, -1}});
    }
    if (!out.faults.empty()) return out;
    std::vector<Place> at;
    for (const Mesh::Index n : nodes) at.push_back(project(n));
    Triangulation all(std::move(at));
    if (all.flat()) {
        out.faults.push_back({FacetFault::Kind::flat, {nodes.front(), nodes.back(), -1, -1}});
        return out;
    }
    bool crossing = false;
    const auto place = [&](Mesh::Index n) {
        return static_cast<Node>(std::ranges::lower_bound(nodes, project(n), {}, project) - nodes.begin());
    };
    for (const auto& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size() && polygon.size() > 1; ++i) {
            if (polygon.size() == 2 && i == 1) break;
            const Node a = place(polygon[i]), b = place(polygon[(i + 1) % polygon.size()]);
            all.insert(a, b, [&](FacetFault::Kind kind, Node from, Node to, const DirectedEdge& other) {
                const bool cross = kind == FacetFault::Kind::crossing;
                crossing |= cross;
                out.faults.push_back({kind,
                                      {cross ? nodes[from] : nodes[other.first], cross ? nodes[to] : nodes[from],
                                       cross ? nodes[other.first] : nodes[to], cross ? nodes[other.second] : -1}});
            });
        }
    }
    if (crossing) return out;
    std::vector<Place> places;
    for (std::size_t i = 0; i + 2 < holes.size(); i += 3) places.push_back(project(&holes[i]));
    const auto first = std::ranges::find_if(polygons, [](const auto& p) { return p.size() > 2; });
    const bool back = first != polygons.end() && is_clockwise(project, *first);
    for (const auto& [a, b, c] : all.region(places)) {
        out.triangles.push_back({nodes[a], nodes[b], nodes[c]});
        if (back) std::swap(out.triangles.back()[1], out.triangles.back()[2]);
    }
    return out;
}

std::size_t add_triangles(std::span<const double> points, const mesh::CellType& type,
                          std::span<const Mesh::Index> nodes, std::vector<Mesh::Index>& corners) {
    std::vector<std::vector<Mesh::Index>> rings;
    mesh::add_rings(type, nodes, rings);
    std::size_t uncut = 0;
    for (const auto& ring : rings) {
        if (ring.size() == 3) {
            corners.insert(corners.end(), ring.begin(), ring.end());
            continue;
        }
        const auto triangles = triangles_of_facet(points, {&ring, 1}, {}).triangles;
        uncut += triangles.empty() ? 1 : 0;
        for (const auto& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
    }
    return uncut;
}

}  // namespace barycert::surface
