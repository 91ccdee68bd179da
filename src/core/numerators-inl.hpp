// Internal: the weights of a point as fractions numerator_i / denominator, in any arithmetic T with + - *.
//
// The one place where the formulas stand: the filter evaluates them in double, the middle tier in double-double, the
// last tier in integers. Each caller bounds the error of its arithmetic by the depth and the terms of these formulas,
// so a change here changes the constants in filter-inl.hpp, refinement-inl.hpp and predicates.cpp, and the widths in
// exact_weights.cpp, integer.hpp and mesh/index/exact_volumes.cpp.
//
// Notation. v_i the vertices, p the point, r_i = v_i - p; x: cross product; . : dot product.
//   tetrahedron  n_0 = r_1.(r_2 x r_3), n_1 = -r_0.(r_2 x r_3), n_2 = r_3.(r_0 x r_1), n_3 = -r_2.(r_0 x r_1)
//                the signed volumes, times 6, of the cell with v_i replaced by p; d = sum n_i, that of the cell
//   triangle     n_i = r_{i+1} x r_{i+2}, twice the signed areas; d = sum n_i
//   triangle3d   n_i = N.(r_{i+1} x r_{i+2}), N = (v_1 - v_0) x (v_2 - v_0), d = N.N
//   segment      n_0 = r_1.e, n_1 = -r_0.e, e = v_1 - v_0, d = e.e
// The last two give the weights of the orthogonal projection of p: a component of p along N, or normal to e, drops out
// of the dot products.
//
// Included once per SIMD target (see Highway's foreach_target.h), hence no #pragma once.
#if defined(BARYCERT_CORE_NUMERATORS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_NUMERATORS_INL_HPP
#undef BARYCERT_CORE_NUMERATORS_INL_HPP
#else
#define BARYCERT_CORE_NUMERATORS_INL_HPP
#endif

#include "core/simd_targets.hpp"
// After the targets.
#include <hwy/highway.h>

#include <type_traits>
#include <utility>

#include "barycert/simplex.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::HWY_NAMESPACE {

/// Vertices relative to the point and, for the simplices that are projected on, edges from vertex 0.
template <Simplex s, class T>
struct Relative {
    static constexpr int n = vertex_count(s), d = space_dimension(s);
    static constexpr bool projected = s == Simplex::segment || s == Simplex::triangle3d;
    T r[n][d];
    T e[projected ? n - 1 : 1][d];  ///< v_{i+1} - v_0; unused unless projected
};

/// The type of a product: integers of fixed width grow, other arithmetics stay what they are.
template <class T, class U = T>
using Product = decltype(std::declval<T>() * std::declval<U>());

/// The type of numerators and denominator, which are made of products of 2 (segment, triangle), 3 or 4 differences.
template <Simplex s, class T>
using Numerator =
    std::conditional_t<s == Simplex::tetrahedron, Product<T, Product<T>>,
                       std::conditional_t<s == Simplex::triangle3d, Product<Product<T>, Product<T>>, Product<T>>>;

template <Simplex s, class T>
struct Fractions {
    Numerator<s, T> numerator[vertex_count(s)];
    Numerator<s, T> denominator;
};

template <class T>
HWY_INLINE Product<T> cross(const T (&x)[2], const T (&y)[2]) {
    return x[0] * y[1] - x[1] * y[0];
}

template <class T>
HWY_INLINE void cross(const T (&x)[3], const T (&y)[3], Product<T> (&out)[3]) {
    out[0] = x[1] * y[2] - x[2] * y[1];
    out[1] = x[2] * y[0] - x[0] * y[2];
    out[2] = x[0] * y[1] - x[1] * y[0];
}

template <class T>
HWY_INLINE Product<T> dot(const T (&x)[2], const T (&y)[2]) {
    return x[0] * y[0] + x[1] * y[1];
}
template <class T, class U>
HWY_INLINE Product<T, U> dot(const T (&x)[3], const U (&y)[3]) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// The determinant of the rows.
template <class T>
HWY_INLINE Product<T> determinant(const T (&rows)[2][2]) {
    return cross(rows[0], rows[1]);
}
template <class T>
HWY_INLINE Product<T, Product<T>> determinant(const T (&rows)[3][3]) {
    Product<T> minors[3];
    cross(rows[1], rows[2], minors);
    return dot(rows[0], minors);
}

/// `zero` is the number 0 of the arithmetic: subtracting from it is exact in every one of them.
template <Simplex s, class T>
HWY_INLINE void solve(const Relative<s, T>& c, const Numerator<s, T>& zero, Fractions<s, T>& out) {
    const auto& r = c.r;
    auto& n = out.numerator;
    if constexpr (s == Simplex::tetrahedron) {
        Product<T> m01[3], m23[3];
        cross(r[0], r[1], m01);
        cross(r[2], r[3], m23);
        n[0] = dot(r[1], m23);
        n[1] = zero - dot(r[0], m23);
        n[2] = dot(r[3], m01);
        n[3] = zero - dot(r[2], m01);
        out.denominator = (n[0] + n[1]) + (n[2] + n[3]);
    } else if constexpr (s == Simplex::triangle) {
        for (int i = 0; i < 3; ++i) n[i] = cross(r[(i + 1) % 3], r[(i + 2) % 3]);
        out.denominator = n[0] + n[1] + n[2];
    } else if constexpr (s == Simplex::triangle3d) {
        Product<T> normal[3], m[3];
        cross(c.e[0], c.e[1], normal);
        for (int i = 0; i < 3; ++i) {
            cross(r[(i + 1) % 3], r[(i + 2) % 3], m);
            n[i] = dot(normal, m);
        }
        out.denominator = dot(normal, normal);
    } else {
        n[0] = dot(r[1], c.e[0]);
        n[1] = zero - dot(r[0], c.e[0]);
        out.denominator = dot(c.e[0], c.e[0]);
    }
}

// The in-circle and in-sphere polynomials, for which predicates.cpp has the bounds and exact_weights.cpp the widths.
// The vectors n_i r_i add up to zero. So with the centre c and the radius R of the circumsphere
//     R^2 = |v_i - c|^2 = |r_i|^2 + 2 r_i.(p - c) + |p - c|^2,
//     sum n_i |r_i|^2 = (R^2 - |p - c|^2) sum n_i,
// and sum n_i is the orientation. The sum on the left is, up to its sign, the classical determinant of the rows
// (r_i, |r_i|^2), expanded along the last column; so it has a meaning for flat simplices too.

template <Simplex s, class T>
struct Lifted {
    static_assert(s == Simplex::triangle || s == Simplex::tetrahedron);
    Product<T> square[vertex_count(s)];        ///< |r_i|^2
    Product<Numerator<s, T>, Product<T>> sum;  ///< of n_i |r_i|^2
};

template <Simplex s, class T>
HWY_INLINE void lift(const Relative<s, T>& c, Lifted<s, T>& out) {
    Fractions<s, T> f;
    solve(c, Numerator<s, T>{}, f);
    const auto& n = f.numerator;
    auto& square = out.square;
    for (int i = 0; i < vertex_count(s); ++i) square[i] = dot(c.r[i], c.r[i]);
    if constexpr (s == Simplex::tetrahedron) {
        out.sum = (n[0] * square[0] + n[1] * square[1]) + (n[2] * square[2] + n[3] * square[3]);
    } else {
        out.sum = n[0] * square[0] + n[1] * square[1] + n[2] * square[2];
    }
}

}  // namespace barycert::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
