/// Checks of cells that were cut, in plain integers: an oracle that shares no predicates with the library.
#pragma once

#include <map>
#include <set>

#include "tests/mesh/shaped_mesh.hpp"

namespace barycert::test {

__extension__ using Whole = __int128;
using WholePoint = std::array<std::int64_t, 3>;

inline WholePoint whole_point(const Mesh& mesh, Mesh::Index node) {
    WholePoint p{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k)
        p[k] = static_cast<std::int64_t>(mesh.point(node)[k]);
    return p;
}

inline WholePoint difference(const WholePoint& a, const WholePoint& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline WholePoint cross_product(const WholePoint& a, const WholePoint& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline int sign_of_product(const WholePoint& a, const WholePoint& b) {
    const Whole sum = Whole{a[0]} * b[0] + Whole{a[1]} * b[1] + Whole{a[2]} * b[2];
    return sum > 0 ? 1 : sum < 0 ? -1 : 0;
}

/// Whether the interiors of two convex hulls are disjoint: one of these directions separates them.
inline bool are_disjoint(const std::vector<WholePoint>& a, const std::vector<WholePoint>& b,
                         const std::vector<WholePoint>& directions) {
    for (const WholePoint& n : directions) {
        if (n == WholePoint{}) continue;
        for (const int way : {-1, 1}) {
            bool apart = true;
            for (const WholePoint& p : a) {
                for (const WholePoint& q : b) apart = apart && way * sign_of_product(n, difference(q, p)) >= 0;
            }
            if (apart) return true;
        }
    }
    return false;
}

inline std::vector<WholePoint> edges_of(const std::vector<WholePoint>& corners) {
    std::vector<WholePoint> edges;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) edges.push_back(difference(corners[i], corners[j]));
    }
    return edges;
}

inline std::vector<WholePoint> corners_of(const Mesh& mesh, std::size_t part) {
    std::vector<WholePoint> corners;
    for (const Mesh::Index node : mesh.corners_of(part)) corners.push_back(whole_point(mesh, node));
    return corners;
}

/// How many pairs of parts overlap: all directions that can separate simplices are tried.
inline std::size_t overlaps(const Mesh& mesh) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const auto a = corners_of(mesh, i), b = corners_of(mesh, j);
            std::vector<WholePoint> directions, all = edges_of(a), other = edges_of(b);
            if (mesh.dimension == 2) {
                all.insert(all.end(), other.begin(), other.end());
                for (const WholePoint& e : all) directions.push_back({-e[1], e[0], 0});
            } else {
                for (const auto* const own : {&all, &other}) {
                    for (const WholePoint& e : *own) {
                        for (const WholePoint& f : *own) directions.push_back(cross_product(e, f));
                    }
                }
                for (const WholePoint& e : all) {
                    for (const WholePoint& f : other) directions.push_back(cross_product(e, f));
                }
            }
            count += are_disjoint(a, b, directions) ? 0 : 1;
        }
    }
    return count;
}

/// Six times the volume inside rings seen from outside, each in one plane.
inline Whole volume_inside(const Mesh& mesh, const std::vector<std::vector<Mesh::Index>>& rings) {
    Whole sum = 0;
    for (const auto& ring : rings) {
        for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
            const WholePoint a = whole_point(mesh, ring[0]), b = whole_point(mesh, ring[i]),
                             c = whole_point(mesh, ring[i + 1]), n = cross_product(b, c);
            sum += Whole{a[0]} * n[0] + Whole{a[1]} * n[1] + Whole{a[2]} * n[2];
        }
    }
    return sum;
}

/// Sets of corners of the parts.
inline std::set<std::set<Mesh::Index>> sets_of_corners(const Mesh& mesh) {
    std::set<std::set<Mesh::Index>> sets;
    for (std::size_t part = 0; part < mesh.cell_count(); ++part) {
        const std::span corners = mesh.corners_of(part);
        sets.emplace(corners.begin(), corners.end());
    }
    return sets;
}

/// Parts of one cell that fill it, once, and use all its nodes; their facets, but for those on its faces, are common to
/// two. Returns what is wrong; empty if nothing is.
inline std::string fault_of_parts(const Mesh& mesh, Whole expected) {
    Whole sum = 0;
    std::set<Mesh::Index> used(mesh.cells.begin(), mesh.cells.end());
    for (std::size_t part = 0; part < mesh.cell_count(); ++part) {
        const std::int64_t own = measure(mesh, part);
        if (own == 0 || (own > 0) != (measure(mesh, 0) > 0)) return "parts are flat, or turned both ways";
        sum += own;
    }
    if ((sum < 0 ? -sum : sum) != (expected < 0 ? -expected : expected)) return "the parts do not fill the cell";
    if (used.size() != mesh.point_count()) return "a node is not used";
    std::map<std::set<Mesh::Index>, std::pair<int, int>> facets;  // how many have it, and have it inside
    for (std::size_t part = 0; part < mesh.cell_count(); ++part) {
        for (std::size_t k = 0; k < mesh.corners(); ++k) {
            std::set<Mesh::Index> facet;
            for (std::size_t i = 0; i < mesh.corners(); ++i) {
                if (i != k) facet.insert(mesh.corners_of(part)[i]);
            }
            ++facets[facet].first;
            facets[facet].second += mesh.shapes.inside[part] >> k & 1;
        }
    }
    for (const auto& [facet, counts] : facets) {
        if (counts != std::pair(1, 0) && counts != std::pair(2, 2)) return "a facet inside is not one of two parts";
    }
    return overlaps(mesh) == 0 ? "" : "parts overlap";
}

}  // namespace barycert::test
