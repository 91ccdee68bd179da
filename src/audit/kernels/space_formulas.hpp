/// Weights on a segment a b and in a triangle a b c of 3-space. Notation and linkage: vectors.hpp.
#pragma once

#include "audit/kernels/triangle_formulas.hpp"

namespace barycert::kernels {
namespace {

/// Signed lengths along one coordinate axis. They are lengths of the projection onto that axis, so a segment
/// perpendicular to it is declared degenerate although its ends differ.
template <class T>
int signed_length(const T* v, const T* p, T* w, int axis) {
    const T xa = v[axis], xb = v[3 + axis], xp = p[axis];
    return over(xb - xa, {xb - xp, xp - xa}, w);
}

template <class T>
int signed_length_x(const T* v, const T* p, T* w) {
    return signed_length(v, p, w, 0);
}

/// Signed lengths along the axis on which the segment is longest.
template <class T>
int dominant_axis(const T* v, const T* p, T* w) {
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        if (magnitude(v[3 + i] - v[i]) > magnitude(v[3 + axis] - v[axis])) axis = i;
    }
    return signed_length(v, p, w, axis);
}

/// t = (p-a).(b-a) / (b-a).(b-a), the parameter of the orthogonal projection.
template <class T>
int segment_projection(const T* v, const T* p, T* w) {
    const auto a = at3(v, 0), direction = at3(v, 1) - a;
    const T whole = dot(direction, direction);
    if (whole == 0) return 1;
    w[1] = dot(at3(p, 0) - a, direction) / whole;
    w[0] = 1 - w[1];
    return 0;
}

// A triangle a b c.

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
    return over(dot(normal, normal),
                {dot(normal, cross(c - b, q - b)), dot(normal, cross(a - c, q - c)), dot(normal, cross(b - a, q - a))},
                w);
}

}  // namespace
}  // namespace barycert::kernels
