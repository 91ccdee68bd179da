/// Weights in a tetrahedron a b c d. Notation and linkage: vectors.hpp.
///
/// V(q0,q1,q2,q3) = det(q1-q0, q2-q0, q3-q0) is six times the signed volume.
#pragma once

#include "audit/kernels/scanline.hpp"
#include "audit/kernels/vectors.hpp"

namespace barycert::kernels {
namespace {

template <class T>
T volume(Vector3<T> q0, Vector3<T> q1, Vector3<T> q2, Vector3<T> q3) {
    return determinant(q1 - q0, q2 - q0, q3 - q0);
}

template <class T>
T volume(const T* v) {
    return volume(at3(v, 0), at3(v, 1), at3(v, 2), at3(v, 3));
}

/// Each weight a volume with the point first, over `whole`; the order of the vertices carries the sign.
template <class T>
void volumes_over(T whole, const T* v, const T* p, T* w) {
    const auto a = at3(v, 0), b = at3(v, 1), c = at3(v, 2), d = at3(v, 3), q = at3(p, 0);
    w[0] = volume(q, b, c, d) / whole;
    w[1] = volume(q, a, d, c) / whole;
    w[2] = volume(q, a, b, d) / whole;
    w[3] = volume(q, a, c, b) / whole;
}

/// Volumes with the point in place of a vertex over V(a,b,c,d).
template <class T>
int signed_volume(const T* v, const T* p, T* w) {
    const T whole = volume(v);
    if (whole == 0) return 1;
    volumes_over(whole, v, p, w);
    return 0;
}

/// With a, b, c, d relative to the point, a x b and c x d hold all four determinants; their sum is the whole.
template <class T>
int two_cross_products(const T* v, const T* p, T* w) {
    const auto q = at3(p, 0), a = at3(v, 0) - q, b = at3(v, 1) - q, c = at3(v, 2) - q, d = at3(v, 3) - q;
    const auto ab = cross(a, b), cd = cross(c, d);
    const T va = dot(b, cd), vb = -dot(a, cd), vc = dot(ab, d), vd = -dot(ab, c);
    const T sum = va + vb + vc + vd;
    if (sum == 0) return 1;
    w[0] = va / sum;
    w[1] = vb / sum;
    w[2] = vc / sum;
    w[3] = vd / sum;
    return 0;
}

/// Volumes without sign over their sum: right inside, positive everywhere.
template <class T>
int unsigned_volume(const T* v, const T* p, T* w) {
    const auto a = at3(v, 0), b = at3(v, 1), c = at3(v, 2), d = at3(v, 3), q = at3(p, 0);
    w[0] = magnitude(volume(q, b, c, d));
    w[1] = magnitude(volume(q, a, d, c));
    w[2] = magnitude(volume(q, a, b, d));
    w[3] = magnitude(volume(q, a, c, b));
    const T sum = w[0] + w[1] + w[2] + w[3];
    for (int i = 0; i < 4; ++i) w[i] /= sum;
    return 0;
}

/// Cramer's rule for (a-o, b-o, c-o) x = p-o with the vertex o as origin: three weights in `x`.
template <class T>
int cramer_rule(Vector3<T> o, Vector3<T> a, Vector3<T> b, Vector3<T> c, Vector3<T> q, T* whole, T* x) {
    const auto oa = a - o, ob = b - o, oc = c - o, oq = q - o;
    *whole = determinant(oa, ob, oc);
    if (*whole == 0) return 1;
    x[0] = determinant(oq, ob, oc) / *whole;
    x[1] = determinant(oa, oq, oc) / *whole;
    x[2] = determinant(oa, ob, oq) / *whole;
    return 0;
}

/// Origin d; the fourth weight is its own determinant, V(p,a,b,c) = det(a-p, b-p, c-p).
template <class T>
int cramer(const T* v, const T* p, T* w) {
    const auto a = at3(v, 0), b = at3(v, 1), c = at3(v, 2), d = at3(v, 3), q = at3(p, 0);
    T whole;
    if (cramer_rule(d, a, b, c, q, &whole, w) != 0) return 1;
    w[3] = volume(q, a, b, c) / whole;
    return 0;
}

/// Origin d; the fourth weight is what is left of 1.
template <class T>
int one_minus_sum(const T* v, const T* p, T* w) {
    T whole;
    if (cramer_rule(at3(v, 3), at3(v, 0), at3(v, 1), at3(v, 2), at3(p, 0), &whole, w) != 0) return 1;
    w[3] = 1 - w[0] - w[1] - w[2];
    return 0;
}

/// Origin a; the first weight is what is left of 1. Inside is read from it with a tolerance (Kernel::tolerance).
template <class T>
int parametric(const T* v, const T* p, T* w) {
    T whole;
    if (cramer_rule(at3(v, 0), at3(v, 1), at3(v, 2), at3(v, 3), at3(p, 0), &whole, w + 1) != 0) return 1;
    w[0] = 1 - w[1] - w[2] - w[3];
    return 0;
}

/// The determinant with rows (1, x, y, z), expanded along the ones: absolute coordinates are multiplied.
template <class T>
T homogeneous_volume(Vector3<T> a, Vector3<T> b, Vector3<T> c, Vector3<T> d) {
    return determinant(b, c, d) - determinant(a, c, d) + determinant(a, b, d) - determinant(a, b, c);
}

template <class T>
int homogeneous4(const T* v, const T* p, T* w) {
    const auto a = at3(v, 0), b = at3(v, 1), c = at3(v, 2), d = at3(v, 3), q = at3(p, 0);
    return over(homogeneous_volume(a, b, c, d),
                {homogeneous_volume(q, b, c, d), homogeneous_volume(a, q, c, d), homogeneous_volume(a, b, q, d),
                 homogeneous_volume(a, b, c, q)},
                w);
}

/// The plane z = p.z meets three or four edges: interpolate on each. The line y = p.y in that plane meets two sides
/// of the section, each in a face: interpolate on each, then along the line.
template <class T>
int trilinear(const T* v, const T* p, T* w) {
    const T height[4] = {v[2], v[5], v[8], v[11]};
    const unsigned up = above(height, 4, p[2]);
    int high[4] = {}, low[4] = {}, highs = 0, lows = 0;
    for (int i = 0; i < 4; ++i) {
        if ((up >> i) & 1U) {
            high[highs++] = i;
        } else {
            low[lows++] = i;
        }
    }
    // The crossed edges, in cyclic order around the section; neighbours share a face. Without lows (a tetrahedron flat
    // in z) the edges run from a vertex to itself and the parameter is 0/0.
    const int edges = highs == 2 ? 4 : 3;
    Crossing<T, 4> corner[4];
    for (int k = 0; k < edges; ++k) {
        const int i = highs == 2 ? high[k / 2] : highs == 1 ? high[0] : high[k];
        const int j = highs == 2 ? low[k == 1 || k == 2] : lows == 3 ? low[k] : low[0];
        const T t = (p[2] - height[i]) / (height[j] - height[i]);
        corner[k] = {(1 - t) * v[3 * i] + t * v[3 * j], (1 - t) * v[3 * i + 1] + t * v[3 * j + 1], {}};
        corner[k].w[i] = 1 - t;
        corner[k].w[j] = t;
    }
    along_scanline(corner, edges, p[0], p[1], w);
    return 0;
}

}  // namespace
}  // namespace barycert::kernels
