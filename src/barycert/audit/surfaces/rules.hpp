/// The rules on triangles in space, by question.
#pragma once

#include "barycert/audit.hpp"
#include "barycert/kernels/space_formulas.hpp"

namespace barycert::audit {

std::vector<SurfaceRule> distance_rules();
std::vector<SurfaceRule> inside_rules();
std::vector<SurfaceRule> meet_rules();

/// The triangles as they are, no node shared.
Surface surface_of(const SurfaceCase& c);

template <class T>
using Vector = kernels::Vector3<T>;
template <class T>
using Corners = std::array<Vector<T>, 3>;

template <class T>
Vector<T> vector_from(const double* x) {
    return {static_cast<T>(x[0]), static_cast<T>(x[1]), static_cast<T>(x[2])};
}
template <class T>
Corners<T> corners_from(const TriangleInSpace& t) {
    return {vector_from<T>(&t[0]), vector_from<T>(&t[3]), vector_from<T>(&t[6])};
}
template <class T>
Vector<T> along(Vector<T> a, Vector<T> b, T t) {
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}
inline Vector<double> normal_of(const Corners<double>& t) {
    return cross(t[1] - t[0], t[2] - t[0]);
}

/// Where the ray p + t d meets the triangle: t, or NaN. A determinant within `tolerance` counts as parallel.
double moller_trumbore(const Corners<double>& t, Vector<double> p, Vector<double> d, double tolerance);

/// From corner to corner, edge to edge, face: the first region of Voronoi that dot products say holds the point.
template <class T>
T by_regions(const Corners<T>& t, Vector<T> p) {
    const auto length = [](Vector<T> v) { return std::sqrt(dot(v, v)); };
    std::array<T, 3> areas{};  // of the part opposite to the corner
    for (std::size_t k = 0; k < 3; ++k) {
        const auto &a = t[k], &b = t[(k + 1) % 3], &c = t[(k + 2) % 3];
        if (dot(b - a, p - a) <= 0 && dot(c - a, p - a) <= 0) return length(p - a);
        areas[(k + 2) % 3] = dot(b - a, p - a) * dot(c - a, p - b) - dot(b - a, p - b) * dot(c - a, p - a);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const auto &a = t[k], &b = t[(k + 1) % 3];
        const T from_a = dot(b - a, p - a), from_b = dot(a - b, p - b);
        if (areas[(k + 2) % 3] <= 0 && from_a >= 0 && from_b >= 0)
            return length(p - along(a, b, from_a / (from_a + from_b)));
    }
    const T whole = areas[0] + areas[1] + areas[2];
    const auto v = t[1] - t[0], w = t[2] - t[0];
    const T s = areas[1] / whole, r = areas[2] / whole;
    return length(p - Vector<T>{t[0].x + s * v.x + r * w.x, t[0].y + s * v.y + r * w.y, t[0].z + s * v.z + r * w.z});
}

}  // namespace barycert::audit
