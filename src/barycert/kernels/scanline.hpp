/// Interpolation by auxiliary lines, as a scan converter does it. Notation and linkage: vectors.hpp.
///
///            o         The line y = const through p meets two sides of a convex polygon in l and r. Interpolate on
///           / \        the two sides, then from l to r:
///          l-p-r           p = (1-u) l + u r.
///         /     \      At a topmost or lowest corner l and r coincide and u is 0/0.
///        o-------o
#pragma once

namespace barycert::kernels {
namespace {

/// A corner of the polygon or a point of a side, with its own weights in the n vertices of the simplex.
template <class T, int n>
struct Crossing {
    T x, y;
    T w[n];
};

/// Where the parameter runs from 0 at `from` to 1 at `to`.
template <class T, int n>
Crossing<T, n> between(const Crossing<T, n>& from, const Crossing<T, n>& to, T t) {
    Crossing<T, n> m;
    m.x = (1 - t) * from.x + t * to.x;
    m.y = (1 - t) * from.y + t * to.y;
    for (int i = 0; i < n; ++i) m.w[i] = (1 - t) * from.w[i] + t * to.w[i];
    return m;
}

/// Which of `count` numbers lie above the level, as a mask that is neither empty nor full unless all are equal. A
/// level beyond the extremes splits at the extreme, so that points outside are extrapolated.
template <class T>
unsigned above(const T* number, int count, T level) {
    T lowest = number[0], highest = number[0];
    for (int i = 1; i < count; ++i) {
        lowest = number[i] < lowest ? number[i] : lowest;
        highest = number[i] > highest ? number[i] : highest;
    }
    const T split = level < lowest ? lowest : level;
    unsigned mask = 0;
    for (int i = 0; i < count; ++i) {
        const bool up = split < highest ? number[i] > split : number[i] == highest;
        mask |= static_cast<unsigned>(up) << i;
    }
    return mask;
}

/// Weights of (x, y) by the two sides that the line through it crosses; a polygon that is flat in y has none and is
/// given u = 0/0, as everything else that this method cannot do.
template <class T, int n>
void along_scanline(const Crossing<T, n>* corner, int corners, T x, T y, T* w) {
    T height[4];
    for (int i = 0; i < corners; ++i) height[i] = corner[i].y;
    const unsigned up = above(height, corners, y);
    Crossing<T, n> end[2] = {corner[0], corner[0]};
    for (int i = 0, found = 0; i < corners && found < 2; ++i) {
        const int j = i + 1 == corners ? 0 : i + 1;
        if (((up >> i) & 1U) == ((up >> j) & 1U)) continue;
        end[found++] = between(corner[i], corner[j], (y - height[i]) / (height[j] - height[i]));
    }
    const T u = (x - end[0].x) / (end[1].x - end[0].x);
    for (int i = 0; i < n; ++i) w[i] = (1 - u) * end[0].w[i] + u * end[1].w[i];
}

}  // namespace
}  // namespace barycert::kernels
