/// The few vector operations that the formulas are written in.
///
/// Everything here and in the *_formulas.hpp headers has internal linkage and uses the language alone, no library:
/// each source file that includes them gets its own copy under its own compiler flags, and no copy can stand in for
/// another at link time (the variants with -ffast-math or -mfma depend on that).
///
/// Notation of all formula headers: T is the scalar; v the vertices, vertex after vertex; a, b, c, d the vertices; p
/// the point; w the weights that leave. A formula returns 0, or 1 where it declares the simplex degenerate.
#pragma once

namespace barycert::kernels {
namespace {

template <class T>
struct Vector2 {
    T x, y;
    friend Vector2 operator-(Vector2 a, Vector2 b) { return {a.x - b.x, a.y - b.y}; }
};

template <class T>
struct Vector3 {
    T x, y, z;
    friend Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
};

/// Vertex i of a simplex.
template <class T>
Vector2<T> at2(const T* v, int i) {
    return {v[2 * i], v[2 * i + 1]};
}
template <class T>
Vector3<T> at3(const T* v, int i) {
    return {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
}

template <class T>
T cross(Vector2<T> a, Vector2<T> b) {
    return a.x * b.y - a.y * b.x;
}
template <class T>
Vector3<T> cross(Vector3<T> a, Vector3<T> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T dot(Vector3<T> a, Vector3<T> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The 3x3 determinant with rows a, b, c, expanded along the first row.
template <class T>
T determinant(Vector3<T> a, Vector3<T> b, Vector3<T> c) {
    return dot(a, cross(b, c));
}

/// Each weight its part of the whole; 1 where that is zero.
template <class T, int n>
int over(T whole, const T (&part)[n], T* w) {
    if (whole == 0) return 1;
    for (int i = 0; i < n; ++i) w[i] = part[i] / whole;
    return 0;
}

template <class T>
T magnitude(T x) {
    return x < 0 ? -x : x;
}

}  // namespace
}  // namespace barycert::kernels
