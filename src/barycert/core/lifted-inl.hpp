// Internal: the in-circle and in-sphere polynomials, in any arithmetic T with + - *.
//
// Notation of numerators-inl.hpp: r_i = v_i - p, n_i the numerators of the weights of p. The vectors n_i r_i add up to
// zero. So with the centre c and the radius R of the circumsphere
//     R^2 = |v_i - c|^2 = |r_i|^2 + 2 r_i.(p - c) + |p - c|^2,
//     sum n_i |r_i|^2 = (R^2 - |p - c|^2) sum n_i,
// and sum n_i is the orientation. The sum on the left is, up to its sign, the classical determinant of the rows
// (r_i, |r_i|^2), expanded along the last column; so it has a meaning for flat simplices too.
//
// The bounds in predicates.cpp and the widths in exact_weights.cpp follow from these formulas.
//
// Included once per SIMD target (see Highway's foreach_target.h), hence no #pragma once.
#if defined(BARYCERT_CORE_LIFTED_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_LIFTED_INL_HPP
#undef BARYCERT_CORE_LIFTED_INL_HPP
#else
#define BARYCERT_CORE_LIFTED_INL_HPP
#endif

#include "barycert/core/numerators-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core {
namespace HWY_NAMESPACE {

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
    for (int i = 0; i < vertex_count(s); ++i) {
        const auto& r = c.r[i];
        if constexpr (s == Simplex::tetrahedron) {
            square[i] = dot(r, r);
        } else {
            square[i] = r[0] * r[0] + r[1] * r[1];
        }
    }
    if constexpr (s == Simplex::tetrahedron) {
        out.sum = (n[0] * square[0] + n[1] * square[1]) + (n[2] * square[2] + n[3] * square[3]);
    } else {
        out.sum = n[0] * square[0] + n[1] * square[1] + n[2] * square[2];
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::core
HWY_AFTER_NAMESPACE();
#endif
