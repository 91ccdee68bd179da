/// Surfaces in space for tests, and exact rational geometry of triangles, written apart from the library.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "barycert/surface.hpp"

namespace barycert::testing {

using Rational3 = std::array<mpq_class, 3>;

inline Rational3 rational(const double* p) {
    return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])};
}
inline Rational3 operator-(const Rational3& a, const Rational3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline mpq_class inner(const Rational3& a, const Rational3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Rational3 outer(const Rational3& a, const Rational3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// a + t (b - a).
inline Rational3 between(const Rational3& a, const Rational3& b, const mpq_class& t) {
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

using RationalTriangle = std::array<Rational3, 3>;

inline RationalTriangle triangle_of(const Surface& s, std::size_t t) {
    RationalTriangle r;
    for (std::size_t i = 0; i < 3; ++i) r[i] = rational(&s.points[3 * static_cast<std::size_t>(s.cells[3 * t + i])]);
    return r;
}

inline bool is_flat(const RationalTriangle& t) {
    const Rational3 n = outer(t[1] - t[0], t[2] - t[0]);
    return n[0] == 0 && n[1] == 0 && n[2] == 0;
}

/// Weights of the projection of p; the triangle is not flat.
inline std::array<mpq_class, 3> weights_in(const RationalTriangle& t, const Rational3& p) {
    const Rational3 e = t[1] - t[0], f = t[2] - t[0], w = p - t[0];
    const mpq_class ee = inner(e, e), ef = inner(e, f), ff = inner(f, f), we = inner(w, e), wf = inner(w, f);
    const mpq_class det = ee * ff - ef * ef, b = (we * ff - wf * ef) / det, c = (wf * ee - we * ef) / det;
    return {1 - b - c, b, c};
}

/// The square of the distance of a point from a triangle, which may be flat.
inline mpq_class square_to(const RationalTriangle& t, const Rational3& p) {
    if (!is_flat(t)) {
        const auto w = weights_in(t, p);
        if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0) {
            const Rational3 n = outer(t[1] - t[0], t[2] - t[0]);
            const mpq_class h = inner(n, p - t[0]);
            return h * h / inner(n, n);
        }
    }
    mpq_class best = -1;
    for (std::size_t i = 0; i < 3; ++i) {
        const Rational3 e = t[(i + 1) % 3] - t[i];
        const mpq_class length = inner(e, e);
        const mpq_class s = length == 0 ? mpq_class(0) : std::clamp<mpq_class>(inner(p - t[i], e) / length, 0, 1);
        const Rational3 away = p - between(t[i], t[(i + 1) % 3], s);
        if (const mpq_class square = inner(away, away); best < 0 || square < best) best = square;
    }
    return best;
}

inline bool lies_on(const RationalTriangle& t, const Rational3& p) {
    if (is_flat(t)) return square_to(t, p) == 0;
    if (inner(outer(t[1] - t[0], t[2] - t[0]), p - t[0]) != 0) return false;
    return std::ranges::all_of(weights_in(t, p), [](const mpq_class& w) { return w >= 0; });
}

/// Points whose convex hull is what two triangles have in common: corners of one in the other, and edges of one where
/// they pass through the plane or, within it, an edge of the other.
inline std::vector<Rational3> common_points(const RationalTriangle& a, const RationalTriangle& b) {
    std::vector<Rational3> all;
    for (const auto& [t, other] : {std::pair(&a, &b), {&b, &a}}) {
        const Rational3 n = outer((*other)[1] - (*other)[0], (*other)[2] - (*other)[0]);
        for (std::size_t i = 0; i < 3; ++i) {
            const Rational3 &p = (*t)[i], &q = (*t)[(i + 1) % 3];
            if (lies_on(*other, p)) all.push_back(p);
            const mpq_class u = inner(n, p - (*other)[0]), v = inner(n, q - (*other)[0]);
            if (u != v) {
                const mpq_class s = u / (u - v);
                if (s >= 0 && s <= 1 && lies_on(*other, between(p, q, s))) all.push_back(between(p, q, s));
                continue;
            }
            for (std::size_t j = 0; u == 0 && j < 3; ++j) {  // in the plane: where it crosses the line of an edge
                const Rational3 side = outer(n, (*other)[(j + 1) % 3] - (*other)[j]);
                const mpq_class x = inner(side, p - (*other)[j]), y = inner(side, q - (*other)[j]);
                if (x == y) continue;
                const mpq_class s = x / (x - y);
                if (s >= 0 && s <= 1 && lies_on(*other, between(p, q, s))) all.push_back(between(p, q, s));
            }
        }
    }
    return all;
}

// Surfaces.

struct Voxels {
    int n = 0;
    std::vector<char> full;  ///< n^3, x first
    bool at(int x, int y, int z) const {
        return x >= 0 && y >= 0 && z >= 0 && x < n && y < n && z < n &&
               full[static_cast<std::size_t>((z * n + y) * n + x)] != 0;
    }
};

inline Voxels random_voxels(int n, double share, std::uint64_t seed) {
    Voxels v{n, {}};
    std::mt19937_64 random(seed);
    std::bernoulli_distribution full(share);
    for (int i = 0; i < n * n * n; ++i) v.full.push_back(full(random) ? 1 : 0);
    return v;
}

/// The boundary, normals outwards; two triangles a side, either diagonal.
inline Surface surface_of(const Voxels& v) {
    Surface s;
    std::map<std::array<int, 3>, Mesh::Index> nodes;
    const auto node = [&](const std::array<int, 3>& at) {
        const auto [found, fresh] = nodes.try_emplace(at, static_cast<Mesh::Index>(nodes.size()));
        for (const int x : at) {
            if (fresh) s.points.push_back(x);
        }
        return found->second;
    };
    for (int x = 0; x < v.n; ++x) {
        for (int y = 0; y < v.n; ++y) {
            for (int z = 0; z < v.n; ++z) {
                if (!v.at(x, y, z)) continue;
                for (int side = 0; side < 6; ++side) {
                    const auto axis = static_cast<std::size_t>(side / 2), a = (axis + 1) % 3, b = (axis + 2) % 3;
                    std::array<int, 3> out{x, y, z};
                    out[axis] += side % 2 == 0 ? -1 : 1;
                    if (v.at(out[0], out[1], out[2])) continue;
                    std::array<int, 3> low{x, y, z};
                    low[axis] += side % 2;
                    std::array<Mesh::Index, 4> ring{};
                    for (std::size_t i = 0; i < 4; ++i) {
                        std::array<int, 3> at = low;
                        at[a] += i == 1 || i == 2 ? 1 : 0;
                        at[b] += i >= 2 ? 1 : 0;
                        ring[i] = node(at);
                    }
                    if (side % 2 == 0) std::swap(ring[1], ring[3]);
                    const std::size_t first = static_cast<std::size_t>(x + y + z) % 2;
                    for (const std::size_t i : {first, first + 1, first + 2, first, first + 2, first + 3})
                        s.cells.push_back(ring[i % 4]);
                }
            }
        }
    }
    return s;
}

/// Triangles between random points of a lattice of so many places an axis, repeated corners included.
inline Surface random_soup(int places, std::size_t nodes, std::size_t triangles, std::uint64_t seed) {
    Surface s;
    std::mt19937_64 random(seed);
    for (std::size_t i = 0; i < 3 * nodes; ++i)
        s.points.push_back(static_cast<double>(random() % static_cast<unsigned>(places)));
    for (std::size_t i = 0; i < 3 * triangles; ++i) s.cells.push_back(static_cast<Mesh::Index>(random() % nodes));
    return s;
}

inline Surface torus(int around, int along) {
    Surface s;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < along; ++j) {
            const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / along;
            s.points.insert(s.points.end(), {(1 + .4 * std::cos(v)) * std::cos(u), (1 + .4 * std::cos(v)) * std::sin(u),
                                             .4 * std::sin(v)});
            const auto at = [&](int a, int b) { return ((i + a) % around) * along + (j + b) % along; };
            s.cells.insert(s.cells.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
        }
    }
    return s;
}

/// Points times a factor, and moved.
inline Surface mapped(Surface s, double factor, double moved = 0) {
    for (double& x : s.points) x = x * factor + moved;
    return s;
}

}  // namespace barycert::testing
