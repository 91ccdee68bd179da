// Internal: the middle tier of quadratic interpolation: the refined weights of refinement-inl.hpp, and from them the
// value in double-double, with a proven bound.
//
// The form. As the weights sum to 1, l_i (2 l_i - 1) = l_i^2 - sum over j != i of l_i l_j, and the value is
//   P(l) = sum_i l_i (sum_{j >= i} l_j b_ij),    b_ii = f_i,    b_ij = 4 f_ij - f_i - f_j.
//
// u = 2^-53. W_i = l_i + c_i as refinement-inl.hpp has them, an exact sum by two_sum, off from the exact weight by at
// most eta; n of them, at most 4; A = sum |W_i|; M the largest |b_ij|, j >= i.
//
// From the weights: |P(W) - P(exact)| <= sum_{i <= j} |b_ij| (eta |W_i| + eta |W_j| + eta^2)
//   <= M (2 eta A + (n - 1) eta A + 10 eta^2) <= M eta (5 A + 10 eta).
// As the exact weights sum to 1, A >= 1 - 4 eta; with eta <= 2^-10 that is below 5.01 M eta A.
//
// From the arithmetic, with the errors of error_free-inl.hpp, relative to sum_{i <= j} |W_i W_j| M <= A^2 M:
//   b_ij: the sums f_i + f_j and 4 f_ij - (f_i + f_j) leave remainders <= 2.01 u M and 1.01 u M, whose difference is
//   rounded: 3.1 u^2; the product with W_j: 9 u^2; at most 3 sums: 12 u^2; the product with W_i: 9 u^2; at most 3 sums:
//   12 u^2. Together 45.1 u^2, and terms of order u^3.
// So M (6 eta A + 50 u^2 A^2) bounds both, the roundings of its own evaluation and of A and M (below 1 + 20 u)
// included.
//
// Ranges; outside them nothing is certain. They are those of the weights; eta <= 2^-10; A <= 2^100; M in [2^-800,
// 2^700] or 0: then all values are zero, and so is the result. |f_i| <= M, |4 f_ij| <= 3.1 M: products stay below
// 2^1000, and their factors below 2^903, so that Dekker's product is as good as the fused one and the tiers are the
// same on all targets. Underflow: each operation of a product loses at most 2^-1070; an inner one is multiplied by at
// most A. That is below 2^-1060 (1 + A) in all, against u^2 A^2 M >= 2^-907 A^2. A NaN or infinity among the values
// makes the sum NaN.
//
// Included once per SIMD target.
#if defined(BARYCERT_CORE_QUADRATIC_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_CORE_QUADRATIC_INL_HPP
#undef BARYCERT_CORE_QUADRATIC_INL_HPP
#else
#define BARYCERT_CORE_QUADRATIC_INL_HPP
#endif

#include "core/lanes.hpp"
#include "core/refinement-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::HWY_NAMESPACE {

/// Nodes of a cell: corners, and behind them the nodes amid the edges.
template <Simplex s>
inline constexpr int quadratic_nodes = vertex_count(s) + mid_node_count(s);

/// The terms that the values of all components share.
template <Simplex s, class D>
struct QuadraticWeights {
    using V = hn::Vec<D>;
    DoubleDouble<V> weight[vertex_count(s)];
    V error;            ///< of a value, relative to M: 6 eta A + 50 u^2 A^2
    hn::Mask<D> valid;  ///< not degenerate, and the ranges of the weights hold
};

template <Simplex s, class D, class V = hn::Vec<D>>
HWY_INLINE QuadraticWeights<s, D> quadratic_weights(D tag, const Refined<s, D>& r) {
    constexpr double u = 0x1p-53;
    QuadraticWeights<s, D> w;
    V magnitude = hn::Zero(tag);  // A
    for (int i = 0; i < vertex_count(s); ++i) {
        w.weight[i] = two_sum(r.weight[i], r.correction[i]);
        magnitude = magnitude + hn::Abs(w.weight[i].high);
    }
    w.error = magnitude * (hn::Set(tag, 6) * r.error + hn::Set(tag, 50 * u * u) * magnitude);
    w.valid =
        hn::And(r.valid, hn::And(hn::Le(r.error, hn::Set(tag, 0x1p-10)), hn::Le(magnitude, hn::Set(tag, 0x1p100))));
    return w;
}

template <class D>
struct QuadraticValue {
    DoubleDouble<hn::Vec<D>> value;
    hn::Vec<D> error;
    hn::Mask<D> valid;  ///< the ranges of the nodal values hold
};

/// The value of the field f, corners first. Where the weights are not valid nothing is said.
template <Simplex s, class D, class V = hn::Vec<D>>
HWY_INLINE QuadraticValue<D> refined_quadratic(D tag, const QuadraticWeights<s, D>& w,
                                               const V (&f)[quadratic_nodes<s>]) {
    constexpr int n = vertex_count(s);
    V max_b = hn::Abs(f[0]);  // M
    DoubleDouble<V> outer{};
    for (int i = n - 1; i >= 0; --i) {
        DoubleDouble<V> inner = w.weight[i] * DoubleDouble<V>{f[i], hn::Zero(tag)};
        max_b = hn::Max(max_b, hn::Abs(f[i]));
        for (int j = i + 1; j < n; ++j) {
            const TwoTerms<V> corners = two_sum(f[i], f[j]);
            const V mid = f[n + quadratic_edge(i, j)];
            const TwoTerms<V> rest = two_difference(hn::Set(tag, 4) * mid, corners.high);
            const TwoTerms<V> b = two_sum(rest.high, rest.low - corners.low);
            inner = inner + w.weight[j] * b;
            max_b = hn::Max(max_b, hn::Abs(b.high));
        }
        const DoubleDouble<V> term = w.weight[i] * inner;
        outer = i == n - 1 ? term : outer + term;
    }
    return {outer, max_b * w.error, hn::Or(hn::Eq(max_b, hn::Zero(tag)), within(tag, max_b, 0x1p-800, 0x1p700))};
}

/// The value correctly rounded; `certain` is cleared where it may not be.
template <Simplex s, class D, class V = hn::Vec<D>>
HWY_INLINE V quadratic_value(D tag, const QuadraticWeights<s, D>& w, const V (&f)[quadratic_nodes<s>],
                             hn::Mask<D>& certain) {
    const QuadraticValue<D> q = refined_quadratic<s>(tag, w, f);
    certain = hn::And(certain, q.valid);
    // + 0: an exact zero is positive
    return rounded_sum(tag, q.value.high, q.value.low, q.error, certain) + hn::Zero(tag);
}

}  // namespace barycert::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
