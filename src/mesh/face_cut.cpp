#include "mesh/face_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "core/base/vectors.hpp"

namespace barycert::mesh {
namespace {

using Index = Mesh::Index;
using FlatPoint = std::array<double, 2>;
using Triple = std::array<std::size_t, 3>;

/// The numbers of a ring in its canonical order: from which place on, and which way.
struct Canonical {
    std::size_t first = 0;
    bool forward = true;

    std::size_t place(std::size_t i, std::size_t n) const { return forward ? (first + i) % n : (first + n - i) % n; }
};

Canonical canonical_order(const NumberedNodes& nodes, std::span<const Index> ring) {
    const std::size_t n = ring.size();
    Canonical order;
    for (std::size_t i = 1; i < n; ++i) {
        if (nodes.lower(ring[i], ring[order.first])) order.first = i;
    }
    order.forward = nodes.lower(ring[(order.first + 1) % n], ring[(order.first + n - 1) % n]);
    return order;
}

base::Vector3<double> from(const double* origin, const double* p) {
    return {p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
}

/// Axes in the order in which projections along them are tried. Lengths that are not a number come last.
std::array<std::size_t, 3> axes_by_length(const base::Vector3<double>& normal) {
    base::Vector3<double> size{};
    for (std::size_t k = 0; k < 3; ++k) size[k] = normal[k] == normal[k] ? std::fabs(normal[k]) : -1;
    std::array<std::size_t, 3> axes{0, 1, 2};
    if (size[axes[1]] > size[axes[0]]) std::swap(axes[0], axes[1]);
    if (size[axes[2]] > size[axes[1]]) std::swap(axes[1], axes[2]);
    if (size[axes[1]] > size[axes[0]]) std::swap(axes[0], axes[1]);
    return axes;
}

FlatPoint along(std::size_t axis, const double* p) {
    return {p[axis == 2 ? 0 : axis + 1], p[axis == 0 ? 2 : axis == 1 ? 0 : 1]};
}

int turn(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
    return static_cast<int>(orient2d(a.data(), b.data(), c.data()));
}

/// A ring in the plane, in its canonical order.
class FlatRing {
public:
    FlatRing(std::vector<FlatPoint> points, std::span<const Index> numbers)
        : points_(std::move(points)), numbers_(numbers) {}

    /// Triangles by places in the ring; empty if it is no simple polygon.
    std::vector<Triple> triangles() const {
        for (const std::size_t centre : by_number()) {
            if (is_fan(centre)) return fan(centre);
        }
        return is_simple() ? ears() : std::vector<Triple>();
    }

    /// All triangles at the place turn one way, and none lies on another.
    bool is_fan(std::size_t centre) const {
        const std::size_t n = size();
        const auto at = [&](std::size_t i) -> const FlatPoint& { return points_[(centre + i) % n]; };
        const int way = turn(at(0), at(1), at(2));
        if (way == 0) return false;
        for (std::size_t i = 2; i + 1 < n; ++i) {
            if (turn(at(0), at(i), at(i + 1)) != way) return false;
        }
        // Each angle at the centre is below 180 degrees. Their sum is below 360 if the direction to the nodes, once it
        // is beyond that opposite to the first, does not come back to the first; three angles and more may exceed it.
        bool beyond = false;
        for (std::size_t i = 2; n > 4 && i < n; ++i) {
            const int side = way * turn(at(0), at(1), at(i));
            if (beyond && side >= 0) return false;
            beyond = side < 0;
        }
        return true;
    }

private:
    std::size_t size() const { return points_.size(); }

    std::vector<std::size_t> by_number() const {
        std::vector<std::size_t> order(size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::sort(order, {}, [&](std::size_t i) { return numbers_[i]; });
        return order;
    }

    std::vector<Triple> fan(std::size_t centre) const {
        std::vector<Triple> all;
        for (std::size_t i = 1; i + 1 < size(); ++i)
            all.push_back({centre, (centre + i) % size(), (centre + i + 1) % size()});
        return all;
    }

    bool within(std::size_t p, std::size_t a, std::size_t b) const {
        const auto [low, high] = std::minmax(points_[a], points_[b]);
        return low <= points_[p] && points_[p] <= high;
    }

    /// Edges from these places on have a point in common that is no common end.
    bool meet(std::size_t e, std::size_t f) const {
        const std::size_t a = e, b = (e + 1) % size(), c = f, d = (f + 1) % size();
        if (b == c || d == a) {
            const std::size_t from = b == c ? a : c, middle = b == c ? b : d, to = b == c ? d : b;
            return turn(points_[from], points_[middle], points_[to]) == 0 && !within(middle, from, to);
        }
        const int c_side = turn(points_[a], points_[b], points_[c]), d_side = turn(points_[a], points_[b], points_[d]);
        const int a_side = turn(points_[c], points_[d], points_[a]), b_side = turn(points_[c], points_[d], points_[b]);
        return (c_side * d_side < 0 && a_side * b_side < 0) || (c_side == 0 && within(c, a, b)) ||
               (d_side == 0 && within(d, a, b)) || (a_side == 0 && within(a, c, d)) || (b_side == 0 && within(b, c, d));
    }

    /// Edges are compared with those that begin before they end, along the first axis.
    bool is_simple() const {
        const std::size_t n = size();
        const auto ends = [&](std::size_t e) { return std::minmax(points_[e], points_[(e + 1) % n]); };
        std::vector<std::size_t> edges(n);
        std::iota(edges.begin(), edges.end(), std::size_t{0});
        std::ranges::sort(edges, [&](std::size_t e, std::size_t f) {
            return std::pair(ends(e).first, e) < std::pair(ends(f).first, f);
        });
        for (std::size_t i = 0; i < n; ++i) {
            const FlatPoint low = ends(edges[i]).first, high = ends(edges[i]).second;
            if (low == high) return false;
            const auto [bottom, top] = std::minmax(low[1], high[1]);
            for (std::size_t j = i + 1; j < n; ++j) {
                const FlatPoint other_low = ends(edges[j]).first, other_high = ends(edges[j]).second;
                if (other_low[0] > high[0]) break;
                if (std::min(other_low[1], other_high[1]) > top || std::max(other_low[1], other_high[1]) < bottom)
                    continue;
                if (meet(edges[i], edges[j])) return false;
            }
        }
        return true;
    }

    /// Requires: the polygon is simple. Then there are two ears as long as there are four nodes and more: a polygon
    /// has triangulations without flat triangles (cut at a convex corner, to the node farthest inside its triangle, or
    /// along its base), and a triangle with one diagonal is an ear.
    std::vector<Triple> ears() const {
        const std::size_t n = size(), none = n;
        std::vector<std::size_t> before(n), behind(n), blocked_by(n, none), order = by_number();
        std::ranges::reverse(order);
        for (std::size_t i = 0; i < n; ++i) before[i] = (i + n - 1) % n, behind[i] = (i + 1) % n;
        std::vector<bool> gone(n, false), known(n, false);
        const auto lowest = static_cast<std::size_t>(std::ranges::min_element(points_) - points_.begin());
        const int way = turn(points_[before[lowest]], points_[lowest], points_[behind[lowest]]);
        // Which node is in its triangle; itself if it is not convex, `none` if it is an ear.
        const auto blocker = [&](std::size_t tip) {
            const std::size_t a = before[tip], b = behind[tip];
            if (turn(points_[a], points_[tip], points_[b]) != way) return tip;
            for (std::size_t q = behind[b]; q != a; q = behind[q]) {
                if (way * turn(points_[a], points_[tip], points_[q]) >= 0 &&
                    way * turn(points_[tip], points_[b], points_[q]) >= 0 &&
                    way * turn(points_[b], points_[a], points_[q]) >= 0)
                    return q;
            }
            return none;
        };
        std::vector<Triple> all;
        while (all.size() + 2 < n) {
            std::size_t ear = none;
            for (const std::size_t tip : order) {
                if (gone[tip]) continue;
                if (!known[tip] || (blocked_by[tip] != none && gone[blocked_by[tip]]))
                    blocked_by[tip] = blocker(tip), known[tip] = true;
                if (blocked_by[tip] != none) continue;
                ear = tip;
                break;
            }
            if (ear == none) return {};
            const std::size_t a = before[ear], b = behind[ear];
            all.push_back({a, ear, b});
            gone[ear] = true;
            behind[a] = b, before[b] = a;
            known[a] = known[b] = false;
        }
        return all;
    }

    std::vector<FlatPoint> points_;
    std::span<const Index> numbers_;
};

/// A ring in its canonical order, with what is asked of it.
struct CanonicalRing {
    CanonicalRing(const NumberedNodes& of, std::span<const Index> given) : nodes(of), ring(given.size()) {
        const Canonical order = canonical_order(nodes, given);
        forward = order.forward;
        for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = given[order.place(i, ring.size())];
        for (const Index node : ring) numbers.push_back(nodes.number(node));
    }

    std::array<std::size_t, 3> axes() const {
        base::Vector3<double> normal{}, last = from(nodes.at(ring[0]), nodes.at(ring[1]));
        for (std::size_t i = 2; i < ring.size(); ++i) {
            const base::Vector3<double> next = from(nodes.at(ring[0]), nodes.at(ring[i]));
            const base::Vector3<double> of_triangle = base::cross(last, next);
            for (std::size_t k = 0; k < 3; ++k) normal[k] += of_triangle[k];
            last = next;
        }
        return axes_by_length(normal);
    }

    FlatRing flat(std::size_t axis) const {
        std::vector<FlatPoint> points;
        for (const Index node : ring) {
            const double* const p = nodes.at(node);
            points.push_back(nodes.dimension == 2 ? FlatPoint{p[0], p[1]} : along(axis, p));
        }
        return {std::move(points), numbers};
    }

    const NumberedNodes& nodes;
    std::vector<Index> ring, numbers;
    bool forward = true;
};

}  // namespace

bool cut_face(const NumberedNodes& nodes, std::span<const Index> ring, std::vector<NodeTriangle>& triangles) {
    const CanonicalRing canonical(nodes, ring);
    const std::size_t projections = nodes.dimension == 2 ? 1 : 3;
    const std::array<std::size_t, 3> axes = nodes.dimension == 2 ? std::array<std::size_t, 3>{} : canonical.axes();
    for (std::size_t i = 0; i < projections; ++i) {
        std::vector<Triple> found = canonical.flat(axes[i]).triangles();
        if (found.empty()) continue;
        if (!canonical.forward) {  // turned as the ring, from its other side on
            std::ranges::reverse(found);
            for (Triple& t : found) std::swap(t[1], t[2]);
        }
        for (const auto& [a, b, c] : found)
            triangles.push_back({canonical.ring[a], canonical.ring[b], canonical.ring[c]});
        return true;
    }
    return false;
}

bool is_cut_from_lowest(const NumberedNodes& nodes, std::span<const Index> ring) {
    if (ring.size() != 4) {
        const CanonicalRing canonical(nodes, ring);
        return canonical.flat(nodes.dimension == 2 ? 0 : canonical.axes()[0]).is_fan(0);
    }
    // Most faces are quadrilaterals: without memory of their own.
    const Canonical order = canonical_order(nodes, ring);
    std::array<const double*, 4> p{};
    for (std::size_t i = 0; i < 4; ++i) p[i] = nodes.at(ring[order.place(i, 4)]);
    if (nodes.dimension == 2) {
        const Sign way = orient2d(p[0], p[1], p[2]);
        return way != Sign::zero && orient2d(p[0], p[2], p[3]) == way;
    }
    const auto a = from(p[0], p[1]), b = from(p[0], p[2]), c = from(p[0], p[3]);
    const auto first = base::cross(a, b), second = base::cross(b, c);
    const std::size_t axis = axes_by_length({first[0] + second[0], first[1] + second[1], first[2] + second[2]})[0];
    std::array<FlatPoint, 4> flat{};
    for (std::size_t i = 0; i < 4; ++i) flat[i] = along(axis, p[i]);
    const int way = turn(flat[0], flat[1], flat[2]);
    return way != 0 && turn(flat[0], flat[2], flat[3]) == way;
}

bool on_one_line(const NumberedNodes& nodes, std::span<const Index> some) {
    const double* const origin = nodes.at(some.front());
    const auto differs = [&](Index node) { return !std::equal(origin, origin + nodes.dimension, nodes.at(node)); };
    const auto other = std::ranges::find_if(some, differs);
    if (other == some.end()) return true;
    const auto is_on_line = [&](Index node) {
        const double* const p = nodes.at(*other);
        const double* const q = nodes.at(node);
        if (nodes.dimension == 2) return orient2d(origin, p, q) == Sign::zero;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (turn(along(axis, origin), along(axis, p), along(axis, q)) != 0) return false;
        }
        return true;
    };
    return std::ranges::all_of(some, is_on_line);
}

bool are_flat(const NumberedNodes& nodes, std::span<const Index> some) {
    if (nodes.dimension == 2 || on_one_line(nodes, some)) return on_one_line(nodes, some);
    // Three that are on no line: the first, one elsewhere, and one that is not on their line.
    std::array<Index, 3> base{some.front(), some.front(), some.front()};
    for (const Index node : some) {
        base[1] = node;
        if (!std::equal(nodes.at(base[0]), nodes.at(base[0]) + 3, nodes.at(node))) break;
    }
    for (const Index node : some) {
        base[2] = node;
        if (!on_one_line(nodes, base)) break;
    }
    return std::ranges::all_of(some, [&](Index node) {
        return orient3d(nodes.at(base[0]), nodes.at(base[1]), nodes.at(base[2]), nodes.at(node)) == Sign::zero;
    });
}

}  // namespace barycert::mesh
