/// Interpolation by auxiliary lines or by increments, as scan converters do it. Notation and linkage: vectors.hpp.
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

// By increments. From the lowest vertex upwards, x and the attributes on the two sides are stepped by a constant for
// each unit of y; then, on the scanline, the attributes by a constant for each unit of x. Each step rounds, so that the
// error grows with their number. The point need not lie a whole number of steps away: the last step is a fraction of
// one.

/// Beyond so many steps the rest is jumped in one product, as is a negative distance: a kernel must come to an end.
constexpr int max_steps = 1 << 14;

/// a += step, `distance` times.
template <class T, int n>
void walk(T (&a)[n], const T (&step)[n], T distance) {
    if (distance >= 0 && distance <= max_steps) {
        const int whole = static_cast<int>(distance);
        for (int k = 0; k < whole; ++k) {
            for (int i = 0; i < n; ++i) a[i] += step[i];
        }
        distance -= static_cast<T>(whole);
    }
    for (int i = 0; i < n; ++i) a[i] += step[i] * distance;
}

/// A vertex: y, and behind x what is stepped along with it.
template <class T, int n>
struct Stepped {
    T y;
    T a[n];
};

/// `from`, walked along the side to `to` up to the height y.
template <class T, int n>
void along_side(const Stepped<T, n>& from, const Stepped<T, n>& to, T y, T (&out)[n]) {
    T step[n];
    for (int i = 0; i < n; ++i) {
        step[i] = (to.a[i] - from.a[i]) / (to.y - from.y);
        out[i] = from.a[i];
    }
    walk(out, step, y - from.y);
}

/// The attributes at (x, y): out[0] is x again. Sorts the vertices. At a topmost or lowest vertex, where the sides
/// meet, the step along the scanline is 0/0, as are all in a triangle that is flat in y.
template <class T, int n>
void by_increments(Stepped<T, n> (&v)[3], T x, T y, T (&out)[n]) {
    for (int pass = 0; pass < 3; ++pass) {
        const int i = pass % 2;  // 01 12 01: a sort of three
        if (!(v[i + 1].y < v[i].y)) continue;
        const Stepped<T, n> other = v[i];
        v[i] = v[i + 1];
        v[i + 1] = other;
    }
    const bool upper = y < v[1].y ? !(v[0].y < v[1].y) : v[1].y < v[2].y;
    T side[2][n], step[n];
    along_side(v[0], v[2], y, side[0]);
    along_side(v[upper ? 1 : 0], v[upper ? 2 : 1], y, side[1]);
    const bool swapped = side[1][0] < side[0][0];
    const T *const left = side[swapped ? 1 : 0], *const right = side[swapped ? 0 : 1];
    for (int i = 0; i < n; ++i) {
        out[i] = left[i];
        step[i] = (right[i] - left[i]) / (right[0] - left[0]);
    }
    walk(out, step, x - left[0]);
}

/// The weights are stepped as three attributes, each 1 at a vertex and 0 at the others.
template <class T>
int increments(const T* v, const T* p, T* w) {
    Stepped<T, 4> corner[3];
    for (int i = 0; i < 3; ++i) {
        corner[i] = {v[2 * i + 1], {v[2 * i], 0, 0, 0}};
        corner[i].a[1 + i] = 1;
    }
    T out[4];
    by_increments(corner, p[0], p[1], out);
    for (int i = 0; i < 3; ++i) w[i] = out[1 + i];
    return 0;
}

/// The value: the attribute itself is stepped.
template <class T>
T incremented_value(const T* v, const T* p, const T* f) {
    Stepped<T, 2> corner[3];
    for (int i = 0; i < 3; ++i) corner[i] = {v[2 * i + 1], {v[2 * i], f[i]}};
    T out[2];
    by_increments(corner, p[0], p[1], out);
    return out[1];
}

}  // namespace
}  // namespace barycert::kernels
