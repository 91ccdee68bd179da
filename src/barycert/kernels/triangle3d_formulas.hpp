/// Weights in a triangle a b c of 3-space. Notation and linkage: vectors.hpp.
#pragma once

#include "barycert/kernels/triangle_formulas.hpp"
#include "barycert/kernels/vectors.hpp"

namespace barycert::kernels {
namespace {

/// Drop the axis of the largest component of the normal, then signed areas in the plane of the other two. A point off
/// the plane is thereby projected along that axis, not along the normal.
template <class T>
int dominant_plane(const T* v, const T* p, T* w) {
    const auto a = at3(v, 0);
    const auto normal = cross(at3(v, 1) - a, at3(v, 2) - a);
    const T nx = magnitude(normal.x), ny = magnitude(normal.y), nz = magnitude(normal.z);
    const int drop = nx >= ny && nx >= nz ? 0 : ny >= nz ? 1 : 2;
    const int i = drop == 0 ? 1 : 0, j = drop == 2 ? 1 : 2;
    const T flat[6] = {v[i], v[j], v[3 + i], v[3 + j], v[6 + i], v[6 + j]};
    const T point[2] = {p[i], p[j]};
    return signed_area(flat, point, w);
}

/// The normal equations: the Gram matrix of ab and ac, solved by Cramer's rule.
template <class T>
int gram(const T* v, const T* p, T* w) {
    const auto a = at3(v, 0), ab = at3(v, 1) - a, ac = at3(v, 2) - a, ap = at3(p, 0) - a;
    const T bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac), pb = dot(ap, ab), pc = dot(ap, ac);
    const T whole = bb * cc - bc * bc;
    w[1] = (cc * pb - bc * pc) / whole;
    w[2] = (bb * pc - bc * pb) / whole;
    w[0] = 1 - w[1] - w[2];
    return 0;
}

/// W_a = n.(bc x bp) / n.n and cyclic, with n = ab x ac.
template <class T>
int cross_product(const T* v, const T* p, T* w) {
    const auto a = at3(v, 0), b = at3(v, 1), c = at3(v, 2), q = at3(p, 0);
    const auto normal = cross(b - a, c - a);
    const T whole = dot(normal, normal);
    if (whole == 0) return 1;
    w[0] = dot(normal, cross(c - b, q - b)) / whole;
    w[1] = dot(normal, cross(a - c, q - c)) / whole;
    w[2] = dot(normal, cross(b - a, q - a)) / whole;
    return 0;
}

}  // namespace
}  // namespace barycert::kernels
