/// Weights on a segment a b in 3-space. Notation and linkage: vectors.hpp.
#pragma once

#include "barycert/kernels/vectors.hpp"

namespace barycert::kernels {
namespace {

/// Signed lengths along one coordinate axis. They are lengths of the projection onto that axis, so a segment
/// perpendicular to it is declared degenerate although its ends differ.
template <class T>
int signed_length(const T* v, const T* p, T* w, int axis) {
    const T xa = v[axis], xb = v[3 + axis], xp = p[axis];
    const T whole = xb - xa;
    if (whole == 0) return 1;
    w[0] = (xb - xp) / whole;
    w[1] = (xp - xa) / whole;
    return 0;
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

}  // namespace
}  // namespace barycert::kernels
