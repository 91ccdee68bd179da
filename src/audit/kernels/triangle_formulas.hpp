/// Weights in a triangle a b c of the plane. Notation and linkage: vectors.hpp.
#pragma once

#include "audit/kernels/scanline.hpp"
#include "audit/kernels/vectors.hpp"

namespace barycert::kernels {
namespace {

/// Twice the signed area.
template <class T>
T twice_area(const T* v) {
    const auto a = at2(v, 0);
    return cross(at2(v, 1) - a, at2(v, 2) - a);
}

/// Each weight its own signed area, bc x bp and cyclic, over `whole`.
template <class T>
void areas_over(T whole, const T* v, const T* p, T* w) {
    const auto a = at2(v, 0), b = at2(v, 1), c = at2(v, 2), q = at2(p, 0);
    w[0] = cross(c - b, q - b) / whole;
    w[1] = cross(a - c, q - c) / whole;
    w[2] = cross(b - a, q - a) / whole;
}

/// W_a = bc x bp / ab x ac and cyclic: each weight its own signed area over the common whole.
template <class T>
int signed_area(const T* v, const T* p, T* w) {
    const T whole = twice_area(v);
    if (whole == 0) return 1;
    areas_over(whole, v, p, w);
    return 0;
}

/// Signed areas of the point with each side, coordinates relative to the point, over their sum.
template <class T>
int relative_to_point(const T* v, const T* p, T* w) {
    const auto q = at2(p, 0), a = at2(v, 0) - q, b = at2(v, 1) - q, c = at2(v, 2) - q;
    const T aa = cross(b, c), ab = cross(c, a), ac = cross(a, b);
    return over(aa + ab + ac, {aa, ab, ac}, w);
}

/// The closed formula with origin a; the third weight is what is left of 1.
template <class T>
int beta_gamma(const T* v, const T* p, T* w) {
    const auto a = at2(v, 0), ab = at2(v, 1) - a, ac = at2(v, 2) - a, ap = at2(p, 0) - a;
    w[1] = (ap.y * ac.x - ap.x * ac.y) / (ab.y * ac.x - ab.x * ac.y);
    w[2] = (ap.y * ab.x - ap.x * ab.y) / (ac.y * ab.x - ac.x * ab.y);
    w[0] = 1 - w[1] - w[2];
    return 0;
}

/// alpha relative to b and c, beta relative to c and a, each with its own denominator.
template <class T>
int alpha_beta(const T* v, const T* p, T* w) {
    const auto a = at2(v, 0), b = at2(v, 1), c = at2(v, 2), q = at2(p, 0);
    w[0] = (-(q.x - b.x) * (c.y - b.y) + (q.y - b.y) * (c.x - b.x)) /
           (-(a.x - b.x) * (c.y - b.y) + (a.y - b.y) * (c.x - b.x));
    w[1] = (-(q.x - c.x) * (a.y - c.y) + (q.y - c.y) * (a.x - c.x)) /
           (-(b.x - c.x) * (a.y - c.y) + (b.y - c.y) * (a.x - c.x));
    w[2] = 1 - w[0] - w[1];
    return 0;
}

/// Areas without sign over their sum: right inside, positive everywhere.
template <class T>
int unsigned_area(const T* v, const T* p, T* w) {
    const auto q = at2(p, 0), a = at2(v, 0) - q, b = at2(v, 1) - q, c = at2(v, 2) - q;
    const T aa = magnitude(cross(b, c)), ab = magnitude(cross(c, a)), ac = magnitude(cross(a, b));
    const T sum = aa + ab + ac;
    w[0] = aa / sum;
    w[1] = ab / sum;
    w[2] = ac / sum;
    return 0;
}

/// The horizontal line through p meets two edges: interpolate on each, then along the line.
template <class T>
int bilinear(const T* v, const T* p, T* w) {
    Crossing<T, 3> corner[3];
    for (int i = 0; i < 3; ++i) {
        corner[i] = {v[2 * i], v[2 * i + 1], {}};
        corner[i].w[i] = 1;
    }
    along_scanline(corner, 3, p[0], p[1], w);
    return 0;
}

/// The determinant with rows (1, x, y), expanded along the ones: absolute coordinates are multiplied.
template <class T>
T homogeneous_area(Vector2<T> a, Vector2<T> b, Vector2<T> c) {
    return cross(b, c) - cross(a, c) + cross(a, b);
}

template <class T>
int homogeneous3(const T* v, const T* p, T* w) {
    const auto a = at2(v, 0), b = at2(v, 1), c = at2(v, 2), q = at2(p, 0);
    return over(homogeneous_area(a, b, c),
                {homogeneous_area(q, b, c), homogeneous_area(a, q, c), homogeneous_area(a, b, q)}, w);
}

}  // namespace
}  // namespace barycert::kernels
