/// Scan conversion by increments. Notation and linkage: vectors.hpp.
///
/// From the lowest vertex upwards, x and the attributes on the two sides are stepped by a constant for each unit of y;
/// then, on the scanline, the attributes by a constant for each unit of x. Each step rounds, so that the error grows
/// with their number. The point need not lie a whole number of steps away: the last step is a fraction of one.
#pragma once

namespace barycert::kernels {
namespace {

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
    T other[n], step[n];
    along_side(v[0], v[2], y, out);
    along_side(v[upper ? 1 : 0], v[upper ? 2 : 1], y, other);
    if (other[0] < out[0]) {
        for (int i = 0; i < n; ++i) {
            const T left = other[i];
            other[i] = out[i];
            out[i] = left;
        }
    }
    for (int i = 0; i < n; ++i) step[i] = (other[i] - out[i]) / (other[0] - out[0]);
    walk(out, step, x - out[0]);
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
