#include "mesh/index/facet_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"

namespace barycert::index {
namespace {

using Point = const double*;

int orient(Point a, Point b, Point c) {
    return static_cast<int>(orient2d(a, b, c));
}
int orient(Point a, Point b, Point c, Point d) {
    return static_cast<int>(orient3d(a, b, c, d));
}

// In the plane.

/// On the closed segment from a to b. Requires: on its line.
bool between(Point a, Point b, Point p) {
    for (int k = 0; k < 2; ++k) {
        if (p[k] < std::min(a[k], b[k]) || p[k] > std::max(a[k], b[k])) return false;
    }
    return true;
}

/// Closed segments ab and cd have a point in common.
bool segments_meet(Point a, Point b, Point c, Point d) {
    const int abc = orient(a, b, c), abd = orient(a, b, d), cda = orient(c, d, a), cdb = orient(c, d, b);
    if (abc * abd < 0 && cda * cdb < 0) return true;
    return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) || (cda == 0 && between(c, d, a)) ||
           (cdb == 0 && between(c, d, b));
}

/// p is in the closed triangle, which has an area.
bool in_triangle(const std::array<Point, 3>& t, Point p) {
    const int s[] = {orient(t[0], t[1], p), orient(t[1], t[2], p), orient(t[2], t[0], p)};
    const auto [min, max] = std::minmax({s[0], s[1], s[2]});
    return min * max >= 0;  // not both signs
}

// In space. Coplanar points are judged in a projection to an axis plane in which the triangle keeps an area: then the
// projection of its plane is one to one.

/// A point without one axis.
struct Projected {
    double at[2];
};

Projected project(Point p, int axis) {
    return {{p[(axis + 1) % 3], p[(axis + 2) % 3]}};
}

std::array<Projected, 3> project(const std::array<Point, 3>& t, int axis) {
    return {project(t[0], axis), project(t[1], axis), project(t[2], axis)};
}

/// The axis along which the triangle's projection is largest, in plain double: where signs are quick to prove.
int widest_projection(const std::array<Point, 3>& t) {
    double area[3];
    for (int axis = 0; axis < 3; ++axis) {
        const auto [a, b, c] = project(t, axis);
        area[axis] = std::fabs((b.at[0] - a.at[0]) * (c.at[1] - a.at[1]) - (b.at[1] - a.at[1]) * (c.at[0] - a.at[0]));
    }
    return static_cast<int>(std::max_element(area, area + 3) - area);
}

/// An axis along which the triangle's projection has an area; -1 if it is degenerate.
int projection_of(const std::array<Point, 3>& t) {
    const int widest = widest_projection(t);
    for (int i = 0; i < 3; ++i) {
        const int axis = (widest + i) % 3;
        const auto [a, b, c] = project(t, axis);
        if (orient(a.at, b.at, c.at) != 0) return axis;
    }
    return -1;
}

bool coplanar_segment_meets_triangle(Point p, Point q, const std::array<Point, 3>& t) {
    const int axis = projection_of(t);
    const auto [a, b, c] = project(t, axis);
    const Projected u = project(p, axis), v = project(q, axis);
    const std::array<Point, 3> flat{a.at, b.at, c.at};
    return in_triangle(flat, u.at) || in_triangle(flat, v.at) || segments_meet(u.at, v.at, a.at, b.at) ||
           segments_meet(u.at, v.at, b.at, c.at) || segments_meet(u.at, v.at, c.at, a.at);
}

/// Closed segment pq and closed triangle have a point in common.
bool segment_meets_triangle(Point p, Point q, const std::array<Point, 3>& t) {
    const int sp = orient(t[0], t[1], t[2], p), sq = orient(t[0], t[1], t[2], q);
    if (sp * sq > 0) return false;
    if (sp == 0 && sq == 0) return coplanar_segment_meets_triangle(p, q, t);
    // The line meets the plane in one point of the segment; it is in the triangle if the line passes no side outside.
    const int s[] = {orient(p, q, t[0], t[1]), orient(p, q, t[1], t[2]), orient(p, q, t[2], t[0])};
    const auto [min, max] = std::minmax({s[0], s[1], s[2]});
    return min * max >= 0;
}

/// All of g on one side of f's plane.
bool apart(const std::array<Point, 3>& f, const std::array<Point, 3>& g) {
    const int s = orient(f[0], f[1], f[2], g[0]);
    return s != 0 && s == orient(f[0], f[1], f[2], g[1]) && s == orient(f[0], f[1], f[2], g[2]);
}

/// Triangles without common nodes: if they meet, then an edge of one meets the other, since an extreme point of what
/// they have in common is on an edge of one.
bool strangers_meet(const std::array<Point, 3>& f, const std::array<Point, 3>& g) {
    if (apart(f, g) || apart(g, f)) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        if (segment_meets_triangle(f[i], f[(i + 1) % 3], g) || segment_meets_triangle(g[i], g[(i + 1) % 3], f))
            return true;
    }
    return false;
}

/// Triangles vab and vcd: if they share another point than v, then on the ray from v through it the first side that is
/// met, ab or cd, is met within the other triangle.
bool meet_beyond_vertex(const std::array<Point, 3>& f, const std::array<Point, 3>& g) {
    return segment_meets_triangle(f[1], f[2], g) || segment_meets_triangle(g[1], g[2], f);
}

/// Triangles abc and abd: they share more than the edge only if they lie in one plane, on one side of ab. They do not
/// if c and d project to different sides of it.
bool meet_beyond_edge(Point a, Point b, Point c, Point d) {
    const int axis = projection_of({a, b, c});
    const auto [pa, pb, pc] = project({a, b, c}, axis);
    const Projected pd = project(d, axis);
    const int side = orient(pa.at, pb.at, pd.at);
    return orient(pa.at, pb.at, pc.at) == side && orient(a, b, c, d) == 0;
}

/// Segments va and vb: they share more than v only if they lie on one line, on one side of v.
bool segments_meet_beyond(Point v, Point a, Point b) {
    if (orient(v, a, b) != 0) return false;
    const int k = a[0] != v[0] ? 0 : 1;  // an axis along which the line is not constant
    return (a[k] > v[k]) == (b[k] > v[k]);
}

}  // namespace

bool proper(int d, const PlacedFacet& f) {
    if (d == 2) return !std::equal(f.at[0], f.at[0] + 2, f.at[1]);
    return projection_of(f.at) >= 0;
}

bool facets_conflict(int d, const PlacedFacet& f, const PlacedFacet& g) {
    const auto n = static_cast<std::size_t>(d);
    // Common nodes first, in the same order in both.
    std::array<Point, 3> a = f.at, b = g.at;
    std::array<Mesh::Index, 3> an = f.nodes, bn = g.nodes;
    std::size_t common = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = common; j < n; ++j) {
            if (an[i] != bn[j]) continue;
            std::swap(an[common], an[i]), std::swap(a[common], a[i]);
            std::swap(bn[common], bn[j]), std::swap(b[common], b[j]);
            ++common;
            break;
        }
    }
    if (d == 2) return common == 0 ? segments_meet(a[0], a[1], b[0], b[1]) : segments_meet_beyond(a[0], a[1], b[1]);
    if (common == 0) return strangers_meet(a, b);
    return common == 1 ? meet_beyond_vertex(a, b) : meet_beyond_edge(a[0], a[1], a[2], b[2]);
}

bool segment_conflicts(const PlacedFacet& segment, const PlacedFacet& triangle) {
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (segment.nodes[i] != triangle.nodes[k]) continue;
            // From the common node they go on together if the other end is in the plane, between the two sides there.
            const Point v = triangle.at[k], b = triangle.at[(k + 1) % 3], c = triangle.at[(k + 2) % 3];
            const Point a = segment.at[1 - i];
            if (orient(v, b, c, a) != 0) return false;
            const int axis = projection_of(triangle.at);
            const Projected pv = project(v, axis), pb = project(b, axis), pc = project(c, axis), pa = project(a, axis);
            const int turn = orient(pv.at, pb.at, pc.at);
            return orient(pv.at, pb.at, pa.at) != -turn && orient(pv.at, pa.at, pc.at) != -turn;
        }
    }
    return segment_meets_triangle(segment.at[0], segment.at[1], triangle.at);
}

std::array<Mesh::Index, 3> face_around(int d, const PlacedFacet& f, const double* point) {
    constexpr std::array<Mesh::Index, 3> none{-1, -1, -1};
    std::array<bool, 3> holds{};  // the nodes whose weights are not zero
    if (d == 2) {
        if (orient(f.at[0], f.at[1], point) != 0 || !between(f.at[0], f.at[1], point)) return none;
        for (std::size_t i = 0; i < 2; ++i) holds[i] = !std::equal(point, point + 2, f.at[1 - i]);
    } else {
        if (orient(f.at[0], f.at[1], f.at[2], point) != 0) return none;
        const int axis = projection_of(f.at);
        const std::array<Projected, 3> t = project(f.at, axis);
        const Projected p = project(point, axis);
        if (!in_triangle({t[0].at, t[1].at, t[2].at}, p.at)) return none;
        for (std::size_t i = 0; i < 3; ++i) holds[i] = orient(t[(i + 1) % 3].at, t[(i + 2) % 3].at, p.at) != 0;
    }
    std::array<Mesh::Index, 3> face = none;
    for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
        if (holds[i]) face[i] = f.nodes[i];
    }
    std::sort(face.begin(), face.end(), [](Mesh::Index a, Mesh::Index b) { return a >= 0 && (b < 0 || a < b); });
    return face;
}

}  // namespace barycert::index
